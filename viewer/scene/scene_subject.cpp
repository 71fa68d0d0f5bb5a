// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene/scene_subject.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "viewer/camera/round_flight.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {
namespace {

MetricBox boxOf(std::span<const Subject* const> objects) {
  MetricBox box = objects.front()->box();
  for (const Subject* object : objects) {
    const MetricBox& b = object->box();
    box.low = {std::min(box.low.x, b.low.x), std::min(box.low.y, b.low.y), std::min(box.low.z, b.low.z)};
    box.high = {std::max(box.high.x, b.high.x), std::max(box.high.y, b.high.y),
                std::max(box.high.z, b.high.z)};
  }
  return box;
}

const Subject* groundOf(std::span<const Subject* const> objects) {
  const auto found = std::ranges::find_if(objects, [](const Subject* s) { return s->terrain() != nullptr; });
  return found == objects.end() ? nullptr : *found;
}

CameraSpace spaceOf(const Subject* ground) {
  return ground ? ground->space() : CameraSpace();
}

}  // namespace

SceneSubject::SceneSubject(std::vector<const Subject*> objects)
    : Subject(spaceOf(groundOf(objects)), boxOf(objects)),
      objects_(std::move(objects)),
      ground_(groundOf(objects_)) {}

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
  shape.box = boxOf(objects_);
  for (const Subject* object : objects_)
    for (const Vec3& corner : object->box().corners()) shape.points.push_back(corner);
  return homeCamera(view, space_, shape, picture, 1, covered);
}

std::optional<Pick> SceneSubject::pick(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const {
  std::optional<Pick> nearest;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (isShown && !isShown(i)) continue;
    auto found = objects_[i]->pick(camera, pixel, settings);
    if (!found || (nearest && nearest->metres <= found->metres)) continue;
    nearest = std::move(found);
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
  return ground_ ? ground_->round(from) : turnAround(space_, boxOf(objects_).centre(), from);
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
