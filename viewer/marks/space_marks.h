// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "viewer/marks/orbit_mark.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/subject.h"

namespace arete {

/// Which marks a view shows, each by itself.
struct SpaceMarks {
  static constexpr const char* kAxes = "axes";
  static constexpr const char* kGrid = "ground grid";
  static constexpr const char* kOrbit = "orbit's centre";

  bool axes = false, grid = false, orbit = false;

  bool operator==(const SpaceMarks&) const = default;
};

/// Lays what is shown as layers of these names, and takes the others away. A layer of the user that has one
/// of the names stays as it is. Whether a layer is visible, its opacity and its place stay.
///
/// @param orbit nothing: no centre is marked.
/// @param stretch vertical exaggeration of what is drawn
void laySpaceMarks(Layers& layers, const SpaceMarks& marks, const Subject& subject, const Camera& camera,
                   const std::optional<OrbitPlace>& orbit, double stretch = 1);

}  // namespace arete
