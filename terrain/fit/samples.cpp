// SPDX-License-Identifier: GPL-3.0-or-later
//
// Raster: a row of a triangle is an interval between integer quotients, rounded inwards. A sample on an edge
// is found by both of its triangles; the first one takes it.
//
// Points: the sample that a node inserts lies in the node's floor. The floor triangle over it is in the front
// if its creator is in the cut. Otherwise the creator is a node outside the cut, whose floor covers all of
// that triangle, and the search continues there.
#include "terrain/fit/samples.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>

#include "engine/parallel/with_threads.h"
#include "terrain/model/plan_orientation.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = FitSamples::kNone;
constexpr std::size_t kCheckEvery = 1 << 14;

struct LatticePoint {
  std::int64_t x, y;
};

std::int64_t floorOf(std::int64_t numerator, std::int64_t denominator) {  // denominator > 0
  return numerator >= 0 ? numerator / denominator : -((denominator - 1 - numerator) / denominator);
}

/// take(x, y) for every lattice point in the closed, counter-clockwise triangle.
template <class Take>
void scanTriangle(const std::array<LatticePoint, 3>& p, const Take& take) {
  const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
  for (std::int64_t y = low; y <= high; ++y) {
    std::int64_t left = std::numeric_limits<std::int64_t>::min(), right = -(left + 1);
    for (int i = 0; i < 3; ++i) {
      const LatticePoint &a = p[i], &b = p[(i + 1) % 3];
      const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
      if (dy > 0) right = std::min(right, a.x + floorOf(dx * (y - a.y), dy));
      if (dy < 0) left = std::max(left, a.x - floorOf(dx * (y - a.y), -dy));
    }
    for (std::int64_t x = left; x <= right; ++x) take(x, y);
  }
}

Result<FitSamples> onLattice(const MultiTriangulation& mt, const Cut& cut, const RunContext& context) {
  const VertexArrays& vertices = mt.vertices();
  const std::uint32_t columns = vertices.columns;
  FitSamples shared{std::vector<std::uint32_t>(cut.triangles.size(), kNone),
                    std::vector<std::uint32_t>(mt.vertexCount(), kNone)};
  std::uint32_t last = 0;
  for (const std::uint32_t s : vertices.samples) last = std::max(last, s);
  std::vector<std::uint32_t> unassigned(std::size_t(last) + 1,
                                        kNone);  // per sample: its vertex, until assigned
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) unassigned[vertices.samples[v]] = v;
  std::size_t assigned = 0;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
    if (t % kCheckEvery == 0 && context.cancelled())
      return failure(ErrorCode::interrupted, "the fit was interrupted");
    std::array<LatticePoint, 3> corner;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t s = vertices.samples[cut.vertices[cut.triangles[t][i]]];
      corner[i] = {s % columns, s / columns};
    }
    scanTriangle(corner, [&](std::int64_t x, std::int64_t y) {
      std::uint32_t& v = unassigned[std::size_t(y) * columns + std::size_t(x)];
      if (v == kNone) return;  // NODATA, or assigned to a neighbour
      shared.next[v] = shared.first[t];
      shared.first[t] = v;
      v = kNone;
      ++assigned;
    });
  }
  if (assigned != mt.vertexCount())
    return failure(ErrorCode::invalidData, "the triangles of the model leave samples uncovered");
  return shared;
}

Result<FitSamples> onPoints(const MultiTriangulation& mt, const Cut& cut, const NodeSet& nodes,
                            const RunContext& context) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> byId(cut.ids.size());
  for (std::uint32_t i = 0; i < byId.size(); ++i) byId[i] = {cut.ids[i], i};
  std::ranges::sort(byId);
  const auto indexOf = [&](std::uint32_t id) {
    return std::ranges::lower_bound(byId, std::pair(id, 0u))->second;
  };
  const auto covers = [&](std::uint32_t id, Vec2 p) {
    const auto corners = mt.corners(TriangleId(id));
    std::array<Vec2, 3> c;
    for (int i = 0; i < 3; ++i) c[i] = mt.vertices().planPosition(VertexId(corners[i]));
    return planOrientation(c[0], c[1], p) >= 0 && planOrientation(c[1], c[2], p) >= 0 &&
           planOrientation(c[2], c[0], p) >= 0;
  };
  std::vector<std::uint32_t> over(mt.vertexCount(), kNone);  // per vertex: its triangle
  for (std::uint32_t t = 0; t < cut.triangles.size(); ++t)
    for (const std::uint32_t corner : cut.triangles[t]) {
      std::uint32_t& at = over[cut.vertices[corner]];
      if (at == kNone) at = t;
    }
  std::atomic<bool> isLost = false;
  withThreads(context, [&] {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mt.nodeCount(), 1024), [&](const auto& range) {
      if (context.cancelled()) return;
      for (std::uint32_t start = range.begin(); start != range.end(); ++start) {
        if (nodes[start]) continue;
        const VertexId v = mt.apex(NodeId(start));
        const Vec2 p = mt.vertices().planPosition(v);
        for (std::uint32_t n = start; over[v.index()] == kNone;) {
          const auto floor = mt.floor(NodeId(n));
          const auto found = std::ranges::find_if(floor, [&](std::uint32_t id) { return covers(id, p); });
          if (found == floor.end()) {
            isLost = true;
            break;
          }
          const NodeId creator = mt.creator(TriangleId(*found));
          if (!creator.isValid() || nodes[creator.index()])
            over[v.index()] = indexOf(*found);
          else
            n = creator.index();
        }
      }
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the fit was interrupted");
  if (isLost) return failure(ErrorCode::invalidData, "the triangles of the model leave samples uncovered");
  FitSamples shared{std::vector<std::uint32_t>(cut.triangles.size(), kNone),
                    std::vector<std::uint32_t>(mt.vertexCount(), kNone)};
  for (std::uint32_t v = mt.vertexCount(); v-- > 0;) {
    shared.next[v] = shared.first[over[v]];
    shared.first[over[v]] = v;
  }
  return shared;
}

}  // namespace

Result<FitSamples> shareSamples(const MultiTriangulation& mt, const Cut& cut, const NodeSet& nodes,
                                const RunContext& context) {
  return mt.vertices().isLattice() ? onLattice(mt, cut, context) : onPoints(mt, cut, nodes, context);
}

NodeSet nodesOf(const MultiTriangulation& mt, const Cut& cut) {
  NodeSet nodes(mt.nodeCount(), 0);
  for (const std::uint32_t v : cut.vertices)
    if (v >= mt.rootVertexCount()) nodes[v - mt.rootVertexCount()] = 1;
  return nodes;
}

}  // namespace arete
