// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each file is opened once to find its place on the lattice of the first one, and again when its first row is
// read. A single file stays open in between.
#include "io/geo/dem/mosaic.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/base/counted.h"
#include "io/files/text/address_text.h"
#include "io/geo/crs/names.h"
#include "io/geo/dem/raster_file.h"

namespace arete {
namespace {

constexpr double kMostTilePixelsOff = 0.01;
constexpr std::uint64_t kSampleLimit = (std::uint64_t(1) << 32) - 2;

/// A file on the lattice.
struct Part {
  std::string path;
  std::int64_t column = 0, row = 0;  ///< of its first sample
  std::uint32_t columns = 0, rows = 0;
  Georeference georeference;
  double rawScale = 1, rawOffset = 0;
  std::uint32_t stripRows = 1;
  std::optional<RasterFile> file;  ///< while it is open
  Warnings warnings;
};

tl::unexpected<Error> differs(const Part& part, const std::string& sentence) {
  return failure(ErrorCode::invalidData, sentence, part.path);
}

std::string crsNameOf(const Georeference& g) {
  return crsName(g.crsWkt);
}

std::string nameOf(const Part& part) {
  return CPLGetFilename(nameWithoutQuery(part.path).c_str());
}

Status checkFrame(const Part& first, const Part& part) {
  const Georeference &a = first.georeference, &b = part.georeference;
  if (a.crsWkt.empty() != b.crsWkt.empty()) {
    const Part &without = a.crsWkt.empty() ? first : part, &with = a.crsWkt.empty() ? part : first;
    return differs(without,
                   fmt::format("has no CRS, and {} is in {}: gdal_edit.py -a_srs writes the one that it is "
                               "in into the file, or `crs` states it for all",
                               with.path, crsNameOf(with.georeference)));
  }
  if (a.crsWkt != b.crsWkt && compareCrs(a.crsWkt, b.crsWkt) != CrsAgreement::same)
    return differs(part, fmt::format("is in {}, and {} in {}: gdalwarp -t_srs transforms one of them",
                                     crsNameOf(b), first.path, crsNameOf(a)));
  if (a.verticalUnitMetres != b.verticalUnitMetres || a.verticalUnit.empty() != b.verticalUnit.empty())
    return differs(
        part, fmt::format("has heights in '{}', and {} in '{}'", b.verticalUnit, first.path, a.verticalUnit));
  if (a.verticalDatum != b.verticalDatum)
    return differs(part, fmt::format("has heights above '{}', and {} above '{}'", b.verticalDatum, first.path,
                                     a.verticalDatum));
  if (a.hasGeoTransform && b.hasGeoTransform) return {};
  return differs(a.hasGeoTransform ? part : first, "has no position, so it cannot be joined with others");
}

std::string stepsOf(const Georeference& g) {
  return fmt::format("{:.10g} by {:.10g}", std::hypot(g.geoTransform[1], g.geoTransform[4]),
                     std::hypot(g.geoTransform[2], g.geoTransform[5]));
}

/// Finds the place of a part on the lattice of the first.
Status placePart(const Part& first, Part& part) {
  const Georeference &lattice = first.georeference, &own = part.georeference;
  const auto onLattice = [&](double column, double row) {
    const Vec2 at = own.toSource(column, row);
    return lattice.toGrid(at.x, at.y);
  };
  const double lastColumn = part.columns - 1.0, lastRow = part.rows - 1.0;
  const Vec2 begin = onLattice(0, 0);
  for (const double column : {0.0, lastColumn})
    for (const double row : {0.0, lastRow}) {
      const Vec2 at = onLattice(column, row);
      if (!(std::abs(at.x - begin.x - column) <= kMostTilePixelsOff &&
            std::abs(at.y - begin.y - row) <= kMostTilePixelsOff))
        return differs(part,
                       fmt::format("has pixels of {}, and {} of {}{}: gdalwarp -tr resamples one of them",
                                   stepsOf(own), first.path, stepsOf(lattice),
                                   stepsOf(own) == stepsOf(lattice) ? " in other directions" : ""));
    }
  const double column = std::round(begin.x), row = std::round(begin.y);
  const double right = begin.x - column, down = begin.y - row;
  if (std::abs(right) > kMostTilePixelsOff || std::abs(down) > kMostTilePixelsOff)
    return differs(
        part, fmt::format("is shifted by {:.3g} and {:.3g} pixel against the lattice of {}: gdalwarp -tr "
                          "with -tap resamples both to one",
                          right, down, first.path));
  constexpr double kFar = double(std::int64_t(1) << 40);
  if (!(std::abs(column) < kFar && std::abs(row) < kFar))
    return differs(part, fmt::format("is too far from {} to be joined with it", first.path));
  part.column = std::int64_t(column);
  part.row = std::int64_t(row);
  return {};
}

/// Moves parts by whole turns, so that the widest gap between them is outside.
void joinTurns(std::vector<Part>& parts) {
  const Georeference& g = parts.front().georeference;
  const auto& t = g.geoTransform;
  if (!g.isGeographic || t[2] != 0 || t[4] != 0 || parts.size() < 2) return;
  const double exact = 2 * std::numbers::pi / g.angularUnitRadians / std::abs(t[1]);
  const std::int64_t turn = std::llround(exact);
  if (turn < 1 || std::abs(exact - double(turn)) > kMostTilePixelsOff) return;

  std::vector<std::size_t> order(parts.size());
  std::vector<std::int64_t> begin(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    order[i] = i;
    begin[i] = ((parts[i].column % turn) + turn) % turn;
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return begin[a] < begin[b]; });
  std::int64_t end = 0, widest = 0, start = begin[order.front()];
  for (const std::size_t i : order) end = std::max(end, begin[i] + parts[i].columns);
  widest = begin[order.front()] + turn - end;  // across the end of the turn
  end = begin[order.front()] + parts[order.front()].columns;
  for (const std::size_t i : order) {
    if (begin[i] - end > widest) {
      widest = begin[i] - end;
      start = begin[i];
    }
    end = std::max(end, begin[i] + parts[i].columns);
  }
  std::int64_t low = std::numeric_limits<std::int64_t>::max(), high = -low;
  for (const Part& part : parts) {
    low = std::min(low, part.column);
    high = std::max(high, part.column + part.columns);
  }
  if (widest <= 0 || turn - widest >= high - low) return;  // it would be no narrower
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].column = begin[i] < start ? begin[i] + turn : begin[i];
}

