// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines are bands of triangles, one instance an edge, tested against the depths of the terrain. A label, or a
// marker, is whole or not there: its place is drawn first as two pixels that only note whether they were
// seen. Which labels have room is decided on the processor.
#include "viewer/layers/feature_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "engine/criteria/view.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/gl/gl_program.h"
#include "viewer/layers/label_atlas.h"

namespace arete {
namespace {

constexpr double kLabelGap = 3;  // pixels between a label and a marker
constexpr double kLeastLabel = 10;
constexpr GLuint kSeenBinding = 12, kAtlasUnit = 5, kSeenUnit = 6;
/// The radius of a marker beside lines of a width.
float markerRadius(const FeatureStyle& style) {
  return float(2.5 + style.width);
}

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

/// Where places in the space that is drawn are in the picture.
class PixelsOfFrame {
 public:
  PixelsOfFrame(const FrameView& frame, int width, int height)
      : frustum_(frame.view),
        planes_(frustum_.planes()),
        side_(frame.isMirrored ? -1 : 1),
        stretch_(frame.earthRadius > 0 ? 1 : frame.stretch),
        width_(width),
        height_(height) {}

  /// In pixels, y downwards; nothing behind the eye.
  std::optional<Vec2> operator()(Vec3 place) const {
    place.z *= stretch_;
    const Vec3 p = frustum_.toView(place);
    if (!(p.z > 0) && !frustum_.isParallel()) return std::nullopt;
    return Vec2{width_ * (0.5 + 0.5 * side_ * p.x / planes_.halfWidth(p.z)),
                height_ * (0.5 - 0.5 * p.y / planes_.halfHeight(p.z))};
  }

