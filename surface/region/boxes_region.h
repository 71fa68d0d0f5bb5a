// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/base/vec.h"
#include "engine/criteria/space_region.h"

namespace arete {

/// The union of boxes. Queries are O(log boxes + boxes near the query).
class BoxesRegion final : public SpaceRegion {
 public:
  /// @param boxes  the least and the largest coordinates of each. O(n log n).
  explicit BoxesRegion(std::vector<std::array<Vec3, 2>> boxes);

  bool meetsTriangle(const SpaceTriangle& triangle, double widening) const override;
  bool meetsBall(const Vec3& c, double r) const override;
  /// Whether one of the boxes holds the ball: false also where only several together do.
  bool holdsBall(const Vec3& c, double r) const override;

 private:
  /// A box around the boxes first .. first + count - 1; of one of them, itself.
  struct Node {
    BoxRegion box;
    std::size_t count;
    std::size_t second;  ///< the other half; the first is the next node
  };

  void split(std::size_t first, std::size_t count);
  /// Whether `test` holds of a box whose ancestors it may hold of: `mayHold`.
  template <class MayHold, class Test>
  bool holdsOfAny(const MayHold& mayHold, const Test& test) const;

  std::vector<std::array<Vec3, 2>> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace arete
