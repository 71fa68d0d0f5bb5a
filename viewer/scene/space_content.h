// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/base/result.h"
#include "viewer/scene/view_settings.h"

namespace arete {

class Subject;

/// What a layer in space is drawn with.
struct SpaceFrame {
  const FrameView& view;   ///< of the first model of the scene
  const Subject& subject;  ///< that model
  const ViewSettings& settings;
  double opacity = 1;        ///< of the layer
  std::uint64_t number = 0;  ///< of the picture: the same for all layers of one
};

/// Content of a layer that draws itself, over the models and what is behind them: a new kind of layer is a
/// new class of these.
class SpaceContent {
 public:
  SpaceContent() = default;
  SpaceContent(const SpaceContent&) = delete;
  SpaceContent& operator=(const SpaceContent&) = delete;
  virtual ~SpaceContent() = default;

  /// As of Layer::kind().
  virtual std::string_view kind() const = 0;
  /// Draws into the framebuffer that is bound, which has the depths of the models.
  virtual Status draw(const SpaceFrame& frame) = 0;
  /// Draws its texts. Called after draw() of all layers, first for the highest, which takes the room.
  virtual Status drawLabels(const SpaceFrame&) { return {}; }
};

}  // namespace arete
