// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/box3.h"
#include "engine/base/nearest_on_triangle.h"
#include "engine/base/oriented_box.h"
#include "engine/base/vec.h"

namespace arete {

/// A point of a triangle: its corners' shares, each at least 0, which sum to 1. A share is 0, to the bit, on
/// the side opposite its corner.
struct TrianglePoint {
  Vec3 place;
  std::array<double, 3> shares{};
};

/// The point of a triangle that is nearest to `p`, by the regions of its corners, sides and inside
/// [Ericson2005]. Of a triangle {a, b, b} that of the segment a-b, with no share of the third corner. O(1).
TrianglePoint nearestWithShares(const Vec3& p, const SpaceTriangle& t);

/// A bounding volume hierarchy over triangles of space, asked for nearest points: boxes of up to eight boxes
/// or triangles each. Thread-safe while it is only asked. Answers are the same on every processor.
class TriangleBvh {
 public:
  using Corners = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  struct Answer {
    std::uint32_t triangle = kNone;
    TrianglePoint point;
    double squaredDistance = 0;
    std::uint32_t looks = 0;  ///< boxes of eight and leaves that the search opened
  };

  /// Of all triangles, those without area too. O(n log n); about 300 bytes a triangle, and half as much again
  /// for long ones that lie aslant (OrientedBox).
  TriangleBvh(std::span<const Vec3> positions, std::span<const Corners> triangles);

  /// The same triangles after their vertices have moved. The tree keeps its shape, so answers are right and
  /// slow down where vertices move far. O(n)
  void refit(std::span<const Vec3> positions, std::span<const Corners> triangles);

  bool isEmpty() const { return order_.empty(); }
  /// The nearest point; of several triangles at one distance, but for rounding, one that depends on the
  /// guess. Precondition: not empty. About O(log n) near the triangles, also around a vertex of many, less
  /// with a good guess.
  /// @param guess  a triangle that may be near; kNone: none is known
  Answer nearest(const Vec3& p, std::uint32_t guess = kNone) const;

 private:
  static constexpr std::uint32_t kWide = 8;
  using Lanes = std::array<double, kWide>;

  /// The boxes of what is below a node; of fewer than eight the last ones are empty.
  struct Node {
    std::array<Lanes, 3> low, high;
    std::array<std::uint32_t, kWide> child;  // a node, or kLeaf plus a leaf
    std::uint32_t aslant = kNone;            // of aslant_
  };
  /// The oriented boxes of a node's children; one without has no bounds.
  struct Aslant {
    std::array<std::array<Lanes, 3>, 3> axes;
    std::array<Lanes, 3> low, high;
  };
  static constexpr std::uint32_t kLeaf = 0x80000000;
  /// Triangles a, b, c; of fewer than eight the last one again.
  struct Leaf {
    std::array<Lanes, 3> a, ab, ac;
    Lanes abab, abac, acac;
    /// Inverses of the squared lengths of ab, ac and bc, and of four times the squared area; 0 where there is
    /// none.
    Lanes perAb, perAc, perBc, perArea;
  };

  static void squaresOf(const Node& node, const Vec3& p, Lanes& to);
  /// Raises them by the oriented boxes.
  static void raise(const Aslant& boxes, const Vec3& p, Lanes& squares);
  static void squaresOf(const Leaf& leaf, const Vec3& p, Lanes& to);
  /// Makes what is below a range of triangles. @return as Node::child
  std::uint32_t build(std::span<std::uint32_t> range, std::span<const Box3> boxes);
  /// What is below a child: its box and its leaves, which follow each other.
  struct Below {
    Box3 box = Box3::empty();
    std::uint32_t first = kNone, end = 0;
  };
  Below refit(std::uint32_t child, std::span<const Vec3> positions, std::span<const Corners> triangles);
  void putAslant(Node& node, std::size_t lane, const OrientedBox& box);

  std::vector<std::uint32_t> order_;    // triangles, eight for each leaf
  std::vector<std::uint32_t> entryOf_;  // by triangle: its place in order_
  std::vector<SpaceTriangle> places_;   // in this order
  std::vector<Node> nodes_;
  std::vector<Aslant> aslant_;
  std::vector<Leaf> leaves_;
  std::uint32_t root_ = kLeaf;
};

}  // namespace arete
