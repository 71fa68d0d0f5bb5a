// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/cut_promises.h"
#include "engine/follow/incremental_cut.h"
#include "engine/morph/geomorph.h"

namespace arete {

/// Brings the cut to the view.
inline void follow(IncrementalCut& cut, const View& view, const MorphCamera& camera) {
  const auto update =
      cut.update(ViewError({.view = view, .pixels = camera.tolerance().cut}, cut.mt().arrays().metric));
  ASSERT_TRUE(update);
  ASSERT_TRUE(update->isComplete);
}

/// A camera that wanders a little.
inline View moved(View view, const Extent& extent, double step, std::mt19937_64& random) {
  std::normal_distribution<double> by(0, step);
  view.eye = {view.eye.x + by(random) * extent.size(), view.eye.y + by(random) * extent.size(),
              view.eye.z + by(random) * extent.relief()};
  view.forward.x += by(random), view.forward.y += by(random);
  return view;
}

/// A slow flight towards the terrain, which is all before the camera, and pixels that leave half of it
/// coarse.
struct MorphFlight {
  View view;
  Vec3 step;
  double pixels = 1;

  MorphFlight(const MultiTriangulation& mt, double stepsToThere, std::mt19937_64& random) {
    const Extent e(mt);
    std::uniform_real_distribution<double> unit(0, 1);
    const Vec3 middle{(e.low.x + e.high.x) / 2, (e.low.y + e.high.y) / 2, (e.low.z + e.high.z) / 2};
    const double azimuth = 2 * M_PI * unit(random), away = e.size() * (0.8 + unit(random));
    view.eye = {middle.x - away * std::cos(azimuth), middle.y - away * std::sin(azimuth),
                e.high.z + (0.1 + unit(random)) * e.size()};
    view.forward = {middle.x - view.eye.x, middle.y - view.eye.y, middle.z - view.eye.z};
    view.verticalFieldOfView = 0.6 + unit(random);
    step = {view.forward.x / stepsToThere, view.forward.y / stepsToThere, view.forward.z / stepsToThere};
    pixels = (mt.nodeCount() ? mt.largestError() : 1) * Frustum(view).pixelsPerUnit() / away * 0.1 *
             (0.1 + unit(random));
    pixels = std::max(pixels, 1e-3);
  }
  void fly() { view.eye = {view.eye.x + step.x, view.eye.y + step.y, view.eye.z + step.z}; }
};

}  // namespace arete
