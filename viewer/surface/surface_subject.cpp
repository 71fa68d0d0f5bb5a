// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_subject.h"

#include <utility>

#include "viewer/camera/round_flight.h"

namespace arete {

SurfaceSubject::SurfaceSubject(const SurfaceModel& model, const ZUpFrame& upright)
    : SurfaceSubject(uprightShape(model, upright), upright) {}

SurfaceSubject::SurfaceSubject(ZUpShape shape, const ZUpFrame& upright)
    : Subject(CameraSpace(), shape.box), upright_(upright), points_(std::move(shape.points)) {}

Result<View> SurfaceSubject::viewOf(const Camera& camera, const ViewSettings&) const {
  return arete::viewOf(camera, space_);
}

Camera SurfaceSubject::home(HomeView view, const Camera& picture, const ViewSettings&) const {
  const Look look = view == HomeView::overview ? Look{325, -20} : homeLook(view);
  Camera camera = space_.at(picture, eyeOnAll(points_, axesOf(space_, look), picture));
  camera.azimuthDegrees = wrappedAzimuth(look.azimuthDegrees);
  camera.pitchDegrees = look.pitchDegrees;
  return camera;
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
