// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/refine_order.h"
#include "surface/model/attribute.h"
#include "surface/model/surface_model.h"

namespace arete {

/// How important the source is where a triangle stands for it: by how much an error that is allowed is
/// divided there. Over a face of the source importance is linear between its corners, so its largest is at
/// one.
struct Importance {
  std::vector<float> most;  ///< by triangle of the MT: at least what any point has that it stands for
  double largest = 1;       ///< of the source's vertices (corners), in the unit of the attribute
  double least = 1;

  double of(TriangleId t) const { return double{most[t.index()]}; }
};

/// Of every triangle, from the finest to the coarsest: what a triangle stands for is divided among what
/// replaces it, and lies within both errors. So the largest of those that are near enough is found, by
/// descending where it may be; after some steps what is certain is taken, which is more.
/// @param ofWedges  whether the attribute is of wedges, not of vertices
/// Preconditions: one component; as many elements as the model has of them.
/// Errors: invalidData, naming the vertex of the source: a number of a vertex in use is not finite or not
/// above 0. O(triangle ids * log)
Result<Importance> importanceOf(const SurfaceModel& model, const Attribute& attribute, bool ofWedges);

/// The importance of triangles divides what a criterion allows: of a triangle that is important w, the error
/// is w times as large. Below 1 it is allowed more.
class ImportanceCriterion final : public BoundedCriterion {
 public:
  /// Precondition: both outlive this.
  ImportanceCriterion(const BoundedCriterion& criterion, const Importance& importance)
      : criterion_(criterion), importance_(importance) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override;
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return importance_.of(t) * criterion_.severity(mt, t, corners);
  }
  /// Of the most important place anywhere, as a ball tells none.
  double allowedError(const Sphere& ball) const override {
    return criterion_.allowedError(ball) / importance_.largest;
  }
  double mostAllowed(const Sphere& ball) const override {
    return criterion_.mostAllowed(ball) / importance_.least;
  }

 private:
  const BoundedCriterion& criterion_;
  const Importance& importance_;
};

/// Another order, whose squares of distances are multiplied by squares of the importance.
class ImportantFirst final : public RefineOrder {
 public:
  /// Precondition: both outlive this.
  ImportantFirst(std::shared_ptr<const RefineOrder> order, const Importance& importance)
      : order_(std::move(order)), importance_(importance) {}
  RefineKey key(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                const Criterion::Corners& corners, std::uint64_t arrival) const override {
    RefineKey key = order_->key(mt, criterion, t, corners, arrival);
    key.rank *= importance_.of(t) * importance_.of(t);
    return key;
  }

 private:
  std::shared_ptr<const RefineOrder> order_;
  const Importance& importance_;
};

}  // namespace arete
