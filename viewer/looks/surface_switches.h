// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/scene/view_settings.h"

namespace arete {

/// The switches of a surface's look, each by itself, in the column of the panel that is being drawn.
///
/// @param look of which `coloring` and `isShaded` say which switches have a meaning.
void drawSurfaceSwitches(ViewLook& look);

}  // namespace arete
