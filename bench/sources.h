// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete::bench {

/// A DEM to measure on.
struct DemSource {
  std::string name;
  std::string path;                ///< as readDem() takes it
  std::vector<double> tolerances;  ///< in its vertical unit, rising: what the cuts are taken at
  std::uint32_t side = 0;          ///< generated: samples along a side; 0 = real
  bool hasLake = true;             ///< generated: a lake of NODATA
  bool isScattered = false;        ///< generated: points, as many as the raster has samples
};

/// Of generated terrain with more samples along a side there is no fidelity model and there are no points: a
/// run would take too long.
inline constexpr std::uint32_t kLargestInFull = 2000;

/// Triangles that the best greedy insertion leaves at a tolerance, and the DEM they were counted on.
struct GreedyBaseline {
  std::string dem;
  double tolerance = 0;
  std::uint32_t triangles = 0;
};

/// The table of bench/baselines.json. Errors: notFound, corrupt.
Result<std::vector<GreedyBaseline>> readBaselines(const std::string& path);

/// Where the real data is: $ARETE_DATA, else shared/data beside the repository; empty if nowhere.
std::string dataFolder();

/// The real DEMs that are there.
std::vector<DemSource> realDems(const std::string& folder);

/// Generated terrain of about `millions` of samples, a power of two and one along a side where it can be:
/// 1, 4 and 16 give 1025, 2049 and 4097. Its file, in `scratch`, is made by generateDem().
DemSource generatedDem(double millions, const std::string& scratch);

/// The same terrain without its lake: no voids. A real DEM stays as it is.
DemSource withoutLake(const DemSource& source);

/// A generated terrain without its lake, as points at random places, in no order: what lidar leaves of it.
DemSource scattered(const DemSource& source);

/// Makes the file of a generated source where it is not there. Errors: those of the generator and the writer.
Status generateDem(const DemSource& source);

/// Errors: those of readDem(); unsupported for scattered points.
Result<RasterHeightfield> readField(const DemSource& source);

/// A model that this very run has written: nothing of it is checked. Errors: those of loadAmt().
Result<TerrainModel> loadModel(const std::string& path);

}  // namespace arete::bench
