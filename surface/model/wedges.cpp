// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wedges are named by vertex and wedge: a wedge that several vertices share counts once for each of them.
#include "surface/model/wedges.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace arete {
namespace {

bool isNamed(const std::vector<Attribute>& attributes, const std::string& name) {
  return std::ranges::any_of(attributes, [&](const Attribute& a) { return a.name == name; });
}

/// The elements of an attribute in another order; MeshAttributes::kNone: zeros.
Attribute gathered(const Attribute& from, std::span<const std::uint32_t> elements) {
  Attribute to = emptyLike(from);
  const std::size_t size = from.elementBytes();
  to.values.resize(elements.size() * size);
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (elements[i] != MeshAttributes::kNone)
      std::memcpy(to.values.data() + i * size, from.values.data() + std::size_t{elements[i]} * size, size);
  return to;
}

/// The corners of a mesh as pairs of a vertex and a wedge, by corner.
struct CornerPairs {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< each once, in order
  std::vector<std::uint32_t> pairOf;                           ///< by corner

  explicit CornerPairs(MeshRef mesh) {
    const auto& triangles = mesh.shape.triangles;
    const auto& wedges = mesh.attributes.wedges;
    const auto pairAt = [&](std::size_t c) {
      return std::pair(triangles[c / 3][c % 3], wedges[c / 3][c % 3]);
    };
    pairs.reserve(3 * triangles.size());
    for (std::size_t c = 0; c < 3 * triangles.size(); ++c) pairs.push_back(pairAt(c));
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    pairOf.resize(3 * triangles.size());
    for (std::size_t c = 0; c < pairOf.size(); ++c)
      pairOf[c] = static_cast<std::uint32_t>(std::ranges::lower_bound(pairs, pairAt(c)) - pairs.begin());
  }
};

/// Whether all wedges of each vertex have the same value of an attribute.
bool agreesAtVertices(const CornerPairs& corners, const Attribute& attribute) {
  for (std::size_t i = 1; i < corners.pairs.size(); ++i) {
    const auto& [v, w] = corners.pairs[i];
    const auto& [before, other] = corners.pairs[i - 1];
    if (v == before && !std::ranges::equal(attribute.element(w), attribute.element(other))) return false;
  }
  return true;
}

/// By pair: the first pair of the same vertex with the same values.
std::vector<std::uint32_t> equalPairs(const CornerPairs& corners, const std::vector<Attribute>& attributes) {
  const auto compare = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = corners.pairs[a].second, second = corners.pairs[b].second;
    for (const Attribute& attribute : attributes)
      if (const int order = std::memcmp(attribute.element(first).data(), attribute.element(second).data(),
                                        attribute.elementBytes());
          order != 0)
        return order;
    return 0;
  };
  std::vector<std::uint32_t> order(corners.pairs.size()), leader(corners.pairs.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && corners.pairs[end].first == corners.pairs[begin].first) ++end;
    std::stable_sort(order.begin() + std::ptrdiff_t(begin), order.begin() + std::ptrdiff_t(end),
                     [&](std::uint32_t a, std::uint32_t b) { return compare(a, b) < 0; });
    for (std::size_t i = begin; i < end; ++i)
      leader[order[i]] = i > begin && compare(order[i - 1], order[i]) == 0 ? leader[order[i - 1]] : order[i];
  }
  return leader;
}

/// Pairs of one vertex with equal values become one wedge, the first of them.
void joinPairs(SurfaceMesh& mesh, const CornerPairs& corners) {
  if (mesh.wedgeAttributes.empty()) {
    mesh.wedges.clear();
    mesh.wedgeCount = 0;
    return;
  }
  const std::vector<std::uint32_t> leader = equalPairs(corners, mesh.wedgeAttributes);
  std::vector<std::uint32_t> kept, wedgeOfPair(corners.pairs.size());
  for (std::size_t i = 0; i < corners.pairs.size(); ++i) {
    if (leader[i] == i) kept.push_back(corners.pairs[i].second);
    wedgeOfPair[i] = leader[i] == i ? static_cast<std::uint32_t>(kept.size() - 1) : wedgeOfPair[leader[i]];
  }
  for (std::size_t c = 0; c < corners.pairOf.size(); ++c)
    mesh.wedges[c / 3][c % 3] = wedgeOfPair[corners.pairOf[c]];
  for (Attribute& attribute : mesh.wedgeAttributes) attribute = gathered(attribute, kept);
  mesh.wedgeCount = static_cast<std::uint32_t>(kept.size());
}

}  // namespace

