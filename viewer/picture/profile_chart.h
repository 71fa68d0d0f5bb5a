// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "terrain/sight/fresnel.h"
#include "terrain/sight/line.h"
#include "terrain/sight/profile.h"
#include "viewer/picture/picture.h"

namespace arete {

/// The line of sight that is drawn over the terrain of a profile.
struct ProfileSight {
  const SightLine& line;
  SightAnswer answer = {};
  double wavelength = 0;                                   ///< metres; > 0: the first Fresnel zone
  double part = kUsualFresnel;                             ///< of its radius, drawn inside of it
  std::optional<FresnelClearance> fresnel = std::nullopt;  ///< where the terrain comes furthest in is marked
};

struct ProfileChartOptions {
  int width = 1400, height = 700;  ///< pixels
  std::string title = {}, subtitle = {};
  std::string unit = {};  ///< of height; may be empty
  double unitMetres = 1;  ///< metres in it; 1 where distances have the unit of heights
};

/// The terrain along a line: distance to the right, height upwards, with separate scales, whose ratio is
/// stated as the exaggeration of heights. Gaps are grey. The sight line is curved as the Earth is at these
/// scales, green where it is visible, grey and dashed over gaps, red and dashed behind the obstruction, which
/// is marked. A legend names what is drawn. The labels of the line's ends and of the obstruction cross
/// neither the line nor the terrain where the chart has room. Errors: usage, for a size without room;
/// degenerate, for a profile without terrain or length. O(vertices).
Result<Canvas> drawProfile(const Profile& profile, const std::optional<ProfileSight>& sight,
                           const ProfileChartOptions& options = {});

}  // namespace arete
