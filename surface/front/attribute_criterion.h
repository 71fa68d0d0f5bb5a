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

/// A criterion and tolerances of attributes, both of which a triangle keeps. Where the criterion allows any
/// error (out of sight, outside a region), attributes may be anything too.
class AttributeCriterion final : public Criterion {
 public:
  /// Preconditions: criterion and model outlive this; indices are in range.
  AttributeCriterion(const BoundedCriterion& criterion, const SurfaceModel& model,
                     const std::vector<AttributeTolerance>& tolerances);

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  /// The criterion's, but at least what a triangle of the largest error has, times by how much an attribute
  /// is off: what is off in looks alone is refined as what is off in shape.
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;

 private:
  struct Limit {
    const AttributeErrors* errors;
    double most;
  };
  bool counts(const MultiTriangulation& mt, TriangleId t) const;
  const BoundedCriterion& criterion_;
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

/// By entry of SurfaceModel::attributeErrors: the largest of a cut's triangles. O(front * attributes).
std::vector<double> attributeErrorsOf(const SurfaceModel& model, const Cut& cut);

}  // namespace arete
