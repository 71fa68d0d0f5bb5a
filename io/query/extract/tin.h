// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/criteria/region.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/placed_mesh.h"
#include "io/query/certificate/certificate.h"
#include "io/query/placed/measure_placed.h"
#include "io/query/request/extract_request.h"
#include "terrain/measure/measure.h"
#include "terrain/model/heightfield.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What extract() made of a request.
struct ExtractedTin {
  std::uint64_t triangles = 0, vertices = 0;
  bool isComplete = true;        ///< false: a budget or a deadline ended the cut before the criterion was met
  std::optional<double> pixels;  ///< with a camera: the worst error in its picture
  double storedError = 0;        ///< largest error of the triangles of the cut, as stored or as fitted
  std::optional<FitFigures> fit;          ///< where heights were fitted
  double promisedError = 0;               ///< the tolerance, or what a budget came to; inside the region
  ExportFormat format;                    ///< what the file holds
  std::optional<MeasureReport> measured;  ///< where a certificate, a raster or a fit needs it
  std::optional<MeasureReport> measuredInside;  ///< the same of the samples inside the region
  bool isKept = true;                           ///< false when the measurement contradicts the promise
  std::optional<PlacedFigures> placed;          ///< with ExtractRequest::place
  Warnings warnings;                            ///< of the coordinates of the file
  bool isRaster = false;                        ///< the source is a raster: samples have a column and a row
  /// Where the caller states shares: what they are of.
  std::optional<double> relief;
  std::optional<std::uint64_t> finestTriangles;
  TriangleMesh mesh = {};           ///< ExtractRequest::keepsMesh: as the file holds it
  std::vector<double> errors = {};  ///< with it, where a raster was measured: TIN minus DEM by sample, or NaN
};

/// Checks that an output's format, or else its extension, names a format that can be written; .tif needs a
/// model of a raster. Errors: usage: an unknown extension (the message lists the known ones), .tif for
/// scattered points.
Status checkExtractOutput(const std::string& path, const TerrainModel& model, const std::string& format = {});

/// Checks that a request's output can be written where ExtractRequest::place leads it. Errors: usage, naming
/// the field: a .tif, which is on the DEM's grid; as checkPlacing().
Status checkExtractPlace(const ExtractRequest& request);

/// Checks that an output can have the normals of a request. Errors: usage, culprit "normals": a
/// .tif; a mesh in degrees, or led elsewhere.
Status checkExtractNormals(const ExtractRequest& request, const TerrainModel& model);

/// The cut of a request, or its fit, as a mesh; nothing is written. Heights that were fitted promise nothing
/// before they are measured.
/// @param reserve  what the tolerance is reduced by
/// @param taken    the cut, where it is known
/// @param tin      receives the counts and errors of the TIN
/// Errors: those of takeCut() and of the fit (terrain/fit/fit.h).
Result<TinExport> takeTin(const TerrainModel& model, const CutRequest& criterion,
                          const std::optional<Region>& region, double reserve, std::optional<Cut> taken,
                          ExtractedTin& tin, const RunContext& context = {});

/// Takes TINs from one model and writes them. Keeps the model's samples once a measurement needed them.
class TinExtractor {
 public:
  using ReadAll = std::function<Result<TerrainModel>(const RunContext&)>;
  /// How to check an export that promises this error, as text.
  using CheckCommand = std::function<std::string(const ExtractRequest&, double promisedError)>;

  /// The share of a tolerance by which readForExtract() reads deeper, so that a format may round heights.
  static constexpr double kReadReserve = 1.0 / 8;

  /// @param model         the whole of a file's model, or the part that readForExtract() returns
  /// @param modelPath     the file's name, for certificates
  /// @param readAll       where the model is a part: reads the whole. Called at most once, when a format
  ///                      rounds heights by more than kReadReserve provides for.
  /// @param checkCommand  the `check` of certificates; empty = an empty text
  TinExtractor(TerrainModel model, std::string modelPath, ReadAll readAll = {},
               CheckCommand checkCommand = {})
      : TinExtractor(std::make_shared<const TerrainModel>(std::move(model)), std::move(modelPath),
                     std::move(readAll), std::move(checkCommand)) {}
  TinExtractor(std::shared_ptr<const TerrainModel> model, std::string modelPath, ReadAll readAll = {},
               CheckCommand checkCommand = {})
      : model_(std::move(model)),
        modelPath_(std::move(modelPath)),
        readAll_(std::move(readAll)),
        checkCommand_(std::move(checkCommand)) {}

  /// Takes the cut, exports it, and measures the exported mesh against the source's samples where heights
  /// were fitted or a raster or a certificate is to be written. The files appear whole and together, or none.
  /// Where a format rounds heights, the cut is taken again with a tolerance that is smaller by the rounding,
  /// so that the promise holds for the numbers in the file. A measurement that contradicts the promise is
  /// reported by isKept; the files are written all the same.
  /// Precondition: where the request states smooth normals, the model is whole, as readForExtract() reads
  /// it.
  /// @param taken  the cut of this request, of the extractor's model with the full tolerance, where
  ///               readForExtract() has taken it; it is used instead of a new one
  /// Errors: those of takeCut(), writeMesh(), writeGeoTiff(), writeCertificate(); outOfMemory. O(cut), and
  /// O(samples) where the mesh is measured.
  Result<ExtractedTin> extract(const ExtractRequest& request, const RunContext& context = {},
                               std::optional<Cut> taken = std::nullopt);

 private:
  using Samples = std::variant<RasterHeightfield, PointHeightfield>;

  const Samples& samples();
  /// Reads the whole model if the part is not enough for a tolerance smaller by `reserve`.
  Status deepen(double maxError, double reserve, const RunContext& context);
  /// takeTin(), written where the output is a mesh. Returns the mesh as the file holds it.
  void warnOfRim(int bits, ExtractedTin& tin) const;
  Result<TriangleMesh> cutAndWrite(const ExtractRequest& request, double reserve, std::optional<Cut> taken,
                                   ExtractedTin& tin, const RunContext& context);
  /// The TIN where the request has it, with its errors and its promise restated.
  /// @param bound  receives the largest error inside the region
  Result<PlacedMesh> lead(const ExtractRequest& request, const TinExport& exported, ExtractedTin& tin,
                          double& bound, const RunContext& context) const;
  /// A TIN with the normals of a request. Precondition: the model is whole.
  Result<SurfaceMesh> shade(const ExtractRequest& request, const TinExport& exported) const;
  Status measureAndWrite(const ExtractRequest& request, const TriangleMesh& mesh, ExtractedTin& tin,
                         const RunContext& context);
  Status writeRasters(const ExtractRequest& request, const MeasureRasters& rasters, ExtractedTin& tin,
                      const RunContext& context) const;

  std::shared_ptr<const TerrainModel> model_;
  std::string modelPath_;
  ReadAll readAll_;
  CheckCommand checkCommand_;
  std::optional<Samples> samples_;
  std::optional<TinPlace> place_;  ///< of the mesh that was written last, where it is not the source's
};

}  // namespace arete
