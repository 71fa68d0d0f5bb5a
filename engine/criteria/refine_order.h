// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/criteria/criterion.h"
#include "engine/criteria/view.h"

namespace arete {

/// Which of the triangles that are not fine enough is refined next, when not all of them can be: smaller
/// first, the earlier queue before the later.
struct RefineKey {
  std::uint32_t queue = 0;
  double rank = 0;
  bool operator==(const RefineKey&) const = default;
  bool operator>(const RefineKey& other) const {
    return queue != other.queue ? queue > other.queue : rank > other.rank;
  }
};

/// The strategies of the explicit multitriangulation (Fornous 2003, 2.4.3). Where neither a budget nor a
/// deadline ends the walk, all of them reach the same cut: the least one.
class RefineOrder {
 public:
  virtual ~RefineOrder() = default;
  /// `arrival` numbers the triangles as they came up.
  virtual RefineKey key(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                        const Criterion::Corners& corners, std::uint64_t arrival) const = 0;
};

/// First come, first refined: the whole front one step finer before any of it goes two.
class BreadthFirst final : public RefineOrder {
 public:
  RefineKey key(const MultiTriangulation&, const Criterion&, TriangleId, const Criterion::Corners&,
                std::uint64_t arrival) const override {
    return {0, static_cast<double>(arrival)};
  }
};

/// Last come, first refined: one place to the end, then the next.
class DepthFirst final : public RefineOrder {
 public:
  RefineKey key(const MultiTriangulation&, const Criterion&, TriangleId, const Criterion::Corners&,
                std::uint64_t arrival) const override {
    return {0, -static_cast<double>(arrival)};
  }
};

/// The largest severity of the criterion first: the error, or the pixels of a view. Under a budget this is
/// the best there is: what it leaves is the least cut for the severity it reached.
class WorstFirst final : public RefineOrder {
 public:
  RefineKey key(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                const Criterion::Corners& corners, std::uint64_t) const override {
    return {0, -criterion.severity(mt, t, corners)};
  }
};

/// Two queues. First what the view may see, the nearest to the eye first; then the rest by the weighted sum
/// of the distances of the significant point (the vertex that the refinement inserts) from the eye and from
/// the axis of the view, with a penalty behind the eye. So a camera close to the ground in the middle of a
/// coarse triangle refines the ground around it, although no vertex is in sight.
class TwoQueues final : public RefineOrder {
 public:
  struct Options {
    View view;
    double axisWeight = 1;      ///< w1: of the distance from the axis
    double distanceWeight = 1;  ///< w2: of the distance from the eye
    double behindFactor = 4;    ///< the sum is multiplied by it behind the eye
  };
  explicit TwoQueues(const Options& options) : o_(options), frustum_(options.view) {}

  RefineKey key(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                const Criterion::Corners& corners, std::uint64_t arrival) const override;

 private:
  Options o_;
  Frustum frustum_;
};

}  // namespace arete
