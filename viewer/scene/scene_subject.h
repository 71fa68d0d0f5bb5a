// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "viewer/scene/subject.h"

namespace arete {

/// Several models as one that a camera looks at. Where one is a terrain, the scene has the metric space of
/// the first, its ground, and its places on the map; else a camera's own, in the unit of the objects.
class SceneSubject final : public Subject {
 public:
  /// Precondition: at least one; they outlive this, and may move.
  explicit SceneSubject(std::vector<const Subject*> objects);

  std::string_view kind() const override { return ground_ ? "terrain" : "surface"; }
  MetricBox box() const override;
  Result<View> viewOf(const Camera& camera, const ViewSettings& settings) const override;
  Vec3 drawn(const Vec3& metric, const ViewSettings& settings) const override;
  /// Of the terrain, where there is one; else of all objects.
  Camera home(HomeView view, const Camera& picture, const ViewSettings& settings,
              const CoveredEdges& covered = {}) const override;
  /// The nearest of all objects that are shown; says which.
  std::optional<Pick> pick(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const override;
  bool isVoid(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const override;
  double boundAt(const Pick& pick, double allowed) const override;
  /// Of all objects; the largest error.
  SubjectFacts facts() const override;
  std::string heightUnit() const override;
  Result<FlightPlan> round(const Camera& from) const override;
  Vec3 inFile(const Vec3& metric) const override;
  double leastRadius() const override;
  double nearPlane() const override;
  const TerrainSubject* terrain() const override;
  const GroundHeights* heights() const override;
  std::span<const Coloring> colorings() const override { return objects_.front()->colorings(); }
  using Subject::check;
  Status check(const ViewSettings& settings) const override;

  std::span<const Subject* const> objects() const { return objects_; }
  /// Whether an object is shown, and so can be picked. Empty: all are.
  std::function<bool(std::size_t)> isShown;

 private:
  /// Of a place in the metric space of an object. A further terrain has a space of its own.
  Vec3 fromObject(const Subject& object, const Vec3& metric) const;

  std::vector<const Subject*> objects_;
  const Subject* ground_ = nullptr;  // the first terrain
};

}  // namespace arete
