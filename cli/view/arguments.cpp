// SPDX-License-Identifier: GPL-3.0-or-later
//
// Declares the options of `arete view` group by group. CLI11 states which options need or exclude each other;
// check() has the rules that depend on an option's value, or on one of several options.
#include "cli/view/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/criterion.h"
#include "io/files/text_scan.h"
#include "viewer/headless/headless.h"
#include "viewer/inks/triangle_inks.h"

namespace arete {
namespace {

constexpr std::int64_t kMostTriangles = 0xFFFFFFF;

Result<Sun> readSun(const std::string& sun) {
  const auto angles = twoNumbers("--sun", sun, ',');
  if (!angles || !(angles->second >= 0 && angles->second <= 90) || !std::isfinite(angles->first))
    return failure(ErrorCode::usage, "must be AZIMUTH,ELEVATION, with an elevation from 0 to 90 degrees",
                   "--sun " + sun);
  return Sun{angles->first, angles->second};
}

}  // namespace

void ViewpointArguments::addTo(CLI::App& command, OptionKinds& kinds) {
  const std::string group = "Viewpoint";
  CLI::Option* place =
      command
          .add_option("--camera", camera,
                      "Position of the camera, H above the ground (agl) or in the DEM's heights (msl, ell); "
                      "its direction in degrees, clockwise from north and above the horizon; its vertical "
                      "field of view (default 60). Of a surface: the eye, what it looks at, field of view")
          ->type_name("X,Y,H[,AZIMUTH,PITCH[,FOV]] | X,Y,Z,TX,TY,TZ[,FOV]")
          ->group(group);
  kinds.ofTerrain(command.add_flag("--lonlat", isLonLat, "X,Y of --camera are longitude and latitude")
                      ->needs(place)
                      ->group(group));
  command.add_option("--home", home, "View of the whole terrain or surface (default overview)")
      ->check(oneOf({"overview", "above", "south", "west", "north", "east"}))
      ->excludes(place)
      ->type_name("NAME")
      ->group(group);
  command
      .add_flag("--parallel", isParallel,
                "Parallel (orthographic) projection, in which nothing is smaller far away")
      ->group(group);
  command
      .add_option("--parallel-height", parallelHeight,
                  "The same, with a picture so high: metres, or the unit of a surface")
      ->check(finiteBetween(1e-9, 1e12))
      ->type_name("H")
      ->group(group);
  CLI::Option* flight =
      command.add_option("--path", path, "Flight through the key frames of a file (docs/topics/flights.md)")
          ->type_name("FLIGHT.json")
          ->group(group);
  command.add_flag("--round", isRound, "Flight around the inside of the terrain; one turn around a surface")
      ->excludes(flight)
      ->group(group);
  kinds.ofSurfaces(command.add_option("--up", up, "Axis that points up (default: as its file says, else z)")
                       ->check(oneOf({"y", "z"}))
                       ->type_name("AXIS")
                       ->group(group));
  kinds.ofSurfaces(
      command
          .add_option("--turn", turn,
                      "Turns it about its middle, in degrees: clockwise seen from above, its front "
                      "upwards, its right side downwards")
          ->type_name("HEADING,PITCH,ROLL")
          ->group(group));
}

HomeView ViewpointArguments::homeView() const {
  // An empty name, the default, is the overview.
  for (const HomeView view : kHomeViews)
    if (toString(view) == home) return view;
  return HomeView::overview;
}

Result<Turn> ViewpointArguments::turnAngles() const {
  if (turn.empty()) return Turn{};
  const std::string culprit = "--turn " + turn;
  ARETE_TRY(const auto angles, parseNumbers(culprit, turn));
  if (angles.size() != 3)
    return failure(ErrorCode::usage, "must be HEADING,PITCH,ROLL: three angles in degrees", culprit);
  return Turn{angles[0], angles[1], angles[2]};
}

void ViewpointArguments::addBesideTo(CLI::App& command) {
  const std::string group = "Two models";
  CLI::Option* other =
      command
          .add_option(
              "--beside", beside,
              "Show another file of the same kind beside it, under the same camera, in the coordinates "
              "of both; error=E or triangles=N: it is drawn at this level, whatever the camera sees")
          ->type_name("FILE[,KEY=VALUE]")
          ->group(group);
  command
      .add_flag("--distances", hasDistances,
                "Of two surfaces: colour each by how far its vertices are from the other, at full resolution")
      ->needs(other)
      ->group(group);
}

void DetailArguments::addTo(CLI::App& command, OptionKinds& kinds) {
  const std::string group = "Detail";
  command.add_option("--pixel-error", pixelError, "Largest error in the picture, in pixels (default 1)")
      ->check(finiteAbove(0))
      ->type_name("P")
      ->group(group);
  command
      .add_option("--max-triangles", budget,
                  "Largest number of triangles, or N% of those of the finest triangulation; the error grows "
                  "to keep it")
      ->check(triangleBudgets())
      ->type_name("N")
      ->group(group);
  kinds.ofTerrain(
      command
          .add_option("--cut", cut,
                      "What computes the triangles to draw: the GPU (device, default) or the processor")
          ->check(oneOf({"device", "processor"}))
          ->type_name("NAME")
          ->group(group));
  command
      .add_option("--frame-time", frameTime,
                  "Longest time of a frame in the window; the error grows to keep it")
      ->check(finiteAbove(0))
      ->type_name("MS")
      ->group(group);
  kinds.ofTerrain(
      command
          .add_option("--deadline", deadline,
                      "Longest time of the processor's cut in a frame; the next frame continues it")
          ->check(finiteAbove(0))
          ->type_name("MS")
          ->group(group));
  command
      .add_option("--page-memory", pageMebibytes,
                  "Of a file in pages: MiB of pages in memory, which are read as the camera needs them "
                  "(default 64); 0: all of the model is read first")
      ->check(CLI::Range(std::int64_t(0), std::int64_t(1) << 20))
      ->type_name("MIB")
      ->group(group);
  command
      .add_option("--page-budget", pageKibibytes,
                  "Of a file in pages: KiB of pages that are read before a frame of --frames or --film at "
                  "most (default: as many as the frame needs)")
      ->check(CLI::Range(std::int64_t(1), std::int64_t(1) << 30))
      ->type_name("KIB")
      ->group(group);
  command.add_flag("--no-geomorph", isFixed, "Do not move new vertices gradually to their place")
      ->group(group);
}

Status DetailArguments::findBudget(std::uint64_t finest) {
  if (budget.empty()) return {};
  // A share is of the finest triangulation, so the number is known only once the model has been read.
  ARETE_TRY(const std::vector<StatedTriangles> stated, parseTriangleBudgets(budget, finest));
  if (stated.size() != 1) return failure(ErrorCode::usage, "takes one number", "--max-triangles");
  maxTriangles = std::min<std::int64_t>(stated.front().count, kMostTriangles);
  return {};
}

void DetailArguments::addBudgetTo(Json& json, std::uint64_t finest) const {
  if (maxTriangles == 0) return;
  json["maxTriangles"] = maxTriangles;
  json["finestTriangles"] = finest;
}

std::string DetailArguments::whatEndsTheCut() const {
  if (deadline > 0 && maxTriangles > 0) return "budget or the deadline";
  return deadline > 0 ? "deadline" : maxTriangles > 0 ? "budget" : "room on the device";
}

void AppearanceArguments::addTo(CLI::App& command, OptionKinds& kinds) {
  const std::string group = "Appearance";
  const CLI::Option* colors =
      command
          .add_option(
              "--color", color,
              "Colour by height (default), slope, aspect, plain or error; a surface by material (default), "
              "plain, error, charts (of its texture and parts), stretch (of the texture) or error:ATTRIBUTE "
              "(what the model states that it is off by: error:uv)")
          ->check([known = oneOf({"height", "slope", "aspect", "plain", "error", "material", "charts",
                                  "stretch", "error:ATTRIBUTE"})](const std::string& text) {
            std::string word = text;
            return word.size() > kErrorInk.size() && word.starts_with(kErrorInk) ? "" : known(word);
          })
          ->type_name("NAME")
          ->group(group);
  // Some colours exist for one kind of model alone; with the other kind they are refused.
  kinds.valuesOf(ModelKind::terrain, colors, {"height", "slope", "aspect"});
  kinds.valuesOf(ModelKind::surface, colors, {"material", "charts", "stretch", std::string(kErrorInk)});
  this->colors.addTo(command, group, kinds);
  CLI::Option* picture = kinds.ofTerrain(
      command
          .add_option("--drape", drapes,
                      "Georeferenced picture over the terrain, in any CRS; --color shows where it does not "
                      "reach. Several "
                      "lie over each other as stated, 4 at most with contours and filled areas; ,opacity=O "
                      "(0 to 1) lets "
                      "what is below shine through")
          ->allow_extra_args(false)
          ->type_name("FILE[,opacity=O]")
          ->group(group));
  kinds.ofTerrain(
      command
          .add_option("--drape-bands", drapeBands,
                      "Bands of the picture: one (grey) or red, green and blue (default: as the file says)")
          ->needs(picture)
          ->type_name("R,G,B")
          ->group(group));
  kinds.ofTerrain(
      command
          .add_option(
              "--layer", layers,
              "Points, lines or outlines of polygons over the terrain, of any vector file and CRS, as "
              "stated over each other. Keys: name of its layer, label (field), where (a condition of SQL), "
              "color (#rrggbb), width "
              "(pixels), opacity and fill of polygons (0 to 1), crs, title, height (ground; own: as the "
              "places state)")
          ->allow_extra_args(false)
          ->type_name("FILE[,KEY=VALUE]...")
          ->group(group));
  kinds.ofTerrain(command
                      .add_option("--contours", contours,
                                  "Interval of contour lines, in the DEM's unit of height or with a unit "
                                  "(default: none)")
                      ->transform(groundLength("--contours", contoursWithUnit))
                      ->check(finiteAbove(0))
                      ->type_name("H")
                      ->group(group));
  kinds.ofTerrain(
      command
          .add_option("--ground-memory", groundMebibytes,
                      "Graphics memory of the heights that colours and contours are read from, in MiB "
                      "(default 512); with less than all of them need, the finest are left out")
          ->check(CLI::Range(std::int64_t(1), std::int64_t(1) << 20))
          ->type_name("MIB")
          ->group(group));
  command.add_option("--sun", sun, "Direction of the sun in degrees, from the map's north (default 315,40)")
      ->type_name("AZIMUTH,ELEVATION")
      ->group(group);
  kinds.ofTerrain(command
                      .add_option("--haze", hazeKilometres,
                                  "Distance at which haze hides about two thirds, in kilometres or with a "
                                  "unit (default: no haze)")
                      ->transform(groundLength("--haze", hazeWithUnit, 1000))
                      ->check(finiteAbove(0))
                      ->type_name("KM")
                      ->group(group));
  kinds.ofTerrain(command.add_option("--exaggeration", exaggeration, "Factor of all heights (default 1)")
                      ->check(finiteBetween(1e-6, 1e6))
                      ->type_name("X")
                      ->group(group));
  kinds.ofTerrain(
      command.add_flag("--curvature", isCurved, "Draw the curvature of the Earth, by the CRS's ellipsoid")
          ->group(group));
  command
      .add_option("--show", marks,
                  "Marks in space among the models, with commas: axes (X red, Y green, Z blue, of the file), "
                  "grid (level, with round spacing), orbit (the centre that the camera turns about)")
      ->type_name("MARK,...")
      ->group(group);
  surface.addTo(command, group, kinds);
  command.add_flag("--wireframe", hasWireframe, "Draw the edges of the triangles")->group(group);
  command.add_flag("--unshaded", isUnshaded, "Draw without sunlight")->group(group);
  command
      .add_flag("--no-decorations", isPlainPicture,
                "Draw no legend, scale bar, north arrow and graticule over the picture")
      ->group(group);
}

Result<DrapeOptions> AppearanceArguments::drapeOptions() const {
  DrapeOptions options;
  if (drapeBands.empty()) return options;
  ARETE_TRY(const auto numbers, parseNumbers("--drape-bands", drapeBands));
  for (const double n : numbers) {
    // A picture is grey or has three colours, so two bands are an error.
    if (!(n >= 1 && n <= 65535 && n == std::floor(n)) || (numbers.size() != 1 && numbers.size() != 3))
      return failure(ErrorCode::usage, "must be one band (grey) or three (red, green, blue), counted from 1",
                     "--drape-bands " + drapeBands);
    options.read.bands.push_back(static_cast<int>(n));
  }
  return options;
}

bool AppearanceArguments::hasInk() const {
  return color == "charts" || color == "stretch" || color.starts_with(kErrorInk);
}

Result<ViewLook> AppearanceArguments::look(std::span<const Coloring> colorings) const {
  // OptionKinds has refused the colours of the other kind of model.
  const auto stated = std::ranges::find(colorings, color, [](Coloring c) { return toString(c); });
  ViewLook look;
  look.coloring = stated == colorings.end() ? colorings.front() : *stated;
  if (hasInk()) {
    look.coloring = Coloring::ink;
    look.ink = color;
  }
  look.isShaded = !isUnshaded;
  look.hazeKilometres = hazeKilometres;
  look.hasWireframe = hasWireframe;
  ARETE_TRY(look.surface, surface.look());
  if (sun.empty()) return look;
  ARETE_TRY(look.sun, readSun(sun));
  return look;
}

Result<SpaceMarks> AppearanceArguments::spaceMarks() const {
  SpaceMarks shown;
  if (marks.empty()) return shown;
  static constexpr std::array<std::string_view, 3> kMarks{"axes", "grid", "orbit"};
  ARETE_TRY(const auto words, wordsOf("--show", marks, kMarks));
  shown.axes = words.contains("axes");
  shown.grid = words.contains("grid");
  shown.orbit = words.contains("orbit");
  return shown;
}

void PictureArguments::addTo(CLI::App& command) {
  const std::string group = "Pictures";
  // What writes pictures draws without a window. What describes a flight's pictures needs --frames or --film.
  command
      .add_flag("--headless", isHeadless,
                "Draw without a window or display; --screenshot, --frames and --film do")
      ->group(group);
  command.add_option("--size", sizeText, "Size of the picture or window in pixels (default 1280x720)")
      ->type_name("WxH")
      ->group(group);
  command.add_option("--samples", samples, "Samples of each pixel, for smooth edges (default 4)")
      ->check(wholeNumber(1, 32))
      ->type_name("N")
      ->group(group);
  command.add_option("--screenshot", screenshot, "Write one picture")->type_name("FILE.png")->group(group);
  command.add_option("--frames", frames, "Write the pictures of the flight")
      ->type_name("FOLDER")
      ->group(group);
  command.add_option("--fps", framesPerSecond, "Pictures per second (default: the flight's)")
      ->check(finiteBetween(0.001, 1000))
      ->type_name("N")
      ->group(group);
  command
      .add_option("--film", film, "Make a film of the flight with ffmpeg; without --frames no picture stays")
      ->type_name("FILE.mp4")
      ->group(group);
  command.add_option("--figures", figures, "Write triangles, tolerance and times of each frame")
      ->type_name("FILE.json")
      ->group(group);
  // Hidden: what other commands call their file, answered by check().
  command.add_option("-o,--output", output)->type_name("FILE")->group("");
  // Hidden: pictures of the window itself.
  command.add_option("--window-screenshot", windowScreenshot)->group("");
  command.add_option("--window-frames", windowFrames)->group("");
  command.add_option("--window-script", windowScript)->group("");
}

Result<std::pair<int, int>> PictureArguments::size() const {
  if (sizeText.empty()) return std::pair(1280, 720);
  const auto size = twoNumbers("--size", sizeText, 'x');
  const auto isSide = [](double n) { return n >= 1 && n <= 1e6 && n == std::floor(n); };
  if (!size || !isSide(size->first) || !isSide(size->second))
    return failure(ErrorCode::usage, "must be WIDTHxHEIGHT, as in 1280x720", "--size " + sizeText);
  return std::pair(static_cast<int>(size->first), static_cast<int>(size->second));
}

void ViewArguments::addTo(CLI::App& command) {
  command
      .add_option(
          "FILE", model,
          "Multitriangulation (.amt), or a DEM, points or a mesh, of which the model is built in memory\n"
          "as 'arete build' builds it by default")
      ->required()
      ->type_name("");
  viewpoint.addTo(command, kinds);
  viewpoint.addBesideTo(command);
  detail.addTo(command, kinds);
  appearance.addTo(command, kinds);
  pictures.addTo(command);
}

// The folder of the pictures of a film alone is made by the command, which removes it at its end.
Status ViewArguments::completePictures() {
  PictureArguments& p = pictures;
  if (!p.output.empty())
    return failure(
        ErrorCode::usage,
        "does not exist here: --screenshot FILE.png writes a picture, --frames FOLDER the pictures "
        "of a flight, --film FILE.mp4 a film",
        "--output " + p.output);
  const bool hasFlightPictures = !p.frames.empty() || !p.film.empty();
  for (const auto& [option, isStated] :
       {std::pair{"--fps", p.framesPerSecond > 0}, {"--figures", !p.figures.empty()}})
    if (isStated && !hasFlightPictures)
      return failure(ErrorCode::usage, "requires --frames FOLDER or --film FILE.mp4", option);
  p.isHeadless = p.isHeadless || hasFlightPictures || !p.screenshot.empty();
  if (p.isHeadless && detail.frameTime > 0)
    return failure(ErrorCode::usage, "is for the window, and pictures are drawn without one", "--frame-time");
  return {};
}

Status ViewArguments::check() const {
  const auto refuse = [](const char* sentence, const std::string& option) {
    return failure(ErrorCode::usage, sentence, option);
  };
  const PictureArguments& p = pictures;
  if (viewpoint.statesParallel() && viewpoint.hasFlight())
    return refuse("is for a view without a flight; key frames state their own projection",
                  viewpoint.isParallel ? "--parallel" : "--parallel-height");
  if (viewpoint.statesParallel() && appearance.isCurved)
    return refuse("is drawn in perspective only", "--curvature");
  if (detail.deadline > 0 && !detail.isCutByProcessor())
    return refuse("requires --cut processor", "--deadline");
  if (p.isHeadless && p.screenshot.empty() && p.frames.empty() && p.film.empty())
    return refuse("requires --screenshot FILE.png, --frames FOLDER or --film FILE.mp4", "--headless");
  if (!p.screenshot.empty() && text::lowerExtension(p.screenshot) != "png")
    return refuse("a picture ends in .png", "--screenshot " + p.screenshot);
  if ((!p.frames.empty() || !p.film.empty()) && !viewpoint.hasFlight())
    return refuse("requires --path FLIGHT.json or --round",
                  p.frames.empty() ? "--film " + p.film : "--frames " + p.frames);
  if (p.isHeadless && p.screenshot.empty() && viewpoint.statesCamera())
    return refuse("requires --screenshot; the frames of a flight have cameras of their own",
                  viewpoint.home.empty() ? "--camera " + viewpoint.camera : "--home " + viewpoint.home);
  if (!appearance.sun.empty()) ARETE_CHECK(readSun(appearance.sun));
  ARETE_CHECK(appearance.surface.look());
  ARETE_CHECK(appearance.drapeOptions());
  ARETE_TRY(const SpaceMarks marks, appearance.spaceMarks());
  if (marks.orbit && p.isHeadless && p.screenshot.empty())
    return refuse("orbit requires --screenshot; a flight turns about nothing", "--show " + appearance.marks);
  if (p.film.empty()) return {};
  // Drawing may take hours: a film that cannot be made is refused first.
  if (Status can = canEncodeFilm(p.film); !can)
    return failure(can.error().code, can.error().message, "--film " + p.film);
  return {};
}

Result<ViewSettings> ViewArguments::settings(std::span<const Coloring> colorings) const {
  ViewSettings s;
  ARETE_TRY(s.look, appearance.look(colorings));
  s.pixels = detail.pixelError;
  s.path = detail.isCutByProcessor() ? CutPath::processor : CutPath::device;
  s.cutMilliseconds = detail.deadline;
  s.isGeomorphed = !detail.isFixed;
  s.stretch = appearance.exaggeration;
  s.isCurved = appearance.isCurved;
  return s;
}

}  // namespace arete
