// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>

#include "viewer/scene/subject.h"
#include "viewer/surface/surface_picker.h"
#include "viewer/surface/z_up_frame.h"

namespace arete {

/// A surface that cameras move around, in upright space (ZUpFrame): cameras count x to the east, y to the
/// north and heights upwards from its middle, in the file's unit. Home views look along the axes, as
/// homeLook(), but for the overview, which shows three sides: the front, its left and the top, from as far
/// above as fills the picture. What is in front looks south. Keeps a reference to the model.
class SurfaceSubject final : public Subject {
 public:
  /// Precondition: the model outlives this. O(vertices).
  SurfaceSubject(const SurfaceModel& model, const ZUpFrame& upright);

  std::string_view kind() const override { return "surface"; }
  Result<View> viewOf(const Camera& camera, const ViewSettings& settings = {}) const override;
  Vec3 drawn(const Vec3& metric, const ViewSettings&) const override { return metric; }
  Camera home(HomeView view, const Camera& picture, const ViewSettings& settings = {},
              const CoveredEdges& covered = {}) const override;
  /// Its height is the coordinate of the file that counts upwards.
  std::optional<Pick> pick(const Camera& camera, Vec2 pixel,
                           const ViewSettings& settings = {}) const override;
  double boundAt(const Pick&, double allowed) const override { return std::min(allowed, largestError_); }
  std::string heightUnit() const override { return unit_; }
  /// One turn, with the camera's distance from the middle of the surface and its height.
  Result<FlightPlan> round(const Camera& from) const override;
  Vec3 inFile(const Vec3& metric) const override { return upright_.toFile(metric); }
  double leastRadius() const override { return 1e-4 * box_.diagonal(); }
  std::span<const Coloring> colorings() const override;
  using Subject::check;
  Status check(const ViewSettings& settings) const override;

  const ZUpFrame& upright() const { return upright_; }

 private:
  SurfaceSubject(const SurfaceModel& model, const ZUpFrame& upright, HomeShape shape);

  ZUpFrame upright_;
  HomeShape shape_;
  SurfacePicker picker_;
  double largestError_;
  std::string unit_;
};

}  // namespace arete
