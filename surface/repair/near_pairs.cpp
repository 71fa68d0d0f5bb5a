// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes of half the distance around the points meet where two points may be within it
// [ZomorodianEdelsbrunner2000].
#include "surface/repair/near_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <tuple>

namespace arete::repair_passes {

std::vector<std::pair<std::uint32_t, std::uint32_t>> findNearPairs(std::span<const Vec3> positions,
                                                                   std::span<const std::uint32_t> points,
                                                                   double distance) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
  std::vector<Box> boxes;
  const double reach = distance / 2 * (1 + 1e-12);
  for (const std::uint32_t v : points) {
    const Vec3& p = positions[v];
    boxes.emplace_back(
        CGAL::Bbox_3(p.x - reach, p.y - reach, p.z - reach, p.x + reach, p.y + reach, p.z + reach), v);
  }
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> found;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const std::uint32_t low = std::min(a.info(), b.info()), high = std::max(a.info(), b.info());
    const double apart = norm(positions[high] - positions[low]);
    if (apart <= distance) found.emplace_back(apart, low, high);
  });
  std::ranges::sort(found);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& [apart, low, high] : found) pairs.emplace_back(low, high);
  return pairs;
}

}  // namespace arete::repair_passes
