// SPDX-License-Identifier: GPL-3.0-or-later
//
// A counting sort groups the sides of all triangles by their lower vertex. A group is short; sorted by the
// other end, it has the sides of one edge side by side.
#include "surface/topology/edges.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace arete {

MeshEdges::MeshEdges(std::span<const Corners> triangles, std::size_t vertexCount)
    : triangles_(triangles), vertexCount_(vertexCount) {
  assert(triangles.size() < std::numeric_limits<std::uint32_t>::max() / 3);
  const auto sideCount = static_cast<std::uint32_t>(3 * triangles.size());
  const auto lowOf = [&](CornerId s) { return std::min(origin(s), target(s)); };
  const auto highOf = [&](CornerId s) { return std::max(origin(s), target(s)); };

  std::vector<std::uint32_t> begin(vertexCount + 2, 0);
  for (std::uint32_t s = 0; s < sideCount; ++s) ++begin[lowOf(CornerId(s)).index() + std::size_t(2)];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  sides_.resize(sideCount);
  for (std::uint32_t s = 0; s < sideCount; ++s)
    sides_[begin[lowOf(CornerId(s)).index() + std::size_t(1)]++] = CornerId(s);

  edgeOf_.resize(sideCount);
  for (std::size_t v = 0; v < vertexCount; ++v) {
    const auto group = std::span(sides_).subspan(begin[v], begin[v + 1] - begin[v]);
    std::ranges::sort(group, [&](CornerId a, CornerId b) {
      return highOf(a) != highOf(b) ? highOf(a) < highOf(b) : a < b;
    });
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (i == 0 || highOf(group[i]) != highOf(group[i - 1]))
        firstSide_.push_back(begin[v] + static_cast<std::uint32_t>(i));
      edgeOf_[group[i].index()] = static_cast<std::uint32_t>(firstSide_.size() - 1);
    }
  }
  firstSide_.push_back(sideCount);
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
