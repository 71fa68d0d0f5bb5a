// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each option (features, given positions, creases) marks samples of the finest triangulation; V_fixed
// consists of the marked ones. The angles of creases are measured in metres where the CRS is known: they have
// no meaning between degrees and metres.
#include "terrain/features/fixed_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "engine/base/caught_failure.h"
#include "engine/simplify/vertex_classes.h"
#include "terrain/triangulation/finest_points.h"
#include "terrain/triangulation/finest_raster.h"

namespace arete {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

bool selectsNothing(const FixedVertexOptions& options) {
  const bool features = options.features && options.features->count > 0;
  return !features && options.given.empty() && !options.creaseAngleDegrees;
}

/// Which samples are in the domain.
std::vector<std::uint8_t> inTriangles(const Triangles& triangles, std::size_t count) {
  std::vector<std::uint8_t> in(count, 0);
  for (const auto& t : triangles)
    for (const std::uint32_t v : t) in[v] = 1;
  return in;
}

/// The corner of the position's cell that is nearest and in the domain.
std::optional<std::uint32_t> snap(const RasterHeightfield& field, const std::vector<std::uint8_t>& inDomain,
                                  Vec2 position) {
  const Vec2 grid = field.georeference.toGrid(position.x, position.y);
  std::optional<std::uint32_t> best;
  double bestDistance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    const double column = std::floor(grid.x) + i % 2, row = std::floor(grid.y) + i / 2;
    // Written so that NaN fails.
    if (!(column >= 0 && row >= 0 && column < field.columns && row < field.rows)) continue;
    const std::uint32_t sample =
        field.index(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    const double distance = std::hypot(grid.x - column, grid.y - row);
    if (!inDomain[sample] || distance >= bestDistance) continue;
    best = sample;
    bestDistance = distance;
  }
  return best;
}

/// The nearest of a set of points: sorted by x, searched from the position's x to both sides.
class NearestPoint {
 public:
  NearestPoint(const PointHeightfield& field, const std::vector<std::uint8_t>& inDomain) : field_(field) {
    for (std::uint32_t v = 0; v < field.size(); ++v)
      if (inDomain[v]) order_.push_back(v);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(x(a), a) < std::pair(x(b), b); });
    for (const std::uint32_t v : order_) {
      lowY_ = std::min(lowY_, field.positions[v].y);
      highY_ = std::max(highY_, field.positions[v].y);
    }
  }

  std::optional<std::uint32_t> operator()(Vec2 p) const {
    if (order_.empty() || !(p.x >= x(order_.front()) && p.x <= x(order_.back())) ||
        !(p.y >= lowY_ && p.y <= highY_))
      return std::nullopt;
    std::uint32_t best = order_.front();
    double bestDistance = std::numeric_limits<double>::infinity();
    const auto consider = [&](std::uint32_t v) {
      const double distance = std::hypot(field_.positions[v].x - p.x, field_.positions[v].y - p.y);
      if (distance < bestDistance || (distance == bestDistance && v < best)) {
        best = v;
        bestDistance = distance;
      }
    };
    const auto middle =
        std::partition_point(order_.begin(), order_.end(), [&](std::uint32_t v) { return x(v) < p.x; });
    for (auto right = middle; right != order_.end() && x(*right) - p.x <= bestDistance; ++right)
      consider(*right);
    for (auto left = middle; left != order_.begin() && p.x - x(*(left - 1)) <= bestDistance;)
      consider(*--left);
    return best;
  }

 private:
  double x(std::uint32_t v) const { return field_.positions[v].x; }

  const PointHeightfield& field_;
  std::vector<std::uint32_t> order_;
  double lowY_ = std::numeric_limits<double>::infinity(), highY_ = -lowY_;
};

