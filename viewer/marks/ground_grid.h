// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/marks/mark_lines.h"
#include "viewer/scene/subject.h"

namespace arete {

/// A level grid a little below the lowest place of a model, at multiples of a round number: of the
/// coordinates of its file, where a level plane has two of these, as every terrain has; of a surface that is
/// turned, of the lengths from the middle of its space. It reaches around the model. The legend has the
/// spacing. O(1).
MarkLines groundGrid(const Subject& subject);

}  // namespace arete
