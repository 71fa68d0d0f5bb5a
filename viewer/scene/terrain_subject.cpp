// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picked ray is cut to the box of the terrain. The rest is a straight line in the plan, along which a
// profile at full resolution has every edge that it crosses; height above the terrain is linear between two
// of them, so its first change of sign is the intersection.
//
// A home view of the curved Earth is found over the same points of the terrain as that of the flat map, where
// they lie on the ellipsoid.
#include "viewer/scene/terrain_subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "viewer/camera/round_flight.h"

namespace arete {
namespace {

constexpr double kMostTilt = 5;  // degrees

struct Stretch {
  double from = 0, to = INFINITY;
};

/// The part of the ray in the box, in lengths of its direction.
std::optional<Stretch> within(const MetricBox& box, const Vec3& eye, const Vec3& d) {
  Stretch part;
  const std::array<double, 3> e{eye.x, eye.y, eye.z}, along{d.x, d.y, d.z};
  const std::array<double, 3> low{box.low.x, box.low.y, box.low.z}, high{box.high.x, box.high.y, box.high.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (along[i] == 0) {
      if (e[i] < low[i] || e[i] > high[i]) return std::nullopt;
      continue;
    }
    const double a = (low[i] - e[i]) / along[i], b = (high[i] - e[i]) / along[i];
    part.from = std::max(part.from, std::min(a, b));
    part.to = std::min(part.to, std::max(a, b));
  }
  if (!(part.from <= part.to) || !std::isfinite(part.to)) return std::nullopt;
  return part;
}

}  // namespace

TerrainSubject::TerrainSubject(const TerrainModel& model)
    : Subject(CameraSpace(model), metricBox(model)),
      model_(model),
      profiles_(model),
      rayBox_(box_),
      plane_(makePlaneEarth(model)) {
  // What lies on the box's own sides is in it after rounding, too.
  const double margin = 1e-9 * box_.diagonal();
  rayBox_.low = box_.low - Vec3{margin, margin, margin};
  rayBox_.high = box_.high + Vec3{margin, margin, margin};
}

Result<const CurvedGround*> TerrainSubject::curvedGround() const {
  if (!ground_) {
    ARETE_TRY(CurvedGround made, CurvedGround::create(model_));
    ground_ = std::move(made);
  }
  return &*ground_;
}

const CurvedGround* TerrainSubject::groundOf(const ViewSettings& settings) const {
  return settings.isCurved && curvedGround() ? &*ground_ : nullptr;
}

std::span<const Coloring> TerrainSubject::colorings() const {
  static constexpr std::array kColorings = {Coloring::height, Coloring::slope, Coloring::aspect,
                                            Coloring::plain, Coloring::error};
  return kColorings;
}

Status TerrainSubject::check(const ViewSettings& settings) const {
  ARETE_CHECK(checkColoring(settings.look.coloring));
  if (settings.isCurved) ARETE_CHECK(curvedGround());
  return {};
}

// On a flat map the device multiplies heights when it draws, so only the eye is raised here.
Result<View> TerrainSubject::viewOf(const Camera& camera, const ViewSettings& settings) const {
  if (settings.isCurved) {
    if (camera.parallelHeight > 0)
      return failure(ErrorCode::usage, "a curved Earth is drawn in perspective", "camera");
    ARETE_TRY(const CurvedGround* const ground, curvedGround());
    return ground->viewOf(camera, settings.stretch);
  }
  ARETE_TRY(View view, arete::viewOf(camera, model_));
  view.eye.z *= settings.stretch;
  return view;
}

Vec3 TerrainSubject::drawn(const Vec3& metric, const ViewSettings& settings) const {
  if (const CurvedGround* const ground = groundOf(settings))
    return ground->position(space_.xy(metric), space_.height(metric), settings.stretch);
  return {metric.x, metric.y, metric.z * settings.stretch};
}

Camera TerrainSubject::home(HomeView view, const Camera& picture, const ViewSettings& settings,
                            const CoveredEdges& covered) const {
  if (!shape_) shape_ = homeShape(model_);
  const CurvedGround* const ground = groundOf(settings);
  if (!ground) return homeCamera(view, space_, *shape_, picture, settings.stretch, covered);
  std::vector<Vec3> points;
  for (const Vec3& flat : shape_->points)
    if (const Vec3 p = drawn(flat, settings); std::isfinite(p.x + p.y + p.z)) points.push_back(p);
  Look home = homeLook(view);
  if (view == HomeView::overview && !points.empty())
    home = filling(
        home, points, [&](Look look) { return axesOf(space_, look); }, picture, covered);
  for (double tilt = 0; tilt <= kMostTilt && !points.empty(); ++tilt) {
    Look look = home;
    look.pitchDegrees = std::max(look.pitchDegrees - tilt, -90.0);
    const PictureAxes axes = axesOf(space_, look);
    const auto camera =
        ground->cameraAt(eyeOnAll(points, axes, picture, covered), axes, picture, settings.stretch);
    if (camera) return *camera;
  }
  return homeCamera(view, space_, *shape_, picture, settings.stretch, covered);
}

SubjectFacts TerrainSubject::facts() const {
  return {model_.mt.vertexCount(), model_.mt.finestTriangleCount(), 0, model_.mt.largestError()};
}

Result<FlightPlan> TerrainSubject::round(const Camera&) const {
  return roundFlight(profiles_.heights(), space_, box_);
}

Vec3 TerrainSubject::inFile(const Vec3& metric) const {
  const Vec2 xy = space_.xy(metric);
  return {xy.x, xy.y, space_.height(metric)};
}

// The ray says where; the height there is the terrain's own. On the rim of NODATA rounding may have carried
// the place off the terrain: then it is taken a little further along the triangle that was hit.
std::optional<Pick> TerrainSubject::pickOf(const Vec3& hit, const Vec3& inside, const Vec3& eye) const {
  for (const double step : {0.0, 1e-9, 1e-6, 1e-3}) {
    const Vec2 xy = space_.xy(hit + step * (inside - hit));
    const auto ground = profiles_.heights().at(xy);
    if (!ground) continue;
    const Vec3 metric = space_.position(xy, ground->height);
    Pick pick{.plan = model_.toPlan(xy), .xy = xy, .height = ground->height, .metric = metric};
    pick.metres = norm(metric - eye);
    pick.inObject = {xy.x, xy.y, ground->height};
    return pick;
  }
  return std::nullopt;
}

std::optional<Pick> TerrainSubject::along(const Vec3& eye, const Vec3& direction) const {
  const auto part = within(rayBox_, eye, direction);
  if (!part) return std::nullopt;
  return between(eye + part->from * direction, eye + part->to * direction, eye);
}

std::optional<Pick> TerrainSubject::between(const Vec3& first, const Vec3& last, const Vec3& eye) const {
  const Vec2 from = model_.toPlan(space_.xy(first)), to = model_.toPlan(space_.xy(last));
  const Vec2 way{to.x - from.x, to.y - from.y};
  const double length2 = way.x * way.x + way.y * way.y;
  if (length2 < 1e-12) {  // straight down, or up
    const auto ground = profiles_.heights().at(space_.xy(first));
    if (!ground) return std::nullopt;
    const Vec3 hit = space_.position(space_.xy(first), ground->height);
    const bool isBetween = (hit.z - first.z) * (hit.z - last.z) <= 0;
    return isBetween ? pickOf(hit, hit, eye) : std::nullopt;
  }
  const auto track = plane_->track(from, to);
  if (!track) return std::nullopt;
  const Profile profile = profiles_.along(*track);
  double before = 0, clearanceBefore = 0;
  for (std::size_t i = 0; i < profile.vertices.size(); ++i) {
    const ProfileVertex& v = profile.vertices[i];
    const double t = ((v.plan.x - from.x) * way.x + (v.plan.y - from.y) * way.y) / length2;
    const double ground = space_.position(model_.toSource(v.plan), v.height).z;
    const double clearance = first.z + t * (last.z - first.z) - ground;
    const bool isJoined = i > 0 && v.isJoined;
    if (clearance == 0 || (isJoined && (clearance > 0) != (clearanceBefore > 0))) {
      const double at = isJoined && clearance != clearanceBefore
                            ? before + (t - before) * (clearanceBefore / (clearanceBefore - clearance))
                            : t;
      const Vec3 ray = last - first;
      const double middle = isJoined ? (before + t) / 2 : at;
      if (const auto pick = pickOf(first + at * ray, first + middle * ray, eye)) return pick;
    }
    before = t;
    clearanceBefore = clearance;
  }
  return std::nullopt;
}

// Heights as they are, not as they are drawn.
Vec3 TerrainSubject::originOf(const View& view, Vec2 pixel, const ViewSettings& settings) const {
  Vec3 origin = originOfPixel(view, space_.isMirrored(), pixel, depthReach(view, *this, settings));
  origin.z /= settings.stretch;
  return origin;
}

std::optional<Pick> TerrainSubject::pick(const Camera& camera, Vec2 pixel,
                                         const ViewSettings& settings) const {
  const Result<View> view = viewOf(camera, settings);
  if (!view) return std::nullopt;
  auto found = settings.isCurved ? pickCurved(*view, pixel, camera, settings.stretch)
                                 : pickFlat(*view, pixel, camera, settings);
  if (found) found->depth = dot(drawn(found->metric, settings) - view->eye, view->forward);
  return found;
}

std::optional<Pick> TerrainSubject::pickFlat(const View& view, Vec2 pixel, const Camera& camera,
                                             const ViewSettings& settings) const {
  Vec3 direction = directionOfPixel(view, space_.isMirrored(), pixel);
  direction.z /= settings.stretch;
  auto found = along(originOf(view, pixel, settings), direction);
  if (found) found->metres = norm(found->metric - space_.position(camera));
  return found;
}

// The triangle of a cut there is one of those over the place, from the coarsest that the error allows down to
// the finest. What the model stores as the error is at samples; the signed bounds hold between them as well.
double TerrainSubject::boundAt(const Pick& pick, double allowed) const {
  const TriangleLocator& locator = profiles_.heights().locator();
  double bound = 0;
  auto t = locator.inRoot(pick.plan);
  for (; t && !locator.isFinest(*t); t = locator.finer(*t, pick.plan))
    if (model_.mt.error(t->triangle) <= allowed)
      bound =
          std::max({bound, model_.mt.decoded(kAbove, t->triangle), model_.mt.decoded(kBelow, t->triangle)});
  // Of a part of a model the finest triangle there may stand for finer ones.
  if (t && model_.mt.isRemoverMissing(t->triangle))
    bound = std::max({bound, model_.mt.decoded(kAbove, t->triangle), model_.mt.decoded(kBelow, t->triangle)});
  return bound;
}

// A ray that meets the terrain nowhere and leaves its box through the bottom has gone through a hole in it.
bool TerrainSubject::isVoid(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const {
  const Result<View> view = viewOf(camera, settings);
  if (!view || settings.isCurved || pick(camera, pixel, settings)) return false;
  Vec3 direction = directionOfPixel(*view, space_.isMirrored(), pixel);
  direction.z /= settings.stretch;
  const Vec3 eye = originOf(*view, pixel, settings);
  if (!(direction.z < 0) || eye.z < rayBox_.low.z) return false;
  const double down = (rayBox_.low.z - eye.z) / direction.z;
  const Vec3 at = eye + down * direction;
  return at.x >= rayBox_.low.x && at.x <= rayBox_.high.x && at.y >= rayBox_.low.y && at.y <= rayBox_.high.y;
}

std::optional<Pick> TerrainSubject::pickCurved(const View& view, Vec2 pixel, const Camera& camera,
                                               double stretch) const {
  const CurvedGround& ground = *ground_;  // viewOf() made it
  const Vec3 direction = unit(directionOfPixel(view, space_.isMirrored(), pixel));
  const Vec3 eye = space_.position(camera), middle = box_.centre();
  const double farthest = std::hypot(eye.x - middle.x, eye.y - middle.y, stretch * (eye.z - middle.z)) +
                          box_.diagonal() * std::max(1.0, stretch);
  const auto flat = [&](double metres) {
    const Vec3 source = ground.source(view.eye + metres * direction, stretch);
    return space_.position({source.x, source.y}, source.z);
  };
  // A chord c of a circle of radius R is off by c^2 / 8 R: 5 mm, and where meridians run together more.
  constexpr double kChordMetres = 500;
  Vec3 before = eye;
  for (int chords = 0; chords * kChordMetres < farthest; ++chords) {
    const Vec3 now = flat((chords + 1) * kChordMetres), chord = now - before;
    const auto part = within(rayBox_, before, chord);
    if (part && part->from <= 1)
      if (auto hit = between(before + part->from * chord, before + std::min(part->to, 1.0) * chord, eye)) {
        hit->metres = norm(ground.position(hit->xy, hit->height) - ground.position(camera.xy, camera.height));
        return hit;
      }
    before = now;
  }
  return std::nullopt;
}

}  // namespace arete
