// SPDX-License-Identifier: GPL-3.0-or-later
//
// A draw call for each material of the front, and one for its wireframe; what is blended comes in a pass of
// its own, a draw call for each run of one material. Light is added up in proportion to light and written as
// sRGB.
#include "viewer/surface/surface_painter.h"

#include <glm/vec4.hpp>

#include <cmath>
#include <numbers>

#include "viewer/color/color_tables.h"
#include "viewer/gl/gl_program.h"

namespace arete {

/// shaders/surface.frag.glsl, std140.
struct SurfacePainter::Look {
  glm::vec4 baseColor{1, 1, 1, 1}, sun{}, modes{}, more{}, zenith{}, parts{1, 1, 1, 0};
};

namespace {

/// In the space of the surface.
Vec3 towardsSun(const FrameView& frame, const ViewLook& look, const Similarity& turned) {
  if (look.sun) {
    const double azimuth = look.sun->azimuthDegrees * std::numbers::pi / 180,
                 elevation = look.sun->elevationDegrees * std::numbers::pi / 180;
    return turned.inverse().direction({std::cos(elevation) * std::sin(azimuth),
                                       std::cos(elevation) * std::cos(azimuth), std::sin(elevation)});
  }
  const Frustum::Planes axes = Frustum(frame.view).planes();
  return unit(-0.62 * axes.right + 0.62 * axes.up - 0.48 * axes.forward);
}

float coloringNumber(Coloring coloring) {
  return coloring == Coloring::material ? 0.0f : coloring == Coloring::plain ? 1.0f : 2.0f;
}

}  // namespace

Result<SurfacePainter> SurfacePainter::create() {
  SurfacePainter p;
  ARETE_TRY(GlProgram surface,
            makeProgram(
                {{GL_VERTEX_SHADER, {"frame.glsl", "surface.vert.glsl"}},
                 {GL_FRAGMENT_SHADER, {"frame.glsl", "color_map.glsl", "light.glsl", "surface.frag.glsl"}}}));
  ARETE_TRY(GlProgram background, makeProgram({{GL_VERTEX_SHADER, {"sky.vert.glsl"}},
                                               {GL_FRAGMENT_SHADER, {"surface_background.frag.glsl"}}}));
  p.surface_ = std::move(surface);
  p.background_ = std::move(background);
  p.frame_ = makeBuffer(sizeof(FrameBlock));
  p.look_ = makeBuffer(sizeof(Look));
  p.errorColors_ = ColorMapsOnGpu({&colorTable("error"), 1});
  p.nothing_ = makeBuffer(16);
  p.surfaceArray_ = makeVertexArray();
  p.emptyArray_ = makeVertexArray();
  return p;
}

// The look differs from range to range and is written before each draw call; OpenGL keeps the order.
void SurfacePainter::drawRange(const DrawnSurface::Range& range, const Look& look) {
  glNamedBufferSubData(look_, 0, sizeof look, &look);
  glDrawElements(GL_TRIANGLES, GLsizei(3 * range.count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(std::size_t(12) * range.first));
}

/// One pass over a surface: binds what its draw calls share, and writes the look of each.
class SurfacePainter::Pass {
 public:
  Pass(SurfacePainter& painter, const SurfaceOnGpu& surface, const MaterialsOnGpu& materials,
       const DrawnSurface& front, const FrameView& frame, const ViewLook& look, const Similarity& turned)
      : painter_(painter),
        surface_(surface),
        materials_(materials),
        look_(look),
        sun_(towardsSun(frame, look, turned)),
        up_(turned.inverse().direction({0, 0, 1})) {
    const FrameBlock block = frameBlock(frame, MetricFrame{});
    glNamedBufferSubData(painter.frame_, 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, painter.frame_);
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, painter.look_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, front.errors != 0 ? front.errors : painter.nothing_);
    glUseProgram(painter.surface_);
    painter.errorColors_.bind();
    glProgramUniform1ui(painter.surface_, 0, painter.errorColors_.place(0));
    // An attribute that the surface lacks is disabled, and a constant takes its place: no coordinates, white.
    attribute(0, front.positions != 0 ? front.positions : GLuint(surface.positions), 3, GL_FLOAT);
    attribute(1, surface.normals, 3, GL_FLOAT);
    attribute(2, surface.textureCoords, 4, GL_FLOAT);
    attribute(3, look.surface.hasVertexColors ? GLuint(surface.colors) : 0, 4, GL_UNSIGNED_BYTE);
    glBindVertexArray(painter.surfaceArray_);
    glVertexAttrib4f(2, 0, 0, 0, 0);
    glVertexAttrib4f(3, 1, 1, 1, 1);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    if (look.surface.sides == SurfaceLook::Sides::front) glEnable(GL_CULL_FACE);
  }
  ~Pass() { glDisable(GL_CULL_FACE); }
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  void takeIndices(GLuint indices) const { glVertexArrayElementBuffer(painter_.surfaceArray_, indices); }
  /// Only the colouring by materials blends.
  bool isBlended(const DrawnSurface::Range& range) const {
    return look_.coloring == Coloring::material &&
           materials_.materials()[range.material].alpha == DrawnMaterial::Alpha::blended;
  }
  void draw(const DrawnSurface::Range& range) const {
    const DrawnMaterial& m = materials_.materials()[range.material];
    const SurfaceLook& shown = look_.surface;
    const auto number = [](bool is) { return is ? 1.0f : 0.0f; };
    Look now;
    if (shown.hasMaterialColors) now.baseColor = m.baseColor;
    now.baseColor.w = m.baseColor.w;
    now.sun = {float(sun_.x), float(sun_.y), float(sun_.z), number(look_.isShaded)};
    const bool hasPicture = shown.hasTextures && m.texture != 0 && surface_.textureCoords != 0;
    now.modes = {coloringNumber(look_.coloring), hasPicture ? float(1 + m.textureCoords) : 0.0f,
                 float(m.alpha), m.alphaCutoff};
    now.more = {number(m.isDoubleSided || shown.sides == SurfaceLook::Sides::both), 0, float(range.first), 0};
    now.zenith = {float(up_.x), float(up_.y), float(up_.z), number(shown.isFlat)};
    now.parts = {number(shown.hasSun), number(shown.hasSky), number(shown.hasHeadlight), 0};
    glBindTextureUnit(0, hasPicture ? m.texture : 0);
    painter_.drawRange(range, now);
  }

 private:
  void attribute(GLuint index, GLuint buffer, GLint size, GLenum type) const {
    const GLuint array = painter_.surfaceArray_;
    if (buffer == 0) {
      glDisableVertexArrayAttrib(array, index);
      return;
    }
    glVertexArrayVertexBuffer(array, index, buffer, 0, (type == GL_FLOAT ? 4 : 1) * size);
    glVertexArrayAttribFormat(array, index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, 0);
    glVertexArrayAttribBinding(array, index, index);
    glEnableVertexArrayAttrib(array, index);
  }

  SurfacePainter& painter_;
  const SurfaceOnGpu& surface_;
  const MaterialsOnGpu& materials_;
  const ViewLook& look_;
  Vec3 sun_, up_;
};

void SurfacePainter::draw(const SurfaceOnGpu& surface, const MaterialsOnGpu& materials,
                          const DrawnSurface& front, const FrameView& frame, const ViewLook& look,
                          const Similarity& turned) {
  const Pass pass(*this, surface, materials, front, frame, look, turned);
  pass.takeIndices(front.indices);
  for (const DrawnSurface::Range& range : front.ranges)
    if (!pass.isBlended(range)) pass.draw(range);
  if (!look.hasWireframe) return;
  Look lines;
  lines.baseColor = {0.05f, 0.07f, 0.10f, 1};
  lines.more.y = 1;
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(1, 1);  // nearer: depth is reversed
  for (const DrawnSurface::Range& range : front.ranges) drawRange(range, lines);
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

// Depth is not written, so that what lies behind stays visible, and nothing is hidden by what is seen
// through.
void SurfacePainter::drawBlended(const SurfaceOnGpu& surface, const MaterialsOnGpu& materials,
                                 const DrawnSurface& front, const FrameView& frame, const ViewLook& look,
                                 const Similarity& turned) {
  if (front.blended.empty() || look.coloring != Coloring::material) return;
  const Pass pass(*this, surface, materials, front, frame, look, turned);
  pass.takeIndices(front.blendedIndices);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  for (const DrawnSurface::Range& range : front.blended) pass.draw(range);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

void SurfacePainter::drawBackground() {
  glUseProgram(background_);
  glBindVertexArray(emptyArray_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_EQUAL);  // where nothing has been drawn
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
}

}  // namespace arete
