// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/scene_subject.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "viewer/camera/round_flight.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {
namespace {

const Subject* groundOf(std::span<const Subject* const> objects) {
  const auto found = std::ranges::find_if(objects, [](const Subject* s) { return s->terrain() != nullptr; });
  return found == objects.end() ? nullptr : *found;
}

CameraSpace spaceOf(const Subject* ground) {
  return ground ? ground->space() : CameraSpace();
}

}  // namespace

SceneSubject::SceneSubject(std::vector<const Subject*> objects)
    : Subject(spaceOf(groundOf(objects)), {}), objects_(std::move(objects)), ground_(groundOf(objects_)) {}

Vec3 SceneSubject::fromObject(const Subject& object, const Vec3& metric) const {
  if (!object.isTerrain() || &object == ground_) return metric;
  return space_.position(object.space().xy(metric), object.space().height(metric));
}

// Objects move, so that it is found anew.
MetricBox SceneSubject::box() const {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  MetricBox box{{kInfinite, kInfinite, kInfinite}, {-kInfinite, -kInfinite, -kInfinite}};
  for (const Subject* object : objects_)
    for (const Vec3& corner : object->box().corners()) {
      const Vec3 p = fromObject(*object, corner);
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  return box;
}

Result<View> SceneSubject::viewOf(const Camera& camera, const ViewSettings& settings) const {
  return ground_ ? ground_->viewOf(camera, settings) : arete::viewOf(camera, space_);
}

Vec3 SceneSubject::drawn(const Vec3& metric, const ViewSettings& settings) const {
  return ground_ ? ground_->drawn(metric, settings) : metric;
}

Camera SceneSubject::home(HomeView view, const Camera& picture, const ViewSettings& settings,
                          const CoveredEdges& covered) const {
  if (ground_) return ground_->home(view, picture, settings, covered);
  HomeShape shape;
  shape.box = box();
  for (const Subject* object : objects_)
    for (const Vec3& corner : object->box().corners()) shape.points.push_back(corner);
  return homeCamera(view, space_, shape, picture, 1, covered);
}

std::optional<Pick> SceneSubject::pick(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const {
  std::optional<Pick> nearest;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (isShown && !isShown(i)) continue;
    auto found = objects_[i]->pick(camera, pixel, settings);
    if (!found || (nearest && nearest->depth <= found->depth)) continue;
    nearest = std::move(found);
    nearest->metric = fromObject(*objects_[i], nearest->metric);
    nearest->object = i;
  }
  return nearest;
}

bool SceneSubject::isVoid(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const {
  return ground_ && ground_->isVoid(camera, pixel, settings) && !pick(camera, pixel, settings);
}

double SceneSubject::boundAt(const Pick& pick, double allowed) const {
  return objects_[pick.object]->boundAt(pick, allowed);
}

SubjectFacts SceneSubject::facts() const {
  SubjectFacts all;
  for (const Subject* object : objects_) {
    const SubjectFacts one = object->facts();
    all.vertices += one.vertices;
    all.triangles += one.triangles;
    all.materials += one.materials;
    all.largestError = std::max(all.largestError, one.largestError);
  }
  return all;
}

std::string SceneSubject::heightUnit() const {
  return (ground_ ? ground_ : objects_.front())->heightUnit();
}

Result<FlightPlan> SceneSubject::round(const Camera& from) const {
  return ground_ ? ground_->round(from) : turnAround(space_, box().centre(), from);
}

Vec3 SceneSubject::inFile(const Vec3& metric) const {
  return ground_ ? ground_->inFile(metric) : metric;
}

double SceneSubject::leastRadius() const {
  double least = std::numeric_limits<double>::infinity();
  for (const Subject* object : objects_) least = std::min(least, object->leastRadius());
  return least;
}

double SceneSubject::nearPlane() const {
  if (ground_) return ground_->nearPlane();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Subject* object : objects_) nearest = std::min(nearest, object->nearPlane());
  return nearest;
}

const TerrainSubject* SceneSubject::terrain() const {
  return ground_ ? ground_->terrain() : nullptr;
}

const GroundHeights* SceneSubject::heights() const {
  return ground_ ? ground_->heights() : nullptr;
}

// Each object shows what it can of the settings (Scene::draw()); the ground has to show all of them.
Status SceneSubject::check(const ViewSettings& settings) const {
  return (ground_ ? ground_ : objects_.front())->check(settings);
}

}  // namespace arete
