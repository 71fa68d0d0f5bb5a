// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles in the order of their angles around the edge are a circle. A triangle whose side runs forward,
// its apex at angle 0, has its normal at a quarter turn: its solid lies at the falling angles. So a backward
// side and the forward one that follows it enclose a solid, and so do the two around them that they leave as
// neighbours: pairs of brackets. At equal angles a forward side comes first: a solid of no width between the
// two sides of one sheet is not meant.
#include "surface/repair/sheet_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
  const std::vector<Leaf> leaves = leavesOf(from, to, sides);
  std::vector<std::pair<CornerId, CornerId>> pairs;
  // Brackets along a circle: those that are open at its end are closed on the second way round.
  std::vector<std::size_t> open;
  std::vector<std::uint8_t> isClosed(leaves.size(), 0);
  for (std::size_t i = 0; i < 2 * leaves.size(); ++i) {
    const std::size_t leaf = i % leaves.size();
    if (!leaves[leaf].isForward) {
      if (i < leaves.size()) open.push_back(leaf);
    } else if (isClosed[leaf] == 0 && !open.empty()) {
      pairs.push_back({leaves[open.back()].side, leaves[leaf].side});
      open.pop_back();
      isClosed[leaf] = 1;
    }
  }
  return pairs;
}

}  // namespace arete::repair_passes
