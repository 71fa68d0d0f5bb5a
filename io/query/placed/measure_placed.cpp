// SPDX-License-Identifier: GPL-3.0-or-later
//
// In another CRS the samples become scattered points of that CRS, which measure() compares exactly. A frame
// of metres with straight axes is led back into the DEM's coordinates. In a frame that is tangent to the
// ellipsoid measure_metric.cpp follows the normal of each sample.
#include "io/query/placed/measure_placed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/geo/bent/place_map.h"
#include "io/geo/crs/local_frame.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/map_scale.h"
#include "io/geo/crs/names.h"
#include "io/query/placed/samples.h"

namespace arete {

using placed::PlacedSample;

namespace {

/// The samples that a TIN should have, and the NODATA that it should not.
struct DemSamples {
  std::vector<PlacedSample> all;
  std::size_t size = 0;       ///< of the DEM
  std::uint32_t columns = 0;  ///< of a raster; 0: points
  std::uint64_t counted = 0, isolated = 0;
  double domainAreaPixels = 0;
  Vec2 pixel{1, 1};  ///< the step between samples
};

bool isLeftOut(const MeasureOptions& options, std::size_t i) {
  return !options.mask.empty() && options.mask[i] == 0;
}

DemSamples samplesOf(const RasterHeightfield& dem, const MeasureOptions& options) {
  DemSamples found;
  found.size = dem.size();
  found.columns = dem.columns;
  const auto& g = dem.georeference.geoTransform;
  found.pixel = {std::max(std::abs(g[1]), std::abs(g[2])), std::max(std::abs(g[4]), std::abs(g[5]))};
  const auto validCorners = [&](std::int64_t c, std::int64_t r) {
    if (c < 0 || r < 0 || c + 1 >= dem.columns || r + 1 >= dem.rows) return 0;
    int valid = 0;
    for (const int dc : {0, 1})
      for (const int dr : {0, 1}) valid += dem.isValid(std::uint32_t(c + dc), std::uint32_t(r + dr));
    return valid;
  };
  for (std::uint32_t r = 0; r < dem.rows; ++r)
    for (std::uint32_t c = 0; c < dem.columns; ++c) {
      const int here = validCorners(c, r);
      if (here >= 3) found.domainAreaPixels += here == 4 ? 1 : 0.5;
      // The first column again is where the first is.
      if (dem.georeference.repeatsFirstColumn && c + 1 == dem.columns) continue;
      const std::size_t i = std::size_t(r) * dem.columns + c;
      if (isLeftOut(options, i)) continue;
      ++found.counted;
      if (dem.isValid(c, r) && here < 3 && validCorners(std::int64_t(c) - 1, r) < 3 &&
          validCorners(c, std::int64_t(r) - 1) < 3 &&
          validCorners(std::int64_t(c) - 1, std::int64_t(r) - 1) < 3) {
        ++found.isolated;
        continue;
      }
      found.all.push_back({.index = i, .source = dem.georeference.toSource(c, r), .height = dem.heights[i]});
    }
  return found;
}

DemSamples samplesOf(const PointHeightfield& points, const MeasureOptions& options) {
  DemSamples found;
  found.size = points.size();
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-low.x, -low.y};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (isLeftOut(options, i)) continue;
    const Vec2& p = points.positions[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    found.all.push_back({.index = i, .source = p, .height = points.heights[i]});
  }
  found.counted = found.all.size();
  const double n = std::sqrt(double(std::max<std::size_t>(found.all.size(), 1)));
  found.pixel = {(high.x - low.x) / n, (high.y - low.y) / n};
  return found;
}

/// Finds the TIN's heights in another CRS. Returns the TIN's report on the samples that a triangle holds.
Result<MeasureReport> findOnMap(const TriangleMesh& mesh, const TinPlace& place, const Georeference& dem,
                                DemSamples& samples, const RunContext& context) {
  std::vector<Vec3> places;
  places.reserve(samples.all.size());
  for (const PlacedSample& s : samples.all) places.push_back({s.source.x, s.source.y, 0});
  ARETE_TRY(const PlaceMap map, PlaceMap::of(dem, {.crs = place.crsWkt}, places, {}));
  map.apply(places);
  // The file and this map may have another whole turn of longitudes.
  if (const Result<Georeference> target = georeferenceOf(place.crsWkt, {});
      target && turnOf(*target) > 0 && !mesh.positions.empty() && !places.empty()) {
    const auto middle = [](const std::vector<Vec3>& all) {
      double west = std::numeric_limits<double>::infinity(), east = -west;
      for (const Vec3& p : all)
        if (std::isfinite(p.x)) {
          west = std::min(west, p.x);
          east = std::max(east, p.x);
        }
      return (west + east) / 2;
    };
    const double turn = turnOf(*target),
                 shift = turn * std::round((middle(mesh.positions) - middle(places)) / turn);
    if (std::isfinite(shift))
      for (Vec3& p : places) p.x += shift;
  }
  PointHeightfield valid, nodata;
  std::vector<std::size_t> sampleOf, nodataOf;
  std::vector<Vec2> plan(places.size());
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-low.x, -low.y};
  for (std::size_t i = 0; i < places.size(); ++i) {
    plan[i] = {places[i].x, places[i].y};
    if (!std::isfinite(plan[i].x) || !std::isfinite(plan[i].y)) {
      plan[i] = {std::numeric_limits<double>::quiet_NaN(), 0};
      continue;  // the CRS does not have it, so no triangle does
    }
    const bool isNodata = std::isnan(samples.all[i].height);
    (isNodata ? nodata : valid).positions.push_back(plan[i]);
    (isNodata ? nodata : valid).heights.push_back(isNodata ? 0 : samples.all[i].height);
    (isNodata ? nodataOf : sampleOf).push_back(i);
    low = {std::min(low.x, plan[i].x), std::min(low.y, plan[i].y)};
    high = {std::max(high.x, plan[i].x), std::max(high.y, plan[i].y)};
  }
  MeasureRasters rasters;
  ARETE_TRY(MeasureReport report, measure(mesh, valid, {}, context, &rasters));
  for (std::size_t i = 0; i < sampleOf.size(); ++i) samples.all[sampleOf[i]].tin = rasters.tinHeights[i];
  if (report.worst) {
    const std::size_t i = sampleOf[report.worst->sample];
    samples.all[i].triangle = report.worst->triangle;
  }
  if (!nodata.positions.empty()) {
    MeasureRasters inside;
    ARETE_TRY(const MeasureReport ignored, measure(mesh, nodata, {}, context, &inside));
    static_cast<void>(ignored);
    for (std::size_t i = 0; i < nodataOf.size(); ++i)
      samples.all[nodataOf[i]].holders = !std::isnan(inside.tinHeights[i]);
  }
  const double n = double(std::max<std::size_t>(samples.all.size(), 1));
  const double spacing =
      std::sqrt(std::max(high.x - low.x, 0.0)) * std::sqrt(std::max(high.y - low.y, 0.0) / n);
  const double most = kBeyondRimPixels * spacing;
  std::vector<Vec2> vertices;
  vertices.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) vertices.push_back({p.x, p.y});
  placed::coverBesideRim(samples.all, plan, placed::rimOf(mesh), vertices, {most, most}, 0, most,
                         [&](std::size_t i, const placed::RimSide& side) {
                           const Vec3 &a = mesh.positions[side.from], &b = mesh.positions[side.to];
                           return std::pair(Vec3{a.x - plan[i].x, a.y - plan[i].y, a.z},
                                            Vec3{b.x - plan[i].x, b.y - plan[i].y, b.z});
                         });
  return report;
}

