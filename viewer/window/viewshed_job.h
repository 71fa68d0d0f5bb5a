// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/parallel/background_work.h"
#include "terrain/viewshed/viewshed.h"
#include "viewer/scene/layer.h"

namespace arete {

/// A viewshed as a picture over the plan.
struct ViewshedOverlay {
  std::shared_ptr<const PlanPicture> picture;
  std::uint64_t seen = 0, cells = 0;
};

/// Makes the overlay of a viewshed. A larger viewshed than `mostPixels` is subsampled.
///
/// @param mostPixels longest side of the overlay.
/// O(pixels).
ViewshedOverlay overlayOf(const Viewshed& viewshed, int mostPixels);
/// What its colours mean.
Legend overlayLegend();

/// Computes a viewshed in the background, one at a time.
class ViewshedJob {
 public:
  /// Cancels a running job and starts another. `targetHeight` is above the terrain. Preconditions: model and
  /// earth outlive the job, or the next cancel().
  void start(const TerrainModel& model, const SightEarth& earth, const ViewshedObserver& observer,
             double targetHeight, int mostPixels);
  /// Cancels the job and waits for its end.
  void cancel() { work_.cancel(); }
  bool isRunning() const { return work_.isRunning(); }
  /// 0..1.
  double progress() const { return work_.progress().fraction; }
  /// The result, once, when it is done; nothing before and after. Errors: those of ViewshedMaker.
  std::optional<Result<ViewshedOverlay>> take() { return work_.take(); }

 private:
  BackgroundWork<ViewshedOverlay> work_;
};

}  // namespace arete
