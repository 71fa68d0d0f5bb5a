// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "viewer/window/viewer_session.h"

namespace arete {

/// Figures and settings around the picture, with Dear ImGui. A context of it is current and a frame begun.
class Panel {
 public:
  /// `scale`: pixels of the picture in one of the units that ImGui counts in.
  void draw(ViewerSession& session, double scale);

 private:
  void frameSection(ViewerSession& s);
  void detailSection(ViewerSession& s);
  void lookSection(ViewerSession& s);
  void cameraSection(ViewerSession& s);
  void flightSection(ViewerSession& s);
  void pickSection(ViewerSession& s);

  std::string goal_;
  bool isGoalLonLat_ = false, hasSetFlightPath_ = false;
  std::string flightPath_, framesFolder_;
};

/// Font and colours. `scale` of the screen: 1, or 2 on a dense one.
void setPanelStyle(float scale);

/// Marks at picks, at the ends of a line of sight and at key frames, over the picture.
void drawMarks(const ViewerSession& session, double scale);

/// The keys and what they do.
void drawHelp(ViewerSession& session);

}  // namespace arete
