// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/space_painter.h"

#include <cmath>
#include <span>
#include <vector>

#include "viewer/gl/frame_block.h"
#include "viewer/gl/gl_program.h"

namespace arete {
namespace {

/// Of shaders/lines.vert.glsl.
struct DrawnVertex {
  std::array<float, 3> place;
  Rgba color;
};

bool isThere(const Vec3& p) {
  return std::isfinite(p.x + p.y + p.z);
}

}  // namespace

Result<SpacePainter> SpacePainter::create() {
  SpacePainter painter;
  ARETE_TRY(painter.program_, makeProgram({{GL_VERTEX_SHADER, {"frame.glsl", "lines.vert.glsl"}},
                                           {GL_FRAGMENT_SHADER, {"lines.frag.glsl"}}}));
  painter.frame_ = makeBuffer(sizeof(FrameBlock));
  painter.array_ = makeVertexArray();
  return painter;
}

void SpacePainter::draw(const SpaceVertices& drawn, const FrameView& stated, double opacity) {
  const std::span<const SpaceVertices::Vertex> vertices = drawn.vertices;
  std::vector<DrawnVertex> ends;
  for (std::size_t i = 0; i + 1 < vertices.size(); i += 2) {
    if (!isThere(vertices[i].place) || !isThere(vertices[i + 1].place)) continue;
    for (const auto& [p, color] : vertices.subspan(i, 2))
      ends.push_back({{float(p.x), float(p.y), float(p.z)},
                      {color[0], color[1], color[2], std::uint8_t(std::lround(color[3] * opacity))}});
  }
  if (ends.empty()) return;
  FrameView frame = stated;
  frame.stretch = 1;  // the places are exaggerated already
  const FrameBlock block = frameBlock(frame, MetricFrame{});
  glNamedBufferSubData(frame_, 0, sizeof block, &block);
  const GlBuffer buffer = makeBuffer(std::span<const DrawnVertex>(ends));
  glVertexArrayVertexBuffer(array_, 0, buffer, 0, sizeof(DrawnVertex));
  glVertexArrayAttribFormat(array_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribFormat(array_, 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(DrawnVertex, color));
  for (const GLuint i : {0u, 1u}) {
    glVertexArrayAttribBinding(array_, i, 0);
    glEnableVertexArrayAttrib(array_, i);
  }
  glUseProgram(program_);
  glBindVertexArray(array_);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_);
  drawn.isAlwaysSeen ? glDisable(GL_DEPTH_TEST) : glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArrays(GL_LINES, 0, GLsizei(ends.size()));
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace arete
