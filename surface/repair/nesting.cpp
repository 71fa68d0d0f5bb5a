// SPDX-License-Identifier: GPL-3.0-or-later
//
// A ray from a vertex leaves each part that holds the vertex an odd number of times. The ray is a segment to
// a point beyond the box of all, so that orientations of five given points decide everything. Where it meets
// a side or a corner of a triangle, another direction is taken.
#include "surface/repair/nesting.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "surface/diagnosis/parts.h"
#include "surface/topology/disjoint_sets.h"

namespace arete::repair_passes {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>>>;

constexpr std::size_t kMostSamples = 64, kMostCompared = 2000;

Point pointOf(const Vec3& p) {
  return {p.x, p.y, p.z};
}

/// Where a point is: in which parts, and on which.
struct Sides {
  std::vector<std::uint32_t> inside, on;
};

/// Answers for points which parts hold them.
class Locator {
 public:
  Locator(const TriangleMesh& mesh, std::span<const ClosedPart> parts, const Box3& box)
      : reach_(4 * box.diagonal()) {
    for (std::uint32_t part = 0; part < parts.size(); ++part)
      for (const std::uint32_t t : parts[part].triangles) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
        if (diagnosis::areCollinear(p, q, r)) continue;
        triangles_.emplace_back(pointOf(p), pointOf(q), pointOf(r));
        partOf_.push_back(part);
      }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  /// Missing where every direction met a side or a corner.
  std::optional<Sides> sidesOf(const Vec3& p, std::uint32_t own) const {
    constexpr std::array<Vec3, 8> kDirections = {{{0.612, 0.487, 0.623},
                                                  {-0.541, 0.682, 0.493},
                                                  {0.437, -0.719, 0.541},
                                                  {0.683, 0.391, -0.617},
                                                  {-0.367, -0.823, 0.433},
                                                  {-0.713, 0.287, -0.639},
                                                  {0.193, -0.613, -0.767},
                                                  {-0.831, -0.419, -0.367}}};
    for (const Vec3& direction : kDirections)
      if (std::optional<Sides> found = along(p, p + direction * reach_, own)) return found;
    return std::nullopt;
  }

 private:
  std::optional<Sides> along(const Vec3& from, const Vec3& to, std::uint32_t own) const {
    const Point p = pointOf(from), q = pointOf(to);
    std::vector<Tree::Primitive_id> hits;
    tree_.all_intersected_primitives(Kernel::Segment_3(p, q), std::back_inserter(hits));
    std::map<std::uint32_t, bool> isOdd;
    Sides sides;
    for (const auto& hit : hits) {
      const std::uint32_t part = partOf_[std::size_t(hit - triangles_.begin())];
      if (part == own) continue;
      const Point &a = hit->vertex(0), &b = hit->vertex(1), &c = hit->vertex(2);
      if (CGAL::orientation(a, b, c, p) == CGAL::COPLANAR) {
        if (CGAL::orientation(a, b, c, q) == CGAL::COPLANAR)
          return std::nullopt;  // the ray lies in its plane
        sides.on.push_back(part);
        continue;
      }
      if (CGAL::orientation(p, q, a, b) == CGAL::COPLANAR ||
          CGAL::orientation(p, q, b, c) == CGAL::COPLANAR || CGAL::orientation(p, q, c, a) == CGAL::COPLANAR)
        return std::nullopt;
      isOdd[part] = !isOdd[part];
    }
    std::ranges::sort(sides.on);
    sides.on.erase(std::unique(sides.on.begin(), sides.on.end()), sides.on.end());
    for (const auto& [part, odd] : isOdd)
      if (odd && !std::ranges::binary_search(sides.on, part)) sides.inside.push_back(part);
    return sides;
  }

  double reach_;
  mutable Triangles triangles_;
  std::vector<std::uint32_t> partOf_;  // by triangle
  Tree tree_;
};

/// Some of the things, spread over all of them.
template <class T>
std::vector<T> spread(const std::vector<T>& things) {
  std::vector<T> some;
  const std::size_t count = std::min(things.size(), kMostSamples);
  for (std::size_t i = 0; i < count; ++i) some.push_back(things[i * things.size() / count]);
  return some;
}

std::vector<Vec3> corners(const TriangleMesh& mesh, const ClosedPart& part) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : part.triangles)
    vertices.insert(vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  std::vector<Vec3> places;
  for (const std::uint32_t v : spread(vertices)) places.push_back(mesh.positions[v]);
  return places;
}

