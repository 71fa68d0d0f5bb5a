// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/build_options.h"
#include "engine/cut/error_curve.h"
#include "terrain/model/source_reading.h"

namespace arete {

struct DemoOptions {
  std::string folder;             ///< made where it is not there, with those above it
  SourceReading reading;          ///< how to read the DEM
  BuildOptions build;             ///< the default features are added to its fixed vertices
  std::vector<double> maxErrors;  ///< in the DEM's vertical unit
  std::vector<double>
      reliefShares{};  ///< more tolerances, in % of the relief; without both: chosen from the data
  std::size_t mostTolerances = 5;  ///< of those chosen, at least 1
  int pictureWidth = 1600;         ///< pixels
  bool isDecorated = true;         ///< pictures have legend, scale bar, north arrow and graticule
};

/// One tolerance, the TIN that keeps it, and what an independent measurement says of it.
struct DemoResult {
  double maxError = 0;
  double percentOfRelief = 0;  ///< of the tolerance
  std::uint32_t triangles = 0;
  double percentOfFinest = 0;
  double measuredMax = 0;
  double measuredRms = 0;
  double measuredMean = 0;      ///< TIN minus DEM
  std::uint64_t uncovered = 0;  ///< valid samples in no triangle, isolated ones not counted
  double cutSeconds = 0;        ///< of the minimal cut alone
  bool isKept = false;          ///< checkPromise() of the measurement
};

struct DemoReport {
  std::string dem;
  std::uint32_t columns = 0, rows = 0;
  std::string unit;   ///< of the heights; may be empty
  double relief = 0;  ///< the highest minus the lowest sample
  std::uint32_t finestTriangles = 0;
  std::uint64_t isolated = 0;
  double buildSeconds = 0;
  double totalSeconds = 0;
  std::vector<DemoResult> results;  ///< by rising tolerance
  std::vector<CurvePoint> curve;    ///< triangles over the whole range of tolerances
  std::vector<std::string> files;   ///< in the order in which they were written
  Warnings warnings;                ///< of reading the DEM
};

/// All of Arete on one DEM: reads it, builds, writes the .amt, takes minimal cuts at several tolerances,
/// writes each as PLY with its certificate, measures each from the mesh alone, and draws pictures: TINs over
/// the relief, a map of the errors, triangles against tolerance, a viewshed, a view of the terrain. Files of
/// the same names are replaced.
///
/// Errors: unsupported for scattered points (the pictures are maps of rasters); usage for a tolerance that is
/// negative or no number; brokenPromise when a TIN does not keep its tolerance, after everything was written;
/// those of reading, building and writing; interrupted.
Result<DemoReport> runDemo(const std::string& dem, const DemoOptions& options,
                           const RunContext& context = {});

/// The results as a table for a terminal: a heading, then one line per tolerance, columns aligned and
/// separated by two blanks or more.
std::string demoTable(const DemoReport& report);

}  // namespace arete
