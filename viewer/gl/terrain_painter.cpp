// SPDX-License-Identifier: GPL-3.0-or-later
//
// One draw call for a front, and one for its wireframe; indirect where the device has computed it. The
// fragment shader colours by height, slope, aspect or error; the sky is a triangle behind everything.
#include "viewer/gl/terrain_painter.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "terrain/model/camera.h"
#include "viewer/color/color_tables.h"
#include "viewer/gl/drape_on_gpu.h"
#include "viewer/gl/gl_program.h"
#include "viewer/heights/contour_levels.h"
#include "viewer/heights/height_pyramid.h"

namespace arete {

/// shaders/terrain.frag.glsl, std140.
struct TerrainPainter::Look {
  glm::vec4 sun{}, heightUnits{}, modes{}, flatColor{}, eastNorth{}, heat{};
  std::array<glm::vec4, Layers::kMostOnGround> ground{}, overlayFrame{}, contours{};
};

namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr GLint kColorMapPlaces = 91, kHeightGrain = 96;  // shaders/terrain.frag.glsl
constexpr GLuint kFirstOverlay = 6;                       // texture unit, as in the shader

void setSampling(GLuint texture, GLenum minify, GLenum magnify) {
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GLint(minify));
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GLint(magnify));
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

GLsizei levelsOf(std::uint32_t width, std::uint32_t height) {
  return GLsizei(std::bit_width(std::max(width, height)));
}

}  // namespace

Result<TerrainPainter> TerrainPainter::create(const TerrainModel& model, const HeightsOptions& options,
                                              const RunContext& context) {
  TerrainPainter p;
  ARETE_TRY(p.sky_, makeProgram({{GL_VERTEX_SHADER, {"sky.vert.glsl"}},
                                 {GL_FRAGMENT_SHADER, {"frame.glsl", "sky.frag.glsl"}}}));

  const MultiTriangulation& mt = model.mt;
  p.metric_ = mt.metric();
  p.scale_ = mt.scale();
  p.frame_ = makeBuffer(sizeof(FrameBlock));
  p.look_ = makeBuffer(sizeof(Look));
  // A small buffer stands in where a front has no ids, so that the shader never meets an empty binding.
  p.noIds_ = makeBuffer(64);
  p.emptyArray_ = makeVertexArray();
  p.terrainArray_ = makeVertexArray();

  {
    // The pyramid is freed as soon as the device has it.
    const auto made = [&]() -> Result<HeightPyramid> {
      if (options.isOfDrawn) return HeightPyramid::none();
      return HeightPyramid::create(model, {}, context);
    };
    ARETE_TRY(const HeightPyramid pyramid, made());
    ARETE_TRY(HeightsOnGpu heights, HeightsOnGpu::load(pyramid, options, context));
    p.heights_ = std::move(heights);
  }
  double low = INFINITY, high = -INFINITY;
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
    const double z = mt.vertices().height(VertexId(v));
    low = std::min(low, z);
    high = std::max(high, z);
  }
  // The sun and the aspects refer to east and north on the ground: where a camera at the middle looks.
  const Vec2 middle = model.toSource({p.metric_.origin.x, p.metric_.origin.y});
  const auto axis = [&](double azimuth, const Vec2& onAFlatMap) {
    const Result<View> view = viewOf({.xy = middle, .azimuthDegrees = azimuth}, model);
    return view ? Vec2{view->forward.x, view->forward.y} : onAFlatMap;
  };
  p.east_ = axis(90, {1, 0});
  p.north_ = axis(0, {0, 1});

  // Heights in the shader are right to a few units of the last place of a float; a grain is 4 to 8 of the
  // largest.
  const double largest = std::max({std::abs(low), std::abs(high), 1e-30});
  p.heightGrain_ = std::exp2(std::ceil(std::log2(largest)) - 21);
  p.ownColors_ = std::make_shared<const TerrainColors>(TerrainColors::over(low, high));
  p.takeColors({});

  return p;
}

void TerrainPainter::takeColors(const ViewLook& look) {
  const std::shared_ptr<const TerrainColors>& colors =
      look.colors ? static_cast<const std::shared_ptr<const TerrainColors>&>(look.colors) : ownColors_;
  if (colors_ == colors) return;
  const std::array maps = {colors->heights.onGrain(heightGrain_), colors->slopes, colors->aspects,
                           colors->errors};
  colorMaps_ = ColorMapsOnGpu(maps);
  colors_ = colors;
}

