// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/scene/terrain_subject.h"
#include "viewer/window/place_text.h"
#include "viewer/window/sight_tool.h"
#include "viewer/window/viewshed_job.h"

namespace arete {

/// What the window of a terrain has beside its camera: typed places, picks, a line of sight between two of
/// them and the viewshed of the last one. Lines of sight and viewsheds are layers. Members are live: the
/// panel changes them in place. Functions that can fail answer with a sentence for the user, or nothing.
class TerrainTools {
 public:
  /// Preconditions: subject and layers outlive this.
  TerrainTools(const TerrainSubject& subject, Layers& layers);
  TerrainTools(const TerrainTools&) = delete;
  TerrainTools& operator=(const TerrainTools&) = delete;

  /// The next pick; a third begins anew.
  std::string add(const Pick& pick);
  /// Again, after a height above the terrain has changed.
  std::string updateSight();
  /// The picks, the line of sight and the viewshed, finished or not.
  void clear();
  /// From the last pick.
  std::string startViewshed();
  /// Takes in the viewshed that is done.
  std::string step();

  const TerrainModel& model() const { return subject_.model(); }

  PlaceText places;
  SightTool sights;
  std::vector<Pick> picks;                    ///< none, one or two
  std::optional<SightPicture> sight;          ///< between two
  double observerAbove = 2, targetAbove = 2;  ///< above the terrain, in the DEM's vertical unit
  ViewshedJob viewshed;
  std::optional<ViewshedOverlay> overlay;
  int mostOverlayPixels = 8192;

 private:
  const TerrainSubject& subject_;
  Layers& layers_;
};

/// An interval for contour lines that gives about a dozen over a range of heights: 1, 2 or 5 times a power of
/// ten.
double usualContourInterval(double heightRange);

}  // namespace arete
