// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "terrain/model/terrain_model.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {

/// A terrain that is read in pages. Its space, its box and home views come from an outline, which has the
/// peaks and pits that every level keeps; picks meet the part that is drawn, and boundAt() says how far that
/// may be from the model. What needs the whole model at full resolution is refused: lines of sight and
/// viewsheds (terrain() has nothing for their tools), the curved Earth, colours by slope. One thread at a
/// time.
class PagedTerrainSubject final : public Subject {
 public:
  /// Keeps the model.
  explicit PagedTerrainSubject(const std::shared_ptr<const TerrainModel>& outline);

  /// From now on picks meet this part.
  void show(std::shared_ptr<const TerrainSubject> part) { part_ = std::move(part); }
  const std::shared_ptr<const TerrainSubject>& part() const { return part_; }
  const std::shared_ptr<const TerrainSubject>& outline() const { return outline_; }

  std::string_view kind() const override { return "terrain"; }
  Result<View> viewOf(const Camera& camera, const ViewSettings& settings) const override;
  Vec3 drawn(const Vec3& metric, const ViewSettings& settings) const override;
  Camera home(HomeView view, const Camera& picture, const ViewSettings& settings,
              const CoveredEdges& covered = {}) const override;
  std::optional<Pick> pick(const Camera& camera, Vec2 pixel,
                           const ViewSettings& settings = {}) const override;
  bool isVoid(const Camera& camera, Vec2 pixel, const ViewSettings& settings = {}) const override;
  double boundAt(const Pick& pick, double allowed) const override;
  /// Of the outline.
  SubjectFacts facts() const override;
  std::string heightUnit() const override { return outline_->heightUnit(); }
  Result<FlightPlan> round(const Camera& from) const override;
  Vec3 inFile(const Vec3& metric) const override { return outline_->inFile(metric); }
  double leastRadius() const override { return outline_->leastRadius(); }
  double nearPlane() const override { return outline_->nearPlane(); }
  /// Of the outline, roughly.
  const GroundHeights* heights() const override { return outline_->heights(); }
  std::span<const Coloring> colorings() const override;
  using Subject::check;
  Status check(const ViewSettings& settings) const override;

 private:
  std::shared_ptr<const TerrainSubject> outline_, part_;
};

/// A subject of a model that it keeps.
std::shared_ptr<const TerrainSubject> subjectOf(std::shared_ptr<const TerrainModel> model);

}  // namespace arete
