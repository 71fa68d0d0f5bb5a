// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// An off-screen OpenGL 4.5 core context: EGL without a surface, on the preferred device, then on any other,
/// then a hidden window if there is a display. Current on the thread that made it until it is destroyed.
class OffscreenContext {
 public:
  /// Errors: unsupported, naming what was found instead.
  static Result<OffscreenContext> create();
  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;
  ~OffscreenContext();

  /// The renderer's name and the version of OpenGL.
  const std::string& description() const;

 private:
  struct Held;
  explicit OffscreenContext(std::unique_ptr<Held> held);
  std::unique_ptr<Held> held_;
};

/// Checks that the current context has OpenGL 4.5.
///
/// @return its description. Errors: unsupported, naming the version.
Result<std::string> checkOpenGl();

}  // namespace arete
