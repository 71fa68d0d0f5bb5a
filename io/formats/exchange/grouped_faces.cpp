// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/exchange/grouped_faces.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

namespace arete {
namespace {

using Key = std::array<std::uint32_t, 3>;

/// None first: kNone + 1 is 0.
std::uint32_t rankOf(const std::vector<std::uint32_t>& numbers, std::size_t t) {
  return numbers.empty() ? 0 : numbers[t] + 1;
}

Key keyOf(const MeshAttributes& mesh, std::size_t t) {
  return {rankOf(mesh.objectOf, t), rankOf(mesh.groupOf, t), rankOf(mesh.materialOf, t)};
}

template <class T>
std::vector<T> gathered(const std::vector<T>& from, const std::vector<std::uint32_t>& order) {
  std::vector<T> to;
  if (from.empty()) return to;
  to.reserve(order.size());
  for (const std::uint32_t t : order) to.push_back(from[t]);
  return to;
}

/// Whether each object, and in it each group and material, is one run, and those of none are the first.
bool areRuns(const MeshAttributes& mesh, std::size_t triangles) {
  std::set<Key> ended;
  std::set<std::uint32_t> endedObjects;
  Key last{};
  for (std::size_t t = 0; t < triangles; ++t) {
    const Key key = keyOf(mesh, t);
    if (t > 0 && key == last) continue;
    if (t > 0) {
      ended.insert(last);
      if (key[0] != last[0]) {
        endedObjects.insert(last[0]);
        if (key[0] == 0) return false;
      }
    }
    if (ended.contains(key) || endedObjects.contains(key[0])) return false;
    last = key;
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> groupedFaces(MeshRef mesh) {
  const std::size_t triangles = mesh.shape.triangles.size();
  const MeshAttributes& attributes = mesh.attributes;
  if (attributes.objectOf.empty() && attributes.groupOf.empty() && attributes.materialOf.empty()) return {};
  if (areRuns(attributes, triangles)) return {};
  std::vector<std::uint32_t> order(triangles);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return keyOf(attributes, t); });
  return order;
}

std::vector<std::uint32_t> trianglesOfFile(MeshRef mesh, const MeshFormat& format) {
  return format.holds.statesPartsOnce ? groupedFaces(mesh) : std::vector<std::uint32_t>();
}

SurfaceMesh inOrder(MeshRef mesh, const std::vector<std::uint32_t>& triangleOf) {
  SurfaceMesh result;
  result.shape() = mesh.shape;
  static_cast<MeshAttributes&>(result) = mesh.attributes;
  result.triangles = gathered(mesh.shape.triangles, triangleOf);
  result.wedges = gathered(mesh.attributes.wedges, triangleOf);
  result.faceOf = gathered(mesh.attributes.faceOf, triangleOf);
  result.objectOf = gathered(mesh.attributes.objectOf, triangleOf);
  result.groupOf = gathered(mesh.attributes.groupOf, triangleOf);
  result.materialOf = gathered(mesh.attributes.materialOf, triangleOf);
  for (Attribute& attribute : result.triangleAttributes) {
    Attribute to = emptyLike(attribute);
    to.values.reserve(attribute.values.size());
    for (const std::uint32_t t : triangleOf) to.append(attribute.element(t));
    attribute = std::move(to);
  }
  return result;
}

}  // namespace arete
