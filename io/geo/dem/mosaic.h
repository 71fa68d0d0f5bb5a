// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
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

/// One raster or several on one lattice, read as one: the smallest raster that holds all of them, NODATA
/// where there is none. Rows are read on demand, and a file is open only while rows of it are read, so that
/// any number of files of any size can be read.
///
/// Where files overlap, NODATA gives way to a height; of two different heights that of the file named later
/// counts, and a warning counts such samples. So files that agree give the same heights in any order and
/// however one raster was cut into them, and the same georeference, which is that of the first sample.
/// Longitudes are taken whole turns apart where that makes the raster narrower: files on both sides of the
/// date line join.
class DemMosaic {
 public:
  /// @param paths At least one.
  ///
  /// Errors: those of readRaster() for each. invalidData: a file on another lattice (another pixel size, or
  /// shifted by more than 0.01 pixel against the first), in another CRS or unit of height.
  static Result<DemMosaic> open(const std::vector<std::string>& paths, const RasterReadOptions& options,
                                const RunContext& context);

  DemMosaic(DemMosaic&&) noexcept;
  DemMosaic& operator=(DemMosaic&&) noexcept;
  ~DemMosaic();

  std::uint32_t columns() const;
  std::uint32_t rows() const;
  const Georeference& georeference() const;
  double rawScale() const;  ///< 1 where the files differ in it
  double rawOffset() const;
  /// Rows that are read best at once.
  std::uint32_t stripRows() const;

  /// Reads whole rows; fastest from the first to the last. Errors: unreadable, invalidData, interrupted.
  Status read(std::uint32_t firstRow, std::uint32_t rowCount, std::span<double> heights,
              const RunContext& context);

  /// Warnings about the files and about what was read.
  void report(Warnings& warnings) const;

 private:
  struct Parts;
  explicit DemMosaic(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace arete
