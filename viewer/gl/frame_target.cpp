// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two framebuffers: a multisampled one to draw into, and one with a sample per pixel to read from.
#include "viewer/gl/frame_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace arete {
namespace {

GlTexture storage(GLenum format, int width, int height, int samples) {
  GlTexture texture = makeTexture(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D);
  if (samples > 1)
    glTextureStorage2DMultisample(texture, samples, format, width, height, GL_TRUE);
  else
    glTextureStorage2D(texture, 1, format, width, height);
  return texture;
}

}  // namespace

Result<FrameTarget> FrameTarget::create(int width, int height, int samples) {
  GLint most = 0, mostSamples = 1;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  glGetIntegerv(GL_MAX_SAMPLES, &mostSamples);
  if (width < 1 || height < 1 || width > most || height > most)
    return failure(ErrorCode::usage,
                   fmt::format("this device draws pictures of 1 x 1 to {} x {} pixels, not {} x {}", most,
                               most, width, height),
                   "picture");
  // The device hands its bytes over with their number as an int.
  if (std::int64_t{4} * width * height > std::numeric_limits<GLsizei>::max())
    return failure(ErrorCode::usage,
                   fmt::format("a picture of {} x {} pixels takes more than 2 GB", width, height), "picture");
  FrameTarget t;
  t.width_ = width;
  t.height_ = height;
  // Fewer samples than stated only make edges less smooth, so the device's limit refuses nothing.
  t.samples_ = std::clamp(samples, 1, std::max(1, mostSamples));
  t.color_ = storage(GL_RGBA8, width, height, t.samples_);
  t.depth_ = storage(GL_DEPTH_COMPONENT32F, width, height, t.samples_);
  t.framebuffer_ = makeFramebuffer();
  glNamedFramebufferTexture(t.framebuffer_, GL_COLOR_ATTACHMENT0, t.color_, 0);
  glNamedFramebufferTexture(t.framebuffer_, GL_DEPTH_ATTACHMENT, t.depth_, 0);
  if (t.samples_ > 1) {
    t.resolved_ = storage(GL_RGBA8, width, height, 1);
    t.resolvedDepth_ = storage(GL_DEPTH_COMPONENT32F, width, height, 1);
    t.resolvedFramebuffer_ = makeFramebuffer();
    glNamedFramebufferTexture(t.resolvedFramebuffer_, GL_COLOR_ATTACHMENT0, t.resolved_, 0);
    glNamedFramebufferTexture(t.resolvedFramebuffer_, GL_DEPTH_ATTACHMENT, t.resolvedDepth_, 0);
  }
  if (glCheckNamedFramebufferStatus(t.framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return failure(ErrorCode::unsupported, "the device has no framebuffer of 8-bit colours and float depths",
                   "picture");
  return t;
}

void FrameTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_, height_);
  // Depth is reversed, 1 at the near plane and 0 far away, because floats are densest at 0.
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 1);
  glClearDepth(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void FrameTarget::copyTo(GLuint framebuffer) const {
  glBlitNamedFramebuffer(framebuffer_, framebuffer, 0, 0, width_, height_, 0, 0, width_, height_,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image FrameTarget::image() const {
  // Samples cannot be read as they are: the second framebuffer takes their averages.
  if (samples_ > 1) copyTo(resolvedFramebuffer_);
  std::vector<std::uint8_t> bytes(std::size_t(4) * std::size_t(width_) * std::size_t(height_));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(samples_ > 1 ? resolved_ : color_, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(bytes.size()),
                    bytes.data());
  return imageFromBottomUp(width_, height_, bytes);
}

Image imageFromBottomUp(int width, int height, std::span<const std::uint8_t> rgba) {
  Image image(width, height);
  // OpenGL begins with the lowest row, a picture with the highest.
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* p = &rgba[4 * (std::size_t(height - 1 - y) * std::size_t(width) + std::size_t(x))];
      image.at(x, y) = {p[0], p[1], p[2]};
    }
  return image;
}

std::vector<float> FrameTarget::depths(double drawnNear, double parallelReach) const {
  const auto w = std::size_t(width_), h = std::size_t(height_);
  std::vector<float> read(w * h), depths(w * h);
  if (samples_ > 1)
    glBlitNamedFramebuffer(framebuffer_, resolvedFramebuffer_, 0, 0, width_, height_, 0, 0, width_, height_,
                           GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glGetTextureImage(samples_ > 1 ? resolvedDepth_ : depth_, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                    GLsizei(4 * read.size()), read.data());
  for (std::size_t y = 0; y < h; ++y)
    for (std::size_t x = 0; x < w; ++x) {
      // The far plane is infinitely far: depth is near / distance, and 0 where nothing is drawn.
      const float d = read[(h - 1 - y) * w + x];
      depths[y * w + x] =
          d > 0 ? float(parallelReach > 0 ? (1 - 2 * double(d)) * parallelReach : drawnNear / double(d))
                : std::numeric_limits<float>::infinity();
    }
  return depths;
}

}  // namespace arete
