// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/contraction_mesh.h"

#include <algorithm>
#include <utility>

namespace arete {
namespace {

using Corners = std::array<std::uint32_t, 3>;

bool holds(std::span<const std::uint32_t> vertices, std::uint32_t v) {
  return std::ranges::find(vertices, v) != vertices.end();
}

}  // namespace

ContractionMesh::ContractionMesh(const TriangleMesh& mesh, double rounding)
    : positions_(mesh.positions),
      triangles_(mesh.triangles),
      isThere_(mesh.triangles.size(), 1),
      trianglesOf_(mesh.positions.size()),
      entries_(mesh.triangles.size()),
      triangleCount_(static_cast<std::uint32_t>(mesh.triangles.size())),
      leastHeight_(4 * rounding) {
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    if (a == b || b == c || c == a) {
      isThere_[t] = 0;
      --triangleCount_;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) attach(t, k);
  }
}

void ContractionMesh::attach(std::uint32_t t, std::size_t corner) {
  std::vector<std::uint32_t>& list = trianglesOf_[triangles_[t][corner]];
  entries_[t][corner] = static_cast<std::uint32_t>(list.size());
  list.push_back(t);
}

void ContractionMesh::detach(std::uint32_t t, std::size_t corner) {
  const std::uint32_t v = triangles_[t][corner], entry = entries_[t][corner];
  std::vector<std::uint32_t>& list = trianglesOf_[v];
  const std::uint32_t last = list.back();
  list[entry] = last;
  list.pop_back();
  const auto at = std::ranges::find(triangles_[last], v) - triangles_[last].begin();
  entries_[last][static_cast<std::size_t>(at)] = entry;
}

void ContractionMesh::neighboursOf(std::uint32_t v, Neighbours& neighbours) const {
  neighbours.clear();
  for (const std::uint32_t t : trianglesOf_[v])
    for (const std::uint32_t w : triangles_[t])
      if (w != v) neighbours.push_back(w);
  std::ranges::sort(neighbours);
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
}

bool ContractionMesh::keepsTopology(std::span<const std::uint32_t> vertices) const {
  // Common neighbours of two of the vertices are opposite to them in a triangle.
  Neighbours mine, other, common, opposite;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      neighboursOf(vertices[i], mine);
      neighboursOf(vertices[j], other);
      common.clear();
      std::ranges::set_intersection(mine, other, std::back_inserter(common));
      opposite.clear();
      for (const std::uint32_t t : trianglesOf_[vertices[i]])
        if (holds(triangles_[t], vertices[j]))
          opposite.insert(opposite.end(), triangles_[t].begin(), triangles_[t].end());
      for (const std::uint32_t w : common)
        if (std::ranges::find(opposite, w) == opposite.end()) return false;
    }
  // The rim of the new vertex: by triangle that is left, from one neighbour to the next.
  boost::container::small_vector<std::pair<std::uint32_t, std::uint32_t>, 24> rim;
  forLeft(vertices, [&](std::uint32_t t, std::size_t at) {
    const Corners& c = triangles_[t];
    rim.emplace_back(c[(at + 1) % 3], c[(at + 2) % 3]);
  });
  if (rim.empty()) return false;
  // Each neighbour begins at most one side of the rim and ends at most one; and the sides are one path or
  // cycle.
  std::ranges::sort(rim);
  for (std::size_t i = 0; i + 1 < rim.size(); ++i)
    if (rim[i].first == rim[i + 1].first) return false;
  const auto next = [&](std::uint32_t v) {
    const auto found = std::ranges::lower_bound(rim, std::pair{v, 0u});
    return found != rim.end() && found->first == v ? found : rim.end();
  };
  Neighbours ends;
  for (const auto& side : rim) ends.push_back(side.second);
  std::ranges::sort(ends);
  if (std::ranges::adjacent_find(ends) != ends.end()) return false;
  auto begin = rim.begin();
  for (auto side = rim.begin(); side != rim.end(); ++side)
    if (!std::ranges::binary_search(ends, side->first)) begin = side;
  std::size_t length = 0;
  for (auto side = begin; side != rim.end() && length < rim.size();) {
    ++length;
    side = next(side->second);
    if (side == begin) break;
  }
  if (length != rim.size()) return false;
  // A triangle that is there already, of three rim vertices in a closed rim, would close a pillow.
  if (rim.size() == 2 && rim[0].first == rim[1].second && rim[1].first == rim[0].second) return false;
  return true;
}

bool ContractionMesh::keepsTurns(std::span<const std::uint32_t> vertices, const Vec3& place) const {
  // The height above the longest side is twice the area by its length.
  const auto isThin = [&](const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    return !(dot(normal, normal) > leastHeight_ * leastHeight_ * longest);
  };
  bool keepsTurns = true;
  forLeft(vertices, [&](std::uint32_t t, std::size_t at) {
    if (!keepsTurns) return;
    const Vec3 &before = positions_[triangles_[t][at]], &p = positions_[triangles_[t][(at + 1) % 3]],
               &q = positions_[triangles_[t][(at + 2) % 3]];
    const Vec3 was = cross(p - before, q - before), is = cross(p - place, q - place);
    if (!(norm(was) > 0)) return;
    keepsTurns = dot(was, is) > 0 && (!isThin(is, place, p, q) || isThin(was, before, p, q));
  });
  return keepsTurns;
}

void ContractionMesh::remove(std::uint32_t t) {
  isThere_[t] = 0;
  --triangleCount_;
  for (std::size_t k = 0; k < 3; ++k) detach(t, k);
}

void ContractionMesh::contract(std::span<const std::uint32_t> vertices, const Vec3& place) {
  const std::uint32_t kept = vertices[0];
  positions_[kept] = place;
  for (const std::uint32_t v : vertices.subspan(1)) {
    const std::vector<std::uint32_t> mine = trianglesOf_[v];
    for (const std::uint32_t t : mine) {
      if (holds(triangles_[t], kept)) {
        remove(t);
        continue;
      }
      const auto corner =
          static_cast<std::size_t>(std::ranges::find(triangles_[t], v) - triangles_[t].begin());
      detach(t, corner);
      triangles_[t][corner] = kept;
      attach(t, corner);
    }
  }
  // Where topology is not kept, triangles may be there twice.
  const auto sorted = [&](std::uint32_t t) {
    Corners c = triangles_[t];
    std::ranges::sort(c);
    return c;
  };
  boost::container::small_vector<std::pair<Corners, std::uint32_t>, 24> all;
  for (const std::uint32_t t : trianglesOf_[kept]) all.emplace_back(sorted(t), t);
  std::ranges::sort(all);
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i].first == all[i - 1].first) remove(all[i].second);
}

}  // namespace arete