 private:
  Frustum frustum_;
  Frustum::Planes planes_;
  double side_, stretch_;
  int width_, height_;
};

/// Of each anchor, not 0 where it was seen. Waits for the drawing.
std::vector<std::uint32_t> seenOf(const FeatureBuffers& features) {
  std::vector<std::uint32_t> seen(features.anchorCount());
  glGetNamedBufferSubData(features.seen, 0, GLsizeiptr(seen.size() * sizeof(std::uint32_t)), seen.data());
  return seen;
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

struct FeaturePainter::State {
  FrameView frame = {};
  std::array<int, 4> viewport = {};
  GlProgram lines, anchors, labels, points;
  GlBuffer block;
  GlVertexArray linesArray, anchorsArray, labelsArray, pointsArray;
  GlTexture seen;
  std::optional<LabelAtlas> atlas;

  void use(const GlProgram& program);
  void drawLines(const FeatureBuffers& features, const FeatureStyle& style);
  void findSeen(FeatureBuffers& features);
  void drawPoints(const FeatureBuffers& features, const FeatureStyle& style);
  void drawTexts(std::span<const LabelBox> boxes);
};

Result<FeaturePainter> FeaturePainter::create() {
  auto made = std::make_unique<State>();
  State& p = *made;
  ARETE_TRY(p.lines, makeProgram({{GL_VERTEX_SHADER, {"frame.glsl", "lifted.glsl", "ground_lines.vert.glsl"}},
                                  {GL_FRAGMENT_SHADER, {"ground_lines.frag.glsl"}}}));
  ARETE_TRY(p.anchors,
            makeProgram({{GL_VERTEX_SHADER, {"frame.glsl", "lifted.glsl", "ground_anchors.vert.glsl"}},
                         {GL_FRAGMENT_SHADER, {"ground_anchors.frag.glsl"}}}));
  ARETE_TRY(p.labels, makeProgram({{GL_VERTEX_SHADER, {"labels.vert.glsl"}},
                                   {GL_FRAGMENT_SHADER, {"labels.frag.glsl"}}}));
  ARETE_TRY(p.points, makeProgram({{GL_VERTEX_SHADER, {"frame.glsl", "ground_points.vert.glsl"}},
                                   {GL_FRAGMENT_SHADER, {"ground_points.frag.glsl"}}}));
  ARETE_TRY(p.atlas, LabelAtlas::create());
  p.block = makeBuffer(sizeof(FrameBlock));
  p.linesArray = makeVertexArray();
  for (const GLuint i : {0u, 1u, 2u, 3u}) {
    setAttribute(p.linesArray, i, 4, 0, i);
    glVertexArrayBindingDivisor(p.linesArray, i, 1);
  }
  p.anchorsArray = makeVertexArray();
  setAttribute(p.anchorsArray, 0, 3, 0);
  p.seen = makeTexture(GL_TEXTURE_BUFFER);
  p.pointsArray = makeVertexArray();
  setAttribute(p.pointsArray, 0, 3, 0);
  glVertexArrayBindingDivisor(p.pointsArray, 0, 1);
  p.labelsArray = makeVertexArray();
  setAttribute(p.labelsArray, 0, 4, offsetof(LabelBox, left));
  setAttribute(p.labelsArray, 1, 2, offsetof(LabelBox, u));
  setAttribute(p.labelsArray, 2, 4, offsetof(LabelBox, ink));
  glVertexArrayBindingDivisor(p.labelsArray, 0, 1);
  return FeaturePainter(std::move(made));
}

FeaturePainter::FeaturePainter(std::unique_ptr<State> state) : state_(std::move(state)) {}
FeaturePainter::FeaturePainter(FeaturePainter&&) noexcept = default;
FeaturePainter& FeaturePainter::operator=(FeaturePainter&&) noexcept = default;
FeaturePainter::~FeaturePainter() = default;

void FeaturePainter::setFrame(const FrameView& frame, const MetricFrame& metric) {
  state_->frame = frame;
  const FrameBlock block = frameBlock(frame, metric);
  glNamedBufferSubData(state_->block, 0, sizeof block, &block);
  glGetIntegerv(GL_VIEWPORT, state_->viewport.data());
}

void FeaturePainter::State::use(const GlProgram& program) {
  glUseProgram(program);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, block);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDisable(GL_CULL_FACE);
}

void FeaturePainter::State::drawLines(const FeatureBuffers& features, const FeatureStyle& style) {
  if (features.lineVertices < 2) return;
  use(lines);
  const Blending blending;
  constexpr GLsizei kStride = 4 * sizeof(float);
  // The edge from vertex i sees its neighbours: the buffer begins with one vertex more.
  for (const GLuint i : {0u, 1u, 2u, 3u})
    glVertexArrayVertexBuffer(linesArray, i, features.lines, GLintptr(i) * kStride, kStride);
  glBindVertexArray(linesArray);
  glProgramUniform2f(lines, 0, float(viewport[2]), float(viewport[3]));
  glProgramUniform1f(lines, 1, float(style.width));
  glProgramUniform4fv(lines, 2, 1, inkOf(style).data());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(features.lineVertices));
}

void FeaturePainter::State::findSeen(FeatureBuffers& features) {
  if (features.anchorCount() == 0) return;
  glClearNamedBufferData(features.seen, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  use(anchors);
  glVertexArrayVertexBuffer(anchorsArray, 0, features.anchors, 0, 3 * sizeof(float));
  glBindVertexArray(anchorsArray);
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

void FeaturePainter::State::drawPoints(const FeatureBuffers& features, const FeatureStyle& style) {
  if (features.points == 0) return;
  use(points);
  const Blending blending;
  glDisable(GL_DEPTH_TEST);
  glVertexArrayVertexBuffer(pointsArray, 0, features.anchors, 0, 3 * sizeof(float));
  glBindVertexArray(pointsArray);
  glTextureBuffer(seen, GL_R32UI, features.seen);
  glBindTextureUnit(kSeenUnit, seen);
  glProgramUniform2f(points, 0, float(viewport[2]), float(viewport[3]));
  glProgramUniform1f(points, 1, markerRadius(style));
  glProgramUniform4fv(points, 2, 1, inkOf(style).data());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(features.points));
  glEnable(GL_DEPTH_TEST);
}

void FeaturePainter::State::drawTexts(std::span<const LabelBox> boxes) {
  if (boxes.empty()) return;
  use(labels);
  const Blending blending;
  glDisable(GL_DEPTH_TEST);
  const GlBuffer buffer = makeBuffer(boxes);
  glVertexArrayVertexBuffer(labelsArray, 0, buffer, 0, sizeof(LabelBox));
  glBindVertexArray(labelsArray);
  glBindTextureUnit(kAtlasUnit, atlas->texture());
  glProgramUniform2f(labels, 0, float(viewport[2]), float(viewport[3]));
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(boxes.size()));
  glEnable(GL_DEPTH_TEST);
}

void FeaturePainter::draw(FeatureBuffers& features, const FeatureStyle& style) {
  state_->drawLines(features, style);
  state_->findSeen(features);
  state_->drawPoints(features, style);
}

void FeaturePainter::keepPointsFree(const FeatureBuffers& features, const FeatureStyle& style,
                                    LabelPlacement& placement) {
  if (features.points == 0 || features.points > FeatureBuffers::kMostKeptFree) return;
  const PixelsOfFrame pixelOf(state_->frame, state_->viewport[2], state_->viewport[3]);
  const std::vector<std::uint32_t> seen = seenOf(features);
  const double radius = markerRadius(style);
  for (std::uint32_t i = 0; i < features.points; ++i)
    if (const auto at = seen[i] != 0 ? pixelOf(features.anchorPlaces[i]) : std::nullopt)
      placement.take({at->x - radius, at->y - radius, 2 * radius, 2 * radius});
}

Status FeaturePainter::drawLabels(const FeatureBuffers& features, const GroundFeatures& texts,
                                  const FeatureStyle& style, LabelPlacement& placement) {
  if (features.labels == 0) return {};
  State& s = *state_;
  const PixelsOfFrame pixelOf(s.frame, s.viewport[2], s.viewport[3]);
  const std::vector<std::uint32_t> seen = seenOf(features);
  const double away = (features.points > 0 ? markerRadius(style) : 0) + kLabelGap + 1;
  std::vector<LabelBox> boxes;
  for (std::uint32_t i = 0; i < features.labels; ++i) {
    const auto at =
        seen[features.points + i] != 0 ? pixelOf(features.anchorPlaces[features.points + i]) : std::nullopt;
    // Where a letter has no room, the size of the text need not be known.
    if (!at || !placement.hasRoom(*at, kLeastLabel, kLeastLabel, away)) continue;
    const std::string& text = texts.labels[i].text;
    const Vec2 size = s.atlas->sizeOf(text);
    const auto area = placement.place(*at, size.x, size.y, away);
    if (!area) continue;
    ARETE_TRY(auto entry, s.atlas->find(text));
    if (!entry) {
      s.drawTexts(boxes);
      boxes.clear();
      s.atlas->clear();
      ARETE_TRY(entry, s.atlas->find(text));
      if (!entry) continue;
    }
    boxes.push_back({float(area->left), float(area->top), float(area->width), float(area->height),
                     float(entry->corner.x), float(entry->corner.y), inkOf(style)});
  }
  s.drawTexts(boxes);
  return {};
}

}  // namespace arete
