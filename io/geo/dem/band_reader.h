// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gdal_priv.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"

namespace arete {

/// Reads rows of a band as heights: raw * scale + offset. NaN is NODATA, as readRaster() defines it.
class BandReader {
 public:
  /// @param band Of a dataset that outlives the reader.
  /// @param nodata Replaces the declared NODATA value. NaN: no value but NaN is NODATA.
  /// @param isDepth The values count downwards: heights are -(raw * scale + offset).
  ///
  /// Errors: unsupported: complex samples. invalidData: an invalid scale or offset.
  static Result<BandReader> of(GDALRasterBand& band, std::optional<double> nodata, bool isDepth = false);

  double scale() const { return scale_; }
  double offset() const { return offset_; }
  /// Rows that are read best at once: whole blocks of the file, about a million samples.
  int stripRows() const { return stripRows_; }

  /// @param heights Receives `rowCount` whole rows.
  ///
  /// Errors: unreadable: GDAL reports an error or a warning. invalidData: 64-bit integers beyond 2^53.
  Status read(int firstRow, int rowCount, std::span<double> heights);

  /// Warnings about the rows read so far: infinite and huge heights, and samples in blocks that the file
  /// leaves out.
  void report(Warnings& warnings) const;

 private:
  /// Decides whether a raw value means NODATA.
  class NodataTest {
   public:
    NodataTest(std::optional<double> value, GDALDataType type);
    bool operator()(double raw) const {
      return stated_ &&
             (raw == value_ || (tolerance_ > 0 && raw - value_ <= tolerance_ && value_ - raw <= tolerance_));
    }

   private:
    bool stated_ = false;
    double value_ = 0;
    double tolerance_ = 0;
  };

  BandReader(GDALRasterBand& band, std::optional<double> nodata);

  Status transfer(GDALRasterBand& band, int firstRow, int rowCount, void* buffer, GDALDataType type);
  Status readPlain(int firstRow, int rowCount, std::span<double> raw);
  template <class Integer>
  Status readWide(int firstRow, int rowCount, std::span<double> raw);
  Status applyMask(GDALRasterBand& mask, int firstRow, int rowCount, std::span<double> raw);
  /// Takes the samples of absent blocks out of a window of the strip that begins at `firstRow`.
  void takeAbsentOut(int column, int row, int columns, int rows, int firstRow, std::span<double> raw);

  GDALRasterBand* band_;
  GDALDataType type_;
  std::vector<GDALRasterBand*> masks_;
  bool signedByte_ = false;
  bool hasWideNodata_ = false;
  bool mayBeSparse_ = false;
  std::string saidBefore_;  ///< by GDAL, before the first row was read
  std::int64_t signedNodata_ = 0;
  std::uint64_t unsignedNodata_ = 0;
  NodataTest nodata_{std::nullopt, GDT_Float64};
  double scale_ = 1, offset_ = 0;
  int stripRows_ = 1;
  std::vector<double> maskStrip_;
  std::size_t infinite_ = 0, huge_ = 0, absent_ = 0;
  double hugeExample_ = 0;
};

/// The band of opacity that a dataset declares, unless `band` is that band; null if there is none.
GDALRasterBand* alphaBandOf(GDALRasterBand& band);

}  // namespace arete
