// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chooses the method and prepares what it needs: for the sweep over geodesics, an azimuthal map of the
// observer, which may not exist.
#include "terrain/viewshed/viewshed.h"

#include <cmath>
#include <string>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/memory/required_memory.h"
#include "terrain/sight/earth.h"
#include "terrain/viewshed/image_plane.h"
#include "terrain/viewshed/methods.h"

namespace arete {
namespace {

/// What the samples, their pyramid and steepness, the answers and the raster of these take for each sample.
constexpr std::uint64_t kBytesOfSample = 26;

Status check(const ViewshedObserver& observer, const ViewshedOptions& options) {
  const auto bad = [](const char* what, const char* culprit) {
    return failure(ErrorCode::usage, what, culprit);
  };
  const ViewshedField& field = options.field;
  if (!std::isfinite(observer.plan.x + observer.plan.y + observer.height))
    return bad("must be finite", "observer");
  if (!(options.targetHeight >= 0 && std::isfinite(options.targetHeight)))
    return bad("must be 0 or more", "targetHeight");
  if (!(field.leastMetres >= 0 && field.leastMetres <= field.greatestMetres))
    return bad("the least distance must be 0 or more, the greatest no less", "field");
  if (!(std::isfinite(field.fromAzimuth) && field.azimuthSpan > 0))
    return bad("the azimuth must be finite, its span more than 0", "field");
  if (!(field.lowest >= -90 && field.lowest <= field.highest && field.highest <= 90))
    return bad("elevations must rise, from -90 degrees or more to 90 or less", "field");
  if (!(options.maxError >= 0 && std::isfinite(options.maxError)))
    return bad("must be 0 or more", "maxError");
  return {};
}

void countCells(Viewshed& result) {
  std::uint64_t counts[5] = {};
  for (const ViewshedCell cell : result.cells) ++counts[static_cast<int>(cell)];
  result.hidden = counts[0];
  result.seen = counts[1];
  result.unknown = counts[2];
  result.undecided = counts[3];
  result.outside = counts[4];
}

}  // namespace

std::uint8_t byteOf(ViewshedCell cell) {
  switch (cell) {
    case ViewshedCell::seen:
      return 255;
    case ViewshedCell::hidden:
      return 0;
    case ViewshedCell::unknown:
      return 100;
    case ViewshedCell::undecided:
      return 200;
    default:
      return 1;
  }
}

std::string_view toString(ViewshedMethod method) {
  switch (method) {
    case ViewshedMethod::sweep:
      return "sweep";
    case ViewshedMethod::rays:
      return "rays";
    default:
      return "automatic";
  }
}

Result<ViewshedMaker> ViewshedMaker::make(const TerrainModel& model, const SightEarth& earth,
                                          std::shared_ptr<const SightGrid> grid,
                                          const RunContext& context) try {
  if (!model.isRaster)
    return failure(ErrorCode::unsupported, "viewsheds are of rasters; this model is of points");
  requireMemory(std::uint64_t{model.columns} * model.rows * kBytesOfSample, "take a part of the terrain");
  ViewshedMaker maker(model, earth, grid ? std::move(grid) : std::make_shared<SightGrid>(model));
  ARETE_TRY(auto engine, makeSightEngine(SightMethod::pyramid, model, maker.grid_, context));
  maker.engine_ = std::move(engine);
  // Only the sweep over geodesics needs the steepness; it is of the grid, so all observers share it.
  if (!earth.planeSteps() && earth.geodesicError())
    maker.steepness_ = std::make_shared<const std::vector<float>>(viewshedSteepness(*maker.grid_, context));
  return maker;
} catch (...) {
  return caughtFailure();
}

Result<std::shared_ptr<const SightEngine>> ViewshedMaker::engineFor(const ViewshedOptions& options) const {
  if (!(options.maxError > 0)) return engine_;
  if (options.method == ViewshedMethod::sweep)
    return failure(ErrorCode::unsupported, "the sweep has no tolerance", "method");
  ARETE_TRY(auto engine, makeSightEngine(SightMethod::descent, *model_, grid_));
  return std::shared_ptr<const SightEngine>(std::move(engine));
}

Result<Viewshed> ViewshedMaker::from(const ViewshedObserver& observer, const ViewshedOptions& options,
                                     const RunContext& context) const try {
  ARETE_CHECK(check(observer, options));
  ARETE_TRY(const auto engine, engineFor(options));
  const bool hasTolerance = options.maxError > 0;
  const ViewshedObserver from{sightEnd(*model_, observer.plan), observer.height};
  // An observer that the Earth cannot place fails here, once, instead of at every cell.
  ARETE_CHECK(earth_->track(from.plan, from.plan));
  const ViewshedExact exact(*engine, *earth_, model_->georeference.verticalUnitMetres, from, options);
  static const std::vector<float> kNothing;
  const ViewshedTask task{
      *model_, *grid_, *earth_, from, options, exact, steepness_ ? *steepness_ : kNothing};
  Viewshed result;
  result.columns = grid_->columns();
  result.rows = grid_->rows();
  const std::size_t count = std::size_t{result.columns} * result.rows;
  result.cells.assign(count, ViewshedCell::outside);
  if (options.value != ViewshedValue::none)
    result.values.assign(count, std::numeric_limits<float>::quiet_NaN());
  // The conditions that need no map come first, because a map of geodesics takes time.
  std::optional<std::string> whyNot;
  if (hasTolerance) {
    whyNot = "it has no tolerance";
  } else if (options.method != ViewshedMethod::rays) {
    whyNot = whyNotSweep(task, nullptr);
  }
  std::optional<AzimuthalMap> map;
  if (!hasTolerance && options.method != ViewshedMethod::rays && !whyNot && !earth_->planeSteps()) {
    auto made = AzimuthalMap::make(*earth_, from.plan, grid_->columns(), grid_->rows(), context);
    if (made) {
      map = std::move(*made);
      whyNot = whyNotSweep(task, &*map);
    } else {
      whyNot = made.error();
    }
  }
  // The automatic method falls back to rays; a sweep that was asked for fails with the reason.
  if (options.method == ViewshedMethod::sweep && whyNot)
    return failure(ErrorCode::unsupported, "the sweep is not possible: " + *whyNot, "method");
  result.method =
      options.method == ViewshedMethod::rays || whyNot ? ViewshedMethod::rays : ViewshedMethod::sweep;
  context.report("viewshed", 0);
  ARETE_CHECK(result.method == ViewshedMethod::sweep
                  ? viewshedSweep(task, map ? &*map : nullptr, context, result)
                  : viewshedRays(task, context, result));
  context.report("viewshed", 1);
  countCells(result);
  result.withoutLine = exact.withoutLine();
  return result;
} catch (...) {
  return caughtFailure();
}

Result<Viewshed> ViewshedMaker::of(std::span<const Vec2> places, const ViewshedObserver& observer,
                                   const ViewshedOptions& options, const RunContext& context) const try {
  ARETE_CHECK(check(observer, options));
  if (options.method == ViewshedMethod::sweep)
    return failure(ErrorCode::unsupported, "the sweep is of the grid of the DEM, not of places", "method");
  ARETE_TRY(const auto engine, engineFor(options));
  const ViewshedObserver from{sightEnd(*model_, observer.plan), observer.height};
  ARETE_CHECK(earth_->track(from.plan, from.plan));
  const ViewshedExact exact(*engine, *earth_, model_->georeference.verticalUnitMetres, from, options);
  std::vector<Vec2> targets(places.begin(), places.end());
  for (Vec2& place : targets) place = sightEnd(*model_, place);
  // The result is one row with a cell for each place.
  Viewshed result;
  result.columns = static_cast<std::uint32_t>(places.size());
  result.rows = 1;
  result.cells.assign(places.size(), ViewshedCell::outside);
  if (options.value != ViewshedValue::none)
    result.values.assign(places.size(), std::numeric_limits<float>::quiet_NaN());
  context.report("viewshed", 0);
  ARETE_CHECK(viewshedOfPlaces(exact, *grid_, targets, context, result));
  context.report("viewshed", 1);
  countCells(result);
  result.rays = places.size() - result.outside;
  result.withoutLine = exact.withoutLine();
  return result;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
