// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/surface_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/store/amt/index_check.h"
#include "io/store/amt/model_columns.h"
#include "io/store/amt/model_writer.h"
#include "io/store/format/checksum.h"
#include "io/store/format/surface_metadata.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/surface/displacement_bytes.h"
#include "io/store/packed/surface/source_numbers.h"
#include "surface/model/face_successors.h"
#include "surface/model/renumbered.h"

namespace arete {
namespace {

/// The triangles that no node removes, in the order of their ids.
template <class Visit>
void forFinest(const MultiTriangulation& mt, const Visit& visit) {
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (!mt.remover(TriangleId(t)).isValid()) visit(t);
}

struct PackedModel {
  PackedSurfaceMt packed;
  SurfaceModel model;  ///< in the order of the packed MT: as a reader has it
};

/// Packs the MT, and takes the model in the order of the packed MT. Displacements stay as they are.
Result<PackedModel> packModel(const SurfaceModel& source, int positionBits, const RunContext& context) {
  const auto refuse = [](Error error) {
    if (error.code != ErrorCode::interrupted) error.message = "the model cannot be packed: " + error.message;
    return tl::unexpected(std::move(error));
  };
  Result<PackedSurfaceMt> packed = packSurfaceMt(source.mt, {positionBits}, context);
  if (!packed) return refuse(packed.error());
  SurfaceMetadata metadata = amtMetadataOf(source, {});
  metadata.hasDoubles = packed->hasDoubles;
  metadata.positionStep = packed->step;
  metadata.scale = packed->scale;
  metadata.model.positionError += packed->moved;
  const PackedMt& bytes = packed->bytes;
  // The bytes are unpacked again, so that the model is put in order around exactly what a reader will have.
  const Result<MultiTriangulation> mt =
      unpackSurfaceMt(metadata, bytes.directory, bytes.tables, bytes.nodes, context);
  if (!mt) return refuse(mt.error());
  SurfaceModel model = renumbered(source, *mt, packed->order.vertexOf, packed->order.triangleOf);
  model.positionError += packed->moved;
  packed->order = {};
  return PackedModel{std::move(*packed), std::move(model)};
}

class Writing {
 public:
  Writing(const std::string& path, const SurfaceModel& model, const RunContext& context)
      : path_(path), source_(model), context_(context), file_(path, context) {}

