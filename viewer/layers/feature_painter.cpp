// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines are bands of triangles, one instance an edge, tested against the depths of the terrain. A label, or a
// marker, is whole or not there: its place is drawn first as two pixels that only note whether they were
// seen. Which labels have room is decided on the processor.
#include "viewer/layers/feature_painter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/criteria/view.h"
#include "viewer/gl/gl_program.h"

namespace arete {
namespace {

constexpr double kLabelAway = 6;  // pixels between a label and its place
constexpr GLuint kSeenBinding = 12, kAtlasUnit = 5;

/// labels.vert.glsl.
struct LabelBox {
  float left, top, width, height, u, v;
  std::array<float, 4> ink;
};

std::array<float, 4> inkOf(const FeatureStyle& style) {
  return {float(style.color.r) / 255, float(style.color.g) / 255, float(style.color.b) / 255,
          float(style.opacity)};
}

void setAttribute(GLuint array, GLuint index, GLint count, std::size_t offset, GLuint binding = 0) {
  glVertexArrayAttribFormat(array, index, count, GL_FLOAT, GL_FALSE, GLuint(offset));
  glVertexArrayAttribBinding(array, index, binding);
  glEnableVertexArrayAttrib(array, index);
}

/// Blends over what is there and leaves its depths.
class Blending {
 public:
  Blending() {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
  }
  ~Blending() {
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }
  Blending(const Blending&) = delete;
  Blending& operator=(const Blending&) = delete;
};

}  // namespace

Result<FeaturePainter> FeaturePainter::create() {
  FeaturePainter p;
  ARETE_TRY(p.lines_,
            makeProgram({{GL_VERTEX_SHADER, {"frame.glsl", "lifted.glsl", "ground_lines.vert.glsl"}},
                         {GL_FRAGMENT_SHADER, {"ground_lines.frag.glsl"}}}));
  ARETE_TRY(p.anchors_,
            makeProgram({{GL_VERTEX_SHADER, {"frame.glsl", "lifted.glsl", "ground_anchors.vert.glsl"}},
                         {GL_FRAGMENT_SHADER, {"ground_anchors.frag.glsl"}}}));
  ARETE_TRY(p.labels_, makeProgram({{GL_VERTEX_SHADER, {"labels.vert.glsl"}},
                                    {GL_FRAGMENT_SHADER, {"labels.frag.glsl"}}}));
  ARETE_TRY(p.atlas_, LabelAtlas::create());
  p.block_ = makeBuffer(sizeof(FrameBlock));
  p.linesArray_ = makeVertexArray();
  for (const GLuint i : {0u, 1u, 2u, 3u}) {
    setAttribute(p.linesArray_, i, 4, 0, i);
    glVertexArrayBindingDivisor(p.linesArray_, i, 1);
  }
  p.anchorsArray_ = makeVertexArray();
  setAttribute(p.anchorsArray_, 0, 3, 0);
  p.labelsArray_ = makeVertexArray();
  setAttribute(p.labelsArray_, 0, 4, offsetof(LabelBox, left));
  setAttribute(p.labelsArray_, 1, 2, offsetof(LabelBox, u));
  setAttribute(p.labelsArray_, 2, 4, offsetof(LabelBox, ink));
  glVertexArrayBindingDivisor(p.labelsArray_, 0, 1);
  return p;
}

void FeaturePainter::setFrame(const FrameView& frame, const MetricFrame& metric) {
  frame_ = frame;
  const FrameBlock block = frameBlock(frame, metric);
  glNamedBufferSubData(block_, 0, sizeof block, &block);
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
}

void FeaturePainter::use(const GlProgram& program) {
  glUseProgram(program);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, block_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDisable(GL_CULL_FACE);
}

void FeaturePainter::drawLines(const FeatureBuffers& features, const FeatureStyle& style) {
  if (features.lineVertices < 2) return;
  use(lines_);
  const Blending blending;
  constexpr GLsizei kStride = 4 * sizeof(float);
  // The edge from vertex i sees its neighbours: the buffer begins with one vertex more.
  for (const GLuint i : {0u, 1u, 2u, 3u})
    glVertexArrayVertexBuffer(linesArray_, i, features.lines, GLintptr(i) * kStride, kStride);
  glBindVertexArray(linesArray_);
  glProgramUniform2f(lines_, 0, float(viewport_[2]), float(viewport_[3]));
  glProgramUniform1f(lines_, 1, float(style.width));
  glProgramUniform4fv(lines_, 2, 1, inkOf(style).data());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(features.lineVertices));
}

void FeaturePainter::findSeen(FeatureBuffers& features) {
  if (features.anchorCount() == 0) return;
  glClearNamedBufferData(features.seen, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  use(anchors_);
  glVertexArrayVertexBuffer(anchorsArray_, 0, features.anchors, 0, 3 * sizeof(float));
  glBindVertexArray(anchorsArray_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kSeenBinding, features.seen);
  glPointSize(2);
  glDepthMask(GL_FALSE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDrawArrays(GL_POINTS, 0, GLsizei(features.anchorCount()));
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glPointSize(1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
}

Status FeaturePainter::drawLabels(const FeatureBuffers& features, const GroundFeatures& texts,
                                  const FeatureStyle& style, LabelPlacement& placement) {
  if (features.labels == 0) return {};
  std::vector<std::uint32_t> seen(features.labels);
  glGetNamedBufferSubData(features.seen, GLintptr(features.points) * GLintptr(sizeof(std::uint32_t)),
                          GLsizeiptr(seen.size() * sizeof(std::uint32_t)), seen.data());
  const Frustum frustum(frame_.view);
  const Frustum::Planes planes = frustum.planes();
  const double stretch = frame_.earthRadius > 0 ? 1 : frame_.stretch, side = frame_.isMirrored ? -1 : 1;
  std::vector<LabelBox> boxes;
  const auto flush = [&] {
    if (boxes.empty()) return;
    use(labels_);
    const Blending blending;
    glDisable(GL_DEPTH_TEST);
    const GlBuffer buffer = makeBuffer(std::span<const LabelBox>(boxes));
    glVertexArrayVertexBuffer(labelsArray_, 0, buffer, 0, sizeof(LabelBox));
    glBindVertexArray(labelsArray_);
    glBindTextureUnit(kAtlasUnit, atlas_->texture());
    glProgramUniform2f(labels_, 0, float(viewport_[2]), float(viewport_[3]));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(boxes.size()));
    glEnable(GL_DEPTH_TEST);
    boxes.clear();
  };
  for (std::uint32_t i = 0; i < features.labels; ++i) {
    if (seen[i] == 0) continue;
    Vec3 place = features.labelPlaces[i];
    place.z *= stretch;
    const Vec3 p = frustum.toView(place);
    if (!(p.z > 0)) continue;
    const Vec2 at{viewport_[2] * (0.5 + 0.5 * side * p.x / (p.z * planes.slopeX)),
                  viewport_[3] * (0.5 - 0.5 * p.y / (p.z * planes.slopeY))};
    const std::string& text = texts.labels[i].text;
    const Vec2 size = atlas_->sizeOf(text);
    const auto area = placement.place(at, size.x, size.y, kLabelAway);
    if (!area) continue;
    ARETE_TRY(auto entry, atlas_->find(text));
    if (!entry) {
      flush();
      atlas_->clear();
      ARETE_TRY(entry, atlas_->find(text));
      if (!entry) continue;
    }
    boxes.push_back({float(area->left), float(area->top), float(area->width), float(area->height),
                     float(entry->corner.x), float(entry->corner.y), inkOf(style)});
  }
  flush();
  return {};
}

}  // namespace arete