/// Sums up what is known of the samples. The report has what belongs to the mesh.
void sumUp(const DemSamples& samples, MeasureReport& report, MeasureRasters* rasters) {
  report.samples = samples.counted;
  report.isolated = samples.isolated;
  report.valid = samples.isolated;
  report.covered = report.uncovered = report.nodataCovered = 0;
  report.maxAbsError = report.errorBeyondRounding = 0;
  report.worst.reset();
  report.domainAreaPixels = samples.domainAreaPixels;
  if (rasters) {
    rasters->tinHeights.assign(samples.size, std::numeric_limits<double>::quiet_NaN());
    rasters->errors = rasters->tinHeights;
  }
  double squares = 0, absolutes = 0, sum = 0;
  for (const PlacedSample& s : samples.all) {
    if (std::isnan(s.height)) {
      report.nodataCovered += s.holders > 0;
      continue;
    }
    ++report.valid;
    if (std::isnan(s.tin)) {
      ++report.uncovered;
      continue;
    }
    ++report.covered;
    const double error = s.tin - s.height;
    if (rasters) {
      rasters->tinHeights[s.index] = s.tin;
      rasters->errors[s.index] = error;
    }
    squares += error * error;
    absolutes += std::abs(error);
    sum += error;
    double highest = std::max(std::abs(s.height), std::abs(s.tin));
    constexpr double kUlps = 4 * std::numeric_limits<double>::epsilon();
    report.errorBeyondRounding = std::max(report.errorBeyondRounding, std::abs(error) - kUlps * highest);
    if (report.worst && std::abs(error) <= report.maxAbsError) continue;
    report.maxAbsError = std::abs(error);
    report.worst = MeasuredSample{.sample = s.index,
                                  .column = samples.columns ? std::uint32_t(s.index % samples.columns) : 0,
                                  .row = samples.columns ? std::uint32_t(s.index / samples.columns) : 0,
                                  .x = s.source.x,
                                  .y = s.source.y,
                                  .demHeight = s.height,
                                  .tinHeight = s.tin,
                                  .triangle = s.triangle};
  }
  const double n = report.covered > 0 ? double(report.covered) : 1;
  report.rmsError = std::sqrt(squares / n);
  report.meanAbsError = absolutes / n;
  report.meanError = sum / n;
}

