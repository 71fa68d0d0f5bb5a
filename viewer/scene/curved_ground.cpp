// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the source by its CRS to longitude and latitude, by GeographicLib to a Cartesian frame that touches
// the ellipsoid, and turned about its vertical.
//
// How much the way from the flat metric space to this one bends is measured: its second derivatives on a grid
// over the DEM, by differences over a kilometre or more, where the rounding of a projection is nothing, in
// sixteen directions, and what is found largest is widened by a tenth. All maps in use bend evenly: over
// steps of a thirty-second of the DEM their bends change by far less.
#include "viewer/scene/curved_ground.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/mt/curved_mt.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "io/geo/crs/local_frame.h"
#include "io/geo/crs/lonlat.h"

namespace arete {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kWiden = 1.1;
constexpr const char* kCulprit = "the Earth's curvature";

/// Largest length of a quadratic form (or, without `xy` and with its halves, a linear one) over directions.
template <class Form>
double largestOver(const Form& form) {
  constexpr int kDirections = 16;
  double most = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = i * std::numbers::pi / kDirections;
    most = std::max(most, norm(form(std::cos(angle), std::sin(angle))));
  }
  return most;
}

tl::unexpected<Error> cameraIsBeyondTheCrs() {
  return failure(ErrorCode::usage, "the CRS of the DEM does not reach to where the camera stands", "camera");
}

}  // namespace

struct CurvedGround::State {
  const TerrainModel* model;
  CrsLonLat lonLat;
  LocalFrame frame;
  MetricFrame metric;                     // the model's
  Vec2 alongX = {1, 0}, alongY = {0, 1};  // of the local frame (east, north): the axes of this space
  double curvature = 0, turning = 0;      // engine/mt/curved_mt.h

  double exaggerated(double height, double stretch) const {
    return stretch == 1 ? height : metric.origin.z + (height - metric.origin.z) * stretch;
  }
  /// Longitude and latitude in degrees.
  Vec3 onEllipsoid(Vec2 lonLatDegrees, double height) const {
    const Vec3 p = frame.toLocal({lonLatDegrees.x, lonLatDegrees.y, height});
    return {p.x * alongX.x + p.y * alongX.y, p.x * alongY.x + p.y * alongY.y, p.z};
  }
  Vec3 position(Vec2 xy, double height) const {
    lonLat.toLonLat(std::span(&xy, 1));
    return onEllipsoid(xy, height);
  }
  Vec3 ofFlat(double x, double y, double z = 0) const {
    return position(
        model->toSource({x / metric.scale.x + metric.origin.x, y / metric.scale.y + metric.origin.y}),
        z / metric.scale.z + metric.origin.z);
  }
  Vec3 vertical(Vec2 xy, double height) const {
    constexpr double kSpan = 1000;  // units: far enough for the last bits not to matter
    return unit(position(xy, height + kSpan) - position(xy, height));
  }
  /// The map's directions at a place, levelled there: unit vectors, not finite where the CRS does not reach.
  struct Level {
    Vec3 up, east, north;
    bool isThere() const { return isFinite(up) && isFinite(east) && isFinite(north); }
  };
  Level level(Vec2 xy, double height) const {
    const Georeference& g = model->georeference;
    const double step = g.isGeographic ? 1e-4 * kRadians / g.angularUnitRadians : 10 / g.linearUnitMetres;
    const auto between = [&](double dx, double dy) {
      return position({xy.x + dx, xy.y + dy}, height) - position({xy.x - dx, xy.y - dy}, height);
    };
    const Vec3 up = vertical(xy, height);
    const auto levelled = [&](const Vec3& a) { return unit(a - dot(a, up) * up); };
    return {up, levelled(between(step, 0)), levelled(between(0, step))};
  }
  void turn();
  bool measure();
};

/// The x axis along the plan's, the y axis on the side of the plan's.
void CurvedGround::State::turn() {
  constexpr double kStep = 1000;
  const Vec3 x = ofFlat(kStep, 0) - ofFlat(-kStep, 0), y = ofFlat(0, kStep) - ofFlat(0, -kStep);
  if (!isFinite(x) || !isFinite(y)) return;  // measure() says so
  const double size = std::hypot(x.x, x.y);
  const double side = x.x * y.y - x.y * y.x < 0 ? -1 : 1;
  alongX = {x.x / size, x.y / size};
  alongY = {-side * alongX.y, side * alongX.x};
}