Status checkSize(double columns, double rows) {
  if (columns * rows >= double(kSampleLimit) || columns > double(std::numeric_limits<int>::max()) ||
      rows > double(std::numeric_limits<int>::max()))
    return failure(ErrorCode::unsupported,
                   fmt::format("{} columns by {} rows are more than the {} samples that can be numbered",
                               columns, rows, kSampleLimit - 1));
  return {};
}

}  // namespace

struct DemMosaic::Parts {
  std::vector<Part> parts;
  RasterReadOptions options;
  std::uint32_t columns = 0, rows = 0, stripRows = 1;
  Georeference georeference;
  double rawScale = 1, rawOffset = 0;
  std::vector<double> strip;
  Warnings leftOut;  ///< a warning of each part that was
  // Where parts differ: how many samples, by how much at most, and the last two files.
  std::size_t different = 0;
  double largestDifference = 0;
  std::string differentFiles;

  Result<RasterFile> openPart(Part& part, Warnings& warnings, const RunContext& context) const {
    return RasterFile::open(part.path, options, warnings, context);
  }

  /// Whether no sample of a part is valid. O(samples) then.
  Result<bool> isEmpty(const Part& part, const RunContext& context) const {
    Warnings ignored;
    ARETE_TRY(auto file, RasterFile::open(part.path, options, ignored, context));
    std::vector<double> heights;
    for (std::uint32_t row = 0; row < file.rows(); row += file.stripRows()) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
      const std::uint32_t count = std::min(file.stripRows(), file.rows() - row);
      heights.resize(std::size_t{count} * file.columns());
      if (Status read = file.read(row, count, heights); !read)
        return failure(read.error().code, read.error().message, part.path);
      if (!std::ranges::all_of(heights, [](double height) { return std::isnan(height); })) return false;
    }
    return true;
  }

  /// Leaves a part out, which has no valid sample.
  void leaveOut(std::size_t i) {
    leftOut.push_back(
        {WarningCode::omitted,
         nameOf(parts[i]) + ": has no valid sample and does not fit the others: it is left out"});
    parts.erase(parts.begin() + std::ptrdiff_t(i));
  }

  /// Holds each part against the first. Empty tiles, as downloads have over the sea, need not fit: they are
  /// left out, the first one too.
  Status fit(const RunContext& context) {
    for (std::size_t i = 1; i < parts.size();) {
      Status fits = checkFrame(parts.front(), parts[i]);
      if (fits) fits = placePart(parts.front(), parts[i]);
      if (fits) {
        ++i;
        continue;
      }
      ARETE_TRY(const auto isOther, isEmpty(parts[i], context));
      if (isOther) {
        leaveOut(i);
        continue;
      }
      ARETE_TRY(const auto isFirst, isEmpty(parts.front(), context));
      if (!isFirst) return fits;
      leaveOut(0);
      i = 1;
      parts.front().column = parts.front().row = 0;
    }
    return {};
  }

  Status find(const RunContext& context) {
    for (Part& part : parts) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
      ARETE_TRY(auto file, openPart(part, part.warnings, context));
      part.columns = file.columns();
      part.rows = file.rows();
      part.georeference = file.georeference();
      part.rawScale = file.rawScale();
      part.rawOffset = file.rawOffset();
      part.stripRows = file.stripRows();
      if (parts.size() == 1) {
        part.file = std::move(file);
        break;
      }
    }
    ARETE_CHECK(fit(context));
    if (Part& only = parts.front(); parts.size() == 1 && !only.file) {
      Warnings repeated;
      ARETE_TRY(auto file, openPart(only, repeated, context));
      only.file = std::move(file);
    }
    joinTurns(parts);
    return {};
  }

  /// The raster that holds all parts. Its position is that of the parts at its left and upper borders, so
  /// that it does not depend on which file was named first.
  Status surround() {
    const auto left =
        std::ranges::min_element(parts, {}, [](const Part& p) { return std::pair(p.column, p.row); });
    const auto upper =
        std::ranges::min_element(parts, {}, [](const Part& p) { return std::pair(p.row, p.column); });
    const std::int64_t firstColumn = left->column, firstRow = upper->row;
    std::int64_t endColumn = firstColumn, endRow = firstRow;
    rawScale = left->rawScale;
    rawOffset = left->rawOffset;
    for (Part& part : parts) {
      endColumn = std::max(endColumn, part.column + part.columns);
      endRow = std::max(endRow, part.row + part.rows);
      stripRows = std::max(stripRows, part.stripRows);
      if (part.rawScale != left->rawScale || part.rawOffset != left->rawOffset) rawScale = 1, rawOffset = 0;
    }
    ARETE_CHECK(checkSize(double(endColumn - firstColumn), double(endRow - firstRow)));
    georeference = left->georeference;
    auto& g = georeference.geoTransform;
    const double up = double(left->row - firstRow);
    if (g[2] == 0 && g[4] == 0) {
      g[3] = upper->georeference.geoTransform[3];
    } else {
      g[0] -= up * g[2];
      g[3] -= up * g[5];
    }
    columns = std::uint32_t(endColumn - firstColumn);
    rows = std::uint32_t(endRow - firstRow);
    for (Part& part : parts) {
      part.column -= firstColumn;
      part.row -= firstRow;
    }
    const std::size_t most = std::max<std::size_t>(1, (std::size_t(1) << 22) / columns);
    if (parts.size() > 1) stripRows = std::uint32_t(std::min<std::size_t>(stripRows, most));
    stripRows = std::min(stripRows, rows);
    return {};
  }

  /// Puts a strip of a part into the rows that begin at `firstRow`.
  void merge(const Part& part, std::int64_t firstRow, std::int64_t begin, std::int64_t end,
             std::span<double> heights) {
    for (std::int64_t row = begin; row < end; ++row) {
      const double* from = strip.data() + std::size_t(row - begin) * part.columns;
      double* to = heights.data() + std::size_t(row - firstRow) * columns + std::size_t(part.column);
      for (std::uint32_t c = 0; c < part.columns; ++c) {
        // NODATA hides nothing: an earlier height stays where the later file has none.
        if (std::isnan(from[c])) continue;
        if (!std::isnan(to[c]) && to[c] != from[c]) {
          ++different;
          largestDifference = std::max(largestDifference, std::abs(to[c] - from[c]));
          if (differentFiles.empty()) differentFiles = nameOf(part);
        }
        to[c] = from[c];
      }
    }
  }
};

