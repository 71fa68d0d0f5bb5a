// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/overlay/overlay_painter.h"

namespace arete {

Result<OverlayPainter> OverlayPainter::create() {
  OverlayPainter painter;
  ARETE_TRY(painter.program_, makeProgram({{GL_VERTEX_SHADER, {"sky.vert.glsl"}},
                                           {GL_FRAGMENT_SHADER, {"overlay.frag.glsl"}}}));
  painter.array_ = makeVertexArray();
  return painter;
}

void OverlayPainter::setPicture(int width, int height, std::span<const std::uint8_t> rgba) {
  if (width != width_ || height != height_) {
    picture_ = makeTexture(GL_TEXTURE_2D);
    glTextureStorage2D(picture_, 1, GL_RGBA8, width, height);
    // Pixel by pixel: nothing is to be smoothed.
    glTextureParameteri(picture_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(picture_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    width_ = width;
    height_ = height;
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(picture_, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

void OverlayPainter::draw() const {
  glUseProgram(program_);
  glBindVertexArray(array_);
  glBindTextureUnit(0, picture_);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace arete
