// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/vec.h"

namespace arete {

/// Mouse, keys and gamepad since the last frame, independent of the window library. Input that the panel has
/// taken is not in it.
struct InputState {
  double seconds = 0;  ///< since the last frame

  bool isOverPicture = false;  ///< the mouse is in the window and not over a panel
  Vec2 mouse = {};             ///< in pixels of the picture, from its top left, y downwards
  Vec2 mouseMoved = {};        ///< since the last frame
  double wheel = 0;            ///< notches, > 0 away from the user
  bool leftButton = false, middleButton = false, rightButton = false;  ///< held

  /// Held keys, each -1, 0 or 1.
  double ahead = 0, right = 0, up = 0;  ///< W - S, D - A, E - Q
  double turnRight = 0, turnUp = 0;     ///< arrows
  bool isFast = false, isSlow = false;  ///< Shift, Alt

  /// Sticks -1..1, right and down positive as GLFW has them; triggers 0..1. All 0 without one.
  struct Gamepad {
    double leftX = 0, leftY = 0, rightX = 0, rightY = 0, leftTrigger = 0, rightTrigger = 0;
    bool isFast = false;  ///< the right bumper
  } gamepad = {};
};

}  // namespace arete
