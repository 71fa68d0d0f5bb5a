// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "terrain/sight/earth.h"
#include "terrain/sight/profile.h"
#include "viewer/scene/curved_ground.h"
#include "viewer/scene/subject.h"

namespace arete {

/// A terrain that cameras move over. Picks are the first intersection of a pixel's ray with the terrain at
/// full resolution; on a curved Earth, where the ray bends over the map, in chords that are off by some
/// centimetres at most. A home view of the curved Earth is found in its middle, be it a whole planet: a level
/// one from over a pole of a geographic CRS, which tells no north there, is taken from some degrees higher;
/// what the CRS does not reach is left out, and where it reaches no such camera the flat map's is handed out.
///
/// Keeps a reference to the model. One thread at a time.
class TerrainSubject final : public Subject {
 public:
  /// Precondition: the model outlives this. O(vertices).
  explicit TerrainSubject(const TerrainModel& model);

  std::string_view kind() const override { return "terrain"; }
  Result<View> viewOf(const Camera& camera, const ViewSettings& settings) const override;
  Vec3 drawn(const Vec3& metric, const ViewSettings& settings) const override;
  Camera home(HomeView view, const Camera& picture, const ViewSettings& settings,
              const CoveredEdges& covered = {}) const override;
  /// O(triangles below the ray * depth).
  std::optional<Pick> pick(const Camera& camera, Vec2 pixel,
                           const ViewSettings& settings = {}) const override;
  bool isVoid(const Camera& camera, Vec2 pixel, const ViewSettings& settings = {}) const override;
  double boundAt(const Pick& pick, double allowed) const override;
  SubjectFacts facts() const override;
  std::string heightUnit() const override { return model_.georeference.verticalUnit; }
  Result<FlightPlan> round(const Camera& from) const override;
  Vec3 inFile(const Vec3& metric) const override;
  double leastRadius() const override { return 0.5; }
  double nearPlane() const override { return 0.1; }
  const TerrainSubject* terrain() const override { return this; }
  const GroundHeights* heights() const override { return &profiles_.heights(); }
  std::span<const Coloring> colorings() const override;
  using Subject::check;
  Status check(const ViewSettings& settings) const override;

  const TerrainModel& model() const { return model_; }
  const Profiles& profiles() const { return profiles_; }
  /// Made at its first use. Errors: as CurvedGround::create().
  Result<const CurvedGround*> curvedGround() const;
  /// The pick of a ray from a point in a direction of any length but 0, in metric space. From above or from
  /// below the terrain.
  Vec3 originOf(const View& view, Vec2 pixel, const ViewSettings& settings) const;
  std::optional<Pick> along(const Vec3& eye, const Vec3& direction) const;

 private:
  /// The first intersection between two points.
  std::optional<Pick> between(const Vec3& first, const Vec3& last, const Vec3& eye) const;
  std::optional<Pick> pickFlat(const View& view, Vec2 pixel, const Camera& camera,
                               const ViewSettings& settings) const;
  std::optional<Pick> pickCurved(const View& view, Vec2 pixel, const Camera& camera, double stretch) const;
  /// Null on a flat map, and if the CRS has no ellipsoid.
  const CurvedGround* groundOf(const ViewSettings& settings) const;
  /// @param inside a place of the triangle that was hit, in the plan.
  std::optional<Pick> pickOf(const Vec3& hit, const Vec3& inside, const Vec3& eye) const;

  const TerrainModel& model_;
  Profiles profiles_;
  MetricBox rayBox_;  // a little larger
  std::unique_ptr<SightEarth> plane_;
  mutable std::optional<CurvedGround> ground_;
  mutable std::optional<HomeShape> shape_;  // made at its first use
};

}  // namespace arete
