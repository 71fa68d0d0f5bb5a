// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/pages/paged_terrain_subject.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "engine/mt/multitriangulation.h"

namespace arete {

std::shared_ptr<const TerrainSubject> subjectOf(std::shared_ptr<const TerrainModel> model) {
  struct Kept {
    explicit Kept(std::shared_ptr<const TerrainModel> m) : model(std::move(m)), subject(*model) {}
    std::shared_ptr<const TerrainModel> model;
    TerrainSubject subject;
  };
  auto kept = std::make_shared<const Kept>(std::move(model));
  const TerrainSubject* const subject = &kept->subject;
  return {std::move(kept), subject};
}

PagedTerrainSubject::PagedTerrainSubject(const std::shared_ptr<const TerrainModel>& outline)
    : Subject(CameraSpace(*outline), metricBox(*outline)), outline_(subjectOf(outline)), part_(outline_) {}

Result<View> PagedTerrainSubject::viewOf(const Camera& camera, const ViewSettings& settings) const {
  return outline_->viewOf(camera, settings);
}

Vec3 PagedTerrainSubject::drawn(const Vec3& metric, const ViewSettings& settings) const {
  return outline_->drawn(metric, settings);
}

Camera PagedTerrainSubject::home(HomeView view, const Camera& picture, const ViewSettings& settings,
                                 const CoveredEdges& covered) const {
  return outline_->home(view, picture, settings, covered);
}

std::optional<Pick> PagedTerrainSubject::pick(const Camera& camera, Vec2 pixel,
                                              const ViewSettings& settings) const {
  return part_->pick(camera, pixel, settings);
}

bool PagedTerrainSubject::isVoid(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const {
  return part_->isVoid(camera, pixel, settings);
}

double PagedTerrainSubject::boundAt(const Pick& pick, double allowed) const {
  return part_->boundAt(pick, allowed);
}

SubjectFacts PagedTerrainSubject::facts() const {
  return outline_->facts();
}

// The ground is nowhere farther above the outline than the largest error of a triangle that it does not
// refine.
Result<FlightPlan> PagedTerrainSubject::round(const Camera& from) const {
  ARETE_TRY(FlightPlan plan, outline_->round(from));
  const MultiTriangulation& mt = outline_->model().mt;
  double above = 0;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (mt.isRemoverMissing(TriangleId(t))) above = std::max(above, mt.decoded(kAbove, TriangleId(t)));
  for (Camera& key : plan.keys) key.height += above;
  return plan;
}

std::span<const Coloring> PagedTerrainSubject::colorings() const {
  static constexpr std::array kColorings = {Coloring::height, Coloring::plain, Coloring::error};
  return kColorings;
}

Status PagedTerrainSubject::check(const ViewSettings& settings) const {
  if (settings.isCurved)
    return failure(ErrorCode::usage, "the curved Earth is for a model that is read whole", "curvature");
  const Coloring coloring = settings.look.coloring;
  if (coloring == Coloring::slope || coloring == Coloring::aspect)
    return failure(ErrorCode::usage, "is for a model that is read whole",
                   "colour by " + std::string(toString(coloring)));
  return outline_->check(settings);
}

}  // namespace arete
