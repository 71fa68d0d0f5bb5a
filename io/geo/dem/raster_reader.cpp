// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads the samples strip by strip and computes their checksum. The memory is reserved at once but touched
// strip by strip, so that a file that states more samples than it has fails early.
#include "io/geo/dem/raster_reader.h"

#include <cpl_conv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/memory/pages.h"
#include "engine/memory/required_memory.h"
#include "io/files/text/address_text.h"
#include "io/geo/dem/mosaic.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_reading.h"

namespace arete {
namespace {

constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;

Status readStrips(DemMosaic& mosaic, std::vector<double>& heights, const RunContext& context) {
  const std::size_t columns = mosaic.columns();
  const std::uint32_t rows = mosaic.rows(), stripRows = mosaic.stripRows();
  reserveInPages(heights, columns * rows);
  for (std::uint32_t row = 0; row < rows; row += stripRows) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
    context.report("reading", double(row) / rows);
    const std::uint32_t count = std::min(stripRows, rows - row);
    const std::size_t begin = heights.size();
    heights.resize(begin + columns * count);
    ARETE_CHECK(mosaic.read(row, count, std::span(heights).subspan(begin), context));
  }
  context.report("reading", 1);
  return {};
}

Result<RasterRead> readMosaic(const std::vector<std::string>& paths, const RasterReadOptions& options,
                              NetworkReading& network, const RunContext& context) {
  ARETE_TRY(auto mosaic, DemMosaic::open(paths, options, context));
  const double samples = double(mosaic.columns()) * mosaic.rows();
  ARETE_CHECK(checkMemory(samples * sizeof(double),
                          fmt::format("{} columns by {} rows", mosaic.columns(), mosaic.rows())));
  RasterRead read;
  RasterHeightfield& heightfield = read.heightfield;
  ARETE_CHECK(readStrips(mosaic, heightfield.heights, context));
  ARETE_CHECK(network.finish());
  mosaic.report(read.warnings);
  heightfield.columns = mosaic.columns();
  heightfield.rows = mosaic.rows();
  heightfield.georeference = mosaic.georeference();
  heightfield.rawScale = mosaic.rawScale();
  heightfield.rawOffset = mosaic.rawOffset();
  heightfield.source = nameWithoutQuery(paths.front());
  heightfield.sourceChecksum = heightsChecksum(heightfield);
  ARETE_CHECK(heightfield.validate());
  return read;
}

}  // namespace

Status checkMemory(double bytes, const std::string& what) {
  ARETE_CHECK(checkBudget(static_cast<std::uint64_t>(std::min(bytes, 1e18)),
                          "take a part of the DEM or a coarser one"));
  const double usable = double(CPLGetUsablePhysicalRAM());
  if (usable <= 0 || bytes <= usable) return {};
  return failure(ErrorCode::unsupported,
                 fmt::format("{} need {:.1f} GiB of memory; this machine has {:.1f} GiB", what,
                             bytes / kGibibyte, usable / kGibibyte));
}

Result<RasterRead> readRaster(const std::string& path, const RasterReadOptions& options,
                              const RunContext& context) {
  return readRasters({path}, options, context);
}

Result<RasterRead> readRasters(const std::vector<std::string>& paths, const RasterReadOptions& options,
                               const RunContext& context) try {
  if (paths.empty()) return failure(ErrorCode::usage, "no file is named");
  registerGdal();
  NetworkReading network(context.cancel);
  auto read = readMosaic(paths, options, network, context);
  if (!read && context.cancelled())
    return failure(ErrorCode::interrupted, "reading was stopped", paths.front());
  if (!read && read.error().culprit.empty()) read.error().culprit = paths.front();
  return read;
} catch (...) {
  return caughtFailure(paths.empty() ? std::string() : paths.front());
}

}  // namespace arete
