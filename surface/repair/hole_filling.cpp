// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle may be a part of a filling if it has an area, its sides inside the hole are no edges of the
// surface, it does not fold back upon the triangle beside it, and it crosses none: a lid upon the outline of
// a flat sheet folds along all of it. Triangles of the surface that are near are found in a tree of boxes
// [CGAL]; crossings are decided exactly (surface/topology/crossing.h), by places, so that a vertex and its
// copy are one.
#include "surface/repair/hole_filling.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "engine/base/box3.h"
#include "surface/diagnosis/parts.h"
#include "surface/topology/crossing.h"

namespace arete::repair_passes {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>>>;
using Corners = HoleFilling::Corners;

/// Fillings of more corners are not searched for, nor is one held against itself: both grow fast.
constexpr std::size_t kMostSearched = 32, kMostHeldAgainstItself = 64;
/// Below this angle between two triangles at an edge, about 2.5 degrees, one lies upon the other.
constexpr double kFoldCosine = 0.999;

Point pointOf(const Vec3& p) {
  return {p.x, p.y, p.z};
}

Box3 boxOf(const PlacedTriangle& t) {
  Box3 box = Box3::empty();
  for (const Vec3& p : t.places) box.include(p);
  return box;
}

std::pair<std::uint32_t, std::uint32_t> edgeOf(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

struct HoleFilling::State {
  Triangles triangles;                 // of the surface, those with an area
  std::vector<PlacedTriangle> placed;  // the same
  Tree tree;
  std::vector<PlacedTriangle> added;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;  // of places

  void addEdges(const PlacedTriangle& t) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert(edgeOf(t.vertices[i], t.vertices[(i + 1) % 3]));
  }

  bool crosses(const PlacedTriangle& t) const {
    std::vector<Tree::Primitive_id> near;
    tree.all_intersected_primitives(
        Kernel::Triangle_3(pointOf(t.places[0]), pointOf(t.places[1]), pointOf(t.places[2])),
        std::back_inserter(near));
    const Triangles::const_iterator first = triangles.begin();
    for (const auto& hit : near)
      if (arete::cross(t, placed[std::size_t(Triangles::const_iterator(hit) - first)])) return true;
    const Box3 box = boxOf(t);
    return std::ranges::any_of(added, [&](const PlacedTriangle& other) {
      return box.meets(boxOf(other)) && arete::cross(t, other);
    });
  }
};

namespace {

/// The search for the filling of one hole.
template <class State>
class OneHole {
 public:
  OneHole(const State& surface, const HoleOutline& hole)
      : surface_(surface), hole_(hole), size_(static_cast<std::uint32_t>(hole.corners.size())) {}

  PlacedTriangle placed(const Corners& t) const {
    PlacedTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.vertices[i] = hole_.places[t[i]];
      triangle.places[i] = hole_.corners[t[i]];
    }
    return triangle;
  }

  /// CGAL's filling, if all of its triangles may be.
  std::vector<Corners> ofCgal() const {
    std::vector<Point> outline;
    for (const Vec3& p : hole_.corners) outline.push_back(pointOf(p));
    std::vector<CGAL::Triple<int, int, int>> patch;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(outline, std::back_inserter(patch));
    std::vector<Corners> filling;
    for (const auto& t : patch) {
      Corners corners{std::uint32_t(t.first), std::uint32_t(t.second), std::uint32_t(t.third)};
      std::ranges::sort(corners);
      filling.push_back(corners);
    }
    if (filling.size() + 2 != size_ ||
        !std::ranges::all_of(filling, [&](const Corners& t) { return mayBe(t); }))
      return {};
    return isFree(filling) ? filling : std::vector<Corners>();
  }

