// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mip levels inside a tile would need borders that double with each level. Here each level of the picture has
// tiles of its own, all in one array texture, and a border of one texel is enough for every level: what looks
// up a texel chooses level and tile itself (shaders/terrain.frag.glsl). Texel 1 of a tile is the first pixel
// of its own.
//
// The first level is read and uploaded tile by tile, row by row; the others are made of it on the device,
// each texel the mean of the four below it, and all of them beyond the picture's edges repeat the last one.
//
// Large pictures: the uniforms say where the eye stands in whole pixels and the rest, so that positions near
// the eye are exact to a small part of a pixel however many pixels there are.
#include "viewer/gl/drape_on_gpu.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/gl/gl_program.h"

namespace arete {
namespace {

constexpr std::int32_t kSmallestPicture = 32;  // of the last level, in pixels along its longer side
constexpr std::size_t kMostLevels = 16;        // shaders/terrain.frag.glsl
constexpr GLint kPicture = 2, kEye = 6, kStep = 10, kLevels = 14;
constexpr GLuint kFirstUnit = 2;

/// Half of what is free, as far as the driver tells; a quarter of the machine's memory where it does not.
std::uint64_t roomInBytes() {
  GLint kibibytes[4] = {0, 0, 0, 0};
  if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
    glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, kibibytes);
  else if (epoxy_has_gl_extension("GL_ATI_meminfo"))
    glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, kibibytes);
  if (kibibytes[0] > 0) return std::uint64_t(kibibytes[0]) * 1024 / 2;
  return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE)) / 4;
}

std::int32_t half(std::int32_t size, int times) {
  return std::int32_t((std::int64_t(size) + (std::int64_t(1) << times) - 1) >> times);
}

}  // namespace

void DrapeOnGpu::planLevels(std::uint32_t columns, std::uint32_t rows) {
  columns_ = columns;
  rows_ = rows;
  grid_.clear();
  layers_ = 0;
  // A tile has a border of one texel on every side.
  const std::int32_t inner = std::int32_t(side_) - 2;
  for (int k = 0; k < int(kMostLevels); ++k) {
    Level level;
    level.columns = half(std::int32_t(columns), k);
    level.rows = half(std::int32_t(rows), k);
    level.tilesAcross = (level.columns + inner - 1) / inner;
    level.tilesDown = (level.rows + inner - 1) / inner;
    level.firstLayer = std::int32_t(layers_);
    layers_ += std::uint32_t(level.tilesAcross) * std::uint32_t(level.tilesDown);
    grid_.push_back(level);
    if (std::max(level.columns, level.rows) <= kSmallestPicture) break;
  }
}