// A program is for one look and its layers and has nothing else: what a picture does not show takes no time,
// and Mesa's software renderer, which computes both sides of a branch, meets no loop over samplers, which it
// does not compile.
Result<GLuint> TerrainPainter::programFor(const ViewLook* look) {
  std::string layers;
  bool hasContours = false;
  if (look != nullptr)
    for (std::size_t i = 0; i < ground_.size(); ++i) {
      const std::size_t kind = ground_[i].layer.content.index();
      hasContours = hasContours || kind == 2;
      layers += kind == 0   ? fmt::format(" base = draped(base, {0}, drapeTiles[{0}]);", i)
                : kind == 1 ? fmt::format(" base = overlaid(base, {0}, overlays[{0}], plan);", i)
                            : fmt::format(" base = inked(base, {}, relief);", i);
    }
  std::string definitions = fmt::format(
      "#define FLAT {}\n#define MODE {}\n#define SHADED {}\n#define HAZE {}\n#define CONTOURS {}\n"
      "#define GROUND_LAYERS{}\n#define CONTOUR_INK (vec3({}, {}, {}) / 255.0)\n",
      look == nullptr, look != nullptr ? int(look->coloring) : 0, look != nullptr && look->isShaded,
      look != nullptr && look->hazeKilometres > 0, hasContours, layers, Contours::kInk.r, Contours::kInk.g,
      Contours::kInk.b);
  const auto known = programs_.find(definitions);
  if (known != programs_.end()) return GLuint(known->second);
  ARETE_TRY(GlProgram made, makeProgram({{GL_VERTEX_SHADER, {"frame.glsl", "terrain.vert.glsl"}},
                                         {GL_FRAGMENT_SHADER,
                                          {"frame.glsl", "ground.glsl", "contours.glsl", "color_map.glsl",
                                           "light.glsl", "terrain.frag.glsl"},
                                          definitions}}));
  return GLuint(programs_.emplace(std::move(definitions), std::move(made)).first->second);
}

void TerrainPainter::setFrame(const FrameView& frame) {
  const FrameBlock block = frameBlock(frame, metric_);
  eyePlan_ = {frame.eyeGround.x / metric_.scale.x + metric_.origin.x,
              frame.eyeGround.y / metric_.scale.y + metric_.origin.y};
  glNamedBufferSubData(frame_, 0, sizeof block, &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_);
}

namespace {

GlTexture overlayTexture(const PlanPicture& picture) {
  GlTexture texture = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(texture, levelsOf(std::uint32_t(picture.width), std::uint32_t(picture.height)), GL_RGBA8,
                     picture.width, picture.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture, 0, 0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE,
                      picture.rgba.data());
  glGenerateTextureMipmap(texture);
  // The overlay keeps hard edges when it is enlarged: a pixel is one answer.
  setSampling(texture, GL_LINEAR_MIPMAP_LINEAR, picture.isArea ? GL_LINEAR : GL_NEAREST);
  if (picture.isArea && !picture.rgba.empty()) {
    const Rgba& ink = picture.rgba.front();
    const std::array<float, 4> beyond = {float(ink[0]) / 255, float(ink[1]) / 255, float(ink[2]) / 255, 0};
    glTextureParameterfv(texture, GL_TEXTURE_BORDER_COLOR, beyond.data());
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  }
  return texture;
}

}  // namespace

Status TerrainPainter::setLayers(std::span<const Layer> layers) {
  std::vector<Ground> ground;
  for (const Layer& layer : layers) {
    if (!layer.isOnGround() || !layer.isVisible) continue;
    if (ground.size() == Layers::kMostOnGround)
      return failure(
          ErrorCode::usage,
          fmt::format("at most {} drapes, filled areas and contours together can be on the ground; hide some",
                      Layers::kMostOnGround),
          layer.name);
    Ground& g = ground.emplace_back(Ground{.layer = layer});
    const auto* overlay = std::get_if<Layer::Overlay>(&layer.content);
    if (!overlay) continue;
    const auto known = std::ranges::find_if(ground_, [&](const Ground& old) {
      const auto* other = std::get_if<Layer::Overlay>(&old.layer.content);
      return other && *other == *overlay && old.overlay != 0;
    });
    g.overlay = known != ground_.end() ? std::move(known->overlay) : overlayTexture(**overlay);
  }
  ground_ = std::move(ground);
  return {};
}

// Azimuths go clockwise from north. The direction is in metric space.
glm::vec4 TerrainPainter::sunOf(const ViewLook& look) const {
  const Sun sun = look.sun.value_or(Sun{});
  const double azimuth = sun.azimuthDegrees * kRadians, elevation = sun.elevationDegrees * kRadians;
  const double flat = std::cos(elevation);
  return {float(flat * (std::sin(azimuth) * east_.x + std::cos(azimuth) * north_.x)),
          float(flat * (std::sin(azimuth) * east_.y + std::cos(azimuth) * north_.y)),
          float(std::sin(elevation)), 0};
}