  /// The filling of the least area whose triangles all may be, by dynamic programming over the chains of
  /// sides [BarequetSharir1995].
  std::vector<Corners> searched() const {
    if (size_ > kMostSearched) return {};
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::vector<double> least(std::size_t{size_} * size_, 0);
    std::vector<std::uint32_t> apex(least.size(), 0);
    const auto at = [&](std::uint32_t i, std::uint32_t k) { return std::size_t{i} * size_ + k; };
    for (std::uint32_t length = 2; length < size_; ++length)
      for (std::uint32_t i = 0; i + length < size_; ++i) {
        const std::uint32_t k = i + length;
        least[at(i, k)] = kNone;
        for (std::uint32_t j = i + 1; j < k; ++j) {
          if (!(least[at(i, j)] < kNone && least[at(j, k)] < kNone)) continue;
          const double area = least[at(i, j)] + least[at(j, k)] + areaOf({i, j, k});
          if (area < least[at(i, k)] && mayBe({i, j, k})) {
            least[at(i, k)] = area;
            apex[at(i, k)] = j;
          }
        }
      }
    if (!(least[at(0, size_ - 1)] < kNone)) return {};
    std::vector<Corners> filling;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> chains = {{0, size_ - 1}};
    while (!chains.empty()) {
      const auto [i, k] = chains.back();
      chains.pop_back();
      if (k - i < 2) continue;
      const std::uint32_t j = apex[at(i, k)];
      filling.push_back({i, j, k});
      chains.insert(chains.end(), {{i, j}, {j, k}});
    }
    return isFree(filling) ? filling : std::vector<Corners>();
  }

 private:
  double areaOf(const Corners& t) const {
    const Vec3& p = hole_.corners[t[0]];
    return norm(cross(hole_.corners[t[1]] - p, hole_.corners[t[2]] - p)) / 2;
  }

  /// @param t in increasing order
  bool mayBe(const Corners& t) const {
    const std::array<Vec3, 3> p = {hole_.corners[t[0]], hole_.corners[t[1]], hole_.corners[t[2]]};
    if (diagnosis::areCollinear(p[0], p[1], p[2])) return false;
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    std::size_t sides = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i], to = t[(i + 1) % 3];
      if ((from + 1) % size_ != to) {
        // A side inside the hole, unless the hole is the triangle.
        if (surface_.edges.contains(edgeOf(hole_.places[from], hole_.places[to]))) return false;
        continue;
      }
      ++sides;
      // Both normals as if the two ran along the side in the same direction: alike where one lies upon the
      // other.
      const Vec3 beside =
          cross(hole_.corners[to] - hole_.corners[from], hole_.apexes[from] - hole_.corners[from]);
      if (dot(beside, normal) > kFoldCosine * norm(beside) * norm(normal)) return false;
    }
    return !surface_.crosses(placed(t));
  }

  /// Whether no two triangles of a filling cross each other.
  bool isFree(const std::vector<Corners>& filling) const {
    if (size_ > kMostHeldAgainstItself) return true;
    for (std::size_t i = 0; i < filling.size(); ++i)
      for (std::size_t j = i + 1; j < filling.size(); ++j)
        if (arete::cross(placed(filling[i]), placed(filling[j]))) return false;
    return true;
  }

  const State& surface_;
  const HoleOutline& hole_;
  const std::uint32_t size_;
};

}  // namespace

HoleFilling::HoleFilling(const TriangleMesh& mesh, std::span<const std::uint32_t> placeOf)
    : state_(std::make_unique<State>()) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const PlacedTriangle t{{placeOf[a], placeOf[b], placeOf[c]},
                           {mesh.positions[a], mesh.positions[b], mesh.positions[c]}};
    state_->addEdges(t);
    if (diagnosis::areCollinear(t.places[0], t.places[1], t.places[2])) continue;
    state_->placed.push_back(t);
    state_->triangles.emplace_back(pointOf(t.places[0]), pointOf(t.places[1]), pointOf(t.places[2]));
  }
  state_->tree.insert(state_->triangles.begin(), state_->triangles.end());
  state_->tree.build();
}

HoleFilling::~HoleFilling() = default;

std::vector<HoleFilling::Corners> HoleFilling::fill(const HoleOutline& hole) {
  const OneHole search(*state_, hole);
  std::vector<Corners> filling = search.ofCgal();
  if (filling.empty()) filling = search.searched();
  for (const Corners& t : filling) {
    state_->added.push_back(search.placed(t));
    state_->addEdges(state_->added.back());
  }
  // The outline runs as its triangles do; those of the filling run the other way.
  for (Corners& t : filling) std::swap(t[1], t[2]);
  return filling;
}

}  // namespace arete::repair_passes
