// SPDX-License-Identifier: GPL-3.0-or-later
//
// A counting sort groups the edges of all triangles by their lower vertex, each edge with the number of its
// triangle. A group is short; sorted by the other end, it has the triangles of one edge side by side. An edge
// with one triangle is a border; of one with two the normals are compared. The numbers of creases and borders
// at a vertex then give its class.
#include "engine/simplify/vertex_classes.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/base/crease.h"

namespace arete {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct EdgeUse {
  std::uint32_t otherEnd = 0;
  std::uint32_t triangle = 0;
  auto operator<=>(const EdgeUse&) const = default;
};

/// Counts of the edges at a vertex.
struct Tally {
  static constexpr std::uint8_t kMany = 3;
  std::uint8_t creases = 0;  ///< up to kMany
  bool used = false;
  bool onBorder = false;
  bool nonManifold = false;

  void addCrease() { creases = std::uint8_t(std::min<int>(creases + 1, kMany)); }
};

VertexClass classOf(const Tally& tally) {
  if (!tally.used) return VertexClass::isolated;
  if (tally.nonManifold) return VertexClass::corner;
  if (tally.onBorder) return VertexClass::boundary;
  if (tally.creases == 0) return VertexClass::simple;
  return tally.creases == 2 ? VertexClass::interiorEdge : VertexClass::corner;
}

template <class Position>
std::vector<VertexClass> classify(std::size_t vertexCount, const Position& positionOf,
                                  std::span<const Triangle> triangles, double creaseAngleDegrees) {
  const auto normalOf = [&](std::uint32_t triangle) {
    const Triangle& t = triangles[triangle];
    const Vec3 origin = positionOf(t[0]);
    return cross((positionOf(t[1]) - origin), (positionOf(t[2]) - origin));
  };
  const auto isCreaseBetween = [&](std::uint32_t a, std::uint32_t b) {
    return isCrease(normalOf(a), normalOf(b), creaseAngleDegrees);
  };

  std::vector<std::size_t> begin(vertexCount + 2, 0);
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) ++begin[std::min(t[i], t[(i + 1) % 3]) + std::size_t(2)];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<EdgeUse> uses(triangles.size() * 3);
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
    const Triangle& t = triangles[triangle];
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      uses[begin[low + std::size_t(1)]++] = {high, triangle};
    }
  }

  std::vector<Tally> tallies(vertexCount);
  for (std::uint32_t low = 0; low < vertexCount; ++low) {
    const auto last = uses.begin() + std::ptrdiff_t(begin[low + 1]);
    auto edge = uses.begin() + std::ptrdiff_t(begin[low]);
    std::sort(edge, last);
    while (edge != last) {
      const auto next =
          std::find_if(edge, last, [&](const EdgeUse& use) { return use.otherEnd != edge->otherEnd; });
      const auto sharing = next - edge;
      const bool crease = sharing == 2 && isCreaseBetween(edge[0].triangle, edge[1].triangle);
      for (Tally* end : {&tallies[low], &tallies[edge->otherEnd]}) {
        end->used = true;
        end->onBorder |= sharing == 1;
        end->nonManifold |= sharing > 2;
        if (crease) end->addCrease();
      }
      edge = next;
    }
  }
  std::vector<VertexClass> classes(vertexCount);
  std::transform(tallies.begin(), tallies.end(), classes.begin(), classOf);
  return classes;
}

}  // namespace

std::vector<VertexClass> classifyVertices(std::span<const Vec3> positions,
                                          std::span<const Triangle> triangles, double creaseAngleDegrees) {
  return classify(
      positions.size(), [&](std::uint32_t v) -> const Vec3& { return positions[v]; }, triangles,
      creaseAngleDegrees);
}

std::vector<VertexClass> classifyVertices(std::size_t vertexCount, const PositionOf& positionOf,
                                          std::span<const Triangle> triangles, double creaseAngleDegrees) {
  return classify(vertexCount, positionOf, triangles, creaseAngleDegrees);
}

}  // namespace arete
