// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles in the order of their angles around the edge are a circle. A triangle whose side runs forward,
// its apex at angle 0, has its normal at a quarter turn: its solid lies at the falling angles. So a backward
// side and the forward one that follows it enclose a solid, and so do the two around them that they leave as
// neighbours: pairs of brackets. At equal angles a forward side comes first: a solid of no width between the
// two sides of one sheet is not meant.
//
// Angles are compared by exact predicates, which never compute one: the half plane of the first apex divides
// the others into those at its own angle, those before half a turn, those at it and those beyond it.
#include "surface/repair/sheet_pairs.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace arete::repair_passes {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

Point pointOf(const Vec3& p) {
  return {p.x, p.y, p.z};
}

struct Leaf {
  CornerId side;
  Point apex;
  int sector;  ///< 0: at the angle of the first apex, 1: before half a turn, 2: at half a turn, 3: beyond it
  bool isForward;
};

/// Whether two apexes in one plane with the edge are on the same side of it.
bool areOnOneSide(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b) {
  const Vec3 axis = to - from;
  const auto across = [&](const Vec3& apex) {
    const Vec3 out = apex - from;
    return out * dot(axis, axis) - axis * dot(out, axis);
  };
  return dot(across(a), across(b)) >= 0;
}

std::vector<Leaf> leavesOf(const Vec3& from, const Vec3& to, std::span<const SheetSide> sides) {
  const Point p = pointOf(from), q = pointOf(to);
  std::vector<Leaf> leaves;
  for (const SheetSide& side : sides) {
    Leaf leaf{side.side, pointOf(side.apex), 0, side.isForward};
    if (!leaves.empty() && leaf.apex != leaves[0].apex)
      switch (CGAL::orientation(p, q, leaves[0].apex, leaf.apex)) {
        case CGAL::POSITIVE:
          leaf.sector = 1;
          break;
        case CGAL::NEGATIVE:
          leaf.sector = 3;
          break;
        default:
          leaf.sector = areOnOneSide(from, to, sides[0].apex, side.apex) ? 0 : 2;
      }
    leaves.push_back(leaf);
  }
  const auto isBefore = [&](const Leaf& a, const Leaf& b) {
    if (a.sector != b.sector) return a.sector < b.sector;
    if (a.sector == 1 || a.sector == 3) {
      const CGAL::Orientation turn = CGAL::orientation(p, q, a.apex, b.apex);
      if (turn != CGAL::COPLANAR) return turn == CGAL::POSITIVE;
    }
    return a.isForward != b.isForward ? a.isForward : a.side < b.side;
  };
  std::ranges::sort(leaves, isBefore);
  return leaves;
}

/// Takes out the pairs of leaves at equal angles whose sides run against each other.
std::vector<std::pair<CornerId, CornerId>> takeTwins(std::vector<Leaf>& leaves, const Vec3& from,
                                                     const Vec3& to) {
  const Point p = pointOf(from), q = pointOf(to);
  const auto areInOnePlane = [&](const Leaf& a, const Leaf& b) {
    return a.sector == b.sector && CGAL::orientation(p, q, a.apex, b.apex) == CGAL::COPLANAR;
  };
  std::vector<std::pair<CornerId, CornerId>> pairs;
  std::vector<Leaf> left;
  for (std::size_t begin = 0, end = 0; begin < leaves.size(); begin = end) {
    std::vector<Leaf> forward, backward;
    for (end = begin; end < leaves.size() && areInOnePlane(leaves[begin], leaves[end]); ++end)
      (leaves[end].isForward ? forward : backward).push_back(leaves[end]);
    const std::size_t twins = std::min(forward.size(), backward.size());
    for (std::size_t i = 0; i < twins; ++i) pairs.push_back({forward[i].side, backward[i].side});
    left.insert(left.end(), forward.begin() + std::ptrdiff_t(twins), forward.end());
    left.insert(left.end(), backward.begin() + std::ptrdiff_t(twins), backward.end());
  }
  leaves = std::move(left);
  return pairs;
}

}  // namespace

std::vector<std::pair<CornerId, CornerId>> pairSheets(const Vec3& from, const Vec3& to,
                                                      std::span<const SheetSide> sides,
                                                      SheetPairing pairing) {
  std::vector<Leaf> leaves = leavesOf(from, to, sides);
  std::vector<std::pair<CornerId, CornerId>> pairs;
  if (pairing == SheetPairing::twins) pairs = takeTwins(leaves, from, to);
  const bool opensForward = pairing == SheetPairing::spaces;
  // Brackets along a circle: those that are open at its end are closed on the second way round.
  std::vector<std::size_t> open;
  std::vector<std::uint8_t> isClosed(leaves.size(), 0);
  for (std::size_t i = 0; i < 2 * leaves.size(); ++i) {
    const std::size_t leaf = i % leaves.size();
    if (leaves[leaf].isForward == opensForward) {
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
