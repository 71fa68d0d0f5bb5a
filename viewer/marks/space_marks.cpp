// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/marks/space_marks.h"

#include <string>
#include <utility>

#include "viewer/marks/axes.h"
#include "viewer/marks/ground_grid.h"

namespace arete {
namespace {

/// The name, unless a layer of another kind has it.
std::string freeName(const Layers& layers, const char* name) {
  const Layer* const found = layers.find(name);
  return found && !std::holds_alternative<SpaceVertices>(found->content) ? std::string(name) + " of the view"
                                                                         : std::string(name);
}

}  // namespace

void laySpaceMarks(Layers& layers, const SpaceMarks& marks, const Subject& subject, const Camera& camera,
                   const std::optional<OrbitPlace>& orbit, double stretch) {
  const auto lay = [&](const char* stated, bool isShown, auto&& make) {
    const std::string name = freeName(layers, stated);
    if (!isShown) return layers.remove(name);
    MarkLines made = make();
    Layer& layer = layers.put(name, std::move(made.lines));
    layer.legend = std::move(made.legend);
  };
  lay(SpaceMarks::kGrid, marks.grid, [&] { return groundGrid(subject); });
  lay(SpaceMarks::kAxes, marks.axes, [&] { return axesOfFile(subject, camera, stretch); });
  lay(SpaceMarks::kOrbit, marks.orbit && orbit, [&] { return MarkLines{orbitMark(*orbit)}; });
}

}  // namespace arete
