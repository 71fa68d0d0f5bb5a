// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The connected components of a model: the same in every cut.
struct ModelComponents {
  std::vector<std::uint32_t> ofVertex;  ///< by vertex of the MT
  std::vector<double> diagonals;        ///< of each one's box in the source
};
/// O(triangles of the source).
ModelComponents componentsOf(const SurfaceModel& model);

/// Some components of a model, to be left out.
struct DroppedComponents {
  std::vector<bool> isDropped;      ///< by vertex of the MT
  std::uint64_t count = 0;          ///< components
  std::uint64_t sourceFaces = 0;    ///< theirs, in the finest front
  std::uint32_t rootTriangles = 0;  ///< theirs, in the coarsest
};
/// Those whose box has a diagonal below `leastDiagonal`.
DroppedComponents componentsBelow(const SurfaceModel& model, double leastDiagonal);

/// A criterion that asks nothing of what is dropped: a budget is spent on the rest.
class KeptComponentsCriterion final : public Criterion {
 public:
  /// Preconditions: both outlive this.
  KeptComponentsCriterion(const Criterion& criterion, const DroppedComponents& dropped)
      : criterion_(criterion), dropped_(dropped) {}

  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return dropped_.isDropped[corners[0]] || criterion_.isFineEnough(mt, t, corners);
  }
  double severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return criterion_.severity(mt, t, corners);
  }

 private:
  const Criterion& criterion_;
  const DroppedComponents& dropped_;
};

/// A cut without the dropped components.
struct KeptCut {
  Cut cut;  ///< its error is that of its triangles
  /// By triangle of the whole cut: its number here, or MeshAttributes::kNone.
  std::vector<std::uint32_t> numberOf;
};
KeptCut withoutDropped(const MultiTriangulation& mt, const Cut& whole, const DroppedComponents& dropped);

/// The finest front of the dropped components alone, without attributes.
TriangleMesh droppedSurface(const SurfaceModel& model, const DroppedComponents& dropped);

}  // namespace arete