/// False when the CRS does not reach the DEM.
bool CurvedGround::State::measure() {
  Vec2 low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (std::uint32_t v = 0; v < model->mt.vertexCount(); ++v) {
    const Vec3 p = metric.toMetric(model->mt.position(VertexId(v)));
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // Steps are a kilometre or more, so that second differences are far larger than the rounding of the
  // projection.
  constexpr int kCells = 32;
  const double step = std::max({(high.x - low.x) / kCells, (high.y - low.y) / kCells, 1000.0});
  const int nx = int(std::ceil((high.x - low.x) / step)), ny = int(std::ceil((high.y - low.y) / step));
  std::vector<std::array<double, 2>> found(std::size_t(nx + 1) * std::size_t(ny + 1), {0, 0});
  parallelFor(0, ny + 1, [&](int j) {
    for (int i = 0; i <= nx; ++i) {
      const double x = low.x + i * (high.x - low.x) / std::max(nx, 1),
                   y = low.y + j * (high.y - low.y) / std::max(ny, 1);
      const auto at = [&](int dx, int dy) { return ofFlat(x + dx * step, y + dy * step); };
      const auto upAt = [&](int dx, int dy) {
        return unit(ofFlat(x + dx * step, y + dy * step, 1000) - at(dx, dy));
      };
      // Second differences along x, y and the diagonals give the bend in every direction. A place for which
      // the CRS gives no value is passed over.
      const Vec3 twice = -2 * at(0, 0);
      const Vec3 xx = at(1, 0) + at(-1, 0) + twice, yy = at(0, 1) + at(0, -1) + twice;
      const Vec3 xy = 0.25 * ((at(1, 1) + at(-1, -1)) - (at(1, -1) + at(-1, 1)));
      const Vec3 upX = upAt(1, 0) - upAt(-1, 0), upY = upAt(0, 1) - upAt(0, -1);
      if (!isFinite(xx) || !isFinite(yy) || !isFinite(xy) || !isFinite(upX) || !isFinite(upY)) continue;
      found[std::size_t(j) * std::size_t(nx + 1) + std::size_t(i)] = {
          largestOver([&](double c, double s) { return (c * c) * xx + (s * s) * yy + (2 * c * s) * xy; }) /
              (step * step),
          largestOver([&](double c, double s) { return c * upX + s * upY; }) / (2 * step)};
    }
  });
  for (const auto& f : found) {
    curvature = std::max(curvature, f[0] * kWiden);
    turning = std::max(turning, f[1] * kWiden);
  }
  return turning > 0;
}

// The frame touches the ellipsoid in the middle of the DEM, and turn() aligns it with the flat metric there.
Result<CurvedGround> CurvedGround::create(const TerrainModel& model) {
  Result<CrsLonLat> lonLat = CrsLonLat::of(model.georeference);
  if (!lonLat) return failure(lonLat.error().code, lonLat.error().message, kCulprit);
  const Georeference& g = model.georeference;
  const MetricFrame& metric = model.mt.metric();
  const auto outOfReach = [] {
    return failure(ErrorCode::invalidData, "the CRS tells no longitude and latitude of the middle of the DEM",
                   kCulprit);
  };
  Vec2 middle = model.toSource({metric.origin.x, metric.origin.y});
  lonLat->toLonLat(std::span(&middle, 1));
  if (!std::isfinite(middle.x) || !std::isfinite(middle.y)) return outOfReach();
  Result<LocalFrame> frame = LocalFrame::create({.origin = {middle.x, middle.y, metric.origin.z},
                                                 .isGeographic = true,
                                                 .verticalUnitMetres = g.verticalUnitMetres,
                                                 .semiMajorAxisMetres = g.semiMajorAxisMetres,
                                                 .inverseFlattening = g.inverseFlattening,
                                                 .middleLongitude = middle.x});
  if (!frame) return failure(frame.error().code, frame.error().message, kCulprit);
  auto state = std::make_shared<State>(State{&model, std::move(*lonLat), std::move(*frame), metric});
  state->turn();
  if (!state->measure()) return outOfReach();
  return CurvedGround(std::move(state));
}

CurvedGround::CurvedGround(std::shared_ptr<const State> state) : state_(std::move(state)) {}

Vec3 CurvedGround::position(Vec2 xy, double height, double stretch) const {
  return state_->position(xy, state_->exaggerated(height, stretch));
}

// This inverts position(): the turn about the vertical is undone first, then the frame, then the CRS and
// the exaggeration.
Vec3 CurvedGround::source(const Vec3& p, double stretch) const {
  const State& s = *state_;
  const Vec3 there =
      s.frame.toSource({p.x * s.alongX.x + p.y * s.alongY.x, p.x * s.alongX.y + p.y * s.alongY.y, p.z});
  Vec2 xy{there.x, there.y};
  s.lonLat.toCrs(std::span(&xy, 1));
  return {xy.x, xy.y, s.metric.origin.z + (there.z - s.metric.origin.z) / stretch};
}

Result<View> CurvedGround::viewOf(const Camera& camera, double stretch) const {
  const State& s = *state_;
  Result<View> view = arete::viewOf(camera, *s.model);  // for what it checks
  if (!view) return view;
  const double height = s.exaggerated(camera.height, stretch);
  const State::Level there = s.level(camera.xy, height);
  if (!there.isThere()) return cameraIsBeyondTheCrs();

  const double azimuth = camera.azimuthDegrees * kRadians, pitch = camera.pitchDegrees * kRadians;
  const Vec3 level = unit(std::sin(azimuth) * there.east + std::cos(azimuth) * there.north);
  view->eye = s.position(camera.xy, height);
  view->forward = std::cos(pitch) * level + std::sin(pitch) * there.up;
  view->up = -std::sin(pitch) * level + std::cos(pitch) * there.up;
  return view;
}

Result<Camera> CurvedGround::cameraAt(const Vec3& eye, const PictureAxes& axes, const Camera& picture,
                                      double stretch) const {
  const State& s = *state_;
  const Vec3 place = source(eye, stretch);
  Camera camera = picture;
  camera.xy = {place.x, place.y};
  camera.height = place.z;
  const State::Level there = s.level(camera.xy, s.exaggerated(camera.height, stretch));
  if (!isFinite(place) || !there.isThere()) return cameraIsBeyondTheCrs();
  const double rise = dot(axes.ahead, there.up);
  Vec3 along = axes.ahead - rise * there.up;
  double run = norm(along);
  constexpr double kUpright = 0.02;  // a degree or so
  if (run < kUpright) {
    const Vec3 top = (rise < 0 ? 1 : -1) * axes.up;
    along = unit(top - dot(top, there.up) * there.up);
    run = std::max(dot(axes.ahead, along), 0.0);
  }
  // The map's directions need not be at right angles.
  const double skew = dot(there.east, there.north), east = dot(along, there.east),
               north = dot(along, there.north);
  camera.azimuthDegrees = wrappedAzimuth(std::atan2(east - skew * north, north - skew * east) / kRadians);
  camera.pitchDegrees = std::atan2(rise, run) / kRadians;
  return camera;
}

Result<MultiTriangulation> CurvedGround::curvedMt(double stretch, const RunContext& context) const {
  const State& s = *state_;
  const MultiTriangulation& mt = s.model->mt;
  Bending bending;
  bending.plan.resize(mt.vertexCount());
  bending.heights.resize(mt.vertexCount());
  bending.flat = s.metric;
  bending.flat.scale.z *= stretch;
  bending.metric = {{}, {1, 1, bending.flat.scale.z}};
  bending.curvature = s.curvature;
  bending.turning = s.turning;
  std::atomic<bool> isWhole = true;
  constexpr std::uint32_t kAtOnce = 4096;
  withThreads(context, [&] {
    parallelFor(IndexRange<std::uint32_t>(0, mt.vertexCount(), kAtOnce), [&](const auto& range) {
      if (context.cancelled()) return;
      const std::span<Vec2> places = std::span(bending.plan).subspan(range.begin(), range.size());
      for (std::uint32_t v = range.begin(); v < range.end(); ++v)
        bending.plan[v] = s.model->toSource(mt.vertices().planPosition(VertexId(v)));
      s.lonLat.toLonLat(places);
      for (std::uint32_t v = range.begin(); v < range.end(); ++v) {
        const Vec3 p =
            s.onEllipsoid(bending.plan[v], s.exaggerated(mt.vertices().height(VertexId(v)), stretch));
        if (!isFinite(p)) isWhole = false;
        bending.plan[v] = {p.x, p.y};
        bending.heights[v] = p.z / bending.metric.scale.z;
      }
    });
  });
  if (context.cancelled())
    return failure(ErrorCode::interrupted, "bending the ground was interrupted", kCulprit);
  if (!isWhole)
    return failure(ErrorCode::invalidData, "parts of the DEM have no longitude and latitude in its CRS",
                   kCulprit);
  return curved(mt, std::move(bending));
}

double CurvedGround::radius() const {
  const State& s = *state_;
  const LocalFrameSpec& spec = s.frame.spec();
  const double f = spec.inverseFlattening == 0 ? 0 : 1 / spec.inverseFlattening,
               sine = std::sin(spec.origin.y * kRadians);
  const double e2 = f * (2 - f), w = 1 - e2 * sine * sine;
  // The square root of the product of both radii: a (1 - e2)^(1/2) / w.
  return spec.semiMajorAxisMetres * std::sqrt(1 - e2) / w;
}

}  // namespace arete
