// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_subject.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "viewer/camera/round_flight.h"

namespace arete {
namespace {

constexpr double kFreeOnATurn = 0.02;  // of half the picture, at its edges

/// How far a camera has to step back for a place to be within so much of its picture; negative: it need not.
class StepBack {
 public:
  StepBack(const CameraSpace& space, const Camera& camera)
      : axes_(axesOf(space, lookOf(camera))),
        eye_(space.position(camera)),
        slope_(std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360)),
        slopeAcross_(slope_ * camera.widthPixels / camera.heightPixels) {}

  double operator()(const Vec3& place, double part) const {
    const Vec3 way = place - eye_;
    return std::max(std::abs(dot(way, axes_.right)) / slopeAcross_, std::abs(dot(way, axes_.up)) / slope_) /
               part -
           dot(way, axes_.ahead);
  }
  Vec3 eyeAt(double step) const { return eye_ - axes_.ahead * step; }

 private:
  PictureAxes axes_;
  Vec3 eye_;
  double slope_, slopeAcross_;
};

}  // namespace

SurfaceSubject::SurfaceSubject(const SurfaceModel& model, const ZUpFrame& upright)
    : SurfaceSubject(model, upright, uprightShape(model, upright)) {}

SurfaceSubject::SurfaceSubject(const SurfaceModel& model, const ZUpFrame& upright, HomeShape shape)
    : Subject(CameraSpace(), shape.box),
      upright_(upright),
      shape_(std::move(shape)),
      picker_(model, upright),
      largestError_(model.mt.largestError()),
      unit_(model.verticalUnit) {}

Result<View> SurfaceSubject::viewOf(const Camera& camera, const ViewSettings&) const {
  return arete::viewOf(camera, space_);
}

Camera SurfaceSubject::home(HomeView view, const Camera& picture, const ViewSettings&,
                            const CoveredEdges& covered) const {
  Look look = view == HomeView::overview ? Look{325, -20} : homeLook(view);
  if (view == HomeView::overview)
    look = filling(
        look, shape_.points, [&](Look at) { return axesOf(space_, at); }, picture, covered);
  return cameraOnAll(space_, shape_, look, picture, covered);
}

std::optional<Pick> SurfaceSubject::pick(const Camera& camera, Vec2 pixel,
                                         const ViewSettings& settings) const {
  const Result<View> view = viewOf(camera, settings);
  if (!view) return std::nullopt;
  const auto found = picker_.along(view->eye, directionOfPixel(*view, space_.isMirrored(), pixel));
  if (!found) return std::nullopt;
  const Vec3 place = upright_.toFile(found->place);
  // Of the three coordinates of the file, the one that counts upwards is the height.
  const bool isYUp = upright_.turned({0, 1, 0}).z > 0.5;
  return Pick{{place.x, place.y}, {place.x, place.y}, isYUp ? place.y : place.z,
              found->place,       found->length,      picker_.materialOf(found->triangle)};
}

Result<FlightPlan> SurfaceSubject::round(const Camera& from) const {
  const StepBack stepBack(space_, from);
  const Vec3 middle = box_.centre();
  const double slack = 1e-6 * box_.diagonal();
  double step = 0;
  for (const Vec3& p : shape_.points) {
    // A camera that leaves something out at its start is one that was chosen.
    if (stepBack(p, 1) > slack) return turnAround(space_, middle, from);
    const double radius = std::hypot(p.x - middle.x, p.y - middle.y);
    constexpr int kPlaces = 72;
    for (int i = 0; i < kPlaces; ++i) {
      const double turn = 2 * std::numbers::pi * i / kPlaces;
      const Vec3 there{middle.x + radius * std::cos(turn), middle.y + radius * std::sin(turn), p.z};
      step = std::max(step, stepBack(there, 1 - kFreeOnATurn));
    }
  }
  return turnAround(space_, middle, space_.at(from, stepBack.eyeAt(step)));
}

std::span<const Coloring> SurfaceSubject::colorings() const {
  static constexpr std::array kColorings = {Coloring::material, Coloring::plain, Coloring::error};
  return kColorings;
}

Status SurfaceSubject::check(const ViewSettings& settings) const {
  const auto isForTerrain = [](const char* what) {
    return failure(ErrorCode::usage, "is for terrain", what);
  };
  if (settings.isCurved) return isForTerrain("the Earth's curvature");
  if (settings.stretch != 1) return isForTerrain("exaggeration");
  if (settings.look.hazeKilometres > 0) return isForTerrain("haze");
  return checkColoring(settings.look.coloring);
}

}  // namespace arete