void joinEqualWedges(SurfaceMesh& mesh) {
  if (mesh.hasWedges()) joinPairs(mesh, CornerPairs(MeshRef(mesh)));
}

void moveToWedges(SurfaceMesh& mesh) {
  if (!mesh.hasWedges()) {
    mesh.wedges = mesh.triangles;
    mesh.wedgeCount = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.wedgeAttributes = std::exchange(mesh.vertexAttributes, {});
    return;
  }
  std::erase_if(mesh.vertexAttributes,
                [&](const Attribute& a) { return isNamed(mesh.wedgeAttributes, a.name); });
  const CornerPairs corners{MeshRef(mesh)};
  std::vector<std::uint32_t> vertices, wedges;
  for (const auto& [v, w] : corners.pairs) {
    vertices.push_back(v);
    wedges.push_back(w);
  }
  for (Attribute& attribute : mesh.wedgeAttributes) attribute = gathered(attribute, wedges);
  for (const Attribute& attribute : mesh.vertexAttributes)
    mesh.wedgeAttributes.push_back(gathered(attribute, vertices));
  mesh.vertexAttributes.clear();
  mesh.wedgeCount = static_cast<std::uint32_t>(corners.pairs.size());
  for (std::size_t c = 0; c < corners.pairOf.size(); ++c) mesh.wedges[c / 3][c % 3] = corners.pairOf[c];
}

void moveToVertices(SurfaceMesh& mesh) {
  if (!mesh.hasWedges()) return;
  CornerPairs corners{MeshRef(mesh)};
  std::vector<std::uint32_t> firstWedge(mesh.positions.size(), MeshAttributes::kNone);
  for (const auto& [v, w] : corners.pairs)
    if (firstWedge[v] == MeshAttributes::kNone) firstWedge[v] = w;
  std::vector<Attribute> left;
  for (Attribute& attribute : mesh.wedgeAttributes) {
    if (isNamed(mesh.vertexAttributes, attribute.name) || !agreesAtVertices(corners, attribute))
      left.push_back(std::move(attribute));
    else
      mesh.vertexAttributes.push_back(gathered(attribute, firstWedge));
  }
  mesh.wedgeAttributes = std::move(left);
  joinPairs(mesh, corners);
}

SplitMesh splitByWedges(MeshRef mesh) {
  SplitMesh split;
  split.mesh.shape() = mesh.shape;
  static_cast<MeshAttributes&>(split.mesh) = mesh.attributes;
  const std::size_t vertices = mesh.shape.positions.size();
  split.vertexOf.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) split.vertexOf[v] = static_cast<std::uint32_t>(v);
  if (!mesh.attributes.hasWedges()) return split;

  const CornerPairs corners(mesh);
  std::vector<std::uint32_t> vertexOfPair(corners.pairs.size(), MeshAttributes::kNone),
      wedgeOf(vertices, MeshAttributes::kNone);
  for (std::size_t c = 0; c < corners.pairOf.size(); ++c) {
    std::uint32_t& vertex = vertexOfPair[corners.pairOf[c]];
    if (vertex == MeshAttributes::kNone) {
      const auto& [v, w] = corners.pairs[corners.pairOf[c]];
      if (wedgeOf[v] == MeshAttributes::kNone) {
        vertex = v;
        wedgeOf[v] = w;
      } else {
        vertex = static_cast<std::uint32_t>(split.vertexOf.size());
        split.vertexOf.push_back(v);
        wedgeOf.push_back(w);
      }
    }
    split.mesh.triangles[c / 3][c % 3] = vertex;
  }
  for (std::size_t v = vertices; v < split.vertexOf.size(); ++v)
    split.mesh.positions.push_back(mesh.shape.positions[split.vertexOf[v]]);
  split.mesh.vertexAttributes.clear();
  for (const Attribute& attribute : mesh.attributes.vertexAttributes)
    if (!isNamed(mesh.attributes.wedgeAttributes, attribute.name))
      split.mesh.vertexAttributes.push_back(gathered(attribute, split.vertexOf));
  for (const Attribute& attribute : mesh.attributes.wedgeAttributes)
    split.mesh.vertexAttributes.push_back(gathered(attribute, wedgeOf));
  split.mesh.wedgeAttributes.clear();
  split.mesh.wedges.clear();
  split.mesh.wedgeCount = 0;
  return split;
}

}  // namespace arete
