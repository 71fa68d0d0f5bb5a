// SPDX-License-Identifier: GPL-3.0-or-later
//
// A counting sort groups the sides of all triangles by their lower vertex. A group is short; sorted by the
// other end, it has the sides of one edge side by side. Groups are sorted, and their edges numbered, in
// parallel.
#include "surface/topology/edges.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

/// A side of a group: its higher vertex, then its corner.
using SideKey = std::uint64_t;
SideKey keyOf(VertexId high, CornerId side) {
  return SideKey(high.index()) << 32 | side.index();
}
std::uint32_t highOf(SideKey key) {
  return static_cast<std::uint32_t>(key >> 32);
}
CornerId sideOf(SideKey key) {
  return CornerId(static_cast<std::uint32_t>(key));
}

template <class Visit>
void forVertices(std::size_t vertexCount, const Visit& visit) {
  parallelFor(IndexRange<std::size_t>(0, vertexCount, 4096), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) visit(v);
  });
}

}  // namespace

MeshEdges::MeshEdges(std::span<const Corners> triangles, std::size_t vertexCount)
    : triangles_(triangles), vertexCount_(vertexCount) {
  assert(triangles.size() < std::numeric_limits<std::uint32_t>::max() / 3);
  const auto sideCount = static_cast<std::uint32_t>(3 * triangles.size());

  std::vector<std::uint32_t> begin(vertexCount + 2, 0);
  for (const Corners& t : triangles)
    for (unsigned i = 0; i < 3; ++i) ++begin[std::min(t[i], t[(i + 1) % 3]) + std::size_t(2)];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  UninitializedVector<SideKey> keys(sideCount);
  for (std::uint32_t s = 0; s < sideCount; ++s) {
    const VertexId a = origin(CornerId(s)), b = target(CornerId(s));
    keys[begin[std::min(a, b).index() + std::size_t(1)]++] = keyOf(std::max(a, b), CornerId(s));
  }

  std::vector<std::uint32_t> firstEdge(vertexCount + 1, 0);
  forVertices(vertexCount, [&](std::size_t v) {
    const auto group = std::span(keys).subspan(begin[v], begin[v + 1] - begin[v]);
    std::ranges::sort(group);
    for (std::size_t i = 0; i < group.size(); ++i)
      if (i == 0 || highOf(group[i]) != highOf(group[i - 1])) ++firstEdge[v + 1];
  });
  std::partial_sum(firstEdge.begin(), firstEdge.end(), firstEdge.begin());

  sides_.resize(sideCount);
  edgeOf_.resize(sideCount);
  firstSide_.resize(firstEdge[vertexCount] + std::size_t(1));
  forVertices(vertexCount, [&](std::size_t v) {
    std::uint32_t next = firstEdge[v];
    for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i) {
      if (i == begin[v] || highOf(keys[i]) != highOf(keys[i - 1])) firstSide_[next++] = i;
      sides_[i] = sideOf(keys[i]);
      edgeOf_[sides_[i].index()] = next - 1;
    }
  });
  firstSide_.back() = sideCount;
}

MeshEdges::Edge MeshEdges::operator[](std::size_t edge) const {
  const auto sides = std::span(sides_).subspan(firstSide_[edge], firstSide_[edge + 1] - firstSide_[edge]);
  const VertexId a = origin(sides[0]), b = target(sides[0]);
  return {std::min(a, b), std::max(a, b), sides};
}

CornerId MeshEdges::across(CornerId side) const {
  const std::uint32_t edge = edgeOf_[side.index()], first = firstSide_[edge];
  if (firstSide_[edge + 1] - first != 2) return {};
  return sides_[first] == side ? sides_[first + 1] : sides_[first];
}

}  // namespace arete
