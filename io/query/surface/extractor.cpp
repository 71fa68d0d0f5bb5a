// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh is taken and written first; a certificate measures what the file holds against the finest surface
// of the model, which is the source as the build mended it. What is left out is measured apart.
#include "io/query/surface/extractor.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/files/output_file.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/grouped_faces.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/exchange/written_mesh.h"
#include "io/query/surface/map_file.h"
#include "measure/mesh_distance.h"
#include "surface/edit/drop_attributes.h"
#include "surface/front/face_map.h"
#include "surface/normals/made_normals.h"

namespace arete {
namespace {

MeshWriteOptions writeOptionsOf(const ExtractRequest& request, const SurfaceModel& model,
                                const TakenSurface& taken) {
  MeshWriteOptions options;
  options.crsWkt = model.crsWkt;
  options.verticalUnit = model.verticalUnit;
  // A glTF has them in a frame of its own, whose z is up.
  const Result<MeshFormat> format = meshFormatOf(request.output, request.format);
  const bool hasOwnFrame = format && format->holds.isYUp;
  // After a fit only the error of the whole mesh is known.
  if (!taken.fit && (!hasOwnFrame || model.up == "z")) options.triangleErrors = taken.front.errors;
  options.format = request.format;
  options.existing = request.existing;
  if (request.packedBits) options.packing = MeshPacking{.positionBits = *request.packedBits};
  options.up = model.up == "y" ? MeshUp::y : model.up == "z" ? MeshUp::z : MeshUp::unknown;
  return options;
}

}  // namespace

SurfaceExtractor::SurfaceExtractor(const SurfaceModel& model, std::string modelPath,
                                   CheckCommand checkCommand, ReadWhole readWhole)
    : model_(model),
      modelPath_(std::move(modelPath)),
      checkCommand_(std::move(checkCommand)),
      readWhole_(std::move(readWhole)) {}

Result<const TriangleMesh*> SurfaceExtractor::finest() {
  if (!finest_ && model_.finestOfWhole) {
    if (!readWhole_) return failure(ErrorCode::unsupported, "is a part of a model, and the source is needed");
    ARETE_TRY(const SurfaceModel whole, readWhole_());
    finest_ = finestSurfaceOf(whole).mesh.shape();
  }
  if (!finest_) finest_ = finestSurfaceOf(model_).mesh.shape();
  return &*finest_;
}

Status SurfaceExtractor::dropFor(const CutRequest& request) {
  if (request.dropParts == leastDiagonal_) return {};
  ARETE_TRY(auto dropped, componentsToDrop(model_, request));
  dropped_ = std::move(dropped);
  leastDiagonal_ = request.dropParts;
  return {};
}

Result<double> SurfaceExtractor::distanceFrom(const TriangleMesh& mesh, const TriangleMesh& other,
                                              const RunContext& context) const {
  ARETE_TRY(const double distance, farthestDistance(mesh, other, context));
  return distance + model_.positionError;  // one of the meshes is the source as it was before rounding
}

Status SurfaceExtractor::writeMap(const ExtractRequest& request, const TakenSurface& taken) const {
  std::vector<std::uint32_t> faces = facesOf(model_, taken.whole);
  for (std::uint32_t& face : faces)
    if (!taken.numberOf.empty() && face != MeshAttributes::kNone) face = taken.numberOf[face];
  ARETE_TRY(const MeshFormat format, meshFormatOf(request.output, request.format));
  renumberForFile(faces, trianglesOfFile(taken.front.mesh, format));
  const std::vector<std::uint32_t>& fileFace = model_.attributes.faceOf;
  return writeNumberMap(
      request.map,
      {.vertexOf = taken.front.vertexOf, .triangleFor = faces, .faceOfFile = [&](std::uint32_t f) {
         return std::uint64_t{fileFace.empty() ? f : fileFace[f]};
       }});
}

Status SurfaceExtractor::measure(const ExtractRequest& request, const TakenSurface& taken,
                                 const TriangleMesh& mesh, const MeshFrame& frame, ExtractedSurface& result,
                                 const RunContext& context) {
  ARETE_TRY(const TriangleMesh* const finest, this->finest());
  const TriangleMesh source = dropped_ ? finestWithout(model_, dropped()).mesh.shape() : *finest;
  const std::uint64_t samples = certificateSamples(source, mesh);
  ARETE_TRY(SurfaceMeasure measured, measureSurface(source, mesh, model_, request.criterion,
                                                    taken.whole.isComplete, samples, context));
  result.isKept = keepsPromise(measured, result.promisedError);
  result.measured = std::move(measured);
  ARETE_TRY(const MeshFormat format, meshFormatOf(request.output, request.format));
  SurfaceCertificate certificate{
      .file = request.output,
      .writtenAt = OutputGroup::placeOf(request.output).string(),
      .model = modelPath_,
      .formatName = std::string(format.name),
      .frame = frame,
      .holds = format.holds,
      .criterion = request.criterion,
      .isComplete = result.isComplete && result.leftByRounding == 0,
      .triangles = result.triangles,
      .vertices = result.vertices,
      .storedError = result.storedError,
      .promisedError = result.promisedError,
      .fit = std::nullopt,
      .droppedComponents = result.droppedComponents.value_or(0),
      .droppedFaces = result.droppedFaces.value_or(0),
      .measured = *result.measured,
      .isKept = result.isKept,
      .checkCommand = checkCommand_ ? checkCommand_(request, result.promisedError, samples) : ""};
  if (taken.fit)
    certificate.fit = {taken.fit->rmsBefore, taken.fit->rmsAfter, taken.cut.achievedError, taken.fit->part};
  return writeCertificate(request.certificate, certificate, model_);
}

Status SurfaceExtractor::write(const ExtractRequest& request, TakenSurface& taken, ExtractedSurface& result,
                               const RunContext& context) {
  OutputGroup together;
  const MeshWriteOptions options = writeOptionsOf(request, model_, taken);
  if (Status dropped = dropAttributes(taken.front.mesh, request.dropAttributes); !dropped) {
    if (dropped.error().code == ErrorCode::usage)
      dropped.error().culprit = "dropAttributes " + dropped.error().culprit;
    return dropped;
  }
  ARETE_CHECK(makeNormals(taken.front.mesh, request.normals));
  if (request.flipsV && !flipTextures(taken.front.mesh))
    return failure(ErrorCode::usage, "the surface has no texture coordinates", "flipV");
  if (request.packedBits && !request.criterion.attributeErrors.empty())
    return failure(ErrorCode::usage, "cannot be combined with `packed`, which rounds attributes",
                   "attributeErrors");
  if (request.packedBits && !request.criterion.importance.empty())
    return failure(ErrorCode::usage, "cannot be combined with `packed`, which moves points alike everywhere",
                   "importance");
  if (request.packedBits && !request.map.empty())
    return failure(
        ErrorCode::usage,
        "tells numbers of the file, whose order `packed` makes anew: write the map of the same cut without "
        "`packed`",
        "map");
  if (request.certificate.empty() && !request.packedBits) {
    ARETE_TRY(MeshWriteReport written, writeMesh(taken.front.mesh, request.output, options, context));
    result.written = std::move(written);
  } else {
    ARETE_TRY(WrittenMesh written,
              writeAndReadBack(taken.front.mesh, request.output, options, false, context));
    result.written = std::move(written.report);
    if (request.packedBits) {
      // Each point of a triangle moves by at most as much as its corners.
      result.movedByGrid = norm(written.frame.rounding);
      result.error += result.movedByGrid;
      result.promisedError = std::max(result.promisedError, result.error);
    }
    if (request.certificate.empty()) return together.commit();
    // Without an order of its own the file has the triangles of the mesh.
    const TriangleMesh& mesh = written.mesh ? *written.mesh : taken.front.mesh.shape();
    ARETE_CHECK(measure(request, taken, mesh, written.frame, result, context));
  }
  if (!request.map.empty()) ARETE_CHECK(writeMap(request, taken));
  return together.commit();
}

// What a grid moves is made good by a finer cut, where the tolerance leaves room.
Result<ExtractedSurface> SurfaceExtractor::extract(const ExtractRequest& request,
                                                   const RunContext& context) try {
  ARETE_TRY(ExtractedSurface first, extractWithin(request, 0, context));
  const std::optional<double>& tolerance = request.criterion.maxError;
  constexpr double kMore = 1.001;  // another cut has another box
  const double reserve = kMore * first.movedByGrid;
  if (first.movedByGrid == 0 || !tolerance || first.error <= *tolerance || reserve >= *tolerance ||
      !request.criterion.promisesMaxError(first.isComplete))
    return first;
  return extractWithin(request, reserve, context);
} catch (...) {
  return caughtFailure(request.output);
}

Result<ExtractedSurface> SurfaceExtractor::extractWithin(const ExtractRequest& request, double reserve,
                                                         const RunContext& context) {
  ARETE_CHECK(dropFor(request.criterion));
  CutRequest criterion = request.criterion;
  if (reserve > 0) *criterion.maxError -= reserve;
  ARETE_TRY(TakenSurface taken, takeSurface(model_, criterion, dropped(), context));
  ExtractedSurface result;
  result.finestTriangles = model_.finestTriangles();
  result.diagonal = model_.diagonal;
  result.boundsLines = model_.boundsLines;
  result.storedError = taken.cut.achievedError;
  result.error = taken.error;
  result.isComplete = taken.whole.isComplete;
  result.isDisplaced = taken.isDisplaced;
  result.pixels = taken.pixels;
  result.fit = taken.fit;
  // Packing rounds every attribute, and normals that are made anew are not the source's.
  if (!request.packedBits) result.attributeErrors = taken.attributeErrors;
  result.movedAttributes = taken.fit ? taken.fit->attributes : taken.displacedAttributes;
  const auto isLeftOut = [&](const auto& of) {
    if (request.normals.kind != NormalsKind::keep && of.name == kNormalName) return true;
    return std::ranges::any_of(request.dropAttributes, [&](const std::string& dropped) {
      return optionNameOf(dropped) == optionNameOf(of.name);
    });
  };
  std::erase_if(result.attributeErrors, isLeftOut);
  std::erase_if(result.movedAttributes, isLeftOut);
  result.leftByRounding = taken.leftByRounding;
  result.importance = taken.importance;
  result.triangles = taken.front.mesh.triangles.size();
  result.vertices = taken.front.mesh.positions.size();
  const bool isTolerance = request.criterion.promisesMaxError(taken.whole.isComplete) &&
                           !request.criterion.spaceRegion && taken.error <= *request.criterion.maxError;
  result.promisedError = isTolerance ? *request.criterion.maxError : taken.error;
  ARETE_TRY(const std::uint64_t crossings, crossingsOf(taken.front.mesh, context));
  result.crossings = crossings;
  if (crossings > 0 && !sourceCrossings_) {
    ARETE_TRY(const TriangleMesh* const finest, this->finest());
    ARETE_TRY(const std::uint64_t ofSource, crossingsOf(*finest, context));
    sourceCrossings_ = ofSource;
  }
  result.sourceCrossings = sourceCrossings_;
  if (dropped_) {
    result.droppedComponents = dropped_->count;
    result.droppedFaces = dropped_->sourceFaces;
  }
  ARETE_CHECK(write(request, taken, result, context));
  result.attributeChanges = changesOfCut(model_, taken);
  const Result<MeshFormat> format = meshFormatOf(request.output, request.format);
  const bool mayDouble =
      format && format->holds.statesScalarType && model_.up != "z" && model_.mt.vertices().places64.empty();
  if (mayDouble) result.movedByFloats = movedByFloats(taken.front.mesh);
  if (dropped_ && dropped_->count > 0) {
    ARETE_TRY(const double distance,
              distanceFrom(droppedSurface(model_, *dropped_), taken.front.mesh, context));
    result.droppedDistance = distance;
  }
  if (request.measuresBothWays) {
    ARETE_TRY(const TriangleMesh* const finest, this->finest());
    ARETE_TRY(const double distance, distanceFrom(taken.front.mesh, *finest, context));
    result.otherWay = distance + result.movedByGrid;
  }
  return result;
}

}  // namespace arete
