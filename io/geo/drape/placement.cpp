// SPDX-License-Identifier: GPL-3.0-or-later
//
// The image that is read has the axes of the terrain's plan coordinates, so that a scale and a shift map a
// plan position to a pixel. Its extent is probed from both sides, since either may fail: positions of the
// file transformed to the plan (undefined for parts of an image of half the globe), and positions of the plan
// transformed to the file (which miss a small image). Its resolution is the finest of the file anywhere on
// the terrain, per axis.
//
// If the rows and columns of a file are parallel to the axes of the plan, its own grid is kept and pixels are
// copied.
#include "io/geo/drape/placement.h"

#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdalwarper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/reader.h"
#include "io/geo/crs/transform.h"

namespace arete {
namespace {

constexpr int kProbes = 33;  // along a side

struct Box {
  double left = INFINITY, right = -INFINITY, low = INFINITY, high = -INFINITY;
  bool isEmpty() const { return !(left < right && low < high); }
  void add(Vec2 p) {
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  Box common(const Box& b) const {
    return {std::max(left, b.left), std::min(right, b.right), std::max(low, b.low), std::min(high, b.high)};
  }
  bool holds(Vec2 p) const { return left <= p.x && p.x <= right && low <= p.y && p.y <= high; }
  Vec2 at(double u, double v) const { return {left + u * (right - left), low + v * (high - low)}; }
};

std::string textOf(const Box& b) {
  return fmt::format("x {:.10g} to {:.10g}, y {:.10g} to {:.10g}", b.left, b.right, b.low, b.high);
}

/// Maps pixels of the file to plan positions and back.
class PictureToPlan {
 public:
  PictureToPlan(void* transformer, const TerrainModel& model)
      : transformer_(transformer), model_(model), turns_(model) {}
  std::optional<Vec2> toMap(Vec2 pixel) const { return transformed(pixel, false); }
  /// Where a plan position lies that is whole turns away from the terrain.
  Vec2 turned(Vec2 plan) const { return model_.toPlan(turns_(model_.toSource(plan))); }
  std::optional<Vec2> toPlan(Vec2 pixel) const {
    const auto map = toMap(pixel);
    return map ? std::optional(model_.toPlan(*map)) : std::nullopt;
  }
  std::optional<Vec2> toPixel(Vec2 plan) const { return transformed(model_.toSource(plan), true); }

 private:
  std::optional<Vec2> transformed(Vec2 p, bool isBack) const {
    double z = 0;
    int isKnown = 0;
    const GdalErrors quiet;
    if (!GDALGenImgProjTransform(transformer_, isBack, 1, &p.x, &p.y, &z, &isKnown) || !isKnown ||
        !std::isfinite(p.x) || !std::isfinite(p.y))
      return std::nullopt;
    return p;
  }
  void* transformer_;
  const TerrainModel& model_;
  LongitudeTurns turns_;
};

Box drapedBox(const TerrainModel& model) {
  if (model.isRaster) return {-0.5, model.columns - 0.5, -0.5, model.rows - 0.5};
  Box box;
  for (std::uint32_t v = 0; v < model.mt.vertexCount(); ++v) {
    const Vec3 p = model.mt.position(VertexId(v));
    box.add({p.x, p.y});
  }
  return box;
}

template <class Function>
void overGrid(const Function& at) {
  for (int i = 0; i < kProbes; ++i)
    for (int j = 0; j < kProbes; ++j) at(double(i) / (kProbes - 1), double(j) / (kProbes - 1));
}

/// The scale and shift from plan positions to the pixels of the file, if its axes are parallel to those of
/// the plan, in either direction.
std::optional<std::pair<Vec2, Vec2>> ownGrid(const PictureToPlan& way, double columns, double rows) {
  const auto a = way.toPlan({0, 0}), b = way.toPlan({columns, 0}), c = way.toPlan({0, rows}),
             d = way.toPlan({columns, rows});
  if (!a || !b || !c || !d) return std::nullopt;
  const Vec2 scale{columns / (b->x - a->x), rows / (c->y - a->y)};
  const auto isOff = [&](double dx, double dy) {
    return !(std::abs(dx * scale.x) < 0.01 && std::abs(dy * scale.y) < 0.01);
  };
  if (isOff(c->x - a->x, b->y - a->y) || isOff(d->x - b->x, d->y - c->y)) return std::nullopt;
  return std::pair(scale, Vec2{-a->x * scale.x, -a->y * scale.y});
}

/// The extents of the image and the terrain.
struct Extents {
  Box covered;  ///< by the image, in the plan
  Box pictureOnMap, terrainOnMap;

