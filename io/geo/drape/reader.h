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
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct DrapeReadOptions {
  /// One band (grey) or three (red, green, blue), counted from 1. Empty: by the file.
  std::vector<int> bands = {};
  /// At least 1. A larger image is read at a coarser resolution, with a warning.
  std::uint64_t maxPixels = std::uint64_t(1) << 28;
};

/// An image mapped onto a terrain: cropped to its extent, with rows and columns along the axes of the
/// terrain's plan coordinates, at the resolution of the image. It is read window by window and never held in
/// memory as a whole.
///
/// The image is any raster that GDAL opens: grey or three colours of 8 bits, classes with a colour table (or
/// the colours of an attribute table), or other numbers, whose range from the 2nd to the 98th percentile is
/// mapped to 8 bits, band by band. Pixels that are NODATA, masked or outside the image are transparent. If
/// the rows of the image are parallel to the terrain's in the same CRS, pixels are copied from the
/// file; otherwise they are interpolated bilinearly. The colours of classes are never mixed: the nearest
/// pixel is taken, and the class of most pixels where the image is read coarser.
class DrapeReader {
 public:
  /// Red, green, blue, alpha; premultiplied.
  using Pixel = std::array<std::uint8_t, 4>;

  /// @param model May be destroyed after the call.
  ///
  /// Errors: notFound, unreadable, corrupt. usage: missing bands. invalidData: no georeference, no CRS while
  /// the terrain has one, no overlap. unsupported: not an image, or too long and thin on the terrain.
  /// interrupted.
  static Result<DrapeReader> open(const std::string& path, const TerrainModel& model,
                                  const DrapeReadOptions& options = {}, const RunContext& context = {});
  DrapeReader(DrapeReader&&) noexcept;
  DrapeReader& operator=(DrapeReader&&) noexcept;
  ~DrapeReader();

  std::uint32_t columns() const;
  std::uint32_t rows() const;
  /// Plan position p is at p * scale() + shift(), in pixels from the first corner of the image.
  Vec2 scale() const;
  Vec2 shift() const;
  /// The image has classes: every pixel has a colour of their table, or is transparent.
  bool hasClasses() const;
  const Warnings& warnings() const;

  /// Reads a window. Precondition: it lies in the image.
  ///
  /// @param pixels Row by row; at least width * height.
  ///
  /// Errors: unreadable.
  Status read(std::uint32_t column, std::uint32_t row, std::uint32_t width, std::uint32_t height,
              std::span<Pixel> pixels);

 private:
  struct State;
  explicit DrapeReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
