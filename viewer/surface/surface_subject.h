// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/fronts/z_up_frame.h"
#include "viewer/inks/triangle_inks.h"
#include "viewer/scene/placement.h"
#include "viewer/scene/subject.h"
#include "viewer/surface/surface_picker.h"

namespace arete {

/// What all objects of one surface share: the model in upright space (ZUpFrame), without a place.
struct SurfaceForm {
  /// Precondition: the model outlives this. O(vertices); of a part of a model O(its triangles).
  SurfaceForm(const SurfaceModel& shown, const ZUpFrame& frame);

  const SurfaceModel& model;
  ZUpFrame upright;
  double largestError;  ///< of any triangle that the model, or that it is a part of, refines
  double beyond;        ///< how far a model may reach beyond the points of its part; 0 of a whole one
  HomeShape shape;      ///< the box has all of the model, also of a part
  SurfacePicker picker;
};

/// A surface that cameras move around. By itself: cameras count x to the east, y to the north and heights
/// upwards from its middle, in the file's unit. In a scene it stands where its placement says. Home views
/// look along the axes, as homeLook(), but for the overview, which shows three sides: the front, its left and
/// the top, from as far above as fills the picture. What is in front looks south.
class SurfaceSubject : public Subject {
 public:
  /// By itself. Precondition: the model outlives this. O(vertices).
  SurfaceSubject(const SurfaceModel& model, const ZUpFrame& upright);
  /// By itself, turned about the middle of its box.
  SurfaceSubject(std::shared_ptr<const SurfaceForm> form, const Turn& turn);
  /// In a scene. Precondition: the scene outlives this.
  ///
  /// @param scene whose space the anchor is in; null: a space of its own, in which nothing is exaggerated.
  SurfaceSubject(std::shared_ptr<const SurfaceForm> form, const Placement& placement, const Subject* scene);

  std::string_view kind() const override { return "surface"; }
  Result<View> viewOf(const Camera& camera, const ViewSettings& settings = {}) const override;
  Vec3 drawn(const Vec3& metric, const ViewSettings& settings) const override {
    return scene_ ? scene_->drawn(metric, settings) : metric;
  }
  Camera home(HomeView view, const Camera& picture, const ViewSettings& settings = {},
              const CoveredEdges& covered = {}) const override;
  /// By itself, its height is the coordinate of the file that counts upwards; in a scene, the place is the
  /// scene's.
  std::optional<Pick> pick(const Camera& camera, Vec2 pixel,
                           const ViewSettings& settings = {}) const override;
  double boundAt(const Pick&, double allowed) const override;
  SubjectFacts facts() const override;
  std::string heightUnit() const override { return unit_; }
  /// One turn, with the camera's distance from the middle of the surface and its height.
  Result<FlightPlan> round(const Camera& from) const override;
  Vec3 inFile(const Vec3& metric) const override;
  Vec3 fromFile(const Vec3& inFile) const override {
    return placed(placement_, scene_)(upright().fromFile(inFile));
  }
  Box3 fileBox() const override;
  double leastRadius() const override { return 1e-4 * box_.diagonal(); }
  /// A surface has no usual unit, so the near plane follows its size.
  double nearPlane() const override { return 1e-4 * box_.diagonal(); }
  std::span<const Coloring> colorings() const override;
  std::vector<std::string> inks() const override { return inkNames(model()); }
  /// O(n log n) at first, then O(1) until another one is asked for.
  Result<std::shared_ptr<const TriangleInk>> ink(const std::string& name) const override;
  using Subject::check;
  Status check(const ViewSettings& settings) const override;

  const ZUpFrame& upright() const { return form_->upright; }
  bool isPlaced() const override { return isPlaced_; }
  const SurfaceModel& model() const { return form_->model; }
  const Placement& placement() const { return placement_; }
  /// In upright space.
  const MetricBox& uprightBox() const { return form_->shape.box; }
  /// Moves it, while it is shown.
  void place(const Placement& placement);
  /// From upright space to where it is drawn.
  Similarity pose(const ViewSettings& settings) const { return placedAsDrawn(placement_, scene_, settings); }

 protected:
  /// What picks meet.
  virtual const SurfacePicker& picker() const { return form_->picker; }

 private:
  /// As placed.
  HomeShape shape() const;

  std::shared_ptr<const SurfaceForm> form_;
  Placement placement_;
  const Subject* scene_ = nullptr;
  bool isPlaced_ = false;
  std::string unit_;
  mutable std::string inkName_;
  mutable std::shared_ptr<const TriangleInk> ink_;  // that was asked for last
};

/// A view of placed space in the space of an object.
View viewedBy(const Similarity& placed, const View& view);

}  // namespace arete