  tl::unexpected<Error> apart() const {
    return failure(
        ErrorCode::invalidData,
        fmt::format("does not overlap the DEM: it lies at {}, the DEM at {}, in the CRS of the DEM",
                    textOf(pictureOnMap), textOf(terrainOnMap)));
  }
};

bool isInside(Vec2 pixel, Vec2 size) {
  return pixel.x >= 0 && pixel.x <= size.x && pixel.y >= 0 && pixel.y <= size.y;
}

Extents extentsOf(const PictureToPlan& way, const TerrainModel& model, const Box& terrain, Vec2 size) {
  Extents extents;
  const auto add = [&](Vec2 plan) {
    extents.covered.add(plan);
    extents.pictureOnMap.add(model.toSource(plan));
  };
  overGrid([&](double u, double v) {
    if (const auto plan = way.toPlan({u * size.x, v * size.y})) {
      add(*plan);
      if (const Vec2 turned = way.turned(*plan); terrain.holds(turned)) add(turned);
    }
    const Vec2 place = terrain.at(u, v);
    extents.terrainOnMap.add(model.toSource(place));
    if (const auto pixel = way.toPixel(place); pixel && isInside(*pixel, size)) add(place);
  });
  return extents;
}

/// A placement before the number of pixels is limited.
struct Sized {
  DrapePlacement placement;
  double wide = 0, high = 0;
};

/// The pixels of the file over the box; nothing if there are none.
std::optional<Sized> onOwnGrid(const std::pair<Vec2, Vec2>& grid, const Box& box, Vec2 size) {
  const auto [scale, shift] = grid;
  const double a = box.left * scale.x + shift.x, b = box.right * scale.x + shift.x;
  const double c = box.low * scale.y + shift.y, d = box.high * scale.y + shift.y;
  const double slack = 1e-6;
  DrapePlacement p;
  p.window = {
      std::max(0.0, std::floor(std::min(a, b) + slack)), std::min(size.x, std::ceil(std::max(a, b) - slack)),
      std::max(0.0, std::floor(std::min(c, d) + slack)), std::min(size.y, std::ceil(std::max(c, d) - slack))};
  if (!(p.window[1] > p.window[0] && p.window[3] > p.window[2])) return std::nullopt;
  p.scale = scale;
  p.shift = {shift.x - p.window[0], shift.y - p.window[2]};
  p.isExact = true;
  return Sized{p, p.window[1] - p.window[0], p.window[3] - p.window[2]};
}

/// A grid along the axes of the plan over the box, as fine as the finest part of the file in it; nothing if
/// the file has no pixel there.
std::optional<Sized> onNewGrid(const PictureToPlan& way, const TerrainModel& model, const Box& terrain,
                               const Box& covered, Vec2 size) {
  Box window;
  Vec2 finest{0, 0};
  const Vec2 step{(covered.right - covered.left) / 1024, (covered.high - covered.low) / 1024};
  overGrid([&](double u, double v) {
    const Vec2 place = covered.at(u * 1023 / 1024, v * 1023 / 1024);
    const auto here = way.toPixel(place), right = way.toPixel({place.x + step.x, place.y}),
               below = way.toPixel({place.x, place.y + step.y});
    if (!here || !right || !below || !isInside(*here, size)) return;
    window.add(*here);
    finest.x = std::max(finest.x, std::hypot(right->x - here->x, right->y - here->y) / step.x);
    finest.y = std::max(finest.y, std::hypot(below->x - here->x, below->y - here->y) / step.y);
  });
  if (!(finest.x > 0 && finest.y > 0)) return std::nullopt;
  // Edges are curved between the probes.
  const Box box = Box{covered.left - 2 / finest.x, covered.right + 2 / finest.x, covered.low - 2 / finest.y,
                      covered.high + 2 / finest.y}
                      .common(terrain);
  DrapePlacement p;
  p.isWarped = true;
  // Rows run south: along the y of the plan for a raster, against it for points.
  p.scale = {finest.x, model.isRaster ? finest.y : -finest.y};
  p.shift = {-box.left * p.scale.x, -(model.isRaster ? box.low : box.high) * p.scale.y};
  p.window = {std::max(0.0, std::floor(window.left)), std::min(size.x, std::ceil(window.right) + 1),
              std::max(0.0, std::floor(window.low)), std::min(size.y, std::ceil(window.high) + 1)};
  return Sized{p, std::ceil((box.right - box.left) * finest.x), std::ceil((box.high - box.low) * finest.y)};
}

void makeCoarser(Sized& sized, double maxPixels) {
  DrapePlacement& p = sized.placement;
  p.coarser = std::sqrt(sized.wide * sized.high / maxPixels);
  p.isExact = false;
  p.scale = {p.scale.x / p.coarser, p.scale.y / p.coarser};
  p.shift = {p.shift.x / p.coarser, p.shift.y / p.coarser};
  sized.wide = std::max(1.0, std::floor(sized.wide / p.coarser));
  sized.high = std::max(1.0, std::floor(sized.high / p.coarser));
}

}  // namespace

void TransformerCloser::operator()(void* transformer) const {
  GDALDestroyTransformer(transformer);
}

Result<TransformerPtr> drapeTransformer(GDALDataset& picture, const TerrainModel& model, Warnings& warnings) {
  std::array<double, 6> transform{};
  // Without a geotransform, ground control points place the picture.
  const bool hasTransform = picture.GetGeoTransform(transform.data()) == CE_None;
  if (!hasTransform && picture.GetGCPCount() == 0)
    return failure(ErrorCode::invalidData,
                   picture.GetMetadata("RPC")
                       ? "has only RPC coefficients; gdalwarp -rpc with the DEM makes an orthophoto of it"
                       : "has no georeference (a geotransform, a world file or ground control points)");
  const OGRSpatialReference* own = hasTransform ? picture.GetSpatialRef() : picture.GetGCPSpatialRef();
  const std::string& dem = model.georeference.crsWkt;
  const bool hasOwn = own && !own->IsEmpty() && isKnownCrs(own);
  CPLStringList options;
  if (dem.empty()) {
    if (hasOwn)
      warnings.push_back(
          {WarningCode::position, "the DEM has no CRS: the coordinates of the image are taken as the DEM's"});
  } else if (!hasOwn) {
    return failure(ErrorCode::invalidData,
                   "has no CRS, and the DEM has one; gdal_translate -a_srs states it in a copy");
  } else {
    ARETE_TRY(const auto way, CrsTransform::between(wktOf(*own), dem));
    ARETE_TRY(auto target, crsFromText(dem));
    // Heights have no part in where a picture lies.
    target.StripVertical();
    if (!way.isIdentity()) options.SetNameValue("DST_SRS", wktOf(target).c_str());
  }
  const GdalErrors errors;
  TransformerPtr made(
      GDALCreateGenImgProjTransformer2(GDALDataset::ToHandle(&picture), nullptr, options.List()));
  if (!made)
    return failure(ErrorCode::invalidData,
                   fmt::format("cannot be mapped onto the DEM: {}", errors.firstFailure()));
  return made;
}

Result<DrapePlacement> placeDrape(GDALDataset& picture, void* transformer, const TerrainModel& model,
                                  std::uint64_t maxPixels) {
  const PictureToPlan way(transformer, model);
  const Vec2 size{double(picture.GetRasterXSize()), double(picture.GetRasterYSize())};
  const Box terrain = drapedBox(model);
  const Extents extents = extentsOf(way, model, terrain, size);
  if (extents.covered.isEmpty())
    return failure(ErrorCode::invalidData, "no part of it is in the domain of the CRS of the DEM");
  const Box box = extents.covered.common(terrain);
  if (box.isEmpty()) return extents.apart();

  const auto own = ownGrid(way, size.x, size.y);
  auto sized = own ? onOwnGrid(*own, box, size) : onNewGrid(way, model, terrain, box, size);
  if (!sized) return extents.apart();
  // Control points give no grid that could be kept, so their picture is warped.
  std::array<double, 6> ignored{};
  if (picture.GetGeoTransform(ignored.data()) != CE_None) sized->placement.isWarped = true;
  if (sized->wide * sized->high > double(maxPixels)) makeCoarser(*sized, double(maxPixels));
  constexpr double kMostSide = std::numeric_limits<int>::max();
  if (sized->wide > kMostSide || sized->high > kMostSide)
    return failure(ErrorCode::unsupported,
                   fmt::format("would be {} by {} pixels on the DEM", sized->wide, sized->high));
  sized->placement.columns = static_cast<std::uint32_t>(sized->wide);
  sized->placement.rows = static_cast<std::uint32_t>(sized->high);
  return sized->placement;
}

}  // namespace arete
