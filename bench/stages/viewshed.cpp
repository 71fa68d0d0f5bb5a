// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viewsheds of the whole DEM from eight places, 2 m above the ground, targets on the ground, the map's plane,
// on one thread; by turns: the sweep, gdal_viewshed (GDAL's own function, in memory) and one ray for each
// cell with Embree. What must be made once for a DEM (the samples from the model and their pyramid; a BVH) is
// stated by itself and is in the ratio, once for one viewshed. Rays of our own are timed on some rows, and
// so is it counted how many cells of each rival, and of the sweep, are not those of the rays.
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "bench/embree_rays.h"
#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "datasets/random.h"
#include "terrain/viewshed/exact.h"

namespace arete::bench {
namespace {

constexpr int kObservers = 8;
constexpr double kMetresUp = 2;
constexpr std::uint32_t kRaysCells = 200'000;  ///< about so many for each observer

std::vector<ViewshedObserver> observersOn(const SightGrid& grid, double unit) {
  Random random(3);
  std::vector<ViewshedObserver> observers;
  for (int tries = 0; int(observers.size()) < kObservers && tries < 10000; ++tries) {
    const Vec2 plan{double(random.below(grid.columns())), double(random.below(grid.rows()))};
    const double z = grid.at(plan);
    if (!std::isnan(z)) observers.push_back({plan, z + kMetresUp / unit});
  }
  return observers;
}

using Seen = std::vector<std::uint8_t>;

/// gdal_viewshed as a function, from memory to memory.
class GdalViewshed {
 public:
  explicit GdalViewshed(const TerrainModel& model, const SightGrid& grid)
      : unit_(model.georeference.verticalUnitMetres) {
    GDALAllRegister();
    GDALDriver* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
    columns_ = int(grid.columns());
    rows_ = int(grid.rows());
    dem_.reset(memory->Create("", columns_, rows_, 1, GDT_Float64, nullptr));
    georeference_ = model.georeference;
    dem_->SetGeoTransform(georeference_.geoTransform.data());
    GDALRasterBand* const band = dem_->GetRasterBand(1);
    band->SetNoDataValue(-32768);
    std::vector<double> row(grid.columns());
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < columns_; ++c) {
        const double z = grid.height(std::uint32_t(c), std::uint32_t(r));
        row[std::size_t(c)] = std::isnan(z) ? -32768 : z;
      }
      if (band->RasterIO(GF_Write, 0, r, columns_, 1, row.data(), columns_, 1, GDT_Float64, 0, 0, nullptr) !=
          CE_None)
        return;
    }
  }
  Seen viewshed(const ViewshedObserver& observer) const {
    const Vec2 at = georeference_.toSource(observer.plan.x, observer.plan.y);
    const GDALDatasetH made =
        GDALViewshedGenerate(dem_->GetRasterBand(1), "MEM", "", nullptr, at.x, at.y, kMetresUp / unit_, 0, 1,
                             0, 0, -1, 0, GVM_Edge, 0, nullptr, nullptr, GVOT_NORMAL, nullptr);
    Seen seen(std::size_t(columns_) * std::size_t(rows_));
    if (made == nullptr) return {};
    const CPLErr status = GDALRasterIO(GDALGetRasterBand(made, 1), GF_Read, 0, 0, columns_, rows_,
                                       seen.data(), columns_, rows_, GDT_Byte, 0, 0);
    GDALClose(made);
    return status == CE_None ? seen : Seen{};
  }

 private:
  struct Close {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
  };
  double unit_;
  int columns_ = 0, rows_ = 0;
  Georeference georeference_;
  std::unique_ptr<GDALDataset, Close> dem_;
};

struct Contestant {
  std::string name;
  double once = 0;  ///< seconds before the first viewshed
  std::function<Seen(const ViewshedObserver&)> viewshed;
  double seconds = 0;  ///< of all viewsheds
  std::uint64_t wrong = 0;
};

Seen seenOf(const Viewshed& viewshed) {
  Seen seen(viewshed.cells.size());
  std::transform(viewshed.cells.begin(), viewshed.cells.end(), seen.begin(),
                 [](ViewshedCell cell) { return cell == ViewshedCell::seen; });
  return seen;
}

}  // namespace

