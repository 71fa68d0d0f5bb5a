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
#include "io/format/required_error.h"
#include "terrain/model/camera.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What is refined first under a budget or a deadline: the orders of engine/criteria/refine_order.h.
enum class ExtractOrder { worst, breadth, depth, twoQueues };

/// Whether vertices leave the samples, and what for (terrain/fit/fit.h).
enum class ExtractFit {
  none,
  triangles,  ///< fewer triangles within the tolerance
  error,      ///< a smaller error of the same triangles
};

/// What was asked for, in the terms of the source.
struct ExtractCriterion {
  std::optional<double> maxError;  ///< everywhere, inside the region, or at the focus
  std::optional<std::uint32_t>
      maxTriangles;     ///< a budget; without a maxError the error is as small as it gets
  std::string region;   ///< as it was given; empty = none
  double distance = 0;  ///< around the region, metres on the ground (source units without a CRS)
  /// Outside the region, out of sight, or far from the focus.
  double outsideError = std::numeric_limits<double>::infinity();

  /// The error allowed grows with the distance from a place.
  struct Focus {
    Vec2 xy;                ///< source coordinates
    double growth = 0;      ///< error for each metre (each source unit without a CRS)
    std::string text = {};  ///< the place as it was given
  };
  std::optional<Focus> focus;
  std::optional<Camera> camera;      ///< the error counts in pixels of its picture
  std::string cameraText;            ///< its position as it was given
  bool isLonLat = false;             ///< the places were given as longitude and latitude
  std::optional<double> pixelError;  ///< with a camera; none = as small as the budget gets it

  CutMethod method = CutMethod::minimal;
  std::optional<double> deadlineMilliseconds;
  ExtractOrder order = ExtractOrder::worst;
  ExtractFit fit = ExtractFit::none;

  /// Whether the tolerance alone says what is promised; otherwise it is what the cut came to.
  bool promisesMaxError() const {
    return maxError && !maxTriangles && !deadlineMilliseconds && !focus && !camera;
  }
};

/// As the option names it.
std::string_view fitName(ExtractFit fit);

/// The criterion for the engine. `region`: in plan coordinates, where one was given. `reserve` is taken off
/// the tolerance for what a format rounds. Errors: usage, a camera that makes no sense. Precondition: the
/// model outlives the criterion.
Result<std::shared_ptr<const BoundedCriterion>> engineCriterion(const ExtractCriterion& criterion,
                                                                const std::optional<Region>& region,
                                                                double reserve, const TerrainModel& model);

/// What the cuts of these criteria can ask for of a model, where nothing is taken off their tolerances and
/// nothing is measured. Null, which is everything, where a camera's pixels decide, or a budget or a
/// deadline alone, and where a fit looks at all samples. Errors: usage. Precondition: `outline` is of the
/// model, its root at least. O(1); of what comes back, that of the region's meetsDisc().
Result<RequiredError> requiredBy(std::span<const ExtractCriterion> criteria,
                                 const std::optional<Region>& region, const TerrainModel& outline);

/// Its budget, deadline (from now on) and order. Errors: usage, two queues without a camera.
Result<CutOptions> engineOptions(const ExtractCriterion& criterion, const TerrainModel& model);

}  // namespace arete
