// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles with the same vertices are side by side when sorted by their sorted corners: first, by counting,
// by the lowest, and then the few of each lowest corner by the others.
#include <algorithm>
#include <numeric>

#include "engine/memory/uninitialized_vector.h"
#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {
namespace {

/// Whether the corners are an even permutation of their sorted order.
bool isEven(const Triangle& t) {
  return ((t[0] > t[1]) + (t[0] > t[2]) + (t[1] > t[2])) % 2 == 0;
}

struct Sorted {
  Triangle corners;
  std::uint32_t triangle;
  bool isEven;
  auto operator<=>(const Sorted&) const = default;
};

}  // namespace

Vec3 centroid(const TriangleMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return (mesh.positions[t[0]] / 3 + mesh.positions[t[1]] / 3) + mesh.positions[t[2]] / 3;
}

KeptTriangles::KeptTriangles(const TriangleMesh& mesh) : triangles_(mesh.triangles) {
  if (std::ranges::none_of(mesh.triangles, hasRepeat)) return;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (hasRepeat(mesh.triangles[t])) continue;
    copies_.push_back(mesh.triangles[t]);
    numbers_.push_back(t);
  }
  triangles_ = copies_;
}

void examineFaces(const TriangleMesh& mesh, const DiagnosisOptions& options, MeshDiagnosis& result) {
  const auto lowest = [](const Triangle& t) { return std::min({t[0], t[1], t[2]}); };
  std::vector<std::uint32_t> begin(mesh.positions.size() + 1, 0);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (hasRepeat(t) || areCollinear(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]))
      add(result.degenerateTriangles, options.mostPlaces, {i}, centroid(mesh, i));
    if (!hasRepeat(t)) ++begin[lowest(t) + std::size_t{1}];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  UninitializedVector<Sorted> sorted(begin.back());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (hasRepeat(t)) continue;
    Sorted& s = sorted[begin[lowest(t)]++];
    s = {t, i, isEven(t)};
    std::ranges::sort(s.corners);
  }
  // begin[v] is now the end of those of v.
  for (std::size_t v = 0; v + 1 < begin.size(); ++v)
    std::sort(sorted.begin() + (v == 0 ? 0 : begin[v - 1]), sorted.begin() + begin[v]);
  struct Pair {
    std::uint32_t other, first;
    bool isDuplicate;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i;
    // The first triangle of either turn stands for the others of that turn.
    const Sorted* first[2] = {nullptr, nullptr};
    for (; end < sorted.size() && sorted[end].corners == sorted[i].corners; ++end) {
      const Sorted*& same = first[sorted[end].isEven ? 1 : 0];
      const Sorted* const turned = first[sorted[end].isEven ? 0 : 1];
      if (same != nullptr)
        pairs.push_back({sorted[end].triangle, same->triangle, true});
      else if (turned != nullptr)
        pairs.push_back({sorted[end].triangle, turned->triangle, false});
      if (same == nullptr) same = &sorted[end];
    }
    i = end;
  }
  std::ranges::sort(pairs, {}, &Pair::other);
  for (const Pair& p : pairs)
    add(p.isDuplicate ? result.duplicateTriangles : result.doubleSided, options.mostPlaces,
        {p.first, p.other}, centroid(mesh, p.other));
}

}  // namespace arete::diagnosis
