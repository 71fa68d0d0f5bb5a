// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file may hold any numbers, so the triangles are checked first: each must be counter-clockwise, and
// together they must not be larger than the grid. That bounds the scan below, and the weights of a fit exist.
//
// Raster: a row of a triangle is an interval between integer quotients, rounded inwards. A sample on an edge
// is found by both of its triangles; the first one takes it.
//
// Points: the sample that a node inserts lies in the node's floor. The floor triangle over it is in the front
// if its creator is in the cut. Otherwise the creator is a node outside the cut, whose floor covers all of
// that triangle, and the search continues there.
#include "terrain/fit/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>

#include "engine/memory/required_memory.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/model/plan_orientation.h"

namespace arete {
namespace {

constexpr std::size_t kCheckEvery = 1 << 14;      // triangles
constexpr std::uint64_t kCheckSamples = 1 << 22;  // samples

tl::unexpected<Error> interrupted() {
  return failure(ErrorCode::interrupted, "the fit was interrupted");
}
tl::unexpected<Error> uncovered() {
  return failure(ErrorCode::invalidData, "the triangles of the model leave samples uncovered");
}

struct LatticePoint {
  std::int64_t x, y;
};

std::int64_t floorOf(std::int64_t numerator, std::int64_t denominator) {  // denominator > 0
  return numerator >= 0 ? numerator / denominator : -((denominator - 1 - numerator) / denominator);
}

/// takeRow(y, left, right) for every row of lattice points in the closed, counter-clockwise triangle.
template <class TakeRow>
void scanTriangle(const std::array<LatticePoint, 3>& p, const TakeRow& takeRow) {
  const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
  for (std::int64_t y = low; y <= high; ++y) {
    std::int64_t left = std::numeric_limits<std::int64_t>::min(), right = -(left + 1);
    for (int i = 0; i < 3; ++i) {
      const LatticePoint &a = p[i], &b = p[(i + 1) % 3];
      const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
      if (dy > 0) right = std::min(right, a.x + floorOf(dx * (y - a.y), dy));
      if (dy < 0) left = std::max(left, a.x - floorOf(dx * (y - a.y), -dy));
    }
    takeRow(y, left, right);
  }
}

/// Checks that all triangles are counter-clockwise and, on a lattice, that together they have no more than
/// its area.
Status checkTriangles(const MultiTriangulation& mt, const Cut& cut) {
  const VertexArrays& vertices = mt.vertices();
  double area = 0, xMax = 0, yMax = 0;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
    std::array<Vec2, 3> c;
    for (int i = 0; i < 3; ++i) c[i] = vertices.planPosition(VertexId(cut.vertices[cut.triangles[t][i]]));
    if (planOrientation(c[0], c[1], c[2]) <= 0)
      return failure(ErrorCode::invalidData,
                     fmt::format("triangle {} of the model is not counter-clockwise", cut.ids[t]));
    area += (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
    for (const Vec2& p : c) xMax = std::max(xMax, p.x), yMax = std::max(yMax, p.y);
  }
  // Twice the areas: on a lattice whole numbers, rounded at the most beyond 2^53, where 1 % is plenty.
  if (vertices.isLattice() && area > 2.02 * xMax * yMax)
    return failure(ErrorCode::invalidData, "the triangles of the model overlap");
  return {};
}

Result<FitSamples> onLattice(const MultiTriangulation& mt, const Cut& cut, const RunContext& context) {
  const VertexArrays& vertices = mt.vertices();
  const std::uint32_t columns = vertices.columns;
  FitSamples shared{std::vector<std::uint32_t>(cut.triangles.size(), FitSamples::kNone),
                    std::vector<std::uint32_t>(mt.vertexCount(), FitSamples::kNone)};
  std::uint32_t last = 0;
  for (const std::uint32_t s : vertices.samples) last = std::max(last, s);
  requireMemory((std::uint64_t(last) + 1) * sizeof(std::uint32_t));
  std::vector<std::uint32_t> unassigned(std::size_t(last) + 1,
                                        FitSamples::kNone);  // per sample: its vertex, until assigned
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) unassigned[vertices.samples[v]] = v;
  std::size_t assigned = 0;
  std::uint64_t visited = 0;
  bool isStopped = false;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
    if (isStopped || (t % kCheckEvery == 0 && context.cancelled())) return interrupted();
    std::array<LatticePoint, 3> corner;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t s = vertices.samples[cut.vertices[cut.triangles[t][i]]];
      corner[i] = {s % columns, s / columns};
    }
    scanTriangle(corner, [&](std::int64_t y, std::int64_t left, std::int64_t right) {
      for (std::int64_t x = left; x <= right; ++x) {
        std::uint32_t& v = unassigned[std::size_t(y) * columns + std::size_t(x)];
        if (v == FitSamples::kNone) continue;  // NODATA, or assigned to a neighbour
        shared.next[v] = shared.first[t];
        shared.first[t] = v;
        v = FitSamples::kNone;
        ++assigned;
      }
      visited += static_cast<std::uint64_t>(right - left + 1);
      if (visited < kCheckSamples) return;
      visited = 0;
      isStopped = isStopped || context.cancelled();
    });
  }
  if (isStopped) return interrupted();
  if (assigned != mt.vertexCount()) return uncovered();
  return shared;
}

