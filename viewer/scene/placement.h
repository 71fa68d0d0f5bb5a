// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/similarity.h"
#include "engine/base/vec.h"
#include "viewer/scene/view_settings.h"

namespace arete {

class Subject;

/// Where an object stands in a scene. An object has a space of its own, whose z points up.
struct Placement {
  Vec3 pivot = {};   ///< the place of the object's space that stands at the anchor, and that it turns about
  Vec3 anchor = {};  ///< in the metric space of the scene
  Turn turn = {};    ///< out of east, north and up at the anchor
  double scale = 1;  ///< metric units of the scene for one of the object's, > 0
};

/// From an object's space to the metric space of the scene, heights as they are.
///
/// @param scene whose space has the anchor; null: a space of its own, x to the east, y to the north, z up.
Similarity placed(const Placement& placement, const Subject* scene);
/// The same to where the scene is drawn. An object stands as high above exaggerated ground as its anchor is
/// drawn, upright on a curved Earth, and is itself never exaggerated.
Similarity placedAsDrawn(const Placement& placement, const Subject* scene, const ViewSettings& settings);

}  // namespace arete
