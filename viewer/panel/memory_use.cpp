// SPDX-License-Identifier: GPL-3.0-or-later
//
// The resident size comes from /proc/self/statm; the device's from the sizes of all buffers and textures.
#include "viewer/panel/memory_use.h"

#include <epoxy/gl.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace arete {
namespace {

constexpr GLuint kNames = 1000;

std::uint64_t textureBytes(GLuint texture) {
  GLint samples = 1;
  std::uint64_t bytes = 0;
  for (GLint level = 0; level < 16; ++level) {
    const auto get = [&](GLenum what) {
      GLint value = 0;
      glGetTextureLevelParameteriv(texture, level, what, &value);
      return value;
    };
    const GLint width = get(GL_TEXTURE_WIDTH);
    if (width == 0) break;
    std::uint64_t bits = 0;
    for (const GLenum part : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
                              GL_TEXTURE_ALPHA_SIZE, GL_TEXTURE_DEPTH_SIZE})
      bits += std::uint64_t(get(part));
    samples = std::max(get(GL_TEXTURE_SAMPLES), 1);
    bytes += std::uint64_t(width) * std::uint64_t(std::max(get(GL_TEXTURE_HEIGHT), 1)) *
             std::uint64_t(std::max(get(GL_TEXTURE_DEPTH), 1)) * std::uint64_t(samples) * bits / 8;
    if (samples > 1) break;
  }
  return bytes;
}

}  // namespace

std::uint64_t residentBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * std::uint64_t(sysconf(_SC_PAGESIZE));
}

std::uint64_t deviceBytes() {
  std::uint64_t bytes = 0;
  for (GLuint name = 1; name <= kNames; ++name) {
    if (glIsBuffer(name)) {
      GLint64 size = 0;
      glGetNamedBufferParameteri64v(name, GL_BUFFER_SIZE, &size);
      bytes += std::uint64_t(size);
    }
    if (glIsTexture(name)) bytes += textureBytes(name);
  }
  return bytes;
}

}  // namespace arete
