// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/check_command.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

TEST(CheckCommand, QuotesNamesForAShell) {
  TerrainModel model;
  model.source = "my dem.tif";
  ExtractRequest request;
  request.criterion.maxError = 5;
  request.output = "it's.ply";
  EXPECT_EQ(checkCommand(request, model, "m.amt", 5),
            R"(arete measure 'it'\''s.ply' 'my dem.tif' --expect 5)");
  request.output = "smooth.tif";
  request.criterion.region = "1,2,3,4";
  request.criterion.outsideError = 50;
  model.options.rimTolerance = 2;
  EXPECT_EQ(checkCommand(request, model, "m.amt", 5),
            "arete extract m.amt -o smooth.ply --max-error 5 --region 1,2,3,4 --outside-error 50 && "
            "arete measure smooth.ply 'my dem.tif' --expect 5 --region 1,2,3,4 --allow-covered-nodata");
}

TEST(CheckCommand, StatesHowTheSourceWasRead) {
  TerrainModel model;
  model.source = "dem.tif";
  ExtractRequest request;
  request.criterion.maxError = 5;
  request.output = "tin.ply";
  model.reading = {
      .band = 2, .layer = "a layer", .zField = "z", .samePlace = "min", .crs = "EPSG:32611", .nodata = -9999};
  EXPECT_EQ(checkCommand(request, model, "m.amt", 5),
            "arete measure tin.ply dem.tif --expect 5 --band 2 --layer 'a layer' --z-field z --same-place "
            "min --nodata -9999 "
            "--crs EPSG:32611");
}

TEST(CheckCommand, StatesEveryOptionOfTheCriterion) {
  CutRequest c;
  EXPECT_EQ(optionsOf(c), "");
  c.maxError = 2.5;
  c.maxTriangles = 100;
  c.region = "a b.gpkg";
  c.distance = 30;
  c.isLonLat = true;
  c.method = CutMethod::saturated;
  c.deadlineMilliseconds = 8;
  c.order = CutOrder::twoQueues;
  c.fit = CutFit::triangles;
  EXPECT_EQ(
      optionsOf(c),
      " --max-error 2.5 --max-triangles 100 --region 'a b.gpkg' --distance 30 --lonlat --method saturated "
      "--deadline 8 --order two-queues --fit triangles");
  CutRequest focus;
  focus.focus = {.xy = {1, 2}, .growth = 0.5, .text = "1,2"};
  EXPECT_EQ(optionsOf(focus), " --focus 1,2 --error-growth 0.5");
  CutRequest camera;
  camera.camera = Camera();
  camera.camera->azimuthDegrees = 90;
  camera.camera->pitchDegrees = -5;
  camera.camera->verticalFieldOfViewDegrees = 45;
  camera.camera->widthPixels = 640;
  camera.camera->heightPixels = 480;
  camera.cameraText = "1,2,3msl";
  camera.pixelError = 2;
  EXPECT_EQ(optionsOf(camera), " --camera 1,2,3msl --look 90,-5 --fov 45 --viewport 640x480 --pixel-error 2");
}

}  // namespace
}  // namespace arete
