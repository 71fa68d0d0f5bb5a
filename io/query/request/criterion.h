// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/region.h"
#include "engine/cut/cut.h"
#include "io/query/request/cut_request.h"
#include "io/store/format/required_error.h"
#include "surface/model/surface_model.h"
#include "terrain/model/terrain_model.h"

namespace arete {

// A request as the engine takes it. A new criterion is added here and in io/query/certificate/parts.cpp.

/// The criterion for a cut of terrain.
/// @param region   request.region in plan coordinates, where there is one
/// @param reserve  subtracted from the tolerance, for what a format rounds
/// Errors: usage: an invalid camera. Precondition: the model outlives the result.
Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const CutRequest& request,
                                                                const std::optional<Region>& region,
                                                                double reserve, const TerrainModel& model);

/// The criterion for a cut of a surface. Around a focus the error that rounding may have moved the source by
/// (SurfaceModel::positionError), times the growth, is taken off, so that what is promised holds for the
/// source as it was. Without a tolerance or a camera no error is allowed. Errors: usage: "outsideError": it
/// is below the error inside; as viewOf().
Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const CutRequest& request,
                                                                const SurfaceModel& model);

/// The error that the cuts of these requests require of a model of terrain. Null (everything) if a request
/// has a camera, a fit, or no tolerance.
/// @param outline  a part of the model, its root at least
/// Errors: usage. O(1); a call of the result costs as much as Region::meetsDisc().
Result<RequiredError> requiredBy(std::span<const CutRequest> requests, const std::optional<Region>& region,
                                 const TerrainModel& outline);

/// Method, budget, deadline (from now on) and order for the engine. A budget or a deadline of a surface
/// everywhere is spent where the integral of the squared distance is largest, unless an order is stated: that
/// leaves about the least mean square error. Errors: usage: two queues without a camera; as viewOf().
Result<CutOptions> engineOptions(const CutRequest& request, const TerrainModel& model);
Result<CutOptions> engineOptions(const CutRequest& request, const SurfaceModel& model);

/// The largest error of a cut's triangles that are coarser than asked for although nothing is finer, which is
/// what rounding has left (SurfaceModel::positionError); 0: none is. O(front)
double errorLeftByRounding(const SurfaceModel& model, const Criterion& criterion, const Cut& cut);

}  // namespace arete
