// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "io/query/surface/take_surface.h"
#include "surface/attributes/attribute_changes.h"

namespace arete {

/// How much the attributes of the source have changed in a cut, at the middles of at most a thousand of its
/// faces (attributeChanges()). Empty without attributes. O(triangle ids) with a small constant
std::vector<AttributeChange> changesOfCut(const SurfaceModel& model, const TakenSurface& taken);

/// A line for each attribute, behind two spaces and its name.
std::string changesText(const std::vector<AttributeChange>& changes);

/// What attributes of vertices that were moved are off by at the nearest point, a line for each.
std::string movedText(const std::vector<AttributeRms>& moved);

/// The name that options have for it, and its root mean squares.
nlohmann::ordered_json toJson(const AttributeRms& of);

/// Its name, the largest change (null: infinite), its unit, and how many places were compared and differ.
nlohmann::ordered_json toJson(const AttributeChange& change);

}  // namespace arete
