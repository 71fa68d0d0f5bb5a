// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/space_region.h"
#include "engine/cut/cut.h"
#include "surface/model/camera.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What a surface is cut for, in its coordinates and its unit.
struct SurfaceCriterion {
  std::optional<double> maxError;             ///< a distance, in the region if there is one
  std::optional<std::uint32_t> maxTriangles;  ///< without an error or a camera: the least mean square error
  std::shared_ptr<const SpaceRegion> region;  ///< null: everywhere
  double outsideError = std::numeric_limits<double>::infinity();  ///< outside the region, or out of sight
  std::optional<SurfaceCamera> camera;  ///< the error is measured in pixels of its picture
  std::optional<double> pixelError;     ///< with a camera; none: 1, with a budget as small as it gets
  CutMethod method = CutMethod::minimal;
};

/// The criterion for the engine. Errors: usage: "outsideError": it is below the error inside; those of
/// viewOf().
Result<std::unique_ptr<const BoundedCriterion>> engineCriterion(const SurfaceCriterion& criterion,
                                                                const SurfaceModel& model);

/// The largest error of a cut's triangles that are coarser than asked for although nothing is finer, which is
/// what rounding has left (SurfaceModel::positionError); 0: none is. O(front)
double errorLeftByRounding(const SurfaceModel& model, const Criterion& criterion, const Cut& cut);

/// Method, budget and order for the engine: a budget everywhere is spent where the integral of the squared
/// distance is largest, which leaves about the least mean square error.
CutOptions engineOptions(const SurfaceCriterion& criterion);

}  // namespace arete