Result<FitSamples> onPoints(const MultiTriangulation& mt, const Cut& cut, const NodeSet& nodes,
                            const RunContext& context) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> byId(cut.ids.size());
  for (std::uint32_t i = 0; i < byId.size(); ++i) byId[i] = {cut.ids[i], i};
  std::ranges::sort(byId);
  const auto indexOf = [&](std::uint32_t id) {
    const auto found = std::ranges::lower_bound(byId, std::pair(id, 0u));
    return found != byId.end() && found->first == id ? found->second : FitSamples::kNone;
  };
  const auto covers = [&](std::uint32_t id, Vec2 p) {
    const auto corners = mt.corners(TriangleId(id));
    std::array<Vec2, 3> c;
    for (int i = 0; i < 3; ++i) c[i] = mt.vertices().planPosition(VertexId(corners[i]));
    return planOrientation(c[0], c[1], p) >= 0 && planOrientation(c[1], c[2], p) >= 0 &&
           planOrientation(c[2], c[0], p) >= 0;
  };
  std::vector<std::uint32_t> over(mt.vertexCount(), FitSamples::kNone);  // per vertex: its triangle
  for (std::uint32_t t = 0; t < cut.triangles.size(); ++t)
    for (const std::uint32_t corner : cut.triangles[t]) {
      std::uint32_t& at = over[cut.vertices[corner]];
      if (at == FitSamples::kNone) at = t;
    }
  std::atomic<bool> isLost = false;
  withThreads(context, [&] {
    parallelFor(IndexRange<std::uint32_t>(0, mt.nodeCount(), 1024), [&](const auto& range) {
      if (context.cancelled()) return;
      for (std::uint32_t start = range.begin(); start != range.end(); ++start) {
        if (nodes[start]) continue;
        const VertexId v = mt.apex(NodeId(start));
        const Vec2 p = mt.vertices().planPosition(v);
        for (std::uint32_t n = start; over[v.index()] == FitSamples::kNone;) {
          const auto floor = mt.floor(NodeId(n));
          const auto found = std::ranges::find_if(floor, [&](std::uint32_t id) { return covers(id, p); });
          if (found == floor.end()) {
            isLost = true;
            break;
          }
          const NodeId creator = mt.creator(TriangleId(*found));
          if (creator.isValid() && !nodes[creator.index()]) {
            n = creator.index();
            continue;
          }
          over[v.index()] = indexOf(*found);
          if (over[v.index()] != FitSamples::kNone) continue;
          isLost = true;
          break;
        }
      }
    });
  });
  if (context.cancelled()) return interrupted();
  if (isLost || std::ranges::find(over, FitSamples::kNone) != over.end()) return uncovered();
  FitSamples shared{std::vector<std::uint32_t>(cut.triangles.size(), FitSamples::kNone),
                    std::vector<std::uint32_t>(mt.vertexCount(), FitSamples::kNone)};
  for (std::uint32_t v = mt.vertexCount(); v-- > 0;) {
    shared.next[v] = shared.first[over[v]];
    shared.first[over[v]] = v;
  }
  return shared;
}

}  // namespace

Result<FitSamples> shareSamples(const MultiTriangulation& mt, const Cut& cut, const NodeSet& nodes,
                                const RunContext& context) {
  ARETE_CHECK(checkTriangles(mt, cut));
  return mt.vertices().isLattice() ? onLattice(mt, cut, context) : onPoints(mt, cut, nodes, context);
}

NodeSet nodesOf(const MultiTriangulation& mt, const Cut& cut) {
  NodeSet nodes(mt.nodeCount(), 0);
  for (const std::uint32_t v : cut.vertices)
    if (v >= mt.rootVertexCount()) nodes[v - mt.rootVertexCount()] = 1;
  return nodes;
}

}  // namespace arete
