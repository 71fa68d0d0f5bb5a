// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/scene/subject.h"

namespace arete {

/// Lines that say where a model is and how large, as layers in space; the models hide what is behind them.

/// The axes of the file, from the corner of the model's box with the least coordinates: red along x, green
/// along y, blue along z, each as long as the box, with a tick at each multiple of markStep().
SpaceVertices axesOf(const Subject& subject);
/// A grid below the model, level with the lowest place of its box: a line at each multiple of markStep() of
/// x and y of the space that cameras move in, at most 200 each way.
SpaceVertices groundGridOf(const Subject& subject);
/// A cross at what the camera orbits, a twentieth of the orbit's radius long each way, seen through the
/// models.
SpaceVertices orbitMark(const Vec3& target, double radius);

/// 1, 2 or 5 times a power of ten, in metric units: about a tenth of the box's longest side in the plan.
double markStep(const Subject& subject);

/// The names of the layers.
inline constexpr const char *kAxesLayer = "axes", *kGridLayer = "grid", *kOrbitLayer = "orbit";

}  // namespace arete
