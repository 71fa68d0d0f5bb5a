// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of both kinds. Chunks must have the sizes that follow from the counts in the metadata
// (model_columns.h). Terrain is opened first and read later, in part where a query needs no more; a surface
// is read whole.
#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/mt/node_blocks.h"
#include "io/store/amt/file.h"
#include "io/store/amt/finest_triangles.h"
#include "io/store/amt/index_check.h"
#include "io/store/amt/model_columns.h"
#include "io/store/amt/part.h"
#include "io/store/amt/surface_file.h"
#include "io/store/format/metadata.h"
#include "io/store/format/surface_metadata.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/surface/displacement_bytes.h"
#include "io/store/packed/surface/source_numbers.h"
#include "surface/model/face_successors.h"

namespace arete {

// Fills an AmtFile from a container: the spans point into the file, and no array is copied.
class AmtOpener {
 public:
  static Result<AmtFile> open(AmtContainer container);

 private:
  explicit AmtOpener(AmtFile& file) : file_(file), all_(file.container_) {}

  Result<AmtMetadata> readMetadata() const;
  Status placeArrays(const AmtMetadata& metadata);

  template <class T>
  void place(AmtTag tag, std::span<const T>& to) const {
    to = all_.elements<T>(tag);
  }

  AmtFile& file_;
  const AmtContainer& all_;
};

static_assert(sizeof(Vec2) == 16 && sizeof(Sphere) == 16 && sizeof(std::array<std::uint32_t, 3>) == 12);

Result<AmtMetadata> AmtOpener::readMetadata() const {
  if (all_.isOfSurface())
    return failure(ErrorCode::unsupported, "is of a surface, and terrain is wanted here", all_.path());
  Result<AmtMetadata> read = fromAmtJson(all_.metadata());
  if (!read) return all_.corrupt(fmt::format("chunk META: {}", read.error().message));
  return read;
}

// A packed model has no arrays yet, and readMt() makes them; of any other the columns are used in place. The
// metadata is kept only where unpacking needs it.
Status AmtOpener::placeArrays(const AmtMetadata& metadata) {
  AmtFacts facts = amtFactsOf(metadata);
  ARETE_CHECK(checkColumns<TerrainModel>(all_, facts));
  file_.writer_ = metadata.writer;
  file_.model_ = metadata.model;
  file_.nodeCount_ = metadata.counts.nodes;
  file_.counts_ = metadata.counts;
  file_.summary_ = metadata.summary;
  place(amt_tag::kIsolatedSamples, file_.isolatedSamples_);
  place(amt_tag::kIsolatedHeights, file_.isolatedHeights_);
  place(amt_tag::kFixedVertices, file_.fixedVertices_);
  if (facts.segments) place(amt_tag::kSegmentChecksums, file_.segmentChecksums_);
  MtArrays a;
  a.rootVertices = static_cast<std::uint32_t>(metadata.counts.rootVertices);
  if (facts.isPacked) {
    place(facts.isPaged ? amt_tag::kPageRoot : amt_tag::kPackedDirectory, file_.packedDirectory_);
    if (facts.isPaged) place(amt_tag::kPageBlocks, file_.pageBlocks_);
    place(amt_tag::kPackedTables, file_.packedTables_);
    place(amt_tag::kPackedNodes, file_.packedNodes_);
    file_.metadata_ = std::make_shared<const AmtMetadata>(metadata);
  } else {
    placeMtColumns<TerrainModel>(all_, facts, a);
    a.vertices.columns = metadata.model.columns;
    a.vertices.encoding = metadata.encoding;
    a.scale = metadata.scale;
    a.metric = metadata.metric;
  }
  file_.model_.mt = MultiTriangulation(a, all_.owner());
  return {};
}

Result<AmtFile> AmtOpener::open(AmtContainer container) {
  AmtFile file;
  file.container_ = std::move(container);
  AmtOpener opener(file);
  ARETE_TRY(const AmtMetadata metadata, opener.readMetadata());
  ARETE_CHECK(opener.placeArrays(metadata));
  return file;
}

// Packed nodes are left out here: the packets that are wanted are loaded before they are decoded.
Status AmtFile::loadAllButPacked(const RunContext& context) const {
  std::vector<FileImage::Part> parts;
  for (const AmtChunk& chunk : chunks())
    if (chunk.tag != amt_tag::kPackedNodes && chunk.tag != amt_tag::kPageBlocks)
      parts.push_back(bytes(chunk));
  return container_.loadParts(parts, context);
}

double AmtFile::errorBeyond(std::uint64_t nodes) const {
  if (isPacked()) {
    if (!container_.load(packedDirectory_)) return 0;
    return isPaged() ? pagedErrorBeyond(packedDirectory_, metadata_->scale, nodes)
                     : packedErrorBeyond(packedDirectory_, metadata_->scale, nodes);
  }
  if (!hasSegments()) return 0;
  const MtArrays& a = model_.mt.arrays();
  if (!container_.load(std::as_bytes(a.blockError))) return 0;
  const std::uint64_t page = nodes / MultiTriangulation::kNodesPerPage + 1,
                      entry = nodeBlockCount(nodeCount_) + page;
  return entry < a.blockError.size() ? a.scale.decode(a.blockError[entry]) : 0;
}

/// A part is read alone where the file's segments have checksums of their own; otherwise everything is loaded
/// and checked. A failed read of the file is reported before the failure to unpack that it causes.
Result<MultiTriangulation> AmtFile::readMt(const AmtReadOptions& options, const RunContext& context) const {
  const bool isPart = options.wanted && options.verify != AmtVerify::none && !isPacked() && hasSegments();
  if (isPart) return readAmtPart(*this, options.wanted, options.verify, context);
  ARETE_CHECK(loadAllButPacked(context));
  ARETE_CHECK(checkAmt(*this, options.verify, context));
  if (!isPacked()) return model_.mt;
  const AmtContainer& all = container_;
  const LoadParts load = [&](std::span<const FileImage::Part> parts) {
    return all.loadParts(parts, context);
  };
  Result<MultiTriangulation> mt =
      isPaged() ? unpackMt(*metadata_, {packedDirectory_, packedTables_, pageBlocks_, packedNodes_},
                           options.wanted, context, load)
                : unpackMt(*metadata_, packedDirectory_, packedTables_, packedNodes_, options.wanted, context,
                           load);
  ARETE_CHECK(container_.loaded());
  if (!mt) return failure(mt.error().code, mt.error().message, path());
  return mt;
}

Result<std::vector<PageNeed>> AmtFile::pagesFor(const RequiredError& wanted,
                                                const RunContext& context) const {
  if (!isPaged()) return std::vector<PageNeed>();
  const std::array<FileImage::Part, 1> directory = {packedDirectory_};
  ARETE_CHECK(container_.loadParts(directory, context));
  auto needs = neededPages(
      *metadata_, {packedDirectory_, packedTables_, pageBlocks_, packedNodes_}, wanted,
      [&](std::span<const FileImage::Part> parts) { return container_.loadParts(parts, context); });
  ARETE_CHECK(container_.loaded());
  if (!needs) return failure(needs.error().code, needs.error().message, path());
  return needs;
}

// The isolated samples and the fixed vertices are copied into the model, while the arrays of the MT stay
// where they lie in the file.
Result<TerrainModel> AmtFile::read(const AmtReadOptions& options, const RunContext& context) const try {
  ARETE_TRY(MultiTriangulation mt, readMt(options, context));
  TerrainModel model = model_;
  model.mt = std::move(mt);
  model.options.fixedVertices.assign(fixedVertices_.begin(), fixedVertices_.end());
  model.isolated.reserve(isolatedSamples_.size());
  for (std::size_t i = 0; i < isolatedSamples_.size(); ++i)
    model.isolated.push_back({isolatedSamples_[i], isolatedHeights_[i]});
  return model;
} catch (...) {
  return caughtFailure(path());
}

Result<AmtFile> openAmt(const std::string& path, const AmtOpenOptions& options) try {
  ARETE_TRY(AmtContainer container, AmtContainer::open(path, options));
  return AmtOpener::open(std::move(container));
} catch (...) {
  return caughtFailure(path);
}

Result<AmtFile> openAmt(AmtContainer container) try {
  return AmtOpener::open(std::move(container));
} catch (...) {
  return caughtFailure();
}

Result<TerrainModel> loadAmt(const std::string& path, const AmtLoadOptions& options,
                             const RunContext& context) try {
  ARETE_TRY(const AmtFile file, openAmt(path, options.open));
  return file.read({options.verify, options.wanted}, context);
} catch (...) {
  return caughtFailure();
}

namespace {

/// Reads one file of a surface, whole.
class SurfaceReading {
 public:
  SurfaceReading(const AmtContainer& container, const SurfaceMetadata& metadata, AmtVerify verify,
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
    const auto bytes = [&](const AmtTag& tag) { return all_.elements<std::byte>(tag); };
    const auto tables = bytes(amt_tag::kPackedTables), nodes = bytes(amt_tag::kPackedNodes);
    Result<MultiTriangulation> mt =
        facts_.isPaged
            ? unpackSurfaceMt(metadata_,
                              {bytes(amt_tag::kPageRoot), tables, bytes(amt_tag::kPageBlocks), nodes}, {},
                              context_, {})
            : unpackSurfaceMt(metadata_, bytes(amt_tag::kPackedDirectory), tables, nodes, context_);
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
    const AmtChunk* const errors = all_.find(amt_tag::kAttributeErrors);
    if (const Status taken =
            takeAttributeErrorCodes(errors ? all_.elements<std::uint16_t>(amt_tag::kAttributeErrors)
                                           : std::span<const std::uint16_t>(),
                                    model_);
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
  ARETE_CHECK(container.loadAll(context));
  const Result<SurfaceMetadata> metadata = fromSurfaceJson(container.metadata());
  if (!metadata) return container.corrupt(fmt::format("chunk META: {}", metadata.error().message));
  return SurfaceReading(container, *metadata, verify, context).run();
} catch (...) {
  return caughtFailure(container.path());
}

}  // namespace arete
