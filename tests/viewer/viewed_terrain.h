// SPDX-License-Identifier: GPL-3.0-or-later
//
// A terrain and the state of a window on it, without a window.
#pragma once

#include "viewer/scene/terrain_subject.h"
#include "viewer/window/viewer_session.h"

namespace arete::test {

struct ViewedTerrain {
  TerrainSubject subject;
  Layers layers;
  ViewerSession session;

  explicit ViewedTerrain(const TerrainModel& model, const ViewerSession::Start& start = {})
      : subject(model), session(subject, layers, start) {}
};

}  // namespace arete::test
