// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/exchange/placed_mesh.h"
#include "io/query/request/cut_request.h"
#include "terrain/measure/measure.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What the file of an export holds, and what its format cannot hold.
struct ExportFormat {
  std::string name;                ///< "STL"
  MeshFrame frame = {};            ///< the frame of its coordinates
  double heightRounding = 0;       ///< the largest change of a height by the format's numbers
  double planTolerancePixels = 0;  ///< within which a sample counts as covered; 0 = a raster, not a mesh
  bool saysCrs = false, saysVerticalUnit = false, saysErrors = false;
};

/// Figures of the cut that a fit started from.
struct FitFigures {
  std::uint64_t trianglesBefore = 0;
  double errorBefore = 0;  ///< the largest error stored with its triangles
  double meanBefore = 0;   ///< mean z_TIN - z_sample of that cut
};

/// What an export promises, and how a third party can check it.
struct Certificate {
  std::string file;
  std::string model;  ///< the .amt it was taken from
  ExportFormat format;
  CutRequest criterion;
  bool isComplete = true;  ///< false: a budget or a deadline ended the cut before the criterion was met
  double storedError = 0;  ///< of the cut: the largest error of its triangles, as stored or as fitted
  std::optional<FitFigures> fit;             ///< where heights were fitted
  std::optional<PlacedFigures> placed = {};  ///< where the mesh was led into another CRS or into metres
  MeasureReport measured;  ///< of the exported mesh, by terrain/measure/measure.h, against every sample
  std::optional<MeasureReport> measuredInside;  ///< against the samples in the region alone
  double promisedError = 0;                     ///< inside the region, where there is one
  bool isKept = false;                          ///< the measurement agrees
  std::string checkCommand;                     ///< repeats the measurement
};

/// The certificate as JSON, as docs/topics/certificate.md states it. O(1).
std::string certificateJson(const Certificate& certificate, const TerrainModel& model);

/// Writes the certificate as JSON. The file appears whole or not at all. Errors: as FileWriter.
Status writeCertificate(const std::string& path, const Certificate& certificate, const TerrainModel& model);

}  // namespace arete
