// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>

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

/// Computes a viewshed in the background, one at a time.
class ViewshedJob {
 public:
  ViewshedJob() = default;
  ViewshedJob(const ViewshedJob&) = delete;
  ViewshedJob& operator=(const ViewshedJob&) = delete;
  ~ViewshedJob() { cancel(); }

  /// Cancels a running job and starts another. `targetHeight` is above the terrain. Preconditions: model and
  /// earth outlive the job, or the next cancel().
  void start(const TerrainModel& model, const SightEarth& earth, const ViewshedObserver& observer,
             double targetHeight, int mostPixels);
  /// Cancels the job and waits for its end.
  void cancel();
  bool isRunning() const { return state_ != nullptr; }
  /// 0..1.
  double progress() const;
  /// The result, once, when it is done; nothing before and after. Errors: those of ViewshedMaker.
  std::optional<Result<ViewshedOverlay>> take();

 private:
  struct State {
    std::atomic<double> progress = 0;
    std::atomic<bool> cancel = false, isDone = false;
    Result<ViewshedOverlay> result;
  };
  std::unique_ptr<State> state_;
  std::thread thread_;
};

}  // namespace arete
