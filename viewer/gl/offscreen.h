// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// An OpenGL 4.5 core context that no screen shows: EGL without a surface, on the device the machine prefers,
/// then on any of its devices, then behind a hidden window where there is a display. Current on the thread
/// that made it until it is destroyed.
class OffscreenContext {
 public:
  /// Errors: unsupported, saying what was found instead.
  static Result<OffscreenContext> create();
  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;
  ~OffscreenContext();

  /// What draws: the renderer's name and the version of OpenGL.
  const std::string& description() const;

 private:
  struct Held;
  explicit OffscreenContext(std::unique_ptr<Held> held);
  std::unique_ptr<Held> held_;
};

/// Of the current context: at least 4.5, or an error that says what it is. Errors: unsupported.
Result<std::string> checkOpenGl();

}  // namespace arete
