// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"
#include "io/query/certificate/surface.h"
#include "io/query/request/extract_request.h"
#include "io/query/surface/changes_of_cut.h"
#include "io/query/surface/take_surface.h"
#include "surface/model/surface_model.h"

namespace arete {

/// What extract() made of a request to a surface. Distances are in the unit of the source.
struct ExtractedSurface {
  std::uint64_t triangles = 0, vertices = 0;
  std::uint64_t finestTriangles = 0;  ///< of the model
  double diagonal = 0;                ///< of the model
  double storedError = 0;             ///< of the cut, as stored
  double movedByGrid = 0;  ///< of a packed file: the farthest that it moves a point; part of `error`
  double error = 0;        ///< no point of the source is farther (but what is left out), also after a fit
  bool isComplete = true;  ///< false: a budget or a deadline ended the cut before the criterion was met
  bool isDisplaced = false;
  bool boundsLines = false;                      ///< SurfaceModel::boundsLines
  std::optional<double> pixels;                  ///< with a camera: the worst error in its picture
  std::uint64_t crossings = 0;                   ///< pairs of triangles that cross
  std::optional<std::uint64_t> sourceCrossings;  ///< of the source, where any request had some
  std::optional<FitOutcome> fit;
  std::vector<AttributeRms> movedAttributes;  ///< by a fit or a displacement; of those that are written
  double leftByRounding = 0;                  ///< TakenSurface::leftByRounding
  std::optional<std::uint64_t> droppedComponents, droppedFaces;  ///< where components may be left out
  std::optional<double> droppedDistance;          ///< the farthest that what is left out is from the result
  std::optional<double> otherWay;                 ///< the farthest that the result is from the source
  std::vector<AttributeChange> attributeChanges;  ///< changesOfCut(); of those that are written
  std::vector<AttributeNumber> attributeErrors;   ///< TakenSurface::attributeErrors
  std::optional<TakenSurface::OfImportance> importance;
  double movedByFloats = 0;  ///< of a PLY with doubles of a source that states no frame (convert.h)
  double promisedError = 0;  ///< the tolerance, or what a budget, a deadline, a place or a fit came to
  MeshWriteReport written;
  std::optional<SurfaceMeasure> measured;  ///< where a certificate is written
  bool isKept = true;                      ///< false: the measurement contradicts the promise
};

/// Takes meshes from one surface and writes them. Keeps what several requests need.
class SurfaceExtractor {
 public:
  /// How to check an export that promises this distance, with as many samples, as text.
  using CheckCommand =
      std::function<std::string(const ExtractRequest&, double promisedError, std::uint64_t samples)>;

  /// The whole model, where the one that cuts are taken of is a part.
  using ReadWhole = std::function<Result<SurfaceModel>()>;

  /// @param modelPath     the file's name, for certificates
  /// @param checkCommand  the `check` of certificates; empty = an empty text
  /// @param readWhole     is called once where a part does not do: to count what crosses in the source
  /// Precondition: the model outlives this.
  explicit SurfaceExtractor(const SurfaceModel& model, std::string modelPath = {},
                            CheckCommand checkCommand = {}, ReadWhole readWhole = {});

  /// Takes the cut (takeSurface()), writes the mesh and what else is asked for, and measures what is asked to
  /// be measured. With a certificate the file is read back and measured against the source, by code that
  /// shares nothing with the build. The files appear whole and together, or none.
  /// Errors: as takeSurface(), writeMesh(), dropAttributes() (usage, culprit "dropAttributes" and the
  /// name), FileWriter; outOfMemory. O(front) and, to find crossings, O(front log front); O(source) where the
  /// source is measured.
  Result<ExtractedSurface> extract(const ExtractRequest& request, const RunContext& context = {});

 private:
  Result<const TriangleMesh*> finest();
  Status dropFor(const CutRequest& request);
  const DroppedComponents* dropped() const { return dropped_ ? &*dropped_ : nullptr; }
  Status write(const ExtractRequest& request, TakenSurface& taken, ExtractedSurface& result,
               const RunContext& context);
  /// @param reserve Taken off the tolerance.
  Result<ExtractedSurface> extractWithin(const ExtractRequest& request, double reserve,
                                         const RunContext& context);
  Status writeMap(const ExtractRequest& request, const TakenSurface& taken) const;
  Status measure(const ExtractRequest& request, const TakenSurface& taken, const TriangleMesh& mesh,
                 const MeshFrame& frame, ExtractedSurface& result, const RunContext& context);
  Result<double> distanceFrom(const TriangleMesh& mesh, const TriangleMesh& other,
                              const RunContext& context) const;

  const SurfaceModel& model_;
  std::string modelPath_;
  CheckCommand checkCommand_;
  ReadWhole readWhole_;
  double leastDiagonal_ = 0;  // of dropped_
  std::optional<DroppedComponents> dropped_;
  std::optional<TriangleMesh> finest_;
  std::optional<std::uint64_t> sourceCrossings_;
};

}  // namespace arete
