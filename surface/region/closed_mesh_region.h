// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/criteria/space_region.h"

namespace arete {

/// What a closed mesh holds, with the mesh itself: a point is inside where a ray from it meets the mesh an
/// odd number of times. Its parts may lie in each other: a ball within a ball is a hole. Decided by exact
/// predicates; distances are widened by one part in 1e9. Each test: O(log triangles) as a rule.
class ClosedMeshRegion final : public SpaceRegion {
 public:
  /// @param mesh its coordinates as they are. Corners at one position count as joined.
  /// Errors: invalidData: it has no triangles, or is not closed.
  static Result<std::shared_ptr<const ClosedMeshRegion>> create(const TriangleMesh& mesh);
  ~ClosedMeshRegion() override;

  bool meetsTriangle(const SpaceTriangle& triangle, double widening) const override;
  bool meetsBall(const Vec3& c, double r) const override;
  bool holdsBall(const Vec3& c, double r) const override;

 private:
  struct State;
  explicit ClosedMeshRegion(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
