// SPDX-License-Identifier: GPL-3.0-or-later
//
// Declares the options of `arete viewshed` group by group. CLI11 states which options need or exclude each
// other; check() has the rules that depend on an option's value, or on one of several options.
#include "cli/sight/viewshed_arguments.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/terrain_error.h"
#include "cli/session/output_argument.h"
#include "io/files/text_scan.h"
#include "io/geo/dem/raster_writer.h"

namespace arete {
namespace {

/// "A,B". Errors: usage, naming the option.
Result<std::pair<double, double>> readRange(const std::string& option, const std::string& text) {
  ARETE_TRY(const auto numbers, parseNumbers(option, text));
  if (numbers.size() != 2 || !std::isfinite(numbers[0] + numbers[1]))
    return failure(ErrorCode::usage, "must be two numbers with a comma between",
                   fmt::format("{} {}", option, text));
  return std::pair{numbers[0], numbers[1]};
}

}  // namespace

void ObserverArguments::addTo(CLI::App& command) {
  // Each --observer takes one text, or it would take the arguments behind it as well.
  command.add_option("--observer", typed, "Position of an observer, in the DEM's CRS; may be repeated")
      ->type_size(1)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("X,Y,H");
  CLI::Option* table =
      command
          .add_option("--observers", file,
                      "Observers of a file: CSV or a layer of points. Columns h, range (metres), azimuth and "
                      "beamwidth (degrees) hold for a row and come before the options")
          ->type_name("FILE");
  command.add_option("--layer", layer, "Layer, where the file has several")->needs(table)->type_name("NAME");
  command
      .add_option("--observer-height", usualHeight,
                  "Height of the observers of --observers that have none in the file")
      ->needs(table)
      ->type_name("H");
}

void FieldOfViewArguments::addTo(CLI::App& command) {
  const std::string group = "Field of view";
  command
      .add_option("--radius", greatestMetres,
                  "Largest distance along the ground, in metres or with a unit (default: no limit)")
      ->transform(groundLength("--radius", greatestWithUnit))
      ->check(finiteAbove(0))
      ->type_name("D")
      ->group(group);
  command
      .add_option("--min-distance", leastMetres,
                  "Smallest distance along the ground, in metres or with a unit (default 0)")
      ->transform(groundLength("--min-distance", leastWithUnit))
      ->check(finiteAtLeast(0))
      ->type_name("D")
      ->group(group);
  command.add_option("--azimuth", azimuths, "From the first azimuth clockwise to the second, in degrees")
      ->type_name("A,B")
      ->group(group);
  command
      .add_option("--elevation", elevations,
                  "Lowest and highest elevation of the target, in degrees above the horizontal")
      ->type_name("A,B")
      ->group(group);
}

Result<ViewshedField> FieldOfViewArguments::field() const {
  ViewshedField field;
  field.leastMetres = leastMetres;
  field.greatestMetres = greatestMetres;
  if (leastMetres > greatestMetres)
    return failure(ErrorCode::usage, fmt::format("is beyond --radius {}", greatestMetres),
                   fmt::format("--min-distance {}", leastMetres));
  if (!azimuths.empty()) {
    ARETE_TRY(const auto range, readRange("--azimuth", azimuths));
    // A field may go through north, from a larger azimuth to a smaller one, so only the turn between them
    // counts.
    const auto turned = [](double v) { return v - 360 * std::floor(v / 360); };
    field.fromAzimuth = turned(range.first);
    const double span = range.second - range.first;
    field.azimuthSpan = span >= 360 ? 360 : turned(span);
    if (!(field.azimuthSpan > 0))
      return failure(ErrorCode::usage, "is an empty field of view: B must differ from A",
                     "--azimuth " + azimuths);
  }
  if (!elevations.empty()) {
    ARETE_TRY(const auto range, readRange("--elevation", elevations));
    if (!(range.first <= range.second && range.first >= -90 && range.second <= 90))
      return failure(ErrorCode::usage, "must be two angles from -90 to 90, the lower first",
                     "--elevation " + elevations);
    field.lowest = range.first;
    field.highest = range.second;
  }
  return field;
}

void ViewshedArguments::addTo(CLI::App& command) {
  command.add_option("FILE.amt", model, "Multitriangulation of a raster")->required()->type_name("");
  command.add_option("-o,--output", output, "GeoTIFF to write")->type_name("FILE.tif");
  addOutputArgument(command, output, {".tif", ".tiff"});
  command
      .add_option("--polygons", polygons,
                  "Write the answer as polygons too, or instead: cells of one answer that share edges, with\n"
                  "their area in square metres on the ground (seen, count, server)")
      ->type_name("FILE.gpkg");
  addOverwriteTo(command, existing);
  CLI::Option* picture =
      command.add_option("--png", png, "Draw the answer as a map over the shaded relief too, or instead")
          ->type_name("FILE.png");
  command
      .add_flag("--no-decorations", isPlainPicture, "Draw no legend, scale bar, north arrow and graticule")
      ->needs(picture);
  observers.addTo(command);
  command.add_option("--like", like, "Raster whose grid and CRS the answer has, instead of the DEM's")
      ->type_name("RASTER");
  command
      .add_option("--target-height", targetHeight,
                  "Height of the target above the terrain, in the DEM's unit or with one (default 0)")
      ->check(lengthAtLeast(0))
      ->type_name("H");
  command
      .add_option(
          "--mode", mode,
          "seen (default); height: least height above the terrain that is seen; horizon: its elevation in "
          "degrees; count: number of observers that see the sample; server: nearest of them")
      ->transform(oneOf<ViewshedMode>({{"seen", ViewshedMode::seen},
                                       {"height", ViewshedMode::height},
                                       {"horizon", ViewshedMode::horizon},
                                       {"count", ViewshedMode::count},
                                       {"server", ViewshedMode::server}}))
      ->type_name("MODE");
  fieldOfView.addTo(command);
  sight.addLonLatTo(command);
  sight.addNodataTo(command);
  addTerrainErrorTo(command, maxError,
                    "Stop refining at this error; samples that it leaves open are undecided", false);
  command.add_option("--method", method, "auto (default), sweep or rays; all give the same answer")
      ->transform(oneOf<ViewshedMethod>({{"auto", ViewshedMethod::automatic},
                                         {"sweep", ViewshedMethod::sweep},
                                         {"rays", ViewshedMethod::rays}}))
      ->type_name("METHOD");
  sight.addEarthTo(command);
}

Status ViewshedArguments::check() const {
  // Observers may be typed, come from a file, or both, so neither option is required by itself.
  if (observers.typed.empty() && observers.file.empty())
    return failure(ErrorCode::usage, "--observer or --observers is required");
  if (output.empty() && polygons.empty() && png.empty())
    return failure(ErrorCode::usage, "--output is required, or --polygons or --png");
  if (!png.empty() && text::lowerExtension(png) != "png")
    return failure(ErrorCode::usage, "a picture ends in .png", "--png " + png);
  if (!polygons.empty() && text::lowerExtension(polygons) != "gpkg")
    return failure(ErrorCode::usage, "polygons are a GeoPackage and end in .gpkg", "--polygons " + polygons);
  if (!polygons.empty() && (mode == ViewshedMode::height || mode == ViewshedMode::horizon))
    return failure(ErrorCode::usage, "requires answers or numbers of observers: --mode seen, count or server",
                   "--polygons " + polygons);
  if (!output.empty() && !isGeoTiffName(output))
    return failure(
        ErrorCode::usage,
        "a viewshed is a GeoTIFF and ends in .tif or .tiff; --polygons writes a GeoPackage, --png a picture",
        "--output " + output);
  if (method == ViewshedMethod::sweep && isAboveZero(maxError))
    return failure(ErrorCode::usage, "cannot be combined with --max-error", "--method sweep");
  return {};
}

Result<ViewshedOptions> ViewshedArguments::options() const {
  ARETE_TRY(const ViewshedField field, fieldOfView.field());
  ViewshedOptions options;
  options.nodata = sight.nodata;
  options.method = method;
  options.field = field;
  // Counts and servers need only what is seen, so these modes compute no values of cells.
  options.value = mode == ViewshedMode::height    ? ViewshedValue::leastHeight
                  : mode == ViewshedMode::horizon ? ViewshedValue::horizon
                                                  : ViewshedValue::none;
  return options;
}

std::string_view toString(ViewshedMode mode) {
  switch (mode) {
    case ViewshedMode::height:
      return "height";
    case ViewshedMode::horizon:
      return "horizon";
    case ViewshedMode::count:
      return "count";
    case ViewshedMode::server:
      return "server";
    default:
      return "seen";
  }
}

bool ViewshedArguments::isOfOne(std::size_t observerCount) const {
  return observerCount == 1 && mode != ViewshedMode::count && mode != ViewshedMode::server;
}

}  // namespace arete
