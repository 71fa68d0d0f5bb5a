// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/vec.h"
#include "engine/criteria/region.h"
#include "engine/criteria/space_region.h"
#include "engine/cut/cut.h"
#include "surface/attributes/attribute_names.h"
#include "surface/model/camera.h"
#include "terrain/model/camera.h"

namespace arete {

/// What is refined first under a budget or a deadline: the orders of engine/criteria/refine_order.h.
enum class CutOrder {
  usual,      ///< the worst first; of a surface everywhere the largest integral of the squared distance
  worst,      ///< the largest error first, or the most pixels
  breadth,    ///< the whole front once before any of it twice
  depth,      ///< one place completely, then the next
  twoQueues,  ///< what the camera sees first
};

/// Whether the vertices are adjusted, and for what.
enum class CutFit {
  none,
  triangles,  ///< of terrain: fewer triangles within the tolerance (terrain/fit/fit.h)
  error,      ///< of terrain: a smaller error of the same triangles
  unbiased,   ///< of terrain: a mean error of 0 of the same triangles
  rms,        ///< of a surface: a smaller mean square distance (surface/fit/fit.h)
};

/// What a model is cut for: where, how fine, and what may end it. Lengths and errors are in the unit of the
/// source: heights of terrain, distances of a surface; a share of the whole is resolved before
/// (io/query/request/wholes.h). A field that is for one kind of model says so, and the other
/// kind refuses it (io/query/request/check_request.h).
struct CutRequest {
  std::optional<double> maxError = {};             ///< everywhere, inside the region, or at the focus
  std::optional<std::uint32_t> maxTriangles = {};  ///< a budget; without a maxError the error is as small as
                                                   ///< it gets, with one what comes first ends the cut
  std::string region = {};                         ///< as it was given; empty = none
  std::string regionCrs = {};  ///< as it was given; empty = the file's, or the DEM's for a box
  double distance = 0;         ///< around the region, metres on the ground (source units without a CRS)
  std::shared_ptr<const Region> planRegion = {};  ///< of terrain: the region in plan coordinates, if known
  std::shared_ptr<const SpaceRegion> spaceRegion = {};  ///< of a surface: the region; null: everywhere
  /// Outside the region, out of sight, or far from the focus.
  double outsideError = std::numeric_limits<double>::infinity();

  /// The allowed error grows with the distance from a place.
  struct Focus {
    Vec2 xy = {};           ///< source coordinates
    double growth = 0;      ///< error for each metre (each source unit without a CRS, and of a surface)
    std::string text = {};  ///< the place as it was given
    /// Of a surface, whose distances are in space; terrain's are in the plan.
    std::optional<double> z = {};
  };
  std::optional<Focus> focus = {};
  std::optional<Camera> camera = {};  ///< of terrain: the error is measured in pixels of its picture
  std::optional<SurfaceCamera> spaceCamera = {};  ///< the same of a surface
  std::string cameraText = {};                    ///< its position as it was given
  bool isLonLat = false;                          ///< the places were given as longitude and latitude
  std::optional<double> pixelError = {};          ///< with a camera; none = as small as the budget gets it

  CutMethod method = CutMethod::minimal;
  std::optional<double> deadlineMilliseconds = {};
  CutOrder order = CutOrder::usual;
  CutFit fit = CutFit::none;

  /// What attributes of a surface may be off by, beside its shape; of a model that bounds them
  /// (SurfaceBuildOptions::boundsAttributes). Then no vertex is displaced.
  std::vector<AttributeNumber> attributeErrors = {};

  /// The name of a number of vertices or corners of a surface: the error that is asked for is divided by it
  /// from place to place (surface/front/importance.h). Then no vertex is displaced. Empty: none.
  std::string importance = {};

  bool isDisplaced = true;  ///< of a surface: where the model has a displacement, vertices are displaced
  /// Components of a surface are left out if their box has a smaller diagonal.
  double dropParts = 0;

  bool hasCamera() const { return camera || spaceCamera; }
  /// Whether the promised error is the tolerance. Otherwise it is the error that the cut reached.
  /// With a budget as well it is the tolerance where the cut is complete: what comes first ends the cut.
  bool promisesMaxError(bool isComplete = false) const {
    return maxError && (!maxTriangles || isComplete) && !deadlineMilliseconds && !focus && !hasCamera();
  }
  /// Whether an error is stated that a cut keeps where it is complete; a budget or a deadline alone states
  /// none.
  bool statesError() const { return maxError || pixelError || (hasCamera() && !maxTriangles); }
};

/// "none", "triangles", "error", "unbiased" or "rms".
std::string_view fitName(CutFit fit);
/// "worst", "breadth", "depth" or "two-queues"; "usual".
std::string_view orderName(CutOrder order);

}  // namespace arete