/// rankedFeatures() is called only if features are selected; `triangles` is read only for creases.
template <class Ranked, class Snap>
Result<FixedVertices> choose(std::size_t vertexCount, const Ranked& rankedFeatures,
                             const Triangles& triangles, const PositionOf& positionOf, const Snap& snapped,
                             const FixedVertexOptions& options, const RunContext& context) {
  FixedVertices chosen;
  std::vector<std::uint8_t> isFixed(vertexCount, 0);
  if (options.features && options.features->count > 0) {
    const std::vector<Feature> ranked = rankedFeatures();
    const std::vector<std::uint32_t> selected = selectFeatures(ranked, *options.features);
    chosen.features = selected.size();
    for (const std::uint32_t v : selected) isFixed[v] = 1;
  }
  for (const Vec2& position : options.given) {
    const std::optional<std::uint32_t> v = snapped(position);
    ++(v ? chosen.given : chosen.givenOutside);
    if (v) isFixed[*v] = 1;
  }
  if (options.creaseAngleDegrees && !context.cancelled()) {
    const std::vector<VertexClass> classes =
        classifyVertices(vertexCount, positionOf, triangles, *options.creaseAngleDegrees);
    for (std::size_t v = 0; v < classes.size(); ++v) {
      if (classes[v] != VertexClass::corner && classes[v] != VertexClass::interiorEdge) continue;
      ++chosen.creases;
      isFixed[v] = 1;
    }
  }
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the choice of features was interrupted");
  for (std::uint32_t v = 0; v < isFixed.size(); ++v)
    if (isFixed[v]) chosen.vertices.push_back(v);
  return chosen;
}

}  // namespace

Result<FixedVertices> chooseFixedVertices(const RasterHeightfield& field, const FixedVertexOptions& options,
                                          const RunContext& context) try {
  if (selectsNothing(options)) return FixedVertices{};
  // Features, all that most builds select, do not need the triangles.
  Triangles triangles;
  if (!options.given.empty() || options.creaseAngleDegrees) {
    triangles = finestTriangulation(field);
    if (triangles.empty()) return FixedVertices{};
  }
  std::vector<std::uint8_t> inDomain;
  if (!options.given.empty()) inDomain = inTriangles(triangles, field.size());
  const Georeference& georeference = field.georeference;
  const Vec2 step = groundStep(georeference, (field.columns - 1) / 2.0, (field.rows - 1) / 2.0);
  const PositionOf positionOf = [&](std::uint32_t v) {
    return Vec3{v % field.columns * step.x, v / field.columns * step.y,
                field.heights[v] * georeference.verticalUnitMetres};
  };
  return choose(
      field.size(), [&] { return rankFeatures(field, *options.features, context); }, triangles, positionOf,
      [&](Vec2 p) { return snap(field, inDomain, p); }, options, context);
} catch (...) {
  return caughtFailure();
}

Result<FixedVertices> chooseFixedVertices(const PointHeightfield& field, const FixedVertexOptions& options,
                                          const RunContext& context) try {
  if (selectsNothing(options) || field.size() == 0) return FixedVertices{};
  ARETE_TRY(const FinestPoints finest, finestPoints(field, context));
  return chooseFixedVertices(field, finest, options, context);
} catch (...) {
  return caughtFailure();
}

Result<FixedVertices> chooseFixedVertices(const PointHeightfield& field, const FinestPoints& finest,
                                          const FixedVertexOptions& options, const RunContext& context) try {
  if (selectsNothing(options)) return FixedVertices{};
  Triangles triangles;
  if (!options.given.empty() || options.creaseAngleDegrees) triangles = finest.trianglesOfPoints();
  std::optional<NearestPoint> nearest;
  if (!options.given.empty()) nearest.emplace(field, inTriangles(triangles, field.size()));
  const Georeference& georeference = field.georeference;
  Vec2 mean;
  for (const Vec2& p : field.positions) mean = {mean.x + p.x, mean.y + p.y};
  const double count = static_cast<double>(field.size());
  const Vec2 centre = georeference.toGrid(mean.x / count, mean.y / count);
  const Vec2 step = groundStep(georeference, centre.x, centre.y);
  const PositionOf positionOf = [&](std::uint32_t v) {
    const Vec2& p = field.positions[v];
    return Vec3{p.x * step.x, p.y * step.y, field.heights[v] * georeference.verticalUnitMetres};
  };
  // In the spatial order of finestPoints() neighbours are close in memory, and ties between equal heights do
  // not depend on the order in which the points were given.
  const auto rankedFeatures = [&] {
    std::vector<double> heights(field.size());
    std::ranges::transform(finest.order, heights.begin(), [&](std::uint32_t v) { return field.heights[v]; });
    std::vector<Feature> ranked = rankFeatures(heights, finest.triangles, *options.features, context);
    for (Feature& feature : ranked) feature.sample = finest.order[feature.sample];
    return ranked;
  };
  return choose(
      field.size(), rankedFeatures, triangles, positionOf, [&](Vec2 p) { return (*nearest)(p); }, options,
      context);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
