// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/sight/arguments.h"

#include <utility>

#include "cli/arguments/arguments.h"
#include "io/crs/lonlat.h"

namespace arete {

void SightArguments::addEarthTo(CLI::App& command) {
  const std::string group = "The Earth";
  command
      .add_option(
          "--earth", earth,
          "ellipsoid: lines over geodesics of the CRS's ellipsoid (default where there is one); plane: "
          "the map taken as it is, without curvature")
      ->check(oneOf({"ellipsoid", "plane"}))
      ->type_name("ellipsoid|plane")
      ->group(group);
  command
      .add_option_function<double>(
          "--refraction",
          [this](double k) {
            refraction = k;
            statesRefraction = true;
          },
          "Refraction K: the Earth's effective radius is R / (1 - K) (default 1/7; GDAL's curvature "
          "coefficient is 1 - K)")
      ->check(finiteBetween(-10, 10))
      ->type_name("K")
      ->group(group);
}

void SightArguments::addNodataTo(CLI::App& command) {
  nodataOption =
      command
          .add_option(
              "--nodata", nodata,
              "What a line over NODATA, or outside the DEM, is there: unknown (default), clear or blocked")
          ->transform(oneOf<NodataSight>({{"unknown", NodataSight::unknown},
                                          {"clear", NodataSight::clear},
                                          {"blocked", NodataSight::blocked}}))
          ->type_name("unknown|clear|blocked");
}

void SightArguments::addLonLatTo(CLI::App& command) {
  command.add_flag("--lonlat", lonLat, "X,Y are longitude, latitude in degrees (WGS 84)");
}

std::string SightArguments::earthName(const TerrainModel& model) const {
  if (!earth.empty()) return earth;
  return !model.georeference.crsWkt.empty() && CrsLonLat::of(model.georeference) ? "ellipsoid" : "plane";
}

Json SightArguments::refractionJson(const TerrainModel& model) const {
  return earthName(model) == "plane" ? Json() : Json(refraction);
}

Result<std::unique_ptr<SightEarth>> SightArguments::makeEarth(const TerrainModel& model,
                                                              Session& session) const {
  if (earthName(model) == "plane") {
    if (statesRefraction && refraction != 0)
      return failure(ErrorCode::usage, "bends lines over an ellipsoid, and the map is taken as plane",
                     "--refraction");
    if (earth.empty() && !model.georeference.crsWkt.empty())
      session.warn("the DEM's CRS knows no longitude and latitude: its map is taken as plane");
    return makePlaneEarth(model);
  }
  auto made = makeEllipsoidEarth(model, refraction);
  if (!made) made.error().culprit = "--earth ellipsoid";
  return made;
}

std::string_view toString(NodataSight nodata) {
  return nodata == NodataSight::clear ? "clear" : nodata == NodataSight::blocked ? "blocked" : "unknown";
}

std::string_view toString(SightVerdict verdict) {
  switch (verdict) {
    case SightVerdict::visible:
      return "visible";
    case SightVerdict::blocked:
      return "blocked";
    case SightVerdict::unknown:
      return "unknown";
    default:
      return "undecided";
  }
}

}  // namespace arete
