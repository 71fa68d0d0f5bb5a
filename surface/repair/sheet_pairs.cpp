// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles in the order of their angles around the edge are a circle. A triangle whose side runs forward,
// its apex at angle 0, has its normal at a quarter turn: its solid lies at the falling angles. So a backward
// side and the forward one that follows it enclose a solid. They are taken out like a pair of brackets, and
// those around them meet. At equal angles a forward side comes first: a solid of no width between the two
// sides of one sheet is not meant.
#include "surface/repair/sheet_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace arete::repair_passes {
namespace {

struct Leaf {
  CornerId side;
  double angle;  ///< of the triangle around the edge
  bool isForward;
};

std::vector<Leaf> leavesOf(const Vec3& from, const Vec3& to, std::span<const SheetSide> sides) {
  const Vec3 axis = to - from;
  std::vector<Leaf> leaves;
  Vec3 zero, quarter;
  for (const SheetSide& side : sides) {
    const Vec3 apex = side.apex - from;
    const Vec3 across = apex * dot(axis, axis) - axis * dot(apex, axis);
    if (leaves.empty()) {
      zero = across;
      quarter = cross(axis, across);
    }
    // Both parts have the scale of `zero`; the second that of the axis besides.
    const double cosine = dot(across, zero) * norm(axis), sine = dot(across, quarter);
    double angle = leaves.empty() ? 0 : std::atan2(sine, cosine);
    if (angle < 0) angle += 2 * std::numbers::pi;
    leaves.push_back({side.side, angle, side.isForward});
  }
  std::ranges::sort(leaves, [](const Leaf& a, const Leaf& b) {
    if (a.angle != b.angle) return a.angle < b.angle;
    return a.isForward != b.isForward ? a.isForward : a.side < b.side;
  });
  return leaves;
}

}  // namespace

std::vector<std::pair<CornerId, CornerId>> pairSheets(const Vec3& from, const Vec3& to,
                                                      std::span<const SheetSide> sides) {
  std::vector<Leaf> leaves = leavesOf(from, to, sides);
  std::vector<std::pair<CornerId, CornerId>> pairs;
  const auto opens = [&] {
    for (std::size_t i = 0; i < leaves.size(); ++i)
      if (!leaves[i].isForward && leaves[(i + 1) % leaves.size()].isForward) return i;
    return leaves.size();
  };
  for (std::size_t i = opens(); i < leaves.size(); i = opens()) {
    const std::size_t next = (i + 1) % leaves.size();
    pairs.push_back({leaves[i].side, leaves[next].side});
    leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
    leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
  }
  return pairs;
}

}  // namespace arete::repair_passes