DemMosaic::DemMosaic(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
DemMosaic::DemMosaic(DemMosaic&&) noexcept = default;
DemMosaic& DemMosaic::operator=(DemMosaic&&) noexcept = default;
DemMosaic::~DemMosaic() = default;

Result<DemMosaic> DemMosaic::open(const std::vector<std::string>& paths, const RasterReadOptions& options,
                                  const RunContext& context) {
  auto parts = std::make_unique<Parts>();
  parts->options = options;
  for (const std::string& path : paths) parts->parts.emplace_back().path = path;
  ARETE_CHECK(parts->find(context));
  if (Status status = parts->surround(); !status)
    return failure(status.error().code, status.error().message, paths.front());
  return DemMosaic(std::move(parts));
}

std::uint32_t DemMosaic::columns() const {
  return parts_->columns;
}
std::uint32_t DemMosaic::rows() const {
  return parts_->rows;
}
const Georeference& DemMosaic::georeference() const {
  return parts_->georeference;
}
double DemMosaic::rawScale() const {
  return parts_->rawScale;
}
double DemMosaic::rawOffset() const {
  return parts_->rawOffset;
}
std::uint32_t DemMosaic::stripRows() const {
  return parts_->stripRows;
}

Status DemMosaic::read(std::uint32_t firstRow, std::uint32_t rowCount, std::span<double> heights,
                       const RunContext& context) {
  Parts& all = *parts_;
  // A single file has nothing to be merged with and is read straight into the result.
  if (all.parts.size() == 1) {
    Status status = all.parts.front().file->read(firstRow, rowCount, heights);
    if (!status && status.error().culprit.empty()) status.error().culprit = all.parts.front().path;
    return status;
  }
  std::fill(heights.begin(), heights.end(), std::numeric_limits<double>::quiet_NaN());
  const std::int64_t first = firstRow, stop = first + rowCount;
  for (Part& part : all.parts) {
    if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped");
    const std::int64_t begin = std::max(first, part.row), end = std::min(stop, part.row + part.rows);
    if (begin < end) {
      Warnings repeated;  // the warnings of the first opening suffice
      if (!part.file) {
        ARETE_TRY(auto file, all.openPart(part, repeated, context));
        if (file.columns() != part.columns || file.rows() != part.rows)
          return failure(ErrorCode::unreadable, "was replaced while it was read", part.path);
        part.file = std::move(file);
      }
      all.strip.resize(std::size_t(end - begin) * part.columns);
      if (Status status =
              part.file->read(std::uint32_t(begin - part.row), std::uint32_t(end - begin), all.strip);
          !status) {
        if (status.error().culprit.empty()) status.error().culprit = part.path;
        return status;
      }
      all.merge(part, first, begin, end, heights);
    }
    if (part.file && stop >= part.row + part.rows) {
      part.file->report(part.warnings);
      part.file.reset();
    }
  }
  return {};
}

void DemMosaic::report(Warnings& warnings) const {
  const bool isOne = parts_->parts.size() == 1 && parts_->leftOut.empty();
  for (const Part& part : parts_->parts) {
    Warnings own = part.warnings;
    if (part.file) part.file->report(own);
    for (const Warning& warning : own)
      warnings.push_back(isOne ? warning : warning.behind(nameOf(part) + ": "));
  }
  warnings.insert(warnings.end(), parts_->leftOut.begin(), parts_->leftOut.end());
  if (parts_->different > 0)
    warnings.push_back(
        {WarningCode::heights,
         fmt::format("{} different heights in several files, by up to {:.6g}: those of the file named "
                     "later count (the first of them: {})",
                     counted(parts_->different, "sample has", "samples have"), parts_->largestDifference,
                     parts_->differentFiles)});
}

}  // namespace arete
