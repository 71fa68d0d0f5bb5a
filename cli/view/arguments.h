// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments/option_kinds.h"
#include "cli/session/session.h"
#include "cli/view/colors.h"
#include "cli/view/surface_look.h"
#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "viewer/camera/home_view.h"
#include "viewer/gl/drape_on_gpu.h"
#include "viewer/marks/space_marks.h"
#include "viewer/scene/subject.h"

namespace arete {

// The options of `arete view`, one struct for each group of its help. addTo() declares them on the command.

/// Where the picture is taken from.
struct ViewpointArguments {
  std::string camera;         ///< "X,Y,H[,AZIMUTH,PITCH[,FOV]]"; empty = `home`
  std::string home;           ///< name of a view of the whole terrain; empty = overview
  std::string path;           ///< file of a flight; empty = none
  std::string up;             ///< of a surface: the axis that points up; empty: as the file says
  std::string beside;         ///< another file of the same kind, drawn beside it; empty: none
  bool hasDistances = false;  ///< the two are coloured by how far each is from the other
  std::string turn;           ///< of a surface: "HEADING,PITCH,ROLL"; empty: as it is
  bool isLonLat = false, isRound = false, isParallel = false;
  double parallelHeight = 0;  ///< of a parallel picture; 0: as the view of the whole, or what is ahead, takes

  void addTo(CLI::App& command, OptionKinds& kinds);
  void addBesideTo(CLI::App& command);
  bool statesCamera() const { return !camera.empty() || !home.empty(); }
  HomeView homeView() const;
  /// Errors: usage: not three numbers.
  Result<Turn> turnAngles() const;
  bool statesParallel() const { return isParallel || parallelHeight > 0; }
  bool hasFlight() const { return !path.empty() || isRound; }
};

/// How fine the terrain is drawn. Times in milliseconds; 0 = no limit.
struct DetailArguments {
  double pixelError = 1, frameTime = 0, deadline = 0;
  std::string budget;               ///< as stated: a number, or a share of the finest; empty = any number
  std::int64_t maxTriangles = 0;    ///< 0 = any number
  std::string cut;                  ///< empty: device
  bool isFixed = false;             ///< no geomorphing
  std::int64_t pageMebibytes = 64;  ///< of packed pages in memory; 0: all of the model is read at once
  std::int64_t pageKibibytes =
      0;  ///< of pages that are read before a frame of a flight; 0 = as many as it needs

  void addTo(CLI::App& command, OptionKinds& kinds);
  /// Sets maxTriangles, of a model whose finest triangulation has so many. Errors: usage.
  Status findBudget(std::uint64_t finest);
  /// Adds "maxTriangles" and "finestTriangles", of which it may be a share, where a budget is stated.
  void addBudgetTo(Json& json, std::uint64_t finest) const;
  /// What can end a cut before it reaches the tolerance, as words of a message: "budget or the deadline".
  std::string whatEndsTheCut() const;
  bool isCutByProcessor() const { return cut == "processor"; }
};

/// Colours, light, and the image draped over the terrain.
struct AppearanceArguments {
  std::string color, sun, drapeBands;       ///< empty color: by height, of a surface by material
  std::vector<std::string> drapes, layers;  ///< the lowest first: FILE[,KEY=VALUE]... (layer_argument.h)
  double contours = 0, hazeKilometres = 0, exaggeration = 1;
  std::int64_t groundMebibytes = 512;          ///< of heights on the device
  std::string contoursWithUnit, hazeWithUnit;  // "OPTION TEXT"; then contours are in metres
  bool hasWireframe = false, isUnshaded = false, isCurved = false;
  bool isPlainPicture = false;  ///< without legend, scale bar, north arrow and graticule
  std::string marks;            ///< axes, grid, orbit: a list with commas; empty: none of them
  ColorArguments colors;
  SurfaceLookArguments surface;

  void addTo(CLI::App& command, OptionKinds& kinds);
  /// Whether the colours are of triangles, and computed (viewer/inks).
  bool hasInk() const;
  /// Which bands of the drape to show. Errors: usage: not one or three band numbers, which count from 1.
  Result<DrapeOptions> drapeOptions() const;
  /// @param colorings of the model, the usual one first.
  /// Errors: usage: `sun` is not two angles; as SurfaceLookArguments::look().
  Result<ViewLook> look(std::span<const Coloring> colorings) const;
  /// Errors: usage: a word that no mark has.
  Result<SpaceMarks> spaceMarks() const;
};

/// Pictures and films, and the size of the window.
struct PictureArguments {
  bool isHeadless = false;
  std::string sizeText, screenshot, frames, film, figures;
  bool dropsFrames = false;    ///< the pictures of the flight are for the film alone
  std::string output;          ///< of --output, which other commands have
  double framesPerSecond = 0;  ///< 0 = the rate that the flight states
  int samples = 4;
  std::string windowScreenshot;  ///< for tests: the last picture of the window
  int windowFrames = 0;          ///< for tests: the window closes after this many frames; 0 = never
  std::string windowScript;      ///< for tests: lines that window_script.h reads

  void addTo(CLI::App& command);
  /// @return width and height in pixels; 1280 x 720 where no size is given. Errors: usage.
  Result<std::pair<int, int>> size() const;
};

struct ViewArguments {
  std::string model;
  ViewpointArguments viewpoint;
  DetailArguments detail;
  AppearanceArguments appearance;
  PictureArguments pictures;
  OptionKinds kinds;

  void addTo(CLI::App& command);
  /// Takes what writes pictures as --headless. Errors: usage, naming the option.
  Status completePictures();
  /// The rules between options that CLI11 cannot state. Errors: usage, naming the option; unsupported: a film
  /// without ffmpeg.
  Status check() const;
  /// @param colorings as look() takes them. Errors: usage.
  Result<ViewSettings> settings(std::span<const Coloring> colorings) const;
};

}  // namespace arete
