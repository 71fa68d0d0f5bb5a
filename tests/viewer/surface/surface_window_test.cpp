// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_window.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/under_xvfb.h"

namespace arete {
namespace {

TEST(SurfaceWindow, OpensDrawsAndSavesItsLastPicture) {
  ARETE_UNDER_XVFB("");
  const Result<SurfaceModel> model = buildSurface(SurfaceMesh(shapes::globe(30, 20)));
  ASSERT_TRUE(model);
  const auto picture =
      std::filesystem::temp_directory_path() / ("arete-surface-" + std::to_string(::getpid()) + ".png");
  SurfaceWindowOptions options;
  options.width = 640;
  options.height = 400;
  options.samples = 1;
  options.frames = 3;
  options.lastPicture = picture;
  const Status shown = runSurfaceWindow(*model, ZUpFrame(*model), options);
  ASSERT_TRUE(shown) << shown.error().describe();
  EXPECT_TRUE(std::filesystem::exists(picture));
  std::filesystem::remove(picture);
}

}  // namespace
}  // namespace arete
