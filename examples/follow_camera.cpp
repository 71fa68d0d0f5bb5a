// SPDX-License-Identifier: GPL-3.0-or-later
//
// follow_camera FILE.amt FRAMES: flies across a terrain and keeps a conforming triangulation of at most a
// pixel of error in view, within 10 ms a frame: what a renderer of your own would draw.
#include <arete/engine/criteria/view_error.h>
#include <arete/engine/follow/incremental_cut.h>
#include <arete/io/store/amt/file.h>
#include <arete/terrain/locate/ground_height.h>
#include <arete/terrain/model/camera.h>

#include <chrono>
#include <cstdlib>
#include <iostream>

namespace {

int fail(const arete::Error& error) {
  std::cerr << error.describe() << "\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: follow_camera FILE.amt FRAMES\n";
    return 2;
  }
  const auto model = arete::loadAmt(argv[1]);
  if (!model) return fail(model.error());
  if (!model->isRaster) return fail({arete::ErrorCode::usage, "this example flies over rasters", argv[1]});
  const int frames = std::atoi(argv[2]);

  const arete::GroundHeights heights(*model);
  arete::IncrementalCut cut(model->mt);
  double ground = 0;
  for (int frame = 0; frame < frames; ++frame) {
    // From the first sample towards the last, 200 units above the ground, or above the last ground that there
    // was.
    const double along = (frame + 0.5) / frames;
    arete::Camera camera;
    camera.xy = model->toSource({along * (model->columns - 1), along * (model->rows - 1)});
    if (const auto found = heights.at(camera.xy)) ground = found->height;
    camera.height = ground + 200;
    camera.azimuthDegrees = 135;
    camera.pitchDegrees = -15;
    const auto view = arete::viewOf(camera, *model);
    if (!view) return fail(view.error());

    arete::IncrementalOptions options;
    options.deadline = arete::Deadline::in(std::chrono::milliseconds(10));
    const arete::ViewError criterion({.view = *view, .pixels = 1}, model->mt.metric());
    const auto update = cut.update(criterion, options);
    if (!update) return fail(update.error());

    // cut.lastSteps() says what changed; cut.triangles() is the front, and model->mt.corners(t) the vertices
    // of t.
    std::cout << "frame " << frame << ": " << cut.triangles().size() << " triangles, " << update->refined
              << " refined, " << update->coarsened << " coarsened"
              << (update->isComplete ? "" : ", to be continued") << "\n";
  }
}