  Status run(const SurfaceWriteOptions& options) {
    if (const Status valid = model().validate(); !valid) return file_.chunks().refuse(valid.error().message);
    if (options.isPacked) ARETE_CHECK(pack(options.positionBits));
    SurfaceMetadata metadata =
        amtMetadataOf(model(), options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
    metadata.positionStep = packed_.step;
    ARETE_CHECK(file_.describe(metadata));
    AmtFacts facts = amtFactsOf(metadata);
    facts.isPacked = options.isPacked;
    facts.hasDisplacement = !model().displacement.isEmpty();
    if (options.isPacked)
      makePackedNumbers();
    else if (!facts.hasAllFaces)
      makeFinestFaces();
    makeLooks();
    return file_.write(model(), facts);
  }

 private:
  const SurfaceModel& model() const { return packedModel_ ? *packedModel_ : source_; }

  Status pack(int positionBits) {
    Result<PackedModel> both = packModel(source_, positionBits, context_);
    if (!both) {
      if (both.error().code == ErrorCode::interrupted) return file_.chunks().interrupted();
      return failure(both.error().code, both.error().message, path_);
    }
    // Displacements belong to exact places, and these have moved.
    if (both->packed.moved > 0 && !source_.displacement.isEmpty())
      return file_.chunks().refuse(
          "has displacements of places that rounding moves: they are found again first");
    packed_ = std::move(both->packed);
    packedModel_ = std::move(both->model);
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

  void makeLooks() {
    looks_ = toLooksJson(model());
    values_ = attributeBytesOf(model());
    for (const EmbeddedPicture& picture : model().attributes.pictures)
      pictures_.insert(pictures_.end(), picture.bytes.begin(), picture.bytes.end());
    file_.make(amt_tag::kLooks, bytesOf(looks_));
    file_.make(amt_tag::kAttributes, bytesOf(values_));
    file_.make(amt_tag::kPictures, bytesOf(pictures_));
  }

  const std::string& path_;
  const SurfaceModel& source_;
  std::optional<SurfaceModel> packedModel_;  // in the order of the packed nodes
  const RunContext& context_;
  AmtModelWriter<SurfaceModel> file_;
  std::string looks_;  // this and the next: what the chunks point to, beside the model
  PackedSurfaceMt packed_;
  std::vector<std::byte> numbers_, displacement_;
  std::vector<std::uint32_t> finestFaces_;
  std::vector<std::byte> values_, pictures_;
};

class Reading {
 public:
  Reading(const AmtContainer& container, const SurfaceMetadata& metadata, AmtVerify verify,
          const RunContext& context)
      : all_(container),
        metadata_(metadata),
        facts_(amtFactsOf(metadata)),
        verify_(verify),
        context_(context),
        model_(metadata.model) {}

  Result<SurfaceModel> run() {
    ARETE_CHECK(checkColumns<SurfaceModel>(all_, facts_));
    const bool isPacked = facts_.isPacked;
    if (verify_ == AmtVerify::all) {
      Status sound = all_.checkSums({}, context_);
      if (sound) sound = all_.checkZeros();
      if (!sound) return tl::unexpected(sound.error());
    }
    ARETE_CHECK(isPacked ? unpackNodes() : placeNodes());
    if (verify_ != AmtVerify::none) {
      std::uint64_t finest = 0;
      forFinest(model_.mt, [&](std::uint32_t) { ++finest; });
      if (finest != metadata_.finestTriangles)
        return all_.corrupt(fmt::format("has {} triangles in its finest front instead of {}", finest,
                                        metadata_.finestTriangles));
    }
    copyModelColumns(all_, facts_, model_);
    if (!isPacked && !facts_.hasAllFaces) takeFinestFaces();
    ARETE_CHECK(takeLooks());
    if (isPacked) {
      ARETE_CHECK(unpackNumbers());
      ARETE_CHECK(unpackDisplacement());
    }
    if (const Status valid = model_.validate(); !valid) return all_.corrupt(valid.error().message);
    return std::move(model_);
  }

 private:
  Status unpackNodes() {
    Result<MultiTriangulation> mt =
        unpackSurfaceMt(metadata_, all_.elements<std::byte>(amt_tag::kPackedDirectory),
                        all_.elements<std::byte>(amt_tag::kPackedTables),
                        all_.elements<std::byte>(amt_tag::kPackedNodes), context_);
    if (!mt) return failure(mt.error().code, mt.error().message, all_.path());
    model_.mt = std::move(*mt);
    model_.attributes.wedgeCount = static_cast<std::uint32_t>(metadata_.wedges);
    return {};
  }
  /// After the looks, which say whether coarse triangles have faces of their own.
  Status unpackNumbers() {
    const Status taken =
        packed::unpackSourceNumbers(all_.elements<std::byte>(amt_tag::kPackedNumbers), model_);
    return taken ? taken : all_.corrupt(taken.error().message);
  }

  Status unpackDisplacement() {
    const AmtChunk* const chunk = all_.find(amt_tag::kPackedDisplacement);
    if (chunk == nullptr) return {};
    Result<SurfaceDisplacement> read = packed::unpackDisplacement(all_.bytes(*chunk), model_.mt);
    if (!read) return all_.corrupt(read.error().message);
    model_.displacement = std::move(*read);
    return {};
  }
  Status placeNodes() {
    placeArrays();
    if (verify_ == AmtVerify::none) return {};
    if (const Status checked = checkMtIndices(model_.mt, 0, context_); !checked)
      return failure(checked.error().code, checked.error().message, all_.path());
    return {};
  }

  void placeArrays() {
    MtArrays a;
    a.rootVertices = static_cast<std::uint32_t>(metadata_.counts.rootVertices);
    placeMtColumns<SurfaceModel>(all_, facts_, a);
    a.scale = metadata_.scale;
    a.metric = metadata_.metric;
    model_.mt = MultiTriangulation(a, all_.owner());
    model_.attributes.wedgeCount = static_cast<std::uint32_t>(metadata_.wedges);
  }

  /// Where the file has faces of the finest triangles alone.
  void takeFinestFaces() {
    const auto faces = all_.elements<std::uint32_t>(amt_tag::kFaceNumbers);
    model_.faceOf.assign(model_.mt.triangleIdCount(), 0);
    std::size_t i = 0;
    forFinest(model_.mt, [&](std::uint32_t t) {
      if (i < faces.size()) model_.faceOf[t] = faces[i++];
    });
    inheritFaces(model_.mt, model_.faceOf);
  }

  Status takeLooks() {
    const auto text = all_.elements<char>(amt_tag::kLooks);
    std::vector<std::uint64_t> pictureBytes;
    if (const Status read = fromLooksJson({text.data(), text.size()}, all_.find(amt_tag::kAttributes)->bytes,
                                          model_, pictureBytes);
        !read)
      return all_.corrupt(read.error().message);
    if (model_.hasFaceAttributes() != metadata_.hasAllFaces)
      return all_.corrupt("has faces with attributes and no numbers of them, or the other way");
    if (const Status taken = takeAttributeBytes(all_.elements<std::byte>(amt_tag::kAttributes),
                                                model_.mt.vertexCount(), model_);
        !taken)
      return all_.corrupt(taken.error().message);
    const auto bytes = all_.elements<std::byte>(amt_tag::kPictures);
    std::size_t at = 0;
    for (std::size_t i = 0; i < pictureBytes.size(); ++i) {
      if (pictureBytes[i] > bytes.size() - at)
        return all_.corrupt(fmt::format("has a picture of {} bytes, which are not there", pictureBytes[i]));
      const auto part = bytes.subspan(at, pictureBytes[i]);
      model_.attributes.pictures[i].bytes.assign(part.begin(), part.end());
      at += part.size();
    }
    return {};
  }

  const AmtContainer& all_;
  const SurfaceMetadata& metadata_;
  AmtFacts facts_;
  AmtVerify verify_;
  const RunContext& context_;
  SurfaceModel model_;
};

}  // namespace

Status writeSurfaceAmt(const std::string& path, const SurfaceModel& model, const RunContext& context,
                       const SurfaceWriteOptions& options) try {
  return Writing(path, model, context).run(options);
} catch (...) {
  return caughtFailure(path);
}

Result<SurfaceModel> roundSurface(const SurfaceModel& model, int positionBits,
                                  const RunContext& context) try {
  ARETE_TRY(PackedModel both, packModel(model, positionBits, context));
  if (both.packed.moved > 0) both.model.displacement = {};
  return std::move(both.model);
} catch (...) {
  return caughtFailure();
}

Result<SurfaceModel> loadSurfaceAmt(const std::string& path, AmtVerify verify,
                                    const RunContext& context) try {
  ARETE_TRY(const AmtContainer container, AmtContainer::open(path));
  return loadSurfaceAmt(container, verify, context);
} catch (...) {
  return caughtFailure(path);
}

Result<SurfaceModel> loadSurfaceAmt(const AmtContainer& container, AmtVerify verify,
                                    const RunContext& context) try {
  if (!container.isOfSurface())
    return failure(ErrorCode::unsupported, "is of terrain, and a surface is wanted here", container.path());
  ARETE_CHECK(container.loadAll());
  const Result<SurfaceMetadata> metadata = fromSurfaceJson(container.metadata());
  if (!metadata) return container.corrupt(fmt::format("chunk META: {}", metadata.error().message));
  return Reading(container, *metadata, verify, context).run();
} catch (...) {
  return caughtFailure(container.path());
}

}  // namespace arete
