// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/marks/mark_lines.h"
#include "viewer/scene/subject.h"

namespace arete {

/// The axes of a model's file: X red, Y green, Z blue, along three edges of its box from the corner of the
/// lowest coordinates, with a tick at every round number and a letter at the end. The legend has the numbers
/// at both ends. Of a scene, the axes of its space.
///
/// @param camera that the letters face
/// @param stretch vertical exaggeration of what is drawn, which letters do not have
/// O(1).
MarkLines axesOfFile(const Subject& subject, const Camera& camera, double stretch = 1);

}  // namespace arete
