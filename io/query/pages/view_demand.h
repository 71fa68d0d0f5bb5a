// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "engine/base/result.h"
#include "engine/criteria/view.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"
#include "io/query/pages/resident_pages.h"
#include "surface/model/surface_model.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What a camera asks of the pages of a model.
struct ViewDemand {
  View view;                       ///< in the metric space of the model, heights multiplied by `stretch`
  std::optional<View> expected{};  ///< where the camera is soon; nothing: it stands still
  double pixels = 1;               ///< tolerance of the cut, > 0
  double stretch = 1;              ///< vertical exaggeration, of terrain
  /// Of a level of detail that is chosen: this error everywhere instead of the tolerance.
  std::optional<double> error{};
};

/// The demand that the cut of a view makes: needed is what requiredInView() says; around it the picture is
/// wider, and the tolerance smaller as if the camera had come nearer. Precondition: the views are valid.
///
/// @param outline a part of the model, its root at least
/// O(outline).
PageDemand demandOf(const ViewDemand& demand, const TerrainModel& outline);
/// The same of a surface. O(1).
PageDemand demandOf(const ViewDemand& demand, const SurfaceModel& outline);

/// The view in which a motion from one view to another ends when it goes on `times` as long. Nothing where
/// the two are one view, or of two kinds of projection.
std::optional<View> viewAhead(const View& before, const View& now, double times);

/// What is drawn of a part for a view, and what the part lacks for it.
struct DrawnOfPart {
  std::uint32_t missing =
      0;              ///< triangles of the cut that are too coarse because their removers are not there
  double pixels = 0;  ///< the largest error of those, in pixels
};
/// Of the saturated cut. O(part), parallel. Errors: as takeCut().
Result<DrawnOfPart> missingInView(const MultiTriangulation& part, const ViewDemand& demand,
                                  const RunContext& context = {});

}  // namespace arete
