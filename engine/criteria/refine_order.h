// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/criteria/criterion.h"
#include "engine/criteria/view.h"

namespace arete {

/// The priority of a triangle that is not fine enough: lower queues first, within one the smaller rank.
struct RefineKey {
  std::uint32_t queue = 0;
  double rank = 0;
  bool operator==(const RefineKey&) const = default;
  bool operator>(const RefineKey& other) const {
    return queue != other.queue ? queue > other.queue : rank > other.rank;
  }
};

/// The order in which triangles are refined [Fornous2003], section 2.4.3. It matters only under a budget or a
/// deadline: without them every order reaches the least cut.
class RefineOrder {
 public:
  virtual ~RefineOrder() = default;
  /// @param arrival Numbers the triangles in the order in which they entered the front.
  virtual RefineKey key(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                        const Criterion::Corners& corners, std::uint64_t arrival) const = 0;
};

/// In the order of arrival: the whole front is refined once before any of it is refined twice.
class BreadthFirst final : public RefineOrder {
 public:
  RefineKey key(const MultiTriangulation&, const Criterion&, TriangleId, const Criterion::Corners&,
                std::uint64_t arrival) const override {
    return {0, static_cast<double>(arrival)};
  }
};

/// The last arrival first: one place is refined completely, then the next.
class DepthFirst final : public RefineOrder {
 public:
  RefineKey key(const MultiTriangulation&, const Criterion&, TriangleId, const Criterion::Corners&,
                std::uint64_t arrival) const override {
    return {0, -static_cast<double>(arrival)};
  }
};

/// The largest severity of the criterion first: the error, or the pixels of a view. Optimal under a budget:
/// it results in the least cut for the severity that it reaches.
class WorstFirst final : public RefineOrder {
 public:
  RefineKey key(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                const Criterion::Corners& corners, std::uint64_t) const override {
    return {0, -criterion.severity(mt, t, corners)};
  }
};

/// Of a surface: the largest integral of the squared distance first, by the triangle's stored root mean
/// square and its area. A budget that is spent so leaves about the least mean square error; the largest error
/// is not the least one.
class LargestSquaresFirst final : public RefineOrder {
 public:
  RefineKey key(const MultiTriangulation& mt, const Criterion&, TriangleId t,
                const Criterion::Corners& corners, std::uint64_t) const override {
    const auto at = [&](std::size_t i) { return mt.position(VertexId(corners[i])); };
    const double rms = mt.decoded(kRms, t);
    return {0, -rms * rms * norm(cross(at(1) - at(0), at(2) - at(0)))};
  }
};

/// Two queues [Fornous2003]. First triangles that the view may see, the nearest to the eye first. Then the
/// others, by a weighted sum of the distances of the vertex that the refinement inserts from the eye and from
/// the axis of the view, with a penalty behind the eye. So a camera near the ground in a coarse triangle
/// refines the ground around it, although no vertex is in sight.
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
