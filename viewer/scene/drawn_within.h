// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "viewer/scene/subject.h"

namespace arete {

/// How far what is drawn at a picked place of a model may be from the model there, in the source's vertical
/// unit: the bound of any triangle that a cut may have there which is taken for a camera to a tolerance in
/// pixels, and with geomorphing that of the motion of its vertices. Vertically of terrain, in any direction
/// of a surface.
///
/// @param cutFor the camera that the cut was taken for; where it does not see the place, any cut counts.
/// @param pixels the tolerance of what is drawn (FrameFigures::pixels); infinite: not known.
/// @return 0: the triangle is one of the finest, at rest. O(depth * degree).
double drawnWithin(const Subject& subject, const Camera& cutFor, const ViewSettings& settings, double pixels,
                   const Pick& pick);

/// A bound in two digits, rounded up: "0.13", "42", "1300".
std::string boundText(double bound);

}  // namespace arete