std::vector<Vec3> middles(const TriangleMesh& mesh, const ClosedPart& part) {
  std::vector<Vec3> places;
  for (const std::uint32_t t : spread(part.triangles)) places.push_back(diagnosis::centroid(mesh, t));
  return places;
}

/// How many places of a part are inside of another one, and how many on it.
struct Votes {
  std::size_t inside = 0, on = 0;
};

class Search {
 public:
  Search(const TriangleMesh& mesh, std::span<const ClosedPart> parts, const Box3& box)
      : mesh_(mesh), parts_(parts), locator_(mesh, parts, box), crossing_(parts.size()) {}

  Nesting run(const std::vector<std::uint8_t>& mayMeet) {
    std::vector<std::vector<std::uint32_t>> holders(parts_.size());
    for (std::uint32_t part = 0; part < parts_.size(); ++part)
      if (mayMeet[part] != 0) holders[part] = holdersOf(part);
    Nesting nesting;
    for (std::uint32_t part = 0; part < parts_.size(); ++part) {
      nesting.crossing.push_back(crossing_.find(part));
      nesting.depth.push_back(static_cast<std::uint32_t>(std::ranges::count_if(
          holders[part], [&](std::uint32_t h) { return crossing_.find(h) != crossing_.find(part); })));
    }
    return nesting;
  }

 private:
  std::vector<std::uint32_t> holdersOf(std::uint32_t part) {
    std::map<std::uint32_t, Votes> votes;
    std::size_t samples = vote(corners(mesh_, parts_[part]), part, votes);
    // Parts on which all vertices lie: the middles of the triangles say on which side.
    std::map<std::uint32_t, Votes> second;
    std::size_t middlesTaken = 0;
    if (std::ranges::any_of(votes, [&](const auto& v) { return v.second.on == samples; }))
      middlesTaken = vote(middles(mesh_, parts_[part]), part, second);
    std::vector<std::uint32_t> holders;
    for (const auto& [other, first] : votes) {
      const bool isOnAll = first.on == samples;
      const Votes v = isOnAll ? second[other] : first;
      const std::size_t outside = (isOnAll ? middlesTaken : samples) - v.inside - v.on;
      if (v.inside == 0) continue;
      if (outside > 0 && !isOnAll)
        crossing_.unite(part, other);
      else if (outside == 0 && parts_[other].volume > parts_[part].volume * (1 + 1e-9))
        holders.push_back(other);
    }
    return holders;
  }

  std::size_t vote(const std::vector<Vec3>& places, std::uint32_t part,
                   std::map<std::uint32_t, Votes>& votes) const {
    std::size_t taken = 0;
    for (const Vec3& p : places) {
      const std::optional<Sides> sides = locator_.sidesOf(p, part);
      if (!sides) continue;
      ++taken;
      for (const std::uint32_t other : sides->inside)
        if (parts_[other].object == parts_[part].object) ++votes[other].inside;
      for (const std::uint32_t other : sides->on)
        if (parts_[other].object == parts_[part].object) ++votes[other].on;
    }
    return taken;
  }

  const TriangleMesh& mesh_;
  std::span<const ClosedPart> parts_;
  Locator locator_;
  DisjointSets crossing_;
};

/// By part: whether its box meets that of another part of its object. Of many parts, all may.
std::vector<std::uint8_t> findMeeting(std::span<const ClosedPart> parts) {
  std::vector<std::uint8_t> mayMeet(parts.size(), parts.size() > kMostCompared ? 1 : 0);
  if (parts.size() > kMostCompared) return mayMeet;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size(); ++j)
      if (parts[i].object == parts[j].object && parts[i].box.meets(parts[j].box)) mayMeet[i] = mayMeet[j] = 1;
  return mayMeet;
}

}  // namespace

Nesting findNesting(const TriangleMesh& mesh, std::span<const ClosedPart> parts) {
  Nesting none{std::vector<std::uint32_t>(parts.size(), 0), std::vector<std::uint32_t>(parts.size())};
  std::iota(none.crossing.begin(), none.crossing.end(), 0u);
  if (parts.size() < 2) return none;
  const std::vector<std::uint8_t> mayMeet = findMeeting(parts);
  Box3 box = Box3::empty();
  for (const ClosedPart& part : parts) {
    box.include(part.box.low);
    box.include(part.box.high);
  }
  if (std::ranges::count(mayMeet, 1) == 0 || !std::isfinite(4 * box.diagonal())) return none;
  return Search(mesh, parts, box).run(mayMeet);
}

}  // namespace arete::repair_passes
