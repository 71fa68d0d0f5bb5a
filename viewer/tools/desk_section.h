// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "viewer/tools/surface_desk.h"

namespace arete {

/// Draws the section of the panel with what can be made of the selected surface; nothing without one.
/// Precondition: the one that viewer/panel/widgets.h states.
///
/// @param camera,settings of the cut that is shown
/// @param say shows a sentence
void drawDeskSection(SurfaceDesk& desk, const Camera& camera, const ViewSettings& settings,
                     const std::function<void(std::string)>& say);

/// Draws the handles of the box over the picture.
///
/// @param scale pixels of the picture per ImGui unit
void drawBoxHandles(const SurfaceDesk& desk, const Subject& subject, const Camera& camera,
                    const ViewSettings& settings, double scale);

}  // namespace arete
