// SPDX-License-Identifier: GPL-3.0-or-later
//
// One table of keys; help and lookup both read it.
#include "viewer/window/key_bindings.h"

#include <algorithm>
#include <array>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace arete {
namespace {

constexpr std::array kKeys = {
    KeyBinding{GLFW_KEY_TAB, false, Action::toggleMode, "Tab", "orbit or free flight"},
    KeyBinding{GLFW_KEY_H, false, Action::nextHome, "H", "home views, one after the other"},
    KeyBinding{GLFW_KEY_F, false, Action::follow, "F", "follow the terrain",
               "following the ground is for terrain"},
    KeyBinding{GLFW_KEY_K, false, Action::setKeyFrame, "K", "set a key frame"},
    KeyBinding{GLFW_KEY_P, false, Action::playFlight, "P", "play or stop the flight"},
    KeyBinding{GLFW_KEY_S, true, Action::saveFlight, "Ctrl+S", "save the flight"},
    KeyBinding{GLFW_KEY_O, true, Action::loadFlight, "Ctrl+O", "load the flight"},
    KeyBinding{GLFW_KEY_L, false, Action::wireframe, "L", "wireframe"},
    KeyBinding{GLFW_KEY_C, false, Action::contours, "C", "contour lines", "contours are for terrain"},
    KeyBinding{GLFW_KEY_Z, false, Action::freeze, "Z", "freeze the cut"},
    KeyBinding{GLFW_KEY_G, false, Action::geomorph, "G", "geomorphing"},
    KeyBinding{GLFW_KEY_1, false, Action::colorUsual, "1", "colour by height; a surface by material"},
    KeyBinding{GLFW_KEY_2, false, Action::colorSlope, "2", "colour by slope",
               "colours by slope are for terrain"},
    KeyBinding{GLFW_KEY_3, false, Action::colorAspect, "3", "colour by aspect",
               "colours by aspect are for terrain"},
    KeyBinding{GLFW_KEY_4, false, Action::colorPlain, "4", "one colour"},
    KeyBinding{GLFW_KEY_5, false, Action::colorError, "5", "error heat map"},
    KeyBinding{GLFW_KEY_BACKSPACE, false, Action::clearPicks, "Backspace", "take picks and viewshed away"},
    KeyBinding{GLFW_KEY_N, false, Action::nextObject, "N", "select the next object"},
    KeyBinding{GLFW_KEY_EQUAL, false, Action::refine, "=", "selected object: twice the triangles, by hand"},
    KeyBinding{GLFW_KEY_MINUS, false, Action::coarsen, "-", "half of them"},
    KeyBinding{GLFW_KEY_0, false, Action::byView, "0", "level by the view again"},
    KeyBinding{GLFW_KEY_I, false, Action::alone, "I", "the selected object alone, or all"},
    KeyBinding{GLFW_KEY_O, false, Action::parallel, "O", "parallel projection or perspective"},
    KeyBinding{GLFW_KEY_KP_5, false, Action::parallel, "numpad 5", "the same"},
    KeyBinding{GLFW_KEY_X, false, Action::axes, "X", "axes of the file"},
    KeyBinding{GLFW_KEY_B, false, Action::grid, "B", "ground grid"},
    KeyBinding{GLFW_KEY_V, false, Action::orbitMark, "V", "what the orbit turns about"},
    KeyBinding{GLFW_KEY_M, false, Action::decorations, "M", "legend, scale bar, north and graticule"},
    KeyBinding{GLFW_KEY_F12, false, Action::screenshot, "F12", "picture of the model as PNG"},
    KeyBinding{GLFW_KEY_F2, false, Action::panel, "F2", "show or hide the panel"},
    KeyBinding{GLFW_KEY_ESCAPE, false, Action::cancel, "Esc", "overwrite nothing, where that is asked"},
    KeyBinding{GLFW_KEY_F1, false, Action::help, "F1", "this help"},
};

constexpr std::array kHeld = {
    HeldControl{"W S", "over the map, ahead and back", "ahead and back"},
    HeldControl{"A D", "over the map, left and right", "left and right"},
    HeldControl{"E Q", "nearer and farther", "up and down"},
    HeldControl{"arrows", "turn", "look around"},
    HeldControl{"Shift, Alt", "5 times as fast, as slow", "5 times as fast, as slow"},
    HeldControl{"left drag", "turn", ""},
    HeldControl{"right, middle drag", "over the map", "look around (right)"},
    HeldControl{"wheel", "nearer and farther, where the mouse is", "speed"},
    HeldControl{"left click", "pick a place; two: a line of sight, a distance on surfaces", "the same"},
    HeldControl{"left stick, triggers", "over the map, nearer and farther", "move, down and up"},
    HeldControl{"right stick", "turn", "look around"},
};

}  // namespace

std::span<const KeyBinding> keyBindings() {
  return kKeys;
}

std::optional<Action> actionOfKey(int key, bool isWithControl) {
  for (const KeyBinding& b : kKeys)
    if (b.key == key && b.isWithControl == isWithControl) return b.action;
  return std::nullopt;
}

std::string_view refusalOf(Action action) {
  return std::ranges::find(kKeys, action, &KeyBinding::action)->refusal;
}

std::optional<Action> actionOfButton(int button) {
  switch (button) {
    case GLFW_GAMEPAD_BUTTON_Y:
      return Action::toggleMode;
    case GLFW_GAMEPAD_BUTTON_BACK:
      return Action::nextHome;
    case GLFW_GAMEPAD_BUTTON_X:
      return Action::follow;
    case GLFW_GAMEPAD_BUTTON_A:
      return Action::setKeyFrame;
    case GLFW_GAMEPAD_BUTTON_START:
      return Action::playFlight;
    case GLFW_GAMEPAD_BUTTON_B:
      return Action::wireframe;
    default:
      return std::nullopt;
  }
}

std::span<const HeldControl> heldControls() {
  return kHeld;
}

}  // namespace arete
