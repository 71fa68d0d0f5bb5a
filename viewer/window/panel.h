// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "viewer/window/viewer_session.h"

namespace arete {

/// Figures and settings beside the picture, with Dear ImGui. Precondition: an ImGui context is current and a
/// frame has begun.
class Panel {
 public:
  /// @param scale pixels of the picture per ImGui unit.
  void draw(ViewerSession& session, double scale);

 private:
  void frameSection(ViewerSession& s);
  void detailSection(ViewerSession& s);
  void lookSection(ViewerSession& s);
  void layerSection(ViewerSession& s);
  void cameraSection(ViewerSession& s);
  void flightSection(ViewerSession& s);
  void pickSection(ViewerSession& s, TerrainTools& tools);

  std::string goal_;
  bool isGoalLonLat_ = false, hasSetFlightPath_ = false;
  std::string flightPath_, framesFolder_;
};

/// Draws marks at picks, at the ends of a line of sight and at key frames, over the picture.
void drawMarks(const ViewerSession& session, double scale);

/// Draws the list of keys and their actions.
void drawHelp(ViewerSession& session);

}  // namespace arete
