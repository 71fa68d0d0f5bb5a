// SPDX-License-Identifier: GPL-3.0-or-later
// Viewsheds that are computed in the background, and their overlays.
#include "viewer/window/viewshed_job.h"

#include <gtest/gtest.h>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <thread>
#include <vector>

#include "terrain/viewshed/viewshed.h"
#include "viewer/camera_models.h"

namespace arete {
namespace {

TEST(ViewshedJob, AnOverlayTooLargeForTheDeviceShowsSomeOfTheSamplesWhereTheyAre) {
  Viewshed viewshed;
  viewshed.columns = 100;
  viewshed.rows = 37;
  viewshed.cells.assign(3700, ViewshedCell::hidden);
  for (std::uint32_t row = 0; row < 37; ++row)
    for (std::uint32_t column = 60; column < 100; ++column)
      viewshed.cells[row * 100 + column] = ViewshedCell::seen;
  const PlanPicture o = *overlayOf(viewshed, 30).picture;
  EXPECT_LE(o.width, 30);
  EXPECT_LE(o.height, 30);
  for (int x = 0; x < o.width; ++x) {
    const double column = ((x + 0.5) / o.width - o.shift.x) / o.scale.x;
    EXPECT_EQ(o.rgba[std::size_t(x)][0] == 255, column > 59.5) << x;
  }
}

TEST(ViewshedJob, GivesTheViewshedOnceWhenItIsDone) {
  const TerrainModel& model = test::cameraModels()[0].model;
  const auto earth = makePlaneEarth(model);
  const ViewshedObserver observer{{20, 15}, 5000};
  ViewshedJob job;
  EXPECT_FALSE(job.isRunning());
  EXPECT_FALSE(job.take());
  job.start(model, *earth, observer, 2, 4096);
  EXPECT_TRUE(job.isRunning());
  std::optional<Result<ViewshedOverlay>> result;
  for (int i = 0; i < 6000 && !result; ++i) {
    EXPECT_GE(job.progress(), 0);
    EXPECT_LE(job.progress(), 1);
    result = job.take();
    if (!result) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(result);
  ASSERT_TRUE(*result) << result->error().describe();
  const ViewshedOverlay& overlay = **result;
  EXPECT_EQ(overlay.cells, std::uint64_t(model.columns) * model.rows);
  EXPECT_GT(overlay.seen, 0u);
  EXPECT_FALSE(job.isRunning());
  EXPECT_FALSE(job.take()) << "the result is taken once";
}

TEST(ViewshedJob, CanBeCancelledAndStartedAnew) {
  const TerrainModel& model = test::cameraModels()[0].model;
  const auto earth = makePlaneEarth(model);
  ViewshedJob job;
  for (int i = 0; i < 5; ++i) job.start(model, *earth, {{double(i), 3}, 5000}, 0, 64);
  job.cancel();
  EXPECT_FALSE(job.isRunning());
  EXPECT_FALSE(job.take());
}

}  // namespace
}  // namespace arete
