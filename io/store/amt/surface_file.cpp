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
#include "io/store/amt/chunk_writer.h"
#include "io/store/amt/index_check.h"
#include "io/store/amt/mt_chunks.h"
#include "io/store/format/checksum.h"
#include "io/store/format/surface_metadata.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/surface/displacement_bytes.h"
#include "io/store/packed/surface/source_numbers.h"
#include "surface/model/face_heirs.h"
#include "surface/model/renumbered.h"

namespace arete {
namespace {

/// The triangles that no node removes, in the order of their ids.
template <class Visit>
void forFinest(const MultiTriangulation& mt, const Visit& visit) {
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (!mt.remover(TriangleId(t)).isValid()) visit(t);
}

AmtShape leftOutShape(std::uint64_t count) {
  return {amt_tag::kLeftOutFaces, AmtScalar::u32, 8, count};
}

std::array<AmtShape, 2> displacementShapes(const MultiTriangulation& mt) {
  return {AmtShape{amt_tag::kDirections, AmtScalar::u8, 3, mt.vertexCount()},
          AmtShape{amt_tag::kReaches, AmtScalar::u8, 1, mt.triangleIdCount()}};
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
  SurfaceMetadata metadata = surfaceMetadataOf(source, {});
  metadata.hasDoubles = packed->hasDoubles;
  metadata.positionStep = packed->step;
  metadata.scale = packed->scale;
  metadata.model.positionError += packed->moved;
  const PackedMt& bytes = packed->bytes;
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
      : path_(path), source_(model), context_(context), chunks_(path, kAmtNewestVersion, context) {}

  Status run(const SurfaceWriteOptions& options) {
    if (const Status valid = model().validate(); !valid) return chunks_.refuse(valid.error().message);
    if (options.isPacked) ARETE_CHECK(pack(options.positionBits));
    SurfaceMetadata metadata =
        surfaceMetadataOf(model(), options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
    metadata.positionStep = packed_.step;
    if (const auto problem = findSurfaceProblem(metadata)) return chunks_.refuse(*problem);
    json_ = toSurfaceJson(metadata);
    if (json_.size() > kAmtMaxMetadataBytes)
      return chunks_.refuse(
          fmt::format("{} bytes of metadata are more than {}", json_.size(), kAmtMaxMetadataBytes));
    chunks_.add(amt_tag::kMetadata, bytesOf(json_));
    if (options.isPacked)
      addPacked();
    else
      addArrays(surfaceShapes(metadata));
    addLooks();
    if (!model().leftOutFaces.empty())
      chunks_.add(leftOutShape(model().leftOutFaces.size()), bytesOf(model().leftOutFaces));
    if (!options.isPacked) chunks_.addSegmentChecksums();
    return chunks_.write();
  }

 private:
  const SurfaceModel& model() const { return packedModel_ ? *packedModel_ : source_; }

  Status pack(int positionBits) {
    Result<PackedModel> both = packModel(source_, positionBits, context_);
    if (!both) {
      if (both.error().code == ErrorCode::interrupted) return chunks_.interrupted();
      return failure(both.error().code, both.error().message, path_);
    }
    if (both->packed.moved > 0 && !source_.displacement.isEmpty())
      return chunks_.refuse("has displacements of places that rounding moves: they are found again first");
    packed_ = std::move(both->packed);
    packedModel_ = std::move(both->model);
    return {};
  }

  void addPacked() {
    numbers_ = packed::packSourceNumbers(model());
    chunks_.add(amt_tag::kPackedDirectory, bytesOf(packed_.bytes.directory));
    chunks_.add(amt_tag::kPackedTables, bytesOf(packed_.bytes.tables));
    chunks_.add(amt_tag::kPackedNodes, bytesOf(packed_.bytes.nodes));
    chunks_.add({amt_tag::kPackedNumbers, AmtScalar::u8, 1, numbers_.size()}, bytesOf(numbers_),
                kAmtRequired);
    if (model().displacement.isEmpty()) return;
    displacement_ = packed::packDisplacement(model().mt, model().displacement);
    chunks_.add(amt_tag::kPackedDisplacement, bytesOf(displacement_));
  }

  void addArrays(const std::vector<AmtShape>& shapes) {
    const MtArrays& a = model().mt.arrays();
    if (!model().hasFaceAttributes())
      forFinest(model().mt, [&](std::uint32_t t) { finestFaces_.push_back(model().faceOf[t]); });
    std::vector<AmtChunkBytes> arrays = mtChunks(a);
    const AmtChunkBytes own[] = {
        {amt_tag::kRms, bytesOf(a.rms)},
        {amt_tag::kPlaces,
         a.vertices.places64.empty() ? bytesOf(a.vertices.places32) : bytesOf(a.vertices.places64)},
        {amt_tag::kVertexNumbers, bytesOf(model().vertexOf)},
        {amt_tag::kFaceNumbers,
         model().hasFaceAttributes() ? bytesOf(model().faceOf) : bytesOf(finestFaces_)},
        {amt_tag::kWedges, bytesOf(model().wedgesOf)},
    };
    arrays.insert(arrays.end(), std::begin(own), std::end(own));
    for (const AmtShape& shape : shapes)
      for (const auto& [tag, bytes] : arrays)
        if (tag == shape.tag) chunks_.add(shape, bytes, tag == amt_tag::kPlaces ? kAmtRequired : 0);
    if (model().displacement.isEmpty()) return;
    for (const AmtShape& shape : displacementShapes(model().mt))
      chunks_.add(shape, shape.tag == amt_tag::kReaches ? bytesOf(model().displacement.reaches)
                                                        : bytesOf(model().displacement.directions));
  }

  void addLooks() {
    looks_ = toLooksJson(model());
    values_ = attributeBytesOf(model());
    for (const EmbeddedPicture& picture : model().attributes.pictures)
      pictures_.insert(pictures_.end(), picture.bytes.begin(), picture.bytes.end());
    chunks_.add(amt_tag::kLooks, bytesOf(looks_));
    chunks_.add(amt_tag::kAttributes, bytesOf(values_));
    chunks_.add(amt_tag::kPictures, bytesOf(pictures_));
  }

  const std::string& path_;
  const SurfaceModel& source_;
  std::optional<SurfaceModel> packedModel_;  // in the order of the packed nodes
  const RunContext& context_;
  AmtChunkWriter chunks_;
  std::string json_, looks_;  // these and the next: what the chunks point to, beside the model
  PackedSurfaceMt packed_;
  std::vector<std::byte> numbers_, displacement_;
  std::vector<std::uint32_t> finestFaces_;
  std::vector<std::byte> values_, pictures_;
};

class Reading {
 public:
  Reading(const AmtContainer& container, const SurfaceMetadata& metadata, AmtVerify verify,
          const RunContext& context)
      : all_(container), metadata_(metadata), verify_(verify), context_(context), model_(metadata.model) {}

  Result<SurfaceModel> run() {
    const bool isPacked = all_.isPacked();
    std::vector<AmtShape> shapes = isPacked ? std::vector<AmtShape>() : surfaceShapes(metadata_);
    const auto addBytes = [&](AmtTag tag) {
      shapes.push_back({tag, AmtScalar::u8, 1, all_.find(tag) == nullptr ? 0 : all_.find(tag)->bytes});
    };
    for (const AmtTag tag : {amt_tag::kLooks, amt_tag::kAttributes, amt_tag::kPictures}) addBytes(tag);
    if (isPacked)
      for (const AmtTag tag : {amt_tag::kPackedDirectory, amt_tag::kPackedTables, amt_tag::kPackedNodes,
                               amt_tag::kPackedNumbers})
        addBytes(tag);
    ARETE_CHECK(all_.checkShapes(shapes));
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
    if (!isPacked) ARETE_CHECK(takeFaces());
    ARETE_CHECK(takeLooks());
    if (isPacked) ARETE_CHECK(unpackNumbers());
    ARETE_CHECK(isPacked ? unpackDisplacement() : takeDisplacement());
    ARETE_CHECK(takeLeftOutFaces());
    if (const Status valid = model_.validate(); !valid) return all_.corrupt(valid.error().message);
    return std::move(model_);
  }

 private:
  template <class T>
  void place(AmtTag tag, std::span<const T>& to) const {
    to = all_.elements<T>(tag);
  }

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
  Status takeDisplacement() {
    if (all_.find(amt_tag::kDirections) == nullptr && all_.find(amt_tag::kReaches) == nullptr) return {};
    ARETE_CHECK(all_.checkShapes(displacementShapes(model_.mt)));
    const auto directions = all_.elements<std::array<std::int8_t, 3>>(amt_tag::kDirections);
    const auto reaches = all_.elements<std::uint8_t>(amt_tag::kReaches);
    model_.displacement.directions.assign(directions.begin(), directions.end());
    model_.displacement.reaches.assign(reaches.begin(), reaches.end());
    return {};
  }

  Status takeLeftOutFaces() {
    const AmtChunk* const chunk = all_.find(amt_tag::kLeftOutFaces);
    if (chunk == nullptr) return {};
    const std::array shape{leftOutShape(chunk->bytes / sizeof(SurfaceModel::LeftOutFace))};
    ARETE_CHECK(all_.checkShapes(shape));
    const auto faces = all_.elements<SurfaceModel::LeftOutFace>(amt_tag::kLeftOutFaces);
    model_.leftOutFaces.assign(faces.begin(), faces.end());
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
    MtArrays a = placeMtChunks(all_);
    a.rootVertices = static_cast<std::uint32_t>(metadata_.counts.rootVertices);
    place(amt_tag::kRms, a.rms);
    if (metadata_.hasDoubles)
      place(amt_tag::kPlaces, a.vertices.places64);
    else
      place(amt_tag::kPlaces, a.vertices.places32);
    a.scale = metadata_.scale;
    a.metric = metadata_.metric;
    model_.mt = MultiTriangulation(a, all_.owner());
    const auto numbers = all_.elements<std::uint32_t>(amt_tag::kVertexNumbers);
    model_.vertexOf.assign(numbers.begin(), numbers.end());
    model_.attributes.wedgeCount = static_cast<std::uint32_t>(metadata_.wedges);
    if (metadata_.wedges == 0) return;
    const auto wedges = all_.elements<std::array<std::uint32_t, 3>>(amt_tag::kWedges);
    model_.wedgesOf.assign(wedges.begin(), wedges.end());
  }

  Status takeFaces() {
    const auto faces = all_.elements<std::uint32_t>(amt_tag::kFaceNumbers);
    if (metadata_.hasAllFaces) {
      model_.faceOf.assign(faces.begin(), faces.end());
      return {};
    }
    model_.faceOf.assign(model_.mt.triangleIdCount(), 0);
    std::size_t i = 0;
    forFinest(model_.mt, [&](std::uint32_t t) {
      if (i < faces.size()) model_.faceOf[t] = faces[i++];
    });
    inheritFaces(model_.mt, model_.faceOf);
    return {};
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