Result<Figures> viewshedStage(const DemSource& source, const std::string& path, const Plan& plan) {
  ARETE_TRY(const TerrainModel model, loadModel(path));
  const auto limit = limitTo(1);
  const double unit = model.georeference.verticalUnitMetres;
  const auto earth = makePlaneEarth(model);
  const Stopwatch making;
  const auto grid = std::make_shared<const SightGrid>(model);
  const double gridSeconds = making.seconds();
  ARETE_TRY(const auto maker, ViewshedMaker::make(model, *earth, grid, onThreads(1)));
  const double makingSeconds = making.seconds();
  const auto pyramid = makeSightPyramid(grid);
  // What is beyond NODATA is unknown, and the rivals look over it.
  ViewshedOptions options;
  options.nodata = NodataSight::clear;

  std::vector<Contestant> contestants;
  contestants.push_back({"sweep", makingSeconds, [&](const ViewshedObserver& from) {
                           const auto viewshed = maker.from(from, options, onThreads(1));
                           return viewshed ? seenOf(*viewshed) : Seen{};
                         }});
  const GdalViewshed gdal(model, *grid);
  contestants.push_back(
      {"gdal_viewshed", 0, [&](const ViewshedObserver& from) { return gdal.viewshed(from); }});
  std::vector<std::unique_ptr<EmbreeRays>> embree;
  for (const auto geometry : {EmbreeRays::Geometry::grid, EmbreeRays::Geometry::triangles}) {
    embree.push_back(EmbreeRays::make(*grid, *earth->planeSteps(), unit, geometry));
    const bool isGrid = geometry == EmbreeRays::Geometry::grid;
    contestants.push_back(
        {isGrid ? "Embree, grid" : "Embree, triangles", embree.back()->buildSeconds(),
         [rays = embree.back().get()](const ViewshedObserver& from) { return rays->viewshed(from); }});
  }

  const std::vector<ViewshedObserver> observers = observersOn(*grid, unit);
  const std::uint64_t cells = std::uint64_t{grid->columns()} * grid->rows();
  // Rays take long, so only some of the rows have them.
  const auto rowStep = std::max(1u, std::uint32_t(cells / kRaysCells));
  std::uint64_t compared = 0, seenCells = 0;
  double raysSeconds = 0;
  for (const ViewshedObserver& observer : observers) {
    std::vector<Seen> seen;
    for (Contestant& c : contestants) {
      seen.push_back(c.viewshed(observer));
      c.seconds += medianSeconds(plan.repetition, [&] { return c.viewshed(observer); });
      if (seen.back().empty()) return failure(ErrorCode::unreadable, "made no viewshed", c.name);
    }
    const ViewshedExact exact(*pyramid, *earth, unit, observer, options);
    for (std::uint32_t row = 0; row < grid->rows(); row += rowStep) {
      std::vector<bool> isSeen(grid->columns());
      const Stopwatch watch;
      for (std::uint32_t c = 0; c < grid->columns(); ++c)
        isSeen[c] = exact.at({double(c), double(row)}, grid->height(c, row))->cell == ViewshedCell::seen;
      raysSeconds += watch.seconds();
      for (std::uint32_t c = 0; c < grid->columns(); ++c) {
        // NODATA has no verdict that could be compared.
        if (std::isnan(grid->height(c, row))) continue;
        ++compared;
        seenCells += isSeen[c];
        for (std::size_t i = 0; i < contestants.size(); ++i)
          contestants[i].wrong += isSeen[c] != (seen[i][std::size_t{row} * grid->columns() + c] != 0);
      }
    }
  }

  Figures figures;
  const auto add = [&](const std::string& variant, const char* name, double value, const char* digits,
                       Better better) {
    figures.push_back({source.name, "viewshed", variant, name, value, digits, better});
  };
  const auto count = double(observers.size());
  double embreeSeconds = 0;
  for (const Contestant& c : contestants) {
    add(c.name, "once", c.once, "s", Better::lower);
    add(c.name, "time", c.seconds / count, "s", Better::lower);
    add(c.name, "wrong cells", 100 * double(c.wrong) / double(compared), "%", Better::lower);
    // The faster geometry of Embree's is the rival.
    const double all = c.once + c.seconds / count;
    if (c.name.starts_with("Embree") && (embreeSeconds == 0 || all < embreeSeconds)) embreeSeconds = all;
  }
  add("rays", "time", raysSeconds / count * rowStep, "s", Better::lower);
  add("seen cells", "share", 100 * double(seenCells) / double(compared), "%", Better::neither);
  add("sweep", "samples from the model", gridSeconds, "s", Better::lower);
  const Contestant& sweep = contestants[0];
  if (embreeSeconds > 0) {
    add("sweep", "times Embree, with what is made once", embreeSeconds / (sweep.once + sweep.seconds / count),
        "", Better::higher);
  }
  add("sweep", "times gdal_viewshed", contestants[1].seconds / sweep.seconds, "", Better::higher);
  return figures;
}

}  // namespace arete::bench
