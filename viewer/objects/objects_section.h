// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "viewer/objects/distance_picks.h"
#include "viewer/objects/object_list.h"

namespace arete {

/// The section of a panel that lists the objects of a scene, with what the selected one is and has; changes
/// them in place. Precondition: a frame of ImGui has begun.
///
/// @param say takes a sentence for the user
void drawObjectsSection(ObjectList& objects, const std::function<void(std::string)>& say);

/// The section of the places that were clicked on surfaces.
void drawDistanceSection(DistancePicks& distance, const ObjectList& objects, const std::string& unit);

}  // namespace arete
