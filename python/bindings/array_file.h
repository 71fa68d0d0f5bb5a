// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/result.h"

namespace arete::python {

/// Heights in memory with what a file would say of them.
struct HeightArray {
  const double* heights = nullptr;  ///< row by row; NaN: NODATA
  std::size_t rows = 0, columns = 0;
  std::optional<std::array<double, 6>> geoTransform;  ///< GDAL's
  std::string crs;                                    ///< as a user states it; empty: none
  std::string unit;                                   ///< of the heights, as the source has it; empty: none
};

/// An array as a raster file in memory, so that it is read as every file is. Removed with this.
class ArrayFile {
 public:
  /// Errors: usage: GDAL knows no such CRS; outOfMemory.
  static Result<ArrayFile> write(const HeightArray& array);
  ~ArrayFile();
  ArrayFile(ArrayFile&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  ArrayFile& operator=(ArrayFile&&) = delete;

  const std::string& path() const { return path_; }

 private:
  explicit ArrayFile(std::string path) : path_(std::move(path)) {}
  std::string path_;
};

}  // namespace arete::python
