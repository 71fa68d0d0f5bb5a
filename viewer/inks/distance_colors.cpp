// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/inks/distance_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "measure/nearest_on_mesh.h"
#include "viewer/color/color_tables.h"

namespace arete {
namespace {

constexpr std::size_t kPerTask = 512;

Rgba colorAt(double part) {
  return colorTable("error").at(std::clamp(part, 0.0, 1.0));
}

}  // namespace

Result<VertexDistances> distancesTo(const TriangleMesh& other, const std::vector<Vec3>& positions,
                                    const RunContext& context) {
  const NearestOnMesh nearest(other);
  VertexDistances found;
  found.distances.resize(positions.size());
  withThreads(context, [&] {
    parallelFor(IndexRange<std::size_t>(0, positions.size(), kPerTask), [&](const auto& range) {
      if (context.cancelled()) return;
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        found.distances[i] = static_cast<float>(nearest.nearest(positions[i]).distance);
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "interrupted");
  double sum = 0;
  for (const float d : found.distances) {
    sum += d;
    found.largest = std::max(found.largest, double(d));
  }
  found.mean = positions.empty() ? 0 : sum / double(positions.size());
  return found;
}

std::vector<std::uint8_t> distanceColors(const VertexDistances& of, double most) {
  std::vector<std::uint8_t> colors;
  colors.reserve(4 * of.distances.size());
  for (const float d : of.distances) {
    const Rgba c = colorAt(most > 0 ? d / most : 0);
    colors.insert(colors.end(), {c.r, c.g, c.b, 255});
  }
  return colors;
}

Legend distanceLegend(double most, const std::string& unit) {
  Legend legend{
      .title = unit.empty() ? std::string(kDistanceLayer) : fmt::format("{} ({})", kDistanceLayer, unit),
      .entries = {}};
  constexpr int kSteps = 4;
  for (int i = kSteps; i >= 0; --i)
    legend.entries.push_back(
        {colorAt(double(i) / kSteps), fmt::format("{:.3g}", most * i / kSteps), Legend::Mark::area});
  return legend;
}

}  // namespace arete
