// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/criteria/motion.h"
#include "engine/criteria/region.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// c(t): when a triangle is fine enough (Mirza, Skvortsov, Sobolev). Errors are vertical, in the unit of the
/// heights.
///
/// A criterion that allows an error by place says so through allowedError(): then it can steer the saturated
/// cut, whose test per node needs a bound over the node's sphere. Any other criterion (isMonotone() false)
/// steers the minimal cut. mostAllowed() only saves time: it decides about triangles before they are asked
/// for.
class Criterion {
 public:
  using Corners = std::array<std::uint32_t, 3>;  ///< MT vertices

  virtual ~Criterion() = default;

  /// Whether the triangle may stay in the front.
  virtual bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const = 0;

  /// How much a triangle that is not fine enough weighs when a budget is spent, the worst first: its error,
  /// or what the criterion makes of it (pixels).
  virtual double severity(const MultiTriangulation& mt, TriangleId t, const Corners&) const {
    return mt.error(t);
  }

  /// Up to which severity every triangle is fine enough; NaN where it is not the severity that decides.
  virtual double severityLimit() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// The same criterion up to another severity; null where severityLimit() is NaN. Precondition: > 0.
  virtual std::unique_ptr<const Criterion> withSeverityLimit(double limit) const {
    static_cast<void>(limit);
    return nullptr;
  }

  /// Whether allowedError() is a bound: for every ball inside another it is at least the other's.
  virtual bool isMonotone() const { return false; }
  /// The least error that the criterion allows to any triangle that meets the ball (metric space).
  virtual double allowedError(const Sphere&) const { return 0; }

  /// The most error that it allows to any triangle within the ball; infinite where it does not know.
  virtual double mostAllowed(const Sphere&) const { return std::numeric_limits<double>::infinity(); }

  /// Which of these balls, 64 at most, are allowed less than their error: bit i of the answer is
  /// error[i] > allowedError(ball[i]). What decides about many balls at once may override it.
  /// Precondition: isMonotone().
  virtual std::uint64_t exceeding(std::span<const Sphere> balls, std::span<const float> errors) const;

  /// A copy to be asked about when the caller's is gone. Null where motionSince() knows nothing anyway.
  virtual std::unique_ptr<const Criterion> remembered() const { return nullptr; }
  /// How far it has moved since it was `before`, at most; nothing where they cannot be compared.
  virtual std::optional<Motion> motionSince(const Criterion& before) const {
    static_cast<void>(before);
    return {};
  }
  /// As exceeding(), and for how long: no criterion that has moved by at most units[i] times `rate` since
  /// this one (motionSince() it) answers otherwise for ball i. The parts of `rate` are positive. 0 units: who
  /// knows. Precondition: as of exceeding(), and as many units.
  virtual std::uint64_t exceedingFor(std::span<const Sphere> balls, std::span<const float> errors,
                                     const Motion& rate, std::span<float> units) const {
    static_cast<void>(rate);
    std::fill(units.begin(), units.end(), 0.0f);
    return exceeding(balls, errors);
  }

  /// The same error allowed everywhere: the front is then found without looking at places. NaN otherwise.
  virtual double uniformError() const { return std::numeric_limits<double>::quiet_NaN(); }
};

/// Error at most E everywhere.
class UniformError final : public Criterion {
 public:
  explicit UniformError(double maxError) : maxError_(maxError) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners&) const override {
    return mt.error(t) <= maxError_;
  }
  bool isMonotone() const override { return true; }
  double allowedError(const Sphere&) const override { return maxError_; }
  double mostAllowed(const Sphere&) const override { return maxError_; }
  double uniformError() const override { return maxError_; }

 private:
  double maxError_;
};

/// One error for the triangles that touch a region of the plan, another for the rest.
class RegionError final : public Criterion {
 public:
  /// The region is in plan coordinates of the MT. Precondition: insideError <= outsideError.
  RegionError(Region region, const MetricFrame& metric, double insideError, double outsideError)
      : region_(std::move(region)),
        metricRegion_(region_.scaled(metric)),
        insideError_(insideError),
        outsideError_(outsideError) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  bool isMonotone() const override { return true; }
  double allowedError(const Sphere& s) const override {
    return metricRegion_.meetsDisc({s.x, s.y}, s.radius) ? insideError_ : outsideError_;
  }
  double mostAllowed(const Sphere& s) const override {
    return metricRegion_.holdsDisc({s.x, s.y}, s.radius) ? insideError_ : outsideError_;
  }
  std::uint64_t exceeding(std::span<const Sphere> balls, std::span<const float> errors) const override;
  const Region& region() const { return region_; }

 private:
  Region region_, metricRegion_;
  double insideError_, outsideError_;
};

/// An error that grows with the distance from a place: nearError + growth * distance, at most farError.
/// Distances are in metric space, between the place and the nearest point of a triangle.
class DistanceError final : public Criterion {
 public:
  struct Options {
    Vec3 place;            ///< metric space
    bool inPlan = false;   ///< distances in the plan alone: place.z does not count
    double nearError = 0;  ///< allowed at the place
    double growth = 0;     ///< error per metric unit, >= 0
    double farError = std::numeric_limits<double>::infinity();  ///< allowed at most
  };
  explicit DistanceError(const Options& options) : o_(options) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return mt.error(t) <= allowedFor(mt, corners);
  }
  /// The error in units of the one allowed, where one is.
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  bool isMonotone() const override { return true; }
  double allowedError(const Sphere& s) const override;
  double mostAllowed(const Sphere& s) const override;

 private:
  double allowedFor(const MultiTriangulation& mt, const Corners& corners) const;
  double allowedAt(double distance) const;
  double distanceToMiddle(const Sphere& s) const;

  Options o_;
};

/// Whatever a caller makes of a triangle.
class Predicate final : public Criterion {
 public:
  using Test = std::function<bool(const MultiTriangulation&, TriangleId, const Corners&)>;
  explicit Predicate(Test isFineEnough) : test_(std::move(isFineEnough)) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return test_(mt, t, corners);
  }

 private:
  Test test_;
};

/// Fine enough for every part. Monotone when all parts are.
class AllOf final : public Criterion {
 public:
  using Parts = std::vector<std::shared_ptr<const Criterion>>;
  /// Precondition: at least one part, none null.
  explicit AllOf(Parts parts) : parts_(std::move(parts)) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  /// The largest of the parts that are not satisfied: parts of one unit make sense.
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  bool isMonotone() const override;
  double allowedError(const Sphere& s) const override;
  double mostAllowed(const Sphere& s) const override;
  std::uint64_t exceeding(std::span<const Sphere> balls, std::span<const float> errors) const override;

 private:
  Parts parts_;
};

/// Fine enough for one part at least. Monotone when all parts are.
class AnyOf final : public Criterion {
 public:
  using Parts = AllOf::Parts;
  /// Precondition: at least one part, none null.
  explicit AnyOf(Parts parts) : parts_(std::move(parts)) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  /// The smallest of the parts': what is left to the nearest of them.
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  bool isMonotone() const override;
  double allowedError(const Sphere& s) const override;
  double mostAllowed(const Sphere& s) const override;
  std::uint64_t exceeding(std::span<const Sphere> balls, std::span<const float> errors) const override;

 private:
  Parts parts_;
};

}  // namespace arete
