// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_model.h"
#include "viewer/scene/triangle_ink.h"

namespace arete {

/// A colour for each chart: what hangs together without crossing a seam or an edge between parts. Charts that
/// meet may have the same colour where there are more than the table has. Errors: usage: the surface has no
/// lines, or an earlier version built it, whose lines are not known. O(n log n).
Result<TriangleInk> chartInk(const SurfaceModel& model);

/// How much a picture is stretched: of each triangle the area that it covers on the surface for its area in
/// the picture, as a part of the same of the whole at full resolution, in octaves from an eighth (blue:
/// dense) to eight times (brown: stretched). A triangle that has no area in the picture counts as the most
/// stretched, one that has none on the surface either has no number. Errors: usage: no texture coordinates.
/// O(n).
Result<TriangleInk> stretchInk(const SurfaceModel& model);

/// What an attribute of the source is off by at most on each triangle, as the model states it
/// (AttributeErrors), in octaves below the largest that is bounded. Triangles without a bound have no number.
///
/// @param name as options have it, or the file's own. Errors: usage: the model states no such errors, or is
/// displaced: its vertices have left what was bounded. O(n).
Result<TriangleInk> attributeErrorInk(const SurfaceModel& model, std::string_view name);

/// How the inks that a surface has are called, in the order of menus: "charts", "stretch", "error:uv". O(n).
std::vector<std::string> inkNames(const SurfaceModel& model);
/// The ink of such a name. Errors: usage, with the name as the culprit: it is of no ink; as the ink's own.
Result<TriangleInk> inkNamed(const SurfaceModel& model, std::string_view name);

/// What the names of inks of errors begin with, before the name of the attribute.
inline constexpr std::string_view kErrorInk = "error:";

}  // namespace arete
