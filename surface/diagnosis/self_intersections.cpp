// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of triangles whose boxes meet [ZomorodianEdelsbrunner2000] are decided exactly
// (surface/topology/crossing.h).
#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

#include "surface/diagnosis/parts.h"
#include "surface/topology/crossing.h"

namespace arete::diagnosis {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                                      CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

struct Interrupted {};

/// Sets of at most so many boxes are scanned instead of divided further: triangles of a surface meet few
/// others.
constexpr std::ptrdiff_t kScanned = 2000;

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

  const auto placed = [&](std::uint32_t t) {
    const Triangle& v = mesh.triangles[t];
    return PlacedTriangle{v, {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]}};
  };
  std::vector<Pair> pairs;
  const auto visit = [&](const Box* a, const Box* b) {
    if (context.cancelled()) throw Interrupted();
    const std::uint32_t first = std::min(a->info(), b->info()), second = std::max(a->info(), b->info());
    if (cross(placed(first), placed(second))) pairs.push_back({first, second});
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
