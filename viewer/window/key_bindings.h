// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace arete {

/// The actions of keys and buttons.
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
  colorUsual,
  colorSlope,
  colorAspect,
  colorPlain,
  colorError,
  clearPicks,
  nextObject,
  refine,
  coarsen,
  byView,
  alone,
  parallel,
  axes,
  grid,
  orbitMark,
  screenshot,
  decorations,
  panel,
  cancel,
  help,
};

/// One line of the help.
struct KeyBinding {
  int key = 0;  ///< GLFW's number
  bool isWithControl = false;
  Action action = Action::help;
  std::string_view name, help;
  /// Why a surface does not have it, as a sentence; empty: it does.
  std::string_view refusal = {};
};

/// All keys with an action. The help and docs/topics/viewer.md list them.
std::span<const KeyBinding> keyBindings();

/// @return nothing for a key without an action.
std::optional<Action> actionOfKey(int key, bool isWithControl);

/// KeyBinding::refusal of an action.
std::string_view refusalOf(Action action);

/// Buttons of a gamepad as GLFW numbers them.
std::optional<Action> actionOfButton(int button);

/// A control that is held or moved, for the help.
struct HeldControl {
  std::string_view what, orbit, free;
};
std::span<const HeldControl> heldControls();

}  // namespace arete