template <class Heightfield>
Result<MeasureReport> measureThere(const TriangleMesh& mesh, const TinPlace& place, const Heightfield& dem,
                                   const MeasureOptions& options, const RunContext& context,
                                   MeasureRasters* rasters) {
  ARETE_CHECK(dem.validate());
  ARETE_CHECK(mesh.validate());
  if (!options.mask.empty() && options.mask.size() != dem.size())
    return failure(ErrorCode::usage, "has not one value for each sample", "mask");
  const Georeference& g = dem.georeference;
  if (place.metresAbout && !g.isGeographic) {
    // Straight axes: the TIN is led back, and all is as if it had never left.
    Georeference scaled = g;
    stateMapScale(scaled, {place.metresAbout->x, place.metresAbout->y});
    ARETE_TRY(const LocalFrame frame, LocalFrame::create(localFrameSpec(scaled, *place.metresAbout)));
    TriangleMesh back = mesh;
    for (Vec3& p : back.positions) p = frame.toSource(p);
    return measure(back, dem, options, context, rasters);
  }
  DemSamples samples = samplesOf(dem, options);
  MeasureReport report;
  if (place.metresAbout) {
    ARETE_TRY(const double area,
              placed::findInMetres(mesh, *place.metresAbout, g, samples.pixel, samples.all, context));
    report.triangles = mesh.triangles.size();
    report.vertices = mesh.positions.size();
    const double each = area / double(std::max<std::size_t>(samples.all.size(), 1));
    report.tinAreaPixels = each > 0 ? area / each : 0;
    for (const PlacedSample& s : samples.all)
      if (!std::isnan(s.height) && s.holders > 1) {
        ++report.doublyCovered;
        ++report.overlapped;
      }
  } else {
    ARETE_TRY(report, findOnMap(mesh, place, g, samples, context));
  }
  sumUp(samples, report, rasters);
  return report;
}

}  // namespace

bool isElsewhere(const TinPlace& place, const Georeference& dem) {
  if (place.metresAbout) return !dem.crsWkt.empty();
  return compareCrs(place.crsWkt, dem.crsWkt) == CrsAgreement::different;
}

Result<MeasureReport> measureElsewhere(const TriangleMesh& mesh, const TinPlace& place,
                                       const RasterHeightfield& dem, const MeasureOptions& options,
                                       const RunContext& context, MeasureRasters* rasters) try {
  return measureThere(mesh, place, dem, options, context, rasters);
} catch (...) {
  return caughtFailure();
}

Result<MeasureReport> measureElsewhere(const TriangleMesh& mesh, const TinPlace& place,
                                       const PointHeightfield& points, const MeasureOptions& options,
                                       const RunContext& context, MeasureRasters* rasters) try {
  return measureThere(mesh, place, points, options, context, rasters);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
