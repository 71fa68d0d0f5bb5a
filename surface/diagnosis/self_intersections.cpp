// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of triangles whose boxes meet [ZomorodianEdelsbrunner2000] are decided by exact predicates, according
// to the vertices that they share:
//
//   none    the triangles, as closed sets, must not meet
//   one     the side opposite the shared vertex, of either triangle, must not meet the other triangle
//   two     the two apexes must not lie in one plane with the edge and on the same side of it
//   three   they are one triangle twice: always reported
//
// With one shared vertex this is complete: two triangles that meet in a point besides the shared one meet in
// a segment that starts there, and that segment ends on one of the two opposite sides.
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

#include "surface/diagnosis/parts.h"

namespace arete::diagnosis {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                                      CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

struct Interrupted {};

/// Sets of at most so many boxes are scanned instead of divided further: triangles of a surface meet few
/// others.
constexpr std::ptrdiff_t kScanned = 2000;

class Meeting {
 public:
  explicit Meeting(const TriangleMesh& mesh) : mesh_(mesh) {}

  bool operator()(std::uint32_t first, std::uint32_t second) const {
    Triangle s = mesh_.triangles[first], t = mesh_.triangles[second];
    const int shared = alignShared(s, t);
    switch (shared) {
      case 0:
        return CGAL::do_intersect(triangle(s), triangle(t));
      case 1:
        return CGAL::do_intersect(triangle(s), side(t)) || CGAL::do_intersect(triangle(t), side(s));
      case 2: {
        const Point a = point(s[0]), b = point(s[1]), c = point(s[2]), d = point(t[2]);
        return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
      }
      default:
        return true;
    }
  }

 private:
  Point point(std::uint32_t v) const {
    const Vec3& p = mesh_.positions[v];
    return {p.x, p.y, p.z};
  }
  Kernel::Triangle_3 triangle(const Triangle& t) const { return {point(t[0]), point(t[1]), point(t[2])}; }
  /// The side opposite the first corner.
  Kernel::Segment_3 side(const Triangle& t) const { return {point(t[1]), point(t[2])}; }

  /// Permutes both so that the shared vertices come first, in the same order. Returns how many there are.
  static int alignShared(Triangle& s, Triangle& t) {
    int shared = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = shared; j < 3; ++j)
        if (s[i] == t[j]) {
          std::swap(t[shared], t[j]);
          std::swap(s[shared], s[i]);
          ++shared;
          break;
        }
    return shared;
  }

  const TriangleMesh& mesh_;
};

}  // namespace

std::optional<std::vector<Pair>> findSelfIntersections(const TriangleMesh& mesh, const RunContext& context) {
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 &a = mesh.positions[mesh.triangles[t][0]], &b = mesh.positions[mesh.triangles[t][1]],
               &c = mesh.positions[mesh.triangles[t][2]];
    if (areCollinear(a, b, c)) continue;
    boxes.emplace_back(CGAL::Bbox_3(a.x, a.y, a.z, a.x, a.y, a.z) +
                           CGAL::Bbox_3(b.x, b.y, b.z, b.x, b.y, b.z) +
                           CGAL::Bbox_3(c.x, c.y, c.z, c.x, c.y, c.z),
                       t);
  }
  std::vector<const Box*> pointers;
  for (const Box& box : boxes) pointers.push_back(&box);

  const Meeting meet(mesh);
  std::vector<Pair> pairs;
  const auto visit = [&](const Box* a, const Box* b) {
    if (context.cancelled()) throw Interrupted();
    const std::uint32_t first = std::min(a->info(), b->info()), second = std::max(a->info(), b->info());
    if (meet(first, second)) pairs.push_back({first, second});
  };
  try {
    CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), visit, kScanned);
  } catch (const Interrupted&) {
    return std::nullopt;
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace arete::diagnosis
