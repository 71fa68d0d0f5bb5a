// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes of triangles, widened by their errors, against the samples as boxes without extent
// [ZomorodianEdelsbrunner2000]; a sample is done with the first triangle that is near enough.
#include "surface/laws/errors_law.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/nearest_on_triangle.h"
#include "surface/displacement/displaced_places.h"
#include "surface/model/charts.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

struct Interrupted {};

/// A front with its vertices somewhere, and how near each triangle must be to what it stands for.
struct PlacedFront {
  const Cut& cut;
  std::vector<Vec3> places;
  std::vector<double> errors;

  SpaceTriangle triangle(std::size_t t) const {
    const auto& [a, b, c] = cut.triangles[t];
    return {places[a], places[b], places[c]};
  }
};

PlacedFront placed(const MultiTriangulation& mt, const Cut& cut) {
  PlacedFront front{cut, {}, {}};
  for (const std::uint32_t v : cut.vertices) front.places.push_back(mt.position(VertexId(v)));
  for (const std::uint32_t t : cut.ids) front.errors.push_back(mt.error(TriangleId(t)));
  return front;
}

/// What rounding may add to the distance from a triangle.
double slackOf(const SpaceTriangle& t, double ulps) {
  return ulps + kThinnestTriangle * std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
}

Box boxOf(const SpaceTriangle& t, double wider, std::uint32_t number) {
  std::array<double, 3> low{}, high{};
  const auto take = [&](std::size_t axis, double a, double b, double c) {
    low[axis] = std::min({a, b, c}) - wider;
    high[axis] = std::max({a, b, c}) + wider;
  };
  take(0, t[0].x, t[1].x, t[2].x);
  take(1, t[0].y, t[1].y, t[2].y);
  take(2, t[0].z, t[1].z, t[2].z);
  return {low.data(), high.data(), number};
}

/// What a sample of a chart may be near to.
struct Target {
  SpaceTriangle place;
  double allowed;
  std::uint32_t chart;
};

/// The triangles; and the edges between charts, which are of both: what is across such an edge from a
/// triangle is within its error of the edge (divideStar()).
std::vector<Target> targetsOf(const PlacedFront& front, const std::vector<std::uint32_t>& chartOf) {
  std::vector<Target> targets;
  const auto chartAt = [&](std::size_t t) { return chartOf.empty() ? 0 : chartOf[front.cut.ids[t]]; };
  for (std::size_t t = 0; t < front.cut.triangles.size(); ++t)
    targets.push_back({front.triangle(t), front.errors[t], chartAt(t)});
  if (chartOf.empty()) return targets;
  const MeshEdges edges(front.cut.triangles, front.places.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const MeshEdges::Edge edge = edges[e];
    if (edge.sides.size() != 2) continue;
    const std::uint32_t s = triangleOf(edge.sides[0]).index(), t = triangleOf(edge.sides[1]).index();
    if (chartAt(s) == chartAt(t)) continue;
    const Vec3 &a = front.places[edge.low.index()], &b = front.places[edge.high.index()];
    targets.push_back({{a, b, b}, front.errors[s], chartAt(t)});
    targets.push_back({{a, b, b}, front.errors[t], chartAt(s)});
  }
  return targets;
}

Status check(const PlacedFront& front, const char* what, const SourceSamples& samples,
             const RunContext& context) {
  double largest = 0;
  for (const Vec3& p : samples.places)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double ulps = 64 * std::numeric_limits<double>::epsilon() * largest;
  std::vector<Box> triangles, points;
  std::vector<Target> targets = targetsOf(front, samples.chartOf);
  for (std::uint32_t t = 0; t < targets.size(); ++t) {
    targets[t].allowed += slackOf(targets[t].place, ulps);
    triangles.push_back(boxOf(targets[t].place, targets[t].allowed, t));
  }
  for (std::uint32_t i = 0; i < samples.places.size(); ++i) {
    const Vec3& p = samples.places[i];
    points.push_back(boxOf({p, p, p}, 0, i));
  }
  std::vector<std::uint8_t> isNear(samples.places.size(), 0);
  std::uint64_t tests = 0;
  const auto test = [&](const Box& triangle, const Box& point) {
    if (++tests % 65536 == 0 && context.cancelled()) throw Interrupted{};
    if (isNear[point.info()]) return;
    const Target& target = targets[triangle.info()];
    if (!samples.charts.empty() && target.chart != samples.charts[point.info()]) return;
    isNear[point.info()] = distanceToTriangle(samples.places[point.info()], target.place) <= target.allowed;
  };
  try {
    CGAL::box_intersection_d(triangles.begin(), triangles.end(), points.begin(), points.end(), test);
  } catch (const Interrupted&) {
    return failure(ErrorCode::interrupted, "interrupted");
  }
  const auto far = std::ranges::find(isNear, 0);
  if (far == isNear.end()) return {};
  const Vec3& p = samples.places[std::size_t(far - isNear.begin())];
  return failure(ErrorCode::brokenPromise,
                 fmt::format("law 10: in a {} of {} triangles none{} is as near to the source at {:.9g}, "
                             "{:.9g}, {:.9g} as its error says",
                             what, front.cut.triangles.size(),
                             samples.charts.empty() ? "" : " of the same part and chart", p.x, p.y, p.z));
}

}  // namespace

SourceSamples samplesOfSource(const SurfaceModel& model, bool isFull) {
  const MultiTriangulation& mt = model.mt;
  SourceSamples samples;
  samples.chartOf = chartsOf(model);
  const Cut finest = frontOfPrefix(mt, mt.nodeCount());
  if (samples.chartOf.empty()) {
    for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) samples.places.push_back(mt.position(VertexId(v)));
  } else {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;  // with a chart each
    for (std::size_t t = 0; t < finest.triangles.size(); ++t)
      for (const std::uint32_t v : finest.triangles[t])
        vertices.emplace_back(finest.vertices[v], samples.chartOf[finest.ids[t]]);
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const auto& [v, chart] : vertices) {
      samples.places.push_back(mt.position(VertexId(v)));
      samples.charts.push_back(chart);
    }
  }
  if (!isFull) return samples;
  const PlacedFront front = placed(mt, finest);
  for (std::size_t t = 0; t < finest.triangles.size(); ++t) {
    const auto [a, b, c] = front.triangle(t);
    for (const Vec3& p : {a / 3 + b / 3 + c / 3, a / 2 + b / 2, b / 2 + c / 2, c / 2 + a / 2}) {
      samples.places.push_back(p);
      if (!samples.chartOf.empty()) samples.charts.push_back(samples.chartOf[finest.ids[t]]);
    }
  }
  return samples;
}

Status checkErrors(const MultiTriangulation& mt, const Cut& front, const SourceSamples& samples,
                   const RunContext& context) {
  return check(placed(mt, front), "front", samples, context);
}

Status checkDisplacedErrors(const SurfaceModel& model, const Cut& front, const SourceSamples& samples,
                            const RunContext& context) {
  PlacedFront drawn = placed(model.mt, front);
  for (const bool isEverywhere : {false, true}) {
    if (isEverywhere) drawn.errors.assign(front.ids.size(), front.achievedError);
    drawn.places = displacedPlaces(model.mt, model.displacement, front, drawn.errors);
    ARETE_CHECK(check(drawn, "displaced front", samples, context));
  }
  return {};
}

}  // namespace arete
