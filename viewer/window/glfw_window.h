// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "viewer/window/input_state.h"
#include "viewer/window/key_bindings.h"

struct GLFWwindow;

namespace arete {

/// A window of the screen with an OpenGL 4.5 core context, current on this thread, and its input.
class GlfwWindow {
 public:
  /// Errors: unsupported: no display, or which OpenGL was found instead.
  static Result<GlfwWindow> open(const std::string& title, int width, int height, bool waitsForScreen);
  GlfwWindow(GlfwWindow&&) noexcept;
  GlfwWindow& operator=(GlfwWindow&&) noexcept;
  ~GlfwWindow();

  GLFWwindow* handle() const;
  /// The renderer's name and the version of OpenGL.
  const std::string& description() const;
  bool isClosing() const;
  /// Of the framebuffer; 0 x 0 when the window is hidden.
  int widthPixels() const;
  int heightPixels() const;
  /// Pixels in one unit of mouse positions.
  double pixelsPerUnit() const;
  /// Scale of text on this screen: 1, or 2 on a dense one.
  float contentScale() const;

  struct Events {
    InputState input;
    std::vector<Action> actions;
    std::optional<Vec2> click;         ///< left, without dragging; pixels from the top left
    std::vector<std::string> dropped;  ///< files that were dropped on the window
  };
  /// The input since the last call. `isMouseTaken`, `areKeysTaken`: by the panel.
  Events poll(bool isMouseTaken, bool areKeysTaken);
  /// Waits for input, at most this long.
  void wait(double seconds);
  void show();
  void setTitle(const std::string& title);

 private:
  struct Held;
  explicit GlfwWindow(std::unique_ptr<Held> held);
  std::unique_ptr<Held> held_;
};

}  // namespace arete
