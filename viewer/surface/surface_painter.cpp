// SPDX-License-Identifier: GPL-3.0-or-later
//
// A draw call for each material of the front, or for each run of triangles of one material, and as many for
// its wireframe. Light is added up in proportion to light and written as sRGB.
#include "viewer/surface/surface_painter.h"

#include <glm/vec4.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include "viewer/color/color_tables.h"
#include "viewer/gl/gl_program.h"
#include "viewer/surface/reflected_light.h"

namespace arete {

/// shaders/surface.frag.glsl, std140.
struct SurfacePainter::Look {
  glm::vec4 baseColor{1, 1, 1, 1}, sun{}, modes{}, more{}, zenith{}, parts{}, finish{0, 1, 0, 1}, emission{};
  std::array<glm::vec4, 2 * DrawnPicture::count> lookups{};
  glm::vec4 keptLow{}, keptHigh{};
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

/// From the eye, in which floats are exact enough wherever the surface lies.
glm::vec4 fromEye(const Vec3& place, const FrameView& frame, float w) {
  const Vec3 way = place - frame.view.eye;
  return {float(way.x), float(way.y), float(way.z), w};
}

float coloringNumber(Coloring coloring) {
  return coloring == Coloring::material ? 0.0f
         : coloring == Coloring::plain  ? 1.0f
         : coloring == Coloring::ink    ? 3.0f
                                        : 2.0f;
}

}  // namespace

InkOnGpu::InkOnGpu(const TriangleInk& ink)
    : numbers(makeBuffer(std::span<const float>(ink.numbers))), colors({&ink.colors, 1}) {}

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
  constexpr GLsizei kSide = 32;
  p.reflected_ = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(p.reflected_, 1, GL_RG32F, kSide, kSide);
  glTextureSubImage2D(p.reflected_, 0, 0, 0, kSide, kSide, GL_RG, GL_FLOAT, reflectedLight(kSide).data());
  glTextureParameteri(p.reflected_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(p.reflected_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  p.surfaceArray_ = makeVertexArray();
  p.emptyArray_ = makeVertexArray();
  return p;
}

// What is switched off leaves what it is multiplied by: without its picture nothing is metal, and what glows
// in places does not glow.
SurfacePainter::Look SurfacePainter::lookOf(const DrawnMaterial& material, const VertexStreams& vertices,
                                            const ViewLook& look) {
  const SurfaceLook& own = look.surface;
  Look now;
  const bool hasPictures = own.hasTextures && vertices.textureCoords.buffer != 0;
  const auto has = [&](DrawnPicture::Role role) {
    return hasPictures && material.pictures[role].texture != 0;
  };
  const auto lacks = [&](DrawnPicture::Role role) {
    return !hasPictures && material.pictures[role].texture != 0;
  };
  const bool hasColors = own.hasVertexColors && vertices.colors.buffer != 0;
  now.baseColor = material.baseColor;
  if (!own.hasMaterialColors)
    now.baseColor = hasColors || has(DrawnPicture::color) ? glm::vec4(1) : kUncolored;
  else if (vertices.colors.buffer != 0 && !hasColors && !has(DrawnPicture::color) &&
           now.baseColor == glm::vec4(1))
    now.baseColor = kUncolored;
  for (std::size_t i = 0; i < material.pictures.size(); ++i) {
    const PictureLookup& lookup = material.pictures[i].lookup;
    const float set = has(DrawnPicture::Role(i)) ? float(1 + std::min(lookup.textureCoords, 1u)) : 0;
    now.lookups[2 * i] = {lookup.u, set};
    now.lookups[2 * i + 1] = {lookup.v, 0};
  }
  const MaterialFinish& finish = material.finish;
  const bool hasFinish = look.coloring == Coloring::material;
  if (hasFinish) {
    now.finish = {lacks(DrawnPicture::metalAndRoughness) ? 0 : finish.metal, finish.roughness,
                  finish.reflectance, finish.normalScale};
    if (own.hasMaterialColors && !lacks(DrawnPicture::emission))
      now.emission = {finish.emission, finish.occlusion};
    now.emission.w = finish.occlusion;
  }
  now.sun.w = look.isShaded && !(hasFinish && finish.isWithoutLight) ? 1.0f : 0.0f;
  now.modes = {coloringNumber(look.coloring), 0, float(material.alpha), material.alphaCutoff};
  now.more.x = material.isDoubleSided || own.sides == SurfaceSides::both ? 1.0f : 0.0f;
  now.more.w = own.shading == SurfaceShading::flat ? 1.0f : 0.0f;
  now.parts = {own.hasSun, own.hasSky, own.hasHeadlight, own.hasHighlights};
  return now;
}

// The look differs from range to range and is written before each draw call; OpenGL keeps the order.
void SurfacePainter::drawRange(const DrawnSurface::Range& range, const Look& look) {
  glNamedBufferSubData(look_, 0, sizeof look, &look);
  glDrawElements(GL_TRIANGLES, GLsizei(3 * range.count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(std::size_t(12) * range.first));
}

void SurfacePainter::draw(const MaterialsOnGpu& materials, const DrawnSurface& front, const FrameView& frame,
                          const ViewLook& look, const Similarity& turned, bool isBlended,
                          const InkOnGpu* ink) {
  const FrameBlock block = frameBlock(frame, MetricFrame{});
  glNamedBufferSubData(frame_, 0, sizeof block, &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_);
  glBindBufferBase(GL_UNIFORM_BUFFER, 1, look_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, front.errors != 0 ? front.errors : nothing_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 9, front.ids != 0 ? front.ids : nothing_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 10, ink ? GLuint(ink->numbers) : GLuint(nothing_));
  glUseProgram(surface_);
  const ColorMapsOnGpu& colors = ink ? ink->colors : errorColors_;
  colors.bind();
  glBindTextureUnit(GLuint(DrawnPicture::count), reflected_);
  glProgramUniform1ui(surface_, 0, colors.place(0));
  const GLuint array = surfaceArray_;
  // An attribute that the surface lacks is disabled, and a constant takes its place: no coordinates, white.
  const auto attribute = [&](GLuint index, const VertexStreams::Stream& stream, GLint size, GLenum type) {
    if (stream.buffer == 0) {
      glDisableVertexArrayAttrib(array, index);
      return;
    }
    glVertexArrayVertexBuffer(array, index, stream.buffer, stream.first, stream.stride);
    glVertexArrayAttribFormat(array, index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, 0);
    glVertexArrayAttribBinding(array, index, index);
    glEnableVertexArrayAttrib(array, index);
  };
  const VertexStreams& vertices = front.vertices;
  attribute(0, vertices.positions, 3, GL_FLOAT);
  const bool isSmooth = look.surface.shading == SurfaceShading::smooth && vertices.smoothNormals.buffer != 0;
  attribute(1, isSmooth ? vertices.smoothNormals : vertices.normals, 3, GL_FLOAT);
  attribute(2, vertices.textureCoords, 4, GL_FLOAT);
  attribute(3, look.surface.hasVertexColors ? vertices.colors : VertexStreams::Stream{}, 4, GL_UNSIGNED_BYTE);
  glVertexArrayElementBuffer(array, front.indices);
  glBindVertexArray(array);
  glVertexAttrib4f(2, 0, 0, 0, 0);
  glVertexAttrib4f(3, 1, 1, 1, 1);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);

  const Vec3 sun = towardsSun(frame, look, turned), up = turned.inverse().direction({0, 0, 1});
  if (look.surface.sides == SurfaceSides::front) glEnable(GL_CULL_FACE);
  if (isBlended) {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
  }
  for (const DrawnSurface::Range& range : front.ranges) {
    const DrawnMaterial& m = materials.materials()[range.material];
    Look now = lookOf(m, vertices, look);
    now.sun = {float(sun.x), float(sun.y), float(sun.z), now.sun.w};
    now.zenith = {float(up.x), float(up.y), float(up.z), 0};
    now.more.z = float(range.first);
    if (look.kept) {
      now.keptLow = fromEye(look.kept->low, frame, 1);
      now.keptHigh = fromEye(look.kept->high, frame, 1);
    }
    for (GLuint i = 0; i < m.pictures.size(); ++i) glBindTextureUnit(i, m.pictures[i].texture);
    drawRange(range, now);
  }
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  if (!look.hasWireframe) {
    glDisable(GL_CULL_FACE);
    return;
  }
  Look lines;
  lines.baseColor = {0.05f, 0.07f, 0.10f, 1};
  lines.more.y = 1;
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(1, 1);  // nearer: depth is reversed
  for (const DrawnSurface::Range& range : front.ranges) drawRange(range, lines);
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDisable(GL_CULL_FACE);
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
