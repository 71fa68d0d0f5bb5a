// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/criteria/refine_order.h"
#include "engine/cut/cut.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What one attribute of a surface may be off by.
struct AttributeTolerance {
  std::size_t index = 0;  ///< in SurfaceModel::attributeErrors
  double most = 0;        ///< in the unit of its errors
};

/// A criterion and tolerances of attributes, both of which a triangle keeps: all attributes at one of the
/// distances of the model's bounds that the criterion allows there. Where the criterion allows any error (out
/// of sight, outside a region), attributes may be anything too.
class AttributeCriterion final : public Criterion {
 public:
  /// Preconditions: criterion and model outlive this; indices are in range.
  AttributeCriterion(const BoundedCriterion& criterion, const SurfaceModel& model,
                     const std::vector<AttributeTolerance>& tolerances);

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  /// The criterion's, but at least what a triangle of the largest error has, times by how much an attribute
  /// is off: what is off in looks alone is refined as what is off in shape.
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;

  /// The level at which a cut states the attributes of one of its triangles: of those within the cut's error,
  /// or if need be within what the criterion allows, one that keeps the tolerances; of these the one where
  /// all attributes together are least off.
  std::size_t statedLevel(const MultiTriangulation& mt, TriangleId t, double cutError) const;

 private:
  struct Limit {
    const AttributeErrors* errors;
    double most;
  };
  /// The error that the criterion allows for all that a triangle stands for; infinite: attributes do not
  /// count.
  double allowed(const MultiTriangulation& mt, TriangleId t) const;
  /// By what an attribute is off more than it may, at the best of the levels within an error.
  double excess(TriangleId t, double within) const;
  const BoundedCriterion& criterion_;
  const SurfaceModel& model_;
  std::vector<Limit> limits_;
};

/// As LargestSquaresFirst, with the squares of what attributes are off, each weighed as the build weighs it
/// (AttributeErrors::length). What is stored of them is the largest, so a quarter counts.
class LargestChangesFirst final : public RefineOrder {
 public:
  /// Precondition: the model outlives this.
  explicit LargestChangesFirst(const SurfaceModel& model) : model_(model) {}
  RefineKey key(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                const Criterion::Corners& corners, std::uint64_t arrival) const override;

 private:
  const SurfaceModel& model_;
};

/// What a cut states of attributes: for every point of the source there is one of the cut within `error`
/// whose attributes are off by at most `largest`, by entry of SurfaceModel::attributeErrors.
struct StatedAttributes {
  double error = 0;  ///< the cut's, or more: a distance of the model's that the criterion allows
  std::vector<double> largest;
};
/// @param asked the criterion of the cut; its tolerances decide between the distances. O(front * attributes).
StatedAttributes statedAttributes(const SurfaceModel& model, const Cut& cut, const AttributeCriterion& asked);
/// The same where no tolerance was asked for, within the cut's error.
std::vector<double> attributeErrorsOf(const SurfaceModel& model, const Cut& cut);

}  // namespace arete
