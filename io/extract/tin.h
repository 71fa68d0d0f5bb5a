// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "engine/base/result.h"
#include "engine/criteria/region.h"
#include "engine/parallel/run_context.h"
#include "io/exchange/export_tin.h"
#include "io/extract/certificate.h"
#include "terrain/measure/measure.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// One TIN to take from a model, and the files to write.
struct ExtractRequest {
  ExtractCriterion criterion;
  std::optional<Region> region;  ///< criterion.region in plan coordinates
  std::string output;       ///< a mesh by its extension, or .tif: the TIN sampled back on the source grid
  std::string certificate;  ///< JSON; empty = none
  std::string errorRaster;  ///< GeoTIFF of z_TIN - z_DEM; empty = none
};

struct ExtractedTin {
  std::uint64_t triangles = 0, vertices = 0;
  bool isComplete = true;         ///< false: a budget or a deadline came before the criterion was met
  std::optional<double> pixels;   ///< with a camera: the worst error in its picture
  double storedError = 0;         ///< largest error of the triangles of the cut, as stored or as fitted
  std::optional<FitFigures> fit;  ///< where heights were fitted
  double promisedError = 0;       ///< the tolerance, or what a budget came to; inside the region
  ExportFormat format;            ///< what the file holds
  std::optional<MeasureReport> measured;        ///< where a certificate or a raster asked for it
  std::optional<MeasureReport> measuredInside;  ///< with a region
  bool isKept = true;                           ///< false when the measurement contradicts the promise
};

/// The formats an output may have, and whether this is one; a .tif needs a model of a raster. Errors: usage,
/// naming the known extensions.
Status checkExtractOutput(const std::string& path, const TerrainModel& model);

/// Takes TINs from one model. Keeps the model's samples once a measurement needed them.
class TinExtractor {
 public:
  using ReadAll = std::function<Result<TerrainModel>(const RunContext&)>;

  /// Of a tolerance, what a model is read for beside it so that a format may round (readForExtract()).
  static constexpr double kReadReserve = 1.0 / 8;

  /// `modelPath` is named in certificates. `readAll`: the whole, where the model is a part, read once a
  /// format turns out to round by more than kReadReserve.
  TinExtractor(TerrainModel model, std::string modelPath, ReadAll readAll = {})
      : model_(std::move(model)), modelPath_(std::move(modelPath)), readAll_(std::move(readAll)) {}

  /// Cuts, exports (with a tolerance that is smaller by what the format rounds away, so that the promise
  /// holds for what the file says), and where heights were fitted or a raster or a certificate is wanted
  /// measures the exported mesh against the source's samples and writes it; each file appears whole or not at
  /// all. A promise that the measurement contradicts is told by isKept, the files are written all the same.
  /// Errors: those of takeCut(), writeMesh(), writeGeoTiff(), writeCertificate(). O(cut), and O(samples)
  /// where it is measured.
  Result<ExtractedTin> extract(const ExtractRequest& request, const RunContext& context = {});

 private:
  using Samples = std::variant<RasterHeightfield, PointHeightfield>;

  const Samples& samples();
  /// Sees to it that the model is enough for a tolerance that is smaller by `reserve`.
  Status deepen(double maxError, double reserve, const RunContext& context);
  /// Cut, or fitted, with a tolerance smaller than asked for by `reserve`.
  Result<TinExport> takeTin(const ExtractRequest& request, double reserve, ExtractedTin& tin,
                            const RunContext& context) const;
  /// `reserve`: for what the format will round away.
  Result<TriangleMesh> cutAndWrite(const ExtractRequest& request, double reserve, ExtractedTin& tin,
                                   const RunContext& context) const;
  Status measureAndWrite(const ExtractRequest& request, const TriangleMesh& mesh, ExtractedTin& tin,
                         const RunContext& context);
  Status writeRasters(const ExtractRequest& request, const MeasureRasters& rasters, ExtractedTin& tin,
                      const RunContext& context) const;

  TerrainModel model_;
  std::string modelPath_;
  ReadAll readAll_;
  std::optional<Samples> samples_;
};

/// The command that checks an export: `arete measure`, behind an `arete extract` where the export is no mesh.
std::string checkCommand(const ExtractRequest& request, const TerrainModel& model,
                         const std::string& modelPath, double promisedError);

}  // namespace arete
