// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_subject.h"

#include <utility>

#include "viewer/camera/round_flight.h"

namespace arete {

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
  return turnAround(space_, box_.centre(), from);
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
