// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "engine/criteria/motion.h"
#include "engine/criteria/region.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

class BoundedCriterion;
class KineticCriterion;

/// Decides when a triangle is fine enough: the extraction condition of [DeFlorianiMagilloPuppo1998]. Errors
/// are vertical, in the unit of heights; of a surface they are distances.
///
/// What is promised by place holds for the places of the source. A triangle of a heightfield stands for what
/// is above and below it. One of a surface stands for a part of the source that lies beside it, within its
/// error: criteria of surfaces test the triangle widened by that.
///
/// A Criterion tests triangles and can take minimal cuts. A BoundedCriterion also bounds the allowed error
/// over balls: it can take saturated cuts, and takes minimal ones faster. A KineticCriterion also bounds its
/// motion: a cut that follows it (IncrementalCut) evaluates little per frame. Thread-safe: all functions are
/// const.
class Criterion {
 public:
  using Corners = std::array<std::uint32_t, 3>;  ///< MT vertices

  virtual ~Criterion() = default;

  /// Whether the triangle may stay in the front.
  virtual bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const = 0;

  /// The weight of a triangle that is not fine enough. A budget is spent on the largest first. By default the
  /// triangle's error; a view returns pixels.
  virtual double severity(const MultiTriangulation& mt, TriangleId t, const Corners&) const {
    return mt.error(t);
  }

  /// This criterion with its bounds; null when it has none.
  virtual const BoundedCriterion* bounded() const { return nullptr; }
};

/// A criterion that bounds the allowed error over balls of metric space.
class BoundedCriterion : public Criterion {
 public:
  /// A lower bound of the error that the criterion allows to any triangle that meets the ball; of a surface,
  /// to any that stands for a part of the source in the ball, as a node's ball contains it. Not larger for a
  /// ball that contains this one.
  virtual double allowedError(const Sphere& ball) const = 0;

  /// An upper bound of the error that the criterion allows to any triangle within the ball; infinity when
  /// unknown. Only saves time: it rejects triangles before they are tested.
  virtual double mostAllowed(const Sphere&) const { return std::numeric_limits<double>::infinity(); }

  /// Compares many balls at once: bit i of the result is errors[i] > allowedError(balls[i]). The default
  /// tests each by itself. Precondition: at most 64 balls, and as many errors.
  virtual std::uint64_t exceeding(std::span<const Sphere> balls, std::span<const float> errors) const;

  /// The allowed error where it is the same everywhere: such a cut is found by comparing codes alone.
  virtual std::optional<double> uniformError() const { return {}; }

  /// The severity up to which every triangle is fine enough, if severity alone decides.
  virtual std::optional<double> severityLimit() const { return {}; }
  /// The same criterion with another severityLimit(). Preconditions: it has one; limit > 0.
  virtual std::unique_ptr<const BoundedCriterion> withSeverityLimit(double limit) const {
    static_cast<void>(limit);
    return nullptr;
  }

  /// This criterion with a bound of its motion; null when it has none.
  virtual const KineticCriterion* kinetic() const { return nullptr; }

  const BoundedCriterion* bounded() const final { return this; }
};

/// A criterion that changes from frame to frame and bounds by how much: for how much motion a verdict on a
/// ball holds is the failure time of a certificate of a kinetic data structure [BaschGuibasHershberger1997].
class KineticCriterion : public BoundedCriterion {
 public:
  /// A copy, to compare later criteria with.
  virtual std::unique_ptr<const KineticCriterion> clone() const = 0;

  /// An upper bound of the motion from `before` to this criterion; nothing when they cannot be compared.
  virtual std::optional<Motion> motionSince(const KineticCriterion& before) const = 0;

  /// exceeding(), and how long each verdict holds: a criterion c with c.motionSince(*this) <= units[i] * rate
  /// has the same verdict on ball i.
  /// @param rate The unit of motion; all parts are positive.
  /// @param units Receives a lower bound per ball; 0 when unknown. As many as balls.
  virtual std::uint64_t exceedingFor(std::span<const Sphere> balls, std::span<const float> errors,
                                     const Motion& rate, std::span<float> units) const = 0;

  const KineticCriterion* kinetic() const final { return this; }
};

/// Error at most E everywhere.
class UniformError final : public BoundedCriterion {
 public:
  explicit UniformError(double maxError) : maxError_(maxError) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners&) const override {
    return mt.error(t) <= maxError_;
  }
  double allowedError(const Sphere&) const override { return maxError_; }
  double mostAllowed(const Sphere&) const override { return maxError_; }
  std::optional<double> uniformError() const override { return maxError_; }

 private:
  double maxError_;
};

/// One error for the triangles that meet a region of the plan, another for the rest.
class RegionError final : public BoundedCriterion {
 public:
  /// @param region In plan coordinates of the MT.
  /// @param metric The frame of the MT.
  /// Precondition: insideError <= outsideError.
  RegionError(Region region, const MetricFrame& metric, double insideError, double outsideError)
      : region_(std::move(region)),
        metricRegion_(region_.scaled(metric)),
        insideError_(insideError),
        outsideError_(outsideError) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
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

/// An error that grows with the distance from a point: nearError + growth * distance, at most farError.
/// Distances are in metric space, between the point and the nearest point of a triangle, or of what of the
/// source the triangle may stand for.
class DistanceError final : public BoundedCriterion {
 public:
  struct Options {
    Vec3 place;            ///< the point, in metric space
    bool inPlan = false;   ///< distances in the plan alone: place.z does not count
    double nearError = 0;  ///< allowed at the point
    double growth = 0;     ///< error per metric unit of distance, >= 0
    double farError = std::numeric_limits<double>::infinity();  ///< allowed at most
  };
  explicit DistanceError(const Options& options) : o_(options) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return mt.error(t) <= allowedFor(mt, t, corners);
  }
  /// The ratio of the error to the allowed one.
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  double allowedError(const Sphere& s) const override;
  double mostAllowed(const Sphere& s) const override;

 private:
  double allowedFor(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const;
  double allowedAt(double distance) const;
  double distanceToMiddle(const Sphere& s) const;

  Options o_;
};

/// A test of the caller's.
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

}  // namespace arete
