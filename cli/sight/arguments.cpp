// SPDX-License-Identifier: GPL-3.0-or-later
//
// The default of --earth depends on the model, so it is resolved after the model is open.
#include "cli/sight/arguments.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <utility>

#include "cli/arguments/arguments.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/position_argument.h"

namespace arete {

CLI::Validator megahertz() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        const auto number = readNumberText(text);
        if (!number) return fmt::format("'{}' is not a number of MHz, as 2400", text);
        return *number > 0 ? "" : fmt::format("must be above 0 MHz, not {}", text);
      },
      "");
}

// A stated coefficient is kept apart from the default one, since a stated one is an error on a plane.
void SightArguments::addEarthTo(CLI::App& command) {
  const std::string group = "Shape of the Earth";
  command
      .add_option(
          "--earth", earth,
          "ellipsoid: lines follow geodesics of the CRS's ellipsoid (default where the CRS has one); plane: "
          "the map without curvature, with metres by its scale in the middle of the DEM")
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
          "Refraction coefficient: the effective radius of the Earth is R / (1 - K) (default 1/7; GDAL's "
          "curvature coefficient is 1 - K)")
      ->check(finiteBetween(-10, 10))
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            if (std::strtod(text.c_str(), nullptr) < 1) return {};
            return fmt::format(
                "{} would bend rays as much as the Earth, or more; an effective Earth of 4/3 is 0.25", text);
          },
          ""))
      ->type_name("K")
      ->group(group);
}

// The option is kept, so that commands can see whether it was stated.
void SightArguments::addNodataTo(CLI::App& command) {
  nodataOption =
      command
          .add_option("--nodata", nodata,
                      "Answer for lines over NODATA or outside the DEM: unknown (default), clear or blocked")
          ->transform(oneOf<NodataSight>({{"unknown", NodataSight::unknown},
                                          {"clear", NodataSight::clear},
                                          {"blocked", NodataSight::blocked}}))
          ->type_name("unknown|clear|blocked");
}

void SightArguments::addLonLatTo(CLI::App& command) {
  command.add_flag("--lonlat", lonLat, "X,Y are longitude and latitude in degrees (WGS 84)");
}

std::string SightArguments::earthName(const TerrainModel& model) const {
  if (!earth.empty()) return earth;
  return isOnEllipsoid(model.georeference) ? "ellipsoid" : "plane";
}

Json SightArguments::refractionJson(const TerrainModel& model) const {
  return earthName(model) == "plane" ? Json() : Json(refraction);
}

// A plane has no refraction. If the CRS exists and allows no ellipsoid, the user is warned that the plane is
// taken.
Result<std::unique_ptr<SightEarth>> SightArguments::makeEarth(const TerrainModel& model,
                                                              Session& session) const {
  if (earthName(model) == "plane") {
    if (statesRefraction && refraction != 0)
      return failure(ErrorCode::usage, "requires an ellipsoid; the map is taken as a plane", "--refraction");
    if (earth.empty() && !model.georeference.crsWkt.empty())
      session.warn("the DEM's CRS has no longitude and latitude: its map is taken as a plane");
    return makePlaneEarth(model);
  }
  auto made = makeEllipsoidEarth(model, refraction);
  if (!made) made.error().culprit = "--earth ellipsoid";
  return made;
}

}  // namespace arete
