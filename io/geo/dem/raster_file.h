// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/geo/dem/raster_reader.h"
#include "terrain/model/georeference.h"

namespace arete {

/// A raster that is open, found to hold heights, and placed. Its rows are read on demand.
class RasterFile {
 public:
  /// Errors: those of readRaster(), with a culprit; interrupted while an archive is searched. Warnings go to
  /// `warnings`.
  static Result<RasterFile> open(const std::string& path, const RasterReadOptions& options,
                                 Warnings& warnings, const RunContext& context);

  std::uint32_t columns() const;
  std::uint32_t rows() const;
  const Georeference& georeference() const;
  double rawScale() const;
  double rawOffset() const;
  /// Rows that are read best at once.
  std::uint32_t stripRows() const;

  /// Reads whole rows. Errors: unreadable, invalidData.
  Status read(std::uint32_t firstRow, std::uint32_t rowCount, std::span<double> heights);
  /// Warnings about what was read.
  void report(Warnings& warnings) const;

  RasterFile(RasterFile&&) noexcept;
  RasterFile& operator=(RasterFile&&) noexcept;
  ~RasterFile();

 private:
  struct Opened;
  explicit RasterFile(std::unique_ptr<Opened> opened);
  std::unique_ptr<Opened> opened_;
};

}  // namespace arete
