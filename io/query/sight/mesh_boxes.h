// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

struct SightBox {
  Vec3 low, high;
  void add(const Vec3& p);
  void grow(double by);
  /// The part of a segment inside, from `a` to `b`; false: nothing.
  bool clip(Vec3& a, Vec3& b) const;
};

/// Boxes among which Embree [WaldWoop2014] finds those that segments meet. Never misses one: the boxes are
/// relative to their middle, rounded outwards, and grown by more than the rounding of a segment. Thread-safe.
class MeshBoxes {
 public:
  /// O(n log n). @param slack the boxes are grown by it, so that chords may stand for curves this near.
  MeshBoxes(const std::vector<SightBox>& boxes, double slack);

  /// Calls met(box) for a superset of the boxes that come within the slack of a segment. O(log n + met).
  void along(const Vec3& from, const Vec3& to, const std::function<void(std::uint32_t)>& met) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
  SightBox all_;  ///< grown too
  Vec3 middle_;
};

}  // namespace arete
