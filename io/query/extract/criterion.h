// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/store/format/required_error.h"
#include "terrain/model/camera.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What is refined first under a budget or a deadline: the orders of engine/criteria/refine_order.h.
enum class ExtractOrder { worst, breadth, depth, twoQueues };

/// Whether the heights of vertices are fitted, and for what (terrain/fit/fit.h).
enum class ExtractFit {
  none,
  triangles,  ///< fewer triangles within the tolerance
  error,      ///< a smaller error of the same triangles
};

/// What a TIN is extracted for, in the coordinates and units of the source.
struct ExtractCriterion {
  std::optional<double> maxError;             ///< everywhere, inside the region, or at the focus
  std::optional<std::uint32_t> maxTriangles;  ///< a budget; without a maxError the error is as small as it
                                              ///< gets, with one what comes first ends the cut
  std::string region;                         ///< as it was given; empty = none
  std::string regionCrs = {};                 ///< as it was given; empty = the file's, or the DEM's for a box
  double distance = 0;  ///< around the region, metres on the ground (source units without a CRS)
  /// Outside the region, out of sight, or far from the focus.
  double outsideError = std::numeric_limits<double>::infinity();

  /// The allowed error grows with the distance from a place.
  struct Focus {
    Vec2 xy;                ///< source coordinates
    double growth = 0;      ///< error for each metre (each source unit without a CRS)
    std::string text = {};  ///< the place as it was given
  };
  std::optional<Focus> focus;
  std::optional<Camera> camera;      ///< the error is measured in pixels of its picture
  std::string cameraText;            ///< its position as it was given
  bool isLonLat = false;             ///< the places were given as longitude and latitude
  std::optional<double> pixelError;  ///< with a camera; none = as small as the budget gets it

  CutMethod method = CutMethod::minimal;
  std::optional<double> deadlineMilliseconds;
  ExtractOrder order = ExtractOrder::worst;
  ExtractFit fit = ExtractFit::none;

  /// Whether the promised error is the tolerance. Otherwise it is the error that the cut reached.
  /// With a budget as well it is the tolerance where the cut is complete: what comes first ends the cut.
  bool promisesMaxError(bool isComplete = false) const {
    return maxError && (!maxTriangles || isComplete) && !deadlineMilliseconds && !focus && !camera;
  }
};

/// "none", "triangles" or "error".
std::string_view fitName(ExtractFit fit);

/// The criterion for the engine.
/// @param region   criterion.region in plan coordinates, where there is one
/// @param reserve  subtracted from the tolerance, for what a format rounds
/// Errors: usage: an invalid camera. Precondition: the model outlives the result.
Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const ExtractCriterion& criterion,
                                                                const std::optional<Region>& region,
                                                                double reserve, const TerrainModel& model);

/// The error that the cuts of these criteria require of a model. Null (everything) if a criterion has a
/// camera, a fit, or no tolerance.
/// @param outline  a part of the model, its root at least
/// Errors: usage. O(1); a call of the result costs as much as Region::meetsDisc().
Result<RequiredError> requiredBy(std::span<const ExtractCriterion> criteria,
                                 const std::optional<Region>& region, const TerrainModel& outline);

/// Method, budget, deadline (from now on) and order for the engine. Errors: usage: two queues without a
/// camera.
Result<CutOptions> engineOptions(const ExtractCriterion& criterion, const TerrainModel& model);

}  // namespace arete
