// SPDX-License-Identifier: GPL-3.0-or-later
//
// The line is drawn with its heights as the DEM counts them: over an ellipsoid it sags on a flat map, and
// touches in the picture what it touches on the ground.
#include "viewer/window/sight_tool.h"

#include <fmt/format.h>

#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/lonlat.h"

namespace arete {
namespace {

constexpr int kPoints = 96;

std::string withUnit(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{:.2f}", value) : fmt::format("{:.2f} {}", value, unit);
}

std::string metresText(double metres) {
  return metres < 10000 ? fmt::format("{:.1f} m", metres) : fmt::format("{:.3f} km", metres / 1000);
}

std::string_view verdictText(const SightAnswer& answer) {
  switch (answer.verdict) {
    case SightVerdict::visible:
      return answer.isTouching ? "visible, touching the terrain" : "visible";
    case SightVerdict::blocked:
      return "blocked";
    case SightVerdict::unknown:
      return "unknown: no terrain known below a part of it";
    default:
      return "undecided";
  }
}

}  // namespace

std::vector<SightPiece> piecesOf(const SightPicture& picture) {
  const SightVerdict verdict = picture.answer.sight.verdict;
  const auto piece = [&](const Vec3& from, const Vec3& to, bool isBefore) {
    const Rgba color = verdict == SightVerdict::visible   ? Rgba{60, 235, 60, 255}
                       : verdict != SightVerdict::blocked ? Rgba{190, 190, 190, 255}
                       : isBefore                         ? Rgba{255, 50, 40, 255}
                                                          : Rgba{150, 40, 40, 255};
    return SightPiece{from, to, isBefore, color};
  };
  std::vector<SightPiece> pieces;
  for (std::size_t i = 1; i < picture.points.size(); ++i) {
    const Vec3 from = picture.points[i - 1], to = picture.points[i];
    if (picture.obstruction && i == picture.pointsBefore) {
      pieces.push_back(piece(from, *picture.obstruction, true));
      pieces.push_back(piece(*picture.obstruction, to, false));
    } else {
      pieces.push_back(piece(from, to, i <= picture.pointsBefore));
    }
  }
  return pieces;
}

SightTool::SightTool(const TerrainModel& model, const Profiles& profiles)
    : model_(model), profiles_(profiles), space_(model) {
  if (!model.georeference.crsWkt.empty() && CrsLonLat::of(model.georeference)) {
    if (auto made = makeEllipsoidEarth(model)) {
      earth_ = std::move(*made);
      earthName_ = "ellipsoid";
    }
  }
  if (!earth_) earth_ = makePlaneEarth(model);
  engine_ = makeSightDescent(model);
}

Result<SightPicture> SightTool::between(const Pick& from, double fromAbove, const Pick& to,
                                        double toAbove) const {
  const SightPath path{sightPlan(model_, from.xy), sightPlan(model_, to.xy), from.height + fromAbove,
                       to.height + toAbove};
  ARETE_TRY(const SightLine line, sightLine(path, *earth_, model_));
  ARETE_TRY(const auto answer, answerPath(path, *earth_, *engine_, profiles_, {}));

  SightPicture picture{.answer = answer, .points = {}, .obstruction = {}, .pointsBefore = 0, .text = {}};
  const SightAnswer& sight = answer.sight;
  const auto placeAt = [&](double s) {
    return space_.position(model_.toSource(line.planAt(s)), line.height(s));
  };
  for (int i = 0; i <= kPoints; ++i) {
    const double s = line.length() * i / kPoints;
    if (!sight.obstruction || s < sight.obstruction->distance) ++picture.pointsBefore;
    picture.points.push_back(placeAt(s));
  }
  if (sight.obstruction) picture.obstruction = placeAt(sight.obstruction->distance);

  const std::string& unit = model_.georeference.verticalUnit;
  picture.text.emplace_back(verdictText(sight));
  picture.text.push_back(fmt::format("{}, azimuth {:.2f}°, {:+.3f}° up", metresText(answer.distanceMetres),
                                     answer.azimuthDegrees, answer.elevationDegrees));
  if (sight.clearance)
    picture.text.push_back(fmt::format("clearance {}, {} away", withUnit(*sight.clearance, unit),
                                       metresText(sight.least.distance)));
  if (sight.obstruction)
    picture.text.push_back(fmt::format("blocked {} away, terrain at {}",
                                       metresText(sight.obstruction->distance),
                                       withUnit(sight.obstruction->terrainHeight, unit)));
  if (sight.gapMetres > 0)
    picture.text.push_back(fmt::format("no terrain below {} of it", metresText(sight.gapMetres)));
  return picture;
}

}  // namespace arete