Status TerrainPainter::draw(const TerrainOnGpu& terrain, const DrawnFront& front, const ViewLook& l) {
  ARETE_TRY(const GLuint program, programFor(&l));
  Look look;
  look.sun = sunOf(l);
  const double base = heights_->base();
  look.heightUnits = {float(1 / metric_.scale.z), float(metric_.origin.z - base),
                      float(l.hazeKilometres * 1000), 0};
  look.modes = {float(base), 0, 0, 0};
  for (std::size_t i = 0; i < ground_.size(); ++i) {
    const Layer& layer = ground_[i].layer;
    look.ground[i] = {float(layer.opacity), 0, 0, 0};
    if (const auto* drape = std::get_if<Layer::Drape>(&layer.content)) {
      (*drape)->bind(program, GLuint(i), eyePlan_, {metric_.scale.x, metric_.scale.y});
    } else if (const auto* overlay = std::get_if<Layer::Overlay>(&layer.content)) {
      const PlanPicture& picture = **overlay;
      look.overlayFrame[i] = {float(picture.scale.x), float(picture.scale.y), float(picture.shift.x),
                              float(picture.shift.y)};
      glBindTextureUnit(kFirstOverlay + GLuint(i), ground_[i].overlay);
    } else {
      const ContourLevels levels =
          contourLevels(std::get<Contours>(layer.content).interval, base, heights_->reach());
      look.contours[i] = {float(levels.interval), float(levels.shift), float(levels.lift), 0};
    }
  }
  heights_->bind(eyePlan_, {metric_.scale.x, metric_.scale.y});
  look.eastNorth = {float(east_.x), float(east_.y), float(north_.x), float(north_.y)};
  look.heat = {float(l.heatError), 0, 0, 0};
  takeColors(l);
  drawWith(program, terrain, front, look);
  // Edges are the same triangles drawn as lines of one colour, and the offset keeps them in front of the
  // faces.
  if (l.hasWireframe) {
    ARETE_TRY(const GLuint flat, programFor(nullptr));
    look.flatColor = {0.05f, 0.07f, 0.10f, 1};
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glEnable(GL_POLYGON_OFFSET_LINE);
    glPolygonOffset(1, 1);  // nearer: depth is reversed
    drawWith(flat, terrain, front, look);
    glDisable(GL_POLYGON_OFFSET_LINE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
  return {};
}

Status TerrainPainter::drawFlat(const TerrainOnGpu& terrain, const DrawnFront& front,
                                const glm::vec4& color) {
  ARETE_TRY(const GLuint program, programFor(nullptr));
  Look look;
  look.flatColor = color;
  drawWith(program, terrain, front, look);
  return {};
}

void TerrainPainter::drawWith(GLuint program, const TerrainOnGpu& terrain, const DrawnFront& front,
                              const Look& look) {
  glNamedBufferSubData(look_, 0, sizeof look, &look);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_);
  glBindBufferBase(GL_UNIFORM_BUFFER, 1, look_);
  glUseProgram(program);
  colorMaps_.bind();
  glProgramUniform4ui(program, kColorMapPlaces, colorMaps_.place(0), colorMaps_.place(1), colorMaps_.place(2),
                      colorMaps_.place(3));
  glProgramUniform1f(program, kHeightGrain, float(heightGrain_));
  // Codes follow each other as the bits of the floats that they stand for do.
  const auto bitsOf = [&](OutwardScale::Code code) {
    return std::bit_cast<std::uint32_t>(scale_.decode(code));
  };
  glProgramUniform2ui(program, 1, bitsOf(1), bitsOf(2) - bitsOf(1));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, front.ids != 0 ? front.ids : noIds_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 9,
                   terrain.triangleErrors != 0 ? terrain.triangleErrors : noIds_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 10, front.indirect != 0 ? front.indirect : noIds_);

  const GLuint array = terrainArray_;
  const auto attribute = [&](GLuint index, GLuint buffer, GLint size) {
    glVertexArrayVertexBuffer(array, index, buffer, 0, 4 * size);
    glVertexArrayAttribFormat(array, index, size, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, index, index);
    glEnableVertexArrayAttrib(array, index);
  };
  attribute(0, terrain.positions, 3);
  attribute(1, terrain.rises, 1);
  attribute(2, terrain.places != 0 ? terrain.places : terrain.positions, 3);
  glVertexArrayElementBuffer(array, front.indices);
  glBindVertexArray(array);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  if (front.indirect != 0) {
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, front.indirect);
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr);
  } else if (front.count > 0) {
    glDrawElements(GL_TRIANGLES, GLsizei(3 * front.count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(std::size_t(12) * front.first));
  }
}

void TerrainPainter::drawSky(const ViewLook& l) {
  const glm::vec4 sun = sunOf(l);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_);
  glProgramUniform4f(sky_, 0, sun.x, sun.y, sun.z, 1.0f);
  glUseProgram(sky_);
  glBindVertexArray(emptyArray_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_EQUAL);  // where nothing has been drawn
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
}

}  // namespace arete
