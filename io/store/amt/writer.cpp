// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of both kinds: each makes what no array of its model is, and the schema is written (model_writer.h).
// The arrays must have the sizes that the reader requires (amtShapeOf()), so that what is written can be
// opened.
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/cut/error_curve.h"
#include "io/store/amt/file.h"
#include "io/store/amt/finest_triangles.h"
#include "io/store/amt/model_writer.h"
#include "io/store/amt/surface_file.h"
#include "io/store/format/metadata.h"
#include "io/store/format/surface_metadata.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/surface/carried.h"
#include "io/store/packed/surface/displacement_bytes.h"
#include "io/store/packed/surface/source_numbers.h"
#include "surface/model/renumbered.h"
#include "surface/model/surface_model.h"
#include "terrain/model/relief.h"

namespace arete {
namespace {

/// What files of both kinds say of their MT.
Result<AmtSummary> summaryOf(const MultiTriangulation& mt, std::span<const double> tolerances,
                             const RunContext& context) {
  AmtSummary summary;
  summary.triangles = mt.triangleCount();
  summary.finestTriangles = mt.finestTriangleCount();
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
    summary.rootError = std::max(summary.rootError, mt.error(TriangleId(t)));
  ARETE_TRY(const auto curve, errorCurve(mt, tolerances, context));
  for (const CurvePoint& p : curve)
    summary.curve.push_back({p.maxError, double(p.minimalTriangles), double(p.saturatedTriangles)});
  return summary;
}

/// Writes one file of terrain.
class TerrainWriting {
 public:
  TerrainWriting(const std::string& path, const TerrainModel& model, const RunContext& context)
      : path_(path), model_(model), context_(context), file_(path, context) {}

  Status run(const AmtWriteOptions& options) {
    AmtMetadata metadata =
        amtMetadataOf(model_, options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
    if (options.isPaged) {
      ARETE_TRY(metadata.summary, summarized());
    }
    ARETE_CHECK(file_.describe(metadata));
    const VertexArrays& vertices = model_.mt.vertices();
    if (model_.isRaster != vertices.isLattice() || model_.columns != vertices.columns)
      return file_.chunks().refuse("its vertices are not of its grid");
    const bool isPacked = options.isPacked || options.isPaged;
    if (isPacked) ARETE_CHECK(pack(options.isPaged));
    // IsolatedSample has padding of undefined bytes, so its members are written as two arrays.
    for (const IsolatedSample& sample : model_.isolated) {
      isolatedSamples_.push_back(sample.sample);
      isolatedHeights_.push_back(sample.height);
    }
    file_.make(amt_tag::kIsolatedSamples, bytesOf(isolatedSamples_));
    file_.make(amt_tag::kIsolatedHeights, bytesOf(isolatedHeights_));
    AmtFacts facts = amtFactsOf(metadata);
    facts.isPacked = isPacked;
    facts.isPaged = options.isPaged;
    return file_.write(model_, facts);
  }

 private:
  Result<AmtSummary> summarized() const {
    ARETE_TRY(AmtSummary summary, summaryOf(model_.mt, toleranceLadder(model_.mt, kSummarySteps), context_));
    summary.relief = reliefOf(model_);
    return summary;
  }

  Status pack(bool isPaged) {
    Result<PackedMt> packed = packMt(model_, {isPaged}, context_);
    if (!packed) {
      if (packed.error().code == ErrorCode::interrupted) return file_.chunks().interrupted();
      return failure(packed.error().code, "the model cannot be packed: " + packed.error().message, path_);
    }
    packed_ = std::move(*packed);
    makePacked(packed_, file_);
    return {};
  }

  const std::string& path_;
  const TerrainModel& model_;
  const RunContext& context_;
  AmtModelWriter<TerrainModel> file_;
  PackedMt packed_;  // this and the next: what the chunks point to, beside the model
  std::vector<std::uint32_t> isolatedSamples_;
  std::vector<double> isolatedHeights_;
};

struct PackedModel {
  PackedSurfaceMt packed;
  SurfaceModel model;            ///< in the order of the packed MT: as a reader has it
  packed::CarriedBytes carried;  ///< of pages, without `ofPage`
};

/// Packs the MT, and takes the model in the order of the packed MT. Displacements stay as they are.
Result<PackedModel> packModel(const SurfaceModel& source, const SurfacePackOptions& options,
                              const RunContext& context) {
  const auto refuse = [](Error error) {
    if (error.code != ErrorCode::interrupted) error.message = "the model cannot be packed: " + error.message;
    return tl::unexpected(std::move(error));
  };
  PackedModel both;
  SurfaceMetadata metadata = amtMetadataOf(source, {});
  const auto describe = [&](const PackedSurfaceMt& packed) {
    metadata.hasDoubles = packed.hasDoubles;
    metadata.positionStep = packed.step;
    metadata.scale = packed.scale;
    metadata.model.positionError = source.positionError + packed.moved;
  };
  const auto inOrder = [&](const PackedSurfaceMt& packed, const MultiTriangulation& mt) {
    both.model = renumbered(source, mt, packed.order.vertexOf, packed.order.triangleOf);
    both.model.positionError += packed.moved;
  };
  const CarryInPages carry = [&](const PackedSurfaceMt& packed) -> Result<CarriedPages> {
    describe(packed);
    const PackedMt& bytes = packed.bytes;
    // The nodes carry nothing yet, which is as good a page.
    ARETE_TRY(UnpackedPages unpacked,
              unpackSurfaceMt(metadata, {bytes.directory, bytes.tables, bytes.blocks, bytes.nodes}, {},
                              context, {}));
    inOrder(packed, unpacked.mt);
    both.carried = packed::packCarried(both.model, unpacked.pages);
    return std::move(both.carried.ofPage);
  };
  Result<PackedSurfaceMt> packed =
      packSurfaceMt(source.mt, options, context, options.isPaged ? carry : CarryInPages());
  if (!packed) return refuse(packed.error());
  if (!options.isPaged) {
    describe(*packed);
    const PackedMt& bytes = packed->bytes;
    const Result<MultiTriangulation> mt =
        unpackSurfaceMt(metadata, bytes.directory, bytes.tables, bytes.nodes, context);
    if (!mt) return refuse(mt.error());
    inOrder(*packed, *mt);
  }
  packed->order = {};
  both.packed = std::move(*packed);
  return both;
}

/// Writes one file of a surface.
class SurfaceWriting {
 public:
  SurfaceWriting(const std::string& path, const SurfaceModel& model, const RunContext& context)
      : path_(path), source_(model), context_(context), file_(path, context) {}

