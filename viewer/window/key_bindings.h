// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace arete {

/// What a key or a button sets off.
enum class Action {
  toggleMode,
  nextHome,
  follow,
  setKeyFrame,
  playFlight,
  saveFlight,
  loadFlight,
  wireframe,
  contours,
  freeze,
  geomorph,
  colorHeight,
  colorSlope,
  colorAspect,
  colorPlain,
  colorError,
  clearPicks,
  screenshot,
  panel,
  help,
};

/// One line of the help.
struct KeyBinding {
  int key = 0;  ///< GLFW's number
  bool isWithControl = false;
  Action action = Action::help;
  std::string_view name, help;
};

/// All keys that set something off; help and docs/topics/viewer.md say what is here.
std::span<const KeyBinding> keyBindings();

/// Nothing for a key that means nothing.
std::optional<Action> actionOfKey(int key, bool isWithControl);

/// Buttons of a gamepad as GLFW numbers them.
std::optional<Action> actionOfButton(int button);

/// What is held or moved rather than pressed, for the help.
struct HeldControl {
  std::string_view what, orbit, free;
};
std::span<const HeldControl> heldControls();

}  // namespace arete
