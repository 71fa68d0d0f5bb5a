// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct DrapeReadOptions {
  /// One band (grey) or three (red, green, blue), counted from 1; empty = as the file says.
  std::vector<int> bands = {};
  /// A picture of more is read coarser, with a warning. At least 1.
  std::uint64_t mostPixels = std::uint64_t(1) << 28;
};

/// A picture brought onto a terrain: cut to its extent, its rows and columns along the axes of the terrain's
/// plan coordinates, at the picture's own resolution. Read window by window; never the whole is in memory.
///
/// Any raster that GDAL opens: grey or three colours of 8 bits, a colour table, or other numbers, which are
/// stretched from their 2nd to their 98th percentile, band by band. What is no data or masked is transparent,
/// and so is what the picture does not cover. Where the picture's rows run along the terrain's in the same
/// CRS, its pixels are those of the file; else they are interpolated (bilinear).
class DrapeReader {
 public:
  /// Red, green, blue multiplied by alpha; alpha.
  using Pixel = std::array<std::uint8_t, 4>;

  /// The model is read only while this runs. Errors: those of opening; usage (bands that are not there);
  /// invalidData (no georeference, no CRS where the terrain has one, no overlap); unsupported (too long and
  /// thin on the terrain); interrupted.
  static Result<DrapeReader> open(const std::string& path, const TerrainModel& model,
                                  const DrapeReadOptions& options = {}, const RunContext& context = {});
  DrapeReader(DrapeReader&&) noexcept;
  DrapeReader& operator=(DrapeReader&&) noexcept;
  ~DrapeReader();

  std::uint32_t columns() const;
  std::uint32_t rows() const;
  /// Plan position p lies p * scale() + shift() pixels from the picture's first corner.
  Vec2 scale() const;
  Vec2 shift() const;
  const std::vector<std::string>& warnings() const;

  /// Row by row. Precondition: the window lies in the picture and `pixels` holds it. Errors: unreadable.
  Status read(std::uint32_t column, std::uint32_t row, std::uint32_t width, std::uint32_t height,
              std::span<Pixel> pixels);

 private:
  struct State;
  explicit DrapeReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
