// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL maps the image onto the terrain: a virtual raster with the grid of io/geo/drape/placement.h, computed
// block by block when it is read, with an alpha band for pixels that are missing.
#include "io/geo/drape/reader.h"

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdalwarper.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/geo/drape/placement.h"
#include "io/geo/drape/source.h"
#include "io/geo/drape/turned_picture.h"

namespace arete {
namespace {

struct Range {
  double low = 0, high = 255;
};

struct WarpOptionsCloser {
  void operator()(GDALWarpOptions* options) const { GDALDestroyWarpOptions(options); }
};

/// The range from the 2nd to the 98th percentile of about a million values spread over the window.
Result<Range> stretchOf(GDALRasterBand& band, const std::array<double, 4>& window) {
  constexpr int kSide = 1024;
  const int column = int(window[0]), row = int(window[2]);
  const int columns = std::max(1, int(window[1]) - column), rows = std::max(1, int(window[3]) - row);
  const int across = std::min(kSide, columns), down = std::min(kSide, rows);
  std::vector<float> values(std::size_t(across) * std::size_t(down));
  std::vector<std::uint8_t> valid(values.size());
  const GdalErrors errors;
  if (band.RasterIO(GF_Read, column, row, columns, rows, values.data(), across, down, GDT_Float32, 0, 0,
                    nullptr) != CE_None ||
      band.GetMaskBand()->RasterIO(GF_Read, column, row, columns, rows, valid.data(), across, down, GDT_Byte,
                                   0, 0, nullptr) != CE_None)
    return failure(ErrorCode::unreadable,
                   fmt::format("band {} cannot be read: {}", band.GetBand(), errors.firstFailure()));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (valid[i] != 0 && std::isfinite(values[i])) values[kept++] = values[i];
  if (kept == 0) return Range{};
  values.resize(kept);
  const auto at = [&](double part) {
    const auto nth = values.begin() + std::ptrdiff_t(part * double(kept - 1));
    std::nth_element(values.begin(), nth, values.end());
    return double(*nth);
  };
  Range range{at(0.02), at(0.98)};
  if (!(range.high > range.low)) range = {at(0), at(1)};
  if (!(range.high > range.low)) range = {range.low - 1, range.high + 1};
  return range;
}

/// GDAL's approximate transformer tests the middle of a row alone, and a deviation to both sides of it would
/// pass. It is given short pieces of the row, which no map bends to both sides.
int transformPieces(void* approximation, int isBack, int count, double* x, double* y, double* z,
                    int* isKnown) {
  constexpr int kPiece = 64;
  int isDone = TRUE;
  for (int begin = 0; begin < count; begin += kPiece)
    if (!GDALApproxTransform(approximation, isBack, std::min(kPiece, count - begin), x + begin, y + begin,
                             z + begin, isKnown + begin))
      isDone = FALSE;
  return isDone;
}

/// The image on the grid of the placement, as a virtual raster that owns the transformer.
GdalDatasetPtr warped(const DrapeSource& source, TransformerPtr transformer, const DrapePlacement& p,
                      const TerrainModel& model) {
  GDALDataset& dataset = source.dataset();
  const auto corner = [&](double column, double row) {
    return model.toSource({(column - p.shift.x) / p.scale.x, (row - p.shift.y) / p.scale.y});
  };
  const Vec2 o = corner(0, 0), e = corner(p.columns, 0), s = corner(0, p.rows);
  std::array<double, 6> transform = {o.x, (e.x - o.x) / p.columns, (s.x - o.x) / p.rows,
                                     o.y, (e.y - o.y) / p.columns, (s.y - o.y) / p.rows};
  void* way = transformer.get();
  GDALSetGenImgProjTransformerDstGeoTransform(way, transform.data());

  const std::unique_ptr<GDALWarpOptions, WarpOptionsCloser> w(GDALCreateWarpOptions());
  w->eResampleAlg = p.isExact              ? GRA_NearestNeighbour
                    : !source.readsNumbers ? GRA_Bilinear
                    : p.coarser > 1        ? GRA_Mode
                                           : GRA_NearestNeighbour;
  w->hSrcDS = GDALDataset::ToHandle(&dataset);
  const int bands = int(source.colors.size());
  w->nBandCount = bands;
  w->panSrcBands = static_cast<int*>(CPLMalloc(sizeof(int) * source.colors.size()));
  w->panDstBands = static_cast<int*>(CPLMalloc(sizeof(int) * source.colors.size()));
  w->nSrcAlphaBand = source.alpha;
  w->nDstAlphaBand = bands + 1;
  int withNodata = 0;
  std::vector<double> nodata(source.colors.size());
  for (int i = 0; i < bands; ++i) {
    w->panSrcBands[i] = source.colors[std::size_t(i)];
    w->panDstBands[i] = i + 1;
    int isDeclared = 0;
    nodata[std::size_t(i)] =
        dataset.GetRasterBand(source.colors[std::size_t(i)])->GetNoDataValue(&isDeclared);
    withNodata += isDeclared ? 1 : 0;
  }
  CPLStringList extra(CSLDuplicate(w->papszWarpOptions), true);
  extra.SetNameValue("INIT_DEST", "0");
  if (withNodata == bands && source.alpha == 0) {
    GDALWarpInitSrcNoDataReal(w.get(), 0);
    std::ranges::copy(nodata, w->padfSrcNoDataReal);
    extra.SetNameValue("UNIFIED_SRC_NODATA", "YES");
  }
  if (source.alpha != 0) {
    const GDALDataType type = dataset.GetRasterBand(source.alpha)->GetRasterDataType();
    if (type == GDT_UInt16) extra.SetNameValue("SRC_ALPHA_MAX", "65535");
    if (type == GDT_Int16) extra.SetNameValue("SRC_ALPHA_MAX", "32767");
  }
  extra.SetNameValue("DST_ALPHA_MAX", "255");
  // GDAL estimates the scale of each block by itself, wrongly if the image is rotated, which gives seams.
  const double kept = std::min(1.0, source.coarser / p.coarser);
  extra.SetNameValue("XSCALE", fmt::format("{}", kept).c_str());
  extra.SetNameValue("YSCALE", fmt::format("{}", kept).c_str());
  CSLDestroy(w->papszWarpOptions);
  w->papszWarpOptions = extra.StealList();
  constexpr double kLargestError = 0.125;  // pixels
  if (p.isWarped) {
    w->pTransformerArg = GDALCreateApproxTransformer(GDALGenImgProjTransform, way, kLargestError);
    w->pfnTransformer = transformPieces;
    GDALApproxTransformerOwnsSubtransformer(w->pTransformerArg, TRUE);
  } else {
    w->pTransformerArg = way;
    w->pfnTransformer = GDALGenImgProjTransform;
  }
  std::ignore = transformer.release();  // owned by the warp now
  GDALDatasetH made = GDALCreateWarpedVRT(w->hSrcDS, int(p.columns), int(p.rows), transform.data(), w.get());
  if (!made) GDALDestroyTransformer(w->pTransformerArg);
  return GdalDatasetPtr(GDALDataset::FromHandle(made));
}

}  // namespace

struct DrapeReader::State {
  std::string path;
  DrapeSource source;
  GdalDatasetPtr picture;  // derived from the source: destroyed first
  DrapePlacement placement;
  std::vector<Range> ranges;
  Warnings warnings;
  std::vector<float> values;
};

DrapeReader::DrapeReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
DrapeReader::DrapeReader(DrapeReader&&) noexcept = default;
DrapeReader& DrapeReader::operator=(DrapeReader&&) noexcept = default;
DrapeReader::~DrapeReader() = default;

Result<DrapeReader> DrapeReader::open(const std::string& path, const TerrainModel& model,
                                      const DrapeReadOptions& options, const RunContext& context) try {
  const auto named = [&](const Error& e) {
    return failure(e.code, e.message, e.culprit.empty() ? path : e.culprit);
  };
  auto state = std::make_unique<State>();
  State& s = *state;
  s.path = path;
  context.report("placing the picture", 0);
  Result<DrapeSource> source = openDrapeSource(path, options.bands, s.warnings);
  if (!source) return named(source.error());
  s.source = std::move(*source);
  if (!s.source.classes.empty()) s.source.readNumbers();
  s.source.turned = turnedOnto(s.source.dataset(), model, s.warnings);
  Result<TransformerPtr> way = drapeTransformer(s.source.dataset(), model, s.warnings);
  if (!way) return named(way.error());
  const auto placement =
      placeDrape(s.source.dataset(), way->get(), model, std::max<std::uint64_t>(1, options.maxPixels));
  if (!placement) return named(placement.error());
  s.placement = *placement;
  if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was stopped", path);

  // A stretched picture takes its range from the window over the terrain, not from all of its values.
  if (s.source.isStretched && !s.source.readsNumbers)
    for (const int b : s.source.colors) {
      const auto range = stretchOf(*s.source.dataset().GetRasterBand(b), s.placement.window);
      if (!range) return named(range.error());
      s.ranges.push_back(*range);
    }
  if (s.placement.coarser > 1) {
    s.warnings.push_back(
        {WarningCode::choice,
         fmt::format("is read at a coarser resolution, {:.2f} times its pixel size, as {} x {} pixels: at "
                     "most {} are read",
                     s.placement.coarser, s.placement.columns, s.placement.rows, options.maxPixels)});
    // The transformer and the turned picture belong to the source, so they go before it moves.
    way->reset();
    s.source.turned.reset();
    Result<DrapeSource> smaller = openDrapeOverview(path, std::move(s.source), s.placement.coarser);
    if (!smaller) return named(smaller.error());
    s.source = std::move(*smaller);
    // These warnings repeat the first opening's and are dropped.
    Warnings said;
    s.source.turned = turnedOnto(s.source.dataset(), model, said);
    way = drapeTransformer(s.source.dataset(), model, said);
    if (!way) return named(way.error());
  }
  GdalErrors errors;
  s.picture = warped(s.source, std::move(*way), s.placement, model);
  if (!s.picture)
    return failure(ErrorCode::unreadable,
                   fmt::format("cannot be mapped onto the DEM: {}", errors.firstFailure()), path);
  return DrapeReader(std::move(state));
} catch (...) {
  return caughtFailure();
}

std::uint32_t DrapeReader::columns() const {
  return state_->placement.columns;
}
std::uint32_t DrapeReader::rows() const {
  return state_->placement.rows;
}
Vec2 DrapeReader::scale() const {
  return state_->placement.scale;
}
Vec2 DrapeReader::shift() const {
  return state_->placement.shift;
}
bool DrapeReader::hasClasses() const {
  return state_->source.readsNumbers;
}
const Warnings& DrapeReader::warnings() const {
  return state_->warnings;
}

Status DrapeReader::read(std::uint32_t column, std::uint32_t row, std::uint32_t width, std::uint32_t height,
                         std::span<Pixel> pixels) try {
  State& s = *state_;
  const std::size_t count = std::size_t(width) * height, colors = s.source.colors.size();
  // A band goes straight to its place among interleaved pixels, which are `step` bytes apart.
  const auto transfer = [&](std::size_t band, void* into, GDALDataType type, GSpacing step) -> Status {
    const GdalErrors errors;
    if (s.picture->GetRasterBand(int(band) + 1)
            ->RasterIO(GF_Read, int(column), int(row), int(width), int(height), into, int(width), int(height),
                       type, step, step * GSpacing(width), nullptr) == CE_None)
      return {};
    return failure(ErrorCode::unreadable, fmt::format("cannot be read: {}", errors.firstFailure()), s.path);
  };
  if (s.source.readsNumbers) {
    s.values.resize(count);
    ARETE_CHECK(transfer(0, s.values.data(), GDT_Float32, sizeof(float)));
    ARETE_CHECK(transfer(1, &pixels[0][3], GDT_Byte, sizeof(Pixel)));
    for (std::size_t i = 0; i < count; ++i) {
      const float number = s.values[i];
      const bool isClass = pixels[i][3] >= 128 && number >= 0 && number < float(s.source.classes.size());
      Pixel& p = pixels[i] = isClass ? s.source.classes[std::size_t(number)] : Pixel{};
      for (std::size_t c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>((p[c] * p[3] + 127) / 255);
    }
    return {};
  }
  for (std::size_t b = 0; b < colors; ++b) {
    if (!s.source.isStretched) {
      ARETE_CHECK(transfer(b, &pixels[0][b], GDT_Byte, sizeof(Pixel)));
      continue;
    }
    s.values.resize(count);
    ARETE_CHECK(transfer(b, s.values.data(), GDT_Float32, sizeof(float)));
    const Range range = s.ranges[b];
    for (std::size_t i = 0; i < count; ++i) {
      const double part = (double(s.values[i]) - range.low) / (range.high - range.low);
      pixels[i][b] = part > 0 ? static_cast<std::uint8_t>(std::lround(255 * std::min(1.0, part))) : 0;
    }
  }
  ARETE_CHECK(transfer(colors, &pixels[0][3], GDT_Byte, sizeof(Pixel)));
  // With one colour the picture is grey. Colours are premultiplied by alpha, which opaque pixels do not need.
  for (Pixel& p : pixels.first(count)) {
    if (colors == 1) p[1] = p[2] = p[0];
    if (p[3] == 255) continue;
    for (std::size_t c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>((p[c] * p[3] + 127) / 255);
  }
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
