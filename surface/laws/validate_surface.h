// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What every front of a surface has in common with the finest one.
class SurfaceTopology {
 public:
  /// O(n log n). Errors: those of diagnose(); brokenPromise: the finest front breaks law 5.
  static Result<SurfaceTopology> of(const MultiTriangulation& mt, const RunContext& context = {});

  /// Law 5 on one front: an oriented manifold, no triangle twice or on another one, of as many components as
  /// the finest front has, each with the Euler number and the number of borders of that with the same
  /// vertices. O(n log n). Errors: brokenPromise.
  Status check(const Cut& cut, const RunContext& context = {}) const;

 private:
  struct Component {
    std::int64_t eulerNumber;
    std::uint32_t borders;
    bool operator==(const Component&) const = default;
  };

  MultiTriangulation mt_;
  std::vector<std::uint32_t> componentOf_;  // by vertex of the MT
  std::vector<Component> components_;
  std::uint64_t doubleSided_ = 0;
};

struct SurfaceLawOptions {
  /// Law 10 by vertices, middles of faces and of their sides; else by vertices.
  bool everySample = false;
};

/// Checks laws 1 to 6, 8 and 10 of docs/topics/multitriangulation.md: those of the engine
/// (engine/laws/validate.h) on every node, laws 5 and 10 on the fronts of 16 prefixes of the nodes, law 10
/// also displaced, and that the finest front has as many triangles as the build kept faces. Errors: those of
/// SurfaceModel::validate(); brokenPromise: names the law.
Status validateSurface(const SurfaceModel& model, const SurfaceLawOptions& options = {},
                       const RunContext& context = {});

}  // namespace arete
