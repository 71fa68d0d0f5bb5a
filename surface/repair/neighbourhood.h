// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete::repair_passes {

/// The triangles at each vertex of a mesh that changes. The owner changes the mesh and calls add() and
/// remove().
class Neighbourhood {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  explicit Neighbourhood(const TriangleMesh& mesh) : mesh_(mesh), at_(mesh.positions.size()) {
    // In order: a triangle that is there already is the last one.
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t])
        if (at_[v].empty() || at_[v].back() != t) at_[v].push_back(t);
  }

  void add(std::uint32_t triangle) {
    for (const std::uint32_t v : mesh_.triangles[triangle])
      if (std::ranges::find(at_[v], triangle) == at_[v].end()) at_[v].push_back(triangle);
  }
  /// Precondition: the triangle has the corners that it was added with.
  void remove(std::uint32_t triangle) {
    for (const std::uint32_t v : mesh_.triangles[triangle]) std::erase(at_[v], triangle);
  }

  const std::vector<std::uint32_t>& at(std::uint32_t vertex) const { return at_[vertex]; }
  /// The triangles that have both vertices.
  std::vector<std::uint32_t> atEdge(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> found;
    const bool isShorter = at_[a].size() <= at_[b].size();
    for (const std::uint32_t t : at_[isShorter ? a : b])
      if (has(t, isShorter ? b : a)) found.push_back(t);
    return found;
  }
  bool has(std::uint32_t triangle, std::uint32_t vertex) const {
    return std::ranges::find(mesh_.triangles[triangle], vertex) != mesh_.triangles[triangle].end();
  }
  /// The vertices that share a triangle with one, itself left out, in increasing order.
  std::vector<std::uint32_t> around(std::uint32_t vertex) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : at_[vertex])
      for (const std::uint32_t v : mesh_.triangles[t])
        if (v != vertex) found.push_back(v);
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::vector<std::uint32_t>> at_;
};

}  // namespace arete::repair_passes
