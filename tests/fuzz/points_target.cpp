// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text of points: read as points with heights, as a grid where they fill one, by a named column of heights,
// and as plan positions. Other files of points are read by GDAL, which has fuzzers of its own.
#include <cpl_vsi.h>

#include <cmath>

#include "fuzz/harness.h"
#include "io/geo/dem/gridded_points.h"
#include "io/geo/dem/point_reader.h"
#include "io/geo/text/point_attributes.h"
#include "io/geo/text/point_text.h"

namespace {

using namespace arete;

constexpr std::size_t kMostBytes = std::size_t(1) << 30;

/// Bytes under a name of GDAL's own file system in memory, through which texts are read.
class VirtualFile {
 public:
  VirtualFile(const char* path, const std::uint8_t* data, std::size_t size) : path_(path) {
    // Not written to: the readers open it for reading.
    VSIFCloseL(VSIFileFromMemBuffer(path, const_cast<GByte*>(data), size, FALSE));
  }
  ~VirtualFile() { VSIUnlink(path_); }
  VirtualFile(const VirtualFile&) = delete;
  VirtualFile& operator=(const VirtualFile&) = delete;

 private:
  const char* path_;
};

void usePoints(const Result<PointRead>& read) {
  if (!read) return fuzz::requireClear(read.error());
  fuzz::requireClear(read->warnings);
  const PointHeightfield& points = read->heightfield;
  fuzz::require(points.validate().has_value() && points.size() > 0, "points that were read are finite");
  if (const auto raster = asRaster(points)) {
    fuzz::require(raster->validate().has_value(), "a grid of points is a valid raster");
    std::size_t valid = 0;
    for (const double height : raster->heights) valid += std::isnan(height) ? 0 : 1;
    fuzz::require(valid == points.size(), "a grid of points has each of them once");
  }
}

/// Places with what else their lines say.
void usePlaces(const char* path, const RunContext& context) {
  Warnings warnings;
  PointAttributes attributes;
  const auto plan = readPointText(path, {}, warnings, context, PointTextColumns::plan, &attributes);
  fuzz::requireClear(warnings);
  if (!plan) return fuzz::requireClear(plan.error());
  attributes.findKinds();
  const std::size_t columns = attributes.columns.size();
  fuzz::require(columns == 0 || attributes.rows() == plan->positions.size(),
                "every place has its attributes");
  std::size_t characters = 0;
  for (std::size_t row = 0; row < attributes.rows(); ++row)
    for (std::size_t column = 0; column < columns; ++column) characters += attributes.at(row, column).size();
  fuzz::require(characters <= kMostBytes, "attributes are parts of the file");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kPath = "/vsimem/fuzz/points.csv";
  constexpr const char* kNameless = "/vsimem/fuzz/points";
  const RunContext context = fuzz::oneThread();
  {
    const VirtualFile file(kPath, data, size);
    usePoints(readPoints(kPath, {}, context));
    PointReadOptions options;
    options.zField = "depth";
    options.nodata = -9999;
    usePoints(readPoints(kPath, options, context));
    usePlaces(kPath, context);
  }
  const VirtualFile file(kNameless, data, size);
  looksLikePointText(kNameless);
  return 0;
}
