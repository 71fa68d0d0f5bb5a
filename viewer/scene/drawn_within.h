// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "viewer/scene/subject.h"

namespace arete {

/// How far what is drawn at a place of the model may be from the model there, in the source's vertical unit:
/// of a cut that is taken for a camera to a tolerance in pixels, no triangle over a place that the camera
/// sees has a larger error. Vertically of terrain, in any direction of a surface.
///
/// @param cutFor the camera that the cut was taken for.
/// @param pixels the tolerance of the cut (FrameFigures::pixels); infinite: not known.
/// @param metric a place of metric space, heights as they are.
/// @return Subject::largestError() at most, and that where the camera of the cut does not see the place.
/// O(1).
double drawnWithin(const Subject& subject, const Camera& cutFor, const ViewSettings& settings, double pixels,
                   const Vec3& metric);

/// A bound in two digits, rounded up: "0.13", "42", "1300".
std::string boundText(double bound);

}  // namespace arete
