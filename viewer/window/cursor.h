// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "viewer/scene/subject.h"
#include "viewer/window/terrain_tools.h"

namespace arete {

/// What is under the mouse: the place of the model at full resolution, and how far what is drawn there may be
/// from it. Asks the model only when the mouse, the camera or the cut has changed, and while a camera moves
/// over a model that takes long to ask, only when it comes to rest.
class Cursor {
 public:
  /// `tools`: nothing for a surface. Preconditions: both outlive this.
  Cursor(const Subject& subject, const std::optional<TerrainTools>& tools)
      : subject_(subject), tools_(tools) {}

  /// What is drawn, and where the mouse is.
  struct Now {
    std::optional<Vec2> mouse = {};   ///< in pixels of the picture; nothing: it is not over the picture
    Camera camera = {}, cutFor = {};  ///< that is shown, and that the cut was taken for
    double pixels = 0;                ///< the tolerance of the cut
    double stretch = 1;
    bool isCurved = false, isGeomorphed = false;

    bool operator==(const Now& other) const;
  };
  void update(const Now& now);

  const std::optional<Pick>& pick() const { return pick_; }
  /// In the source's vertical unit.
  double within() const { return within_; }
  /// "409050.0, 3801450.0   118.1° W, 34.3° N   height 1234.56 m, drawn within 0.8 m of it"; "no data" over
  /// NODATA; empty beside the model.
  const std::string& text() const { return text_; }
  /// How often the model was asked.
  int asked() const { return asked_; }

 private:
  void ask(const Now& now);
  std::string textOf(const Pick& pick) const;

  const Subject& subject_;
  const std::optional<TerrainTools>& tools_;
  std::optional<Now> seen_, answered_;  // of the last frame; of the text
  std::optional<Pick> pick_;
  double within_ = 0, askedMilliseconds_ = 0;
  std::string text_;
  int asked_ = 0;
};

}  // namespace arete
