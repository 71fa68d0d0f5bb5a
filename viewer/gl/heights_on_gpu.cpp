// SPDX-License-Identifier: GPL-3.0-or-later
//
// As the tiles of a drape (drape_on_gpu.cpp), but only the first texels of the next tiles are repeated: what
// is looked up lies between a texel and those to the right of it and below.
#include "viewer/gl/heights_on_gpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace arete {
namespace {

constexpr std::uint64_t kBytesPerTexel = sizeof(float) + sizeof(HeightPyramid::Ground);
constexpr GLuint kHeightsUnit = 14, kSlopesUnit = 15, kBlockBinding = 4;  // shaders/ground.glsl

/// shaders/ground.glsl, std140.
struct GroundBlock {
  std::array<GLint, 4> tiles{}, eye{};
  std::array<GLfloat, 4> step{}, spare{};
  std::array<std::array<GLint, 4>, 16> levels{};
};

}  // namespace

std::uint64_t HeightsOnGpu::bytes() const {
  return kBytesPerTexel * layers_ * side_ * side_;
}

void HeightsOnGpu::plan(const HeightPyramid& pyramid) {
  const std::int32_t inner = std::int32_t(side_) - 1;
  levels_.clear();
  layers_ = 0;
  for (std::size_t k = 0; k < pyramid.levels().size(); ++k) {
    Tiles tiles{.columns = std::int32_t(pyramid.levels()[k].columns),
                .rows = std::int32_t(pyramid.levels()[k].rows)};
    if (int(k) >= finest_) {
      tiles.across = (tiles.columns + inner - 1) / inner;
      tiles.down = (tiles.rows + inner - 1) / inner;
      tiles.firstLayer = std::int32_t(layers_);
      layers_ += std::uint32_t(tiles.across) * std::uint32_t(tiles.down);
    }
    levels_.push_back(tiles);
  }
}

Result<HeightsOnGpu> HeightsOnGpu::load(const HeightPyramid& pyramid, const HeightsOptions& options,
                                        const RunContext& context) {
  GLint mostLayers = 0, mostSide = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &mostLayers);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostSide);
  HeightsOnGpu h;
  h.scale_ = pyramid.scale();
  h.shift_ = pyramid.shift();
  h.base_ = pyramid.base();
  h.reach_ = pyramid.reach();
  h.isExact_ = pyramid.isExact();
  h.warnings_ = pyramid.warnings();
  h.block_ = makeBuffer(sizeof(GroundBlock));
  const int count = int(pyramid.levels().size());
  for (; h.finest_ < count; ++h.finest_) {
    // The smallest side is taken that needs at most half of the device's layers.
    constexpr std::array<std::uint32_t, 5> kSides = {64, 256, 512, 1024, 2048};
    for (const std::uint32_t side : kSides) {
      h.side_ = options.tileSide == 0 ? side : std::max<std::uint32_t>(options.tileSide, 4);
      h.side_ = std::min(h.side_, std::uint32_t(mostSide));
      h.plan(pyramid);
      if (h.layers_ <= std::uint32_t(mostLayers) / 2 || options.tileSide != 0) break;
    }
    if (h.layers_ > std::uint32_t(mostLayers) || h.bytes() > options.mostBytes) continue;
    // Older errors are cleared, so that the next one is about the storage.
    while (glGetError() != GL_NO_ERROR) {
    }
    for (const auto& [texture, format] : {std::pair(&h.heights_, GL_R32F), {&h.slopes_, GL_RGBA16_SNORM}}) {
      *texture = makeTexture(GL_TEXTURE_2D_ARRAY);
      glTextureStorage3D(*texture, 1, GLenum(format), GLsizei(h.side_), GLsizei(h.side_), GLsizei(h.layers_));
    }
    if (glGetError() == GL_NO_ERROR) break;
  }
  if (h.finest_ == count)
    return failure(
        ErrorCode::unsupported,
        fmt::format("{} MiB of graphics memory have no room for its heights", options.mostBytes >> 20));
  for (const auto& [texture, filter] : {std::pair(&h.heights_, GL_NEAREST), {&h.slopes_, GL_LINEAR}})
    for (const auto& [name, value] : {std::pair(GL_TEXTURE_MIN_FILTER, filter),
                                      {GL_TEXTURE_MAG_FILTER, filter},
                                      {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                      {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}})
      glTextureParameteri(*texture, GLenum(name), value);
  if (h.finest_ > 0)
    h.warnings_.push_back(
        {WarningCode::display,
         fmt::format(
             "colours and contours are of means over {0} x {0} samples: full resolution needs more than "
             "{1} MiB of graphics memory",
             1 << h.finest_, options.mostBytes >> 20)});
  ARETE_CHECK(h.upload(pyramid, context));
  return h;
}

Status HeightsOnGpu::upload(const HeightPyramid& pyramid, const RunContext& context) {
  const std::int32_t inner = std::int32_t(side_) - 1;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t k = std::size_t(finest_); k < levels_.size(); ++k) {
    const HeightPyramid::Level& level = pyramid.levels()[k];
    const Tiles& tiles = levels_[k];
    glPixelStorei(GL_UNPACK_ROW_LENGTH, tiles.columns);
    for (std::int32_t i = 0; i < tiles.across * tiles.down; ++i) {
      if (context.cancelled()) break;
      const std::int32_t left = i % tiles.across * inner, top = i / tiles.across * inner;
      const GLsizei width = std::min(std::int32_t(side_), tiles.columns - left),
                    height = std::min(std::int32_t(side_), tiles.rows - top);
      const std::size_t first = std::size_t(top) * level.columns + std::size_t(left);
      glTextureSubImage3D(heights_, 0, 0, 0, tiles.firstLayer + i, width, height, 1, GL_RED, GL_FLOAT,
                          &level.heights[first]);
      glTextureSubImage3D(slopes_, 0, 0, 0, tiles.firstLayer + i, width, height, 1, GL_RGBA, GL_SHORT,
                          &level.ground[first]);
    }
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (context.cancelled()) return failure(ErrorCode::interrupted, "loading the heights was stopped");
  return {};
}

void HeightsOnGpu::bind(Vec2 eyePlan, Vec2 metricScale) const {
  constexpr double kFar = 1e9;
  const Vec2 eye{eyePlan.x * scale_.x + shift_.x, eyePlan.y * scale_.y + shift_.y};
  const double x = std::clamp(std::floor(eye.x), -kFar, kFar), y = std::clamp(std::floor(eye.y), -kFar, kFar);
  GroundBlock block;
  block.tiles = {GLint(side_), GLint(levels_.size()), finest_, isExact_ ? 1 : 0};
  block.eye = {GLint(x), GLint(y), 0, 0};
  block.step = {float(scale_.x / metricScale.x), float(scale_.y / metricScale.y), float(eye.x - x),
                float(eye.y - y)};
  for (std::size_t k = 0; k < levels_.size(); ++k)
    block.levels[k] = {levels_[k].firstLayer, levels_[k].across, levels_[k].columns, levels_[k].rows};
  glNamedBufferSubData(block_, 0, sizeof block, &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, kBlockBinding, block_);
  glBindTextureUnit(kHeightsUnit, heights_);
  glBindTextureUnit(kSlopesUnit, slopes_);
}

}  // namespace arete
