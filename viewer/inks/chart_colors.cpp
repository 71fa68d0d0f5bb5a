// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/inks/chart_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/model/charts.h"
#include "viewer/color/color_tables.h"

namespace arete {
namespace {

void put(std::vector<std::uint8_t>& colors, std::size_t vertex, const Rgba& c) {
  const std::array<std::uint8_t, 4> bytes = {c.r, c.g, c.b, 255};
  std::ranges::copy(bytes, colors.begin() + std::ptrdiff_t(4 * vertex));
}

std::size_t drawnCount(const SurfaceModel& model) {
  return model.hasWedges() ? model.attributes.wedgeCount : model.mt.vertexCount();
}

/// Calls visit(triangle, drawn corners) for the triangles of the finest front.
template <class Visit>
void forFinestTriangles(const SurfaceModel& model, const Visit& visit) {
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    if (!model.mt.remover(TriangleId(t)).isValid())
      visit(t, model.hasWedges() ? model.wedgesOf[t] : model.mt.corners(TriangleId(t)));
}

}  // namespace

Result<ComputedColors> chartColors(const SurfaceModel& model) {
  const std::vector<std::uint32_t> charts = chartsOf(model);
  if (charts.empty())
    return failure(ErrorCode::usage, "the surface has no seams and no edges between parts", "charts");
  const auto table = classColors();
  ComputedColors made{.colors = std::vector<std::uint8_t>(4 * drawnCount(model), 255), .legend = {}};
  std::uint32_t count = 0;
  forFinestTriangles(model, [&](std::uint32_t t, const auto& corners) {
    count = std::max(count, charts[t] + 1);
    const Rgb c = table[charts[t] % table.size()];
    for (const std::uint32_t v : corners) put(made.colors, v, {c.r, c.g, c.b, 255});
  });
  made.legend.title = fmt::format("charts: {}", count);
  return made;
}

Result<ComputedColors> stretchColors(const SurfaceModel& model) {
  const Attribute* coords = nullptr;
  const bool isOfWedges = model.hasWedges();
  for (const Attribute& a : model.attributes.vertexAttributes)
    if (a.name == kTexcoordName && a.components >= 2) coords = &a;
  bool areWedges = false;
  for (const Attribute& a : model.attributes.wedgeAttributes)
    if (isOfWedges && a.name == kTexcoordName && a.components >= 2) coords = &a, areWedges = true;
  if (!coords) return failure(ErrorCode::usage, "the surface has no texture coordinates", "stretch");
  struct Sum {
    double onSurface = 0, inPicture = 0;
  };
  std::vector<Sum> of(drawnCount(model));
  Sum whole;
  const auto areaOf = [&](std::uint32_t t, const std::array<std::uint32_t, 3>& corners) {
    const auto ids = model.mt.corners(TriangleId(t));
    std::array<std::vector<double>, 3> uv;
    for (std::size_t c = 0; c < 3; ++c) uv[c] = coords->numbers(areWedges ? corners[c] : ids[c]);
    return ((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[2][0] - uv[0][0]) * (uv[1][1] - uv[0][1])) /
           2;
  };
  forFinestTriangles(model, [&](std::uint32_t t, const auto& corners) {
    const auto ids = model.mt.corners(TriangleId(t));
    const auto at = [&](std::size_t c) { return model.mt.position(VertexId(ids[c])); };
    const double surface = norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
    const double picture = std::abs(areaOf(t, corners));
    if (!std::isfinite(picture)) return;
    whole.onSurface += surface;
    whole.inPicture += picture;
    for (const std::uint32_t v : corners) {
      of[v].onSurface += surface;
      of[v].inPicture += picture;
    }
  });
  if (!(whole.inPicture > 0))
    return failure(ErrorCode::usage, "the texture coordinates cover nothing", "stretch");
  constexpr double kOctaves = 3;
  const ColorMap& map = colorTable("difference");
  ComputedColors made{.colors = std::vector<std::uint8_t>(4 * of.size(), 255), .legend = {}};
  for (std::size_t v = 0; v < of.size(); ++v) {
    const double ratio = of[v].inPicture > 0
                             ? of[v].onSurface / of[v].inPicture * whole.inPicture / whole.onSurface
                             : std::exp2(kOctaves);
    put(made.colors, v, map.at(std::clamp(std::log2(std::max(ratio, 1e-300)) / kOctaves, -1.0, 1.0)));
  }
  made.legend.title = "stretch of the picture";
  for (const double octave : {3.0, 1.5, 0.0, -1.5, -3.0})
    made.legend.entries.push_back(
        {map.at(octave / kOctaves), fmt::format("{:.3g} times", std::exp2(octave)), Legend::Mark::area});
  return made;
}

}  // namespace arete
