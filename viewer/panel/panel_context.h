// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/picture/picture.h"

struct GLFWwindow;

namespace arete {

/// Owns the ImGui context of one window. ImGui receives input before the viewer, and draws over its picture.
class PanelContext {
 public:
  /// @param scale of the screen: 1, or 2 on a dense one.
  PanelContext(GLFWwindow* window, float scale);
  PanelContext(const PanelContext&) = delete;
  PanelContext& operator=(const PanelContext&) = delete;
  ~PanelContext();

  /// Before the widgets of a frame.
  void beginFrame();
  /// Draws them into the framebuffer that is bound.
  void drawFrame();
};

/// What the window shows, panel and all.
Image windowImage(int width, int height);

}  // namespace arete