  Status run(const SurfaceWriteOptions& options) {
    if (const Status valid = model().validate(); !valid) return file_.chunks().refuse(valid.error().message);
    const bool isPacked = options.isPacked || options.isPaged;
    if (isPacked) ARETE_CHECK(pack({options.positionBits, options.isPaged}));
    SurfaceMetadata metadata =
        amtMetadataOf(model(), options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
    metadata.positionStep = packed_.step;
    if (options.isPaged) {
      ARETE_TRY(metadata.summary, summaryOf(model().mt, sharesOfDiagonal(model()), context_));
      metadata.summary.rootError = model().mt.largestError();
    }
    ARETE_CHECK(file_.describe(metadata));
    AmtFacts facts = amtFactsOf(metadata);
    facts.isPacked = isPacked;
    facts.isPaged = options.isPaged;
    facts.hasDisplacement = !model().displacement.isEmpty();
    if (options.isPaged)
      file_.make(amt_tag::kPackedNumbers, bytesOf(carried_.tables));
    else if (isPacked)
      makePackedNumbers();
    else if (!facts.hasAllFaces)
      makeFinestFaces();
    makeLooks(options.isPaged);
    return file_.write(model(), facts);
  }

 private:
  const SurfaceModel& model() const { return packedModel_ ? *packedModel_ : source_; }

  Status pack(const SurfacePackOptions& options) {
    Result<PackedModel> both = packModel(source_, options, context_);
    if (!both) {
      if (both.error().code == ErrorCode::interrupted) return file_.chunks().interrupted();
      return failure(both.error().code, both.error().message, path_);
    }
    if (both->packed.moved > 0 && !source_.displacement.isEmpty())
      return file_.chunks().refuse(
          "has displacements of places that rounding moves: they are found again first");
    packed_ = std::move(both->packed);
    packedModel_ = std::move(both->model);
    carried_ = std::move(both->carried);
    makePacked(packed_.bytes, file_);
    return {};
  }

  void makePackedNumbers() {
    numbers_ = packed::packSourceNumbers(model());
    file_.make(amt_tag::kPackedNumbers, bytesOf(numbers_));
    if (model().displacement.isEmpty()) return;
    displacement_ = packed::packDisplacement(model().mt, model().displacement);
    file_.make(amt_tag::kPackedDisplacement, bytesOf(displacement_));
  }

  /// Coarse triangles inherit the faces of fine ones.
  void makeFinestFaces() {
    forFinest(model().mt, [&](std::uint32_t t) { finestFaces_.push_back(model().faceOf[t]); });
    file_.make(amt_tag::kFaceNumbers, bytesOf(finestFaces_));
  }

  /// @param isPaged the values of what triangles have are in the pages
  void makeLooks(bool isPaged) {
    looks_ = toLooksJson(model());
    values_ = isPaged ? std::move(carried_.rest) : attributeBytesOf(model());
    for (const EmbeddedPicture& picture : model().attributes.pictures)
      pictures_.insert(pictures_.end(), picture.bytes.begin(), picture.bytes.end());
    file_.make(amt_tag::kLooks, bytesOf(looks_));
    file_.make(amt_tag::kAttributes, bytesOf(values_));
    file_.make(amt_tag::kPictures, bytesOf(pictures_));
    if (isPaged) return;
    attributeErrors_ = attributeErrorCodesOf(model());
    if (!attributeErrors_.empty()) file_.make(amt_tag::kAttributeErrors, bytesOf(attributeErrors_));
  }

  const std::string& path_;
  const SurfaceModel& source_;
  std::optional<SurfaceModel> packedModel_;  // in the order of the packed nodes
  const RunContext& context_;
  AmtModelWriter<SurfaceModel> file_;
  std::string looks_;  // this and the next: what the chunks point to, beside the model
  PackedSurfaceMt packed_;
  packed::CarriedBytes carried_;
  std::vector<std::byte> numbers_, displacement_;
  std::vector<std::uint32_t> finestFaces_;
  std::vector<std::byte> values_, pictures_;
  std::vector<std::uint16_t> attributeErrors_;
};

}  // namespace

Status writeAmt(const std::string& path, const TerrainModel& model, const RunContext& context,
                const AmtWriteOptions& options) try {
  return TerrainWriting(path, model, context).run(options);
} catch (...) {
  return caughtFailure(path);
}

Status writeSurfaceAmt(const std::string& path, const SurfaceModel& model, const RunContext& context,
                       const SurfaceWriteOptions& options) try {
  return SurfaceWriting(path, model, context).run(options);
} catch (...) {
  return caughtFailure(path);
}

Result<SurfaceModel> roundSurface(const SurfaceModel& model, int positionBits,
                                  const RunContext& context) try {
  ARETE_TRY(PackedModel both, packModel(model, {positionBits}, context));
  if (both.packed.moved > 0) both.model.displacement = {};
  return std::move(both.model);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
