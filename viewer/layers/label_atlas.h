// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <unordered_map>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "viewer/gl/gl_objects.h"

namespace arete {

/// Texts as coverage in one texture, each drawn when it is first needed. When the texture is full it begins
/// anew: precondition of its use, a frame's texts fit. 2048 x 2048 bytes on the device.
class LabelAtlas {
 public:
  struct Entry {
    Vec2 corner;  ///< texels
    double width = 0, height = 0;
  };

  /// Errors: unsupported, by the driver.
  static Result<LabelAtlas> create();

  /// The size of a text in pixels, with the room for its halo. O(length) at its first use.
  Vec2 sizeOf(const std::string& text);
  /// @return where the text is; nothing while the texture is full (clear() makes room).
  Result<std::optional<Entry>> find(const std::string& text);
  void clear();

  GLuint texture() const { return texture_; }

 private:
  GlTexture texture_;
  std::unordered_map<std::string, Vec2> sizes_;
  std::unordered_map<std::string, Entry> entries_;
  Vec2 next_;
};

}  // namespace arete