Result<DrapeOnGpu> DrapeOnGpu::load(const std::string& path, const TerrainModel& model,
                                    const DrapeOptions& options, const RunContext& context) {
  GLint mostLayers = 0, mostSide = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &mostLayers);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostSide);
  const std::uint64_t room = roomInBytes();
  DrapeReadOptions read = options.read;
  // A picture for which the device has no room is read again, coarser, until it fits.
  for (;;) {
    ARETE_TRY(DrapeReader reader, DrapeReader::open(path, model, read, context));
    DrapeOnGpu drape;
    drape.scale_ = reader.scale();
    drape.shift_ = reader.shift();
    drape.warnings_ = reader.warnings();
    if (options.tileSide != 0) {
      drape.side_ = std::clamp<std::uint32_t>(options.tileSide, 4, std::uint32_t(mostSide));
      drape.planLevels(reader.columns(), reader.rows());
    } else {
      // The smallest side is taken that needs at most half of the device's layers.
      constexpr std::uint32_t kSides[] = {256, 512, 1024, 2048};
      for (const std::uint32_t side : kSides) {
        drape.side_ = side;
        drape.planLevels(reader.columns(), reader.rows());
        if (drape.layers_ <= std::uint32_t(mostLayers) / 2) break;
      }
    }
    bool hasRoom = drape.layers_ <= std::uint32_t(mostLayers) && drape.bytes() <= room;
    if (hasRoom) {
      // Older errors are cleared, so that the next one is about the storage.
      while (glGetError() != GL_NO_ERROR) {
      }
      drape.texture_ = makeTexture(GL_TEXTURE_2D_ARRAY);
      glTextureStorage3D(drape.texture_, 1, GL_RGBA8, GLsizei(drape.side_), GLsizei(drape.side_),
                         GLsizei(drape.layers_));
      hasRoom = glGetError() == GL_NO_ERROR;
    }
    if (!hasRoom) {
      const std::uint64_t pixels = std::uint64_t(reader.columns()) * reader.rows();
      if (pixels < 4096)
        return failure(ErrorCode::unsupported,
                       fmt::format("the device has no room for its {} tiles", drape.layers_), path);
      read.maxPixels = pixels * 3 / 4;
      continue;
    }
    for (const auto& [name, value] : {std::pair(GL_TEXTURE_MIN_FILTER, GL_LINEAR),
                                      {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                      {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                      {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}})
      glTextureParameteri(drape.texture_, GLenum(name), value);
    ARETE_CHECK(drape.upload(reader, context));
    ARETE_CHECK(drape.makeLevels());
    return drape;
  }
}

Status DrapeOnGpu::upload(DrapeReader& reader, const RunContext& context) {
  const std::uint32_t inner = side_ - 2;
  const Level& level = grid_[0];
  const std::uint32_t across = std::uint32_t(level.tilesAcross), down = std::uint32_t(level.tilesDown);
  std::vector<DrapeReader::Pixel> window(std::size_t(side_) * side_), tile(window.size());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::uint32_t i = 0; i < across * down; ++i) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "reading the picture was stopped");
    context.report("reading the picture", double(i) / (across * down));
    // Its own pixels and one around them, as far as there are such.
    const std::uint32_t left = i % across * inner, top = i / across * inner;
    const std::uint32_t c0 = left - (left > 0 ? 1 : 0), c1 = std::min(columns_, left + inner + 1);
    const std::uint32_t r0 = top - (top > 0 ? 1 : 0), r1 = std::min(rows_, top + inner + 1);
    const std::uint32_t width = c1 - c0, height = r1 - r0;
    ARETE_CHECK(reader.read(c0, r0, width, height, std::span(window).first(std::size_t(width) * height)));
    const std::uint32_t used = std::min(side_, columns_ - left + 2),
                        usedRows = std::min(side_, rows_ - top + 2);
    for (std::uint32_t y = 0; y < usedRows; ++y) {
      const std::uint32_t row = std::clamp(top + y, r0 + 1, r1) - 1 - r0;
      for (std::uint32_t x = 0; x < used; ++x)
        tile[std::size_t(y) * used + x] =
            window[std::size_t(row) * width + (std::clamp(left + x, c0 + 1, c1) - 1 - c0)];
    }
    glTextureSubImage3D(texture_, 0, 0, 0, GLint(i), GLsizei(used), GLsizei(usedRows), 1, GL_RGBA,
                        GL_UNSIGNED_BYTE, tile.data());
  }
  context.report("reading the picture", 1);
  return {};
}

Status DrapeOnGpu::makeLevels() const {
  ARETE_TRY(const GlProgram program, makeProgram({{GL_COMPUTE_SHADER, {"drape_level.comp.glsl"}}}));
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glUseProgram(program);
  glBindImageTexture(0, texture_, 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA8);
  glBindImageTexture(1, texture_, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA8);
  glProgramUniform1i(program, 2, GLint(side_) - 2);
  const GLuint groups = (side_ + 7) / 8;
  for (std::size_t k = 1; k < grid_.size(); ++k) {
    const Level &from = grid_[k - 1], &to = grid_[k];
    glProgramUniform4i(program, 0, from.firstLayer, from.tilesAcross, from.columns, from.rows);
    glProgramUniform4i(program, 1, to.firstLayer, to.tilesAcross, to.columns, to.rows);
    glDispatchCompute(groups, groups, GLuint(to.tilesAcross * to.tilesDown));
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  return {};
}

void DrapeOnGpu::bind(GLuint program, GLuint slot, Vec2 eyePlan, Vec2 metricScale) const {
  glBindTextureUnit(kFirstUnit + slot, texture_);
  const auto at = GLint(slot);
  constexpr double kFar = 1e9;
  const Vec2 eye{eyePlan.x * scale_.x + shift_.x, eyePlan.y * scale_.y + shift_.y};
  const double x = std::clamp(std::floor(eye.x), -kFar, kFar), y = std::clamp(std::floor(eye.y), -kFar, kFar);
  glProgramUniform4i(program, kPicture + at, GLint(columns_), GLint(rows_), GLint(side_),
                     GLint(grid_.size()));
  glProgramUniform2i(program, kEye + at, GLint(x), GLint(y));
  glProgramUniform4f(program, kStep + at, float(scale_.x / metricScale.x), float(scale_.y / metricScale.y),
                     float(eye.x - x), float(eye.y - y));
  for (std::size_t k = 0; k < grid_.size(); ++k)
    glProgramUniform2i(program, kLevels + 16 * at + GLint(k), grid_[k].firstLayer, grid_[k].tilesAcross);
}

}  // namespace arete
