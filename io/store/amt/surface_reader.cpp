// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of surfaces. The MT comes first, then what is declared of attributes, then numbers and values, which
// follow from both. A file in pages is read in part where a query needs no more.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/memory/required_memory.h"
#include "io/store/amt/block_parts.h"
#include "io/store/amt/finest_triangles.h"
#include "io/store/amt/index_check.h"
#include "io/store/amt/model_columns.h"
#include "io/store/amt/surface_file.h"
#include "io/store/format/surface_metadata.h"
#include "io/store/packed/packed.h"
#include "io/store/packed/surface/carried.h"
#include "io/store/packed/surface/displacement_bytes.h"
#include "io/store/packed/surface/source_numbers.h"
#include "surface/model/face_successors.h"

namespace arete {
namespace {

/// Reads one file of a surface: whole, or of pages a part.
class SurfaceReading {
 public:
  SurfaceReading(const AmtContainer& container, const SurfaceMetadata& metadata,
                 const AmtReadOptions& options, const RunContext& context)
      : all_(container),
        metadata_(metadata),
        facts_(amtFactsOf(metadata)),
        verify_(options.verify),
        wanted_(options.wanted),
        context_(context),
        model_(metadata.model) {}

  Result<SurfaceModel> run() {
    ARETE_CHECK(checkColumns<SurfaceModel>(all_, facts_));
    const bool isPacked = facts_.isPacked;
    ARETE_CHECK(load());
    if (facts_.isPaged)
      ARETE_CHECK(unpackPages());
    else
      ARETE_CHECK(isPacked ? unpackNodes() : placeNodes());
    if (isPart()) {
      model_.finestOfWhole = metadata_.finestTriangles;
    } else if (verify_ != AmtVerify::none) {
      std::uint64_t finest = 0;
      forFinest(model_.mt, [&](std::uint32_t) { ++finest; });
      if (finest != metadata_.finestTriangles)
        return all_.corrupt(fmt::format("has {} triangles in its finest front instead of {}", finest,
                                        metadata_.finestTriangles));
    }
    copyModelColumns(all_, facts_, model_);
    if (isPart()) model_.leftOutFaces.clear();
    if (!isPacked && !facts_.hasAllFaces) takeFinestFaces();
    ARETE_CHECK(takeLooks());
    if (facts_.isPaged) {
      ARETE_CHECK(unpackCarried());
    } else {
      ARETE_CHECK(takeValues());
      if (isPacked) {
        ARETE_CHECK(unpackNumbers());
        ARETE_CHECK(unpackDisplacement());
      }
    }
    if (const Status valid = model_.validate(); !valid) return all_.corrupt(valid.error().message);
    return std::move(model_);
  }

 private:
  bool isPart() const { return pages_ && model_.mt.nodeCount() < metadata_.counts.nodes; }
  std::span<const std::byte> bytesOf(const AmtTag& tag) const { return all_.elements<std::byte>(tag); }

  /// Pages are loaded as they are needed, and checked then.
  Status load() {
    constexpr std::array kInPages = {amt_tag::kPackedNodes, amt_tag::kPageBlocks};
    std::vector<FileImage::Part> parts;
    for (const AmtChunk& chunk : all_.chunks())
      if (!facts_.isPaged || std::ranges::find(kInPages, chunk.tag) == kInPages.end())
        parts.push_back(all_.bytes(chunk));
    ARETE_CHECK(all_.loadParts(parts, context_));
    if (verify_ != AmtVerify::all) return {};
    if (facts_.isPaged) return all_.checkSums(kInPages, context_);
    ARETE_CHECK(all_.checkSums({}, context_));
    return all_.checkZeros();
  }

  Status unpackPages() {
    const LoadParts load = [&](std::span<const FileImage::Part> parts) {
      return all_.loadParts(all_.owner()->isFar() ? withBlocksJoined(parts, bytesOf(amt_tag::kPageBlocks),
                                                                     bytesOf(amt_tag::kPackedNodes))
                                                  : std::vector(parts.begin(), parts.end()),
                            context_);
    };
    Result<UnpackedPages> unpacked =
        unpackSurfaceMt(metadata_,
                        {bytesOf(amt_tag::kPageRoot), bytesOf(amt_tag::kPackedTables),
                         bytesOf(amt_tag::kPageBlocks), bytesOf(amt_tag::kPackedNodes)},
                        wanted_, context_, load);
    ARETE_CHECK(all_.loaded());
    if (!unpacked) return failure(unpacked.error().code, unpacked.error().message, all_.path());
    model_.mt = std::move(unpacked->mt);
    pages_ = std::move(unpacked->pages);
    model_.attributes.wedgeCount = static_cast<std::uint32_t>(metadata_.wedges);
    return {};
  }
  /// After the looks, which say what there is.
  Status unpackCarried() {
    const Status taken =
        packed::unpackCarried({bytesOf(amt_tag::kPackedNumbers), bytesOf(amt_tag::kAttributes)},
                              bytesOf(amt_tag::kPackedNodes), *pages_, isPart(), model_);
    return taken ? taken : all_.corrupt(taken.error().message);
  }

  Status unpackNodes() {
    Result<MultiTriangulation> mt =
        unpackSurfaceMt(metadata_, bytesOf(amt_tag::kPackedDirectory), bytesOf(amt_tag::kPackedTables),
                        bytesOf(amt_tag::kPackedNodes), context_);
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
    // Of pages, the values of faces lie in these, and the faces are known when they are read.
    const std::uint64_t faces = facts_.isPaged ? 1 : model_.sourceFaces;
    if (const Status read = fromLooksJson(
            {text.data(), text.size()}, faces,
            facts_.isPaged ? sizeof faces : all_.find(amt_tag::kAttributes)->bytes, model_, pictureBytes);
        !read)
      return all_.corrupt(read.error().message);
    if (model_.hasFaceAttributes() != metadata_.hasAllFaces)
      return all_.corrupt("has faces with attributes and no numbers of them, or the other way");
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

  Status takeValues() {
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
    return {};
  }

  const AmtContainer& all_;
  const SurfaceMetadata& metadata_;
  AmtFacts facts_;
  AmtVerify verify_;
  const RequiredError& wanted_;
  const RunContext& context_;
  SurfaceModel model_;
  std::optional<packed::Directory> pages_;  ///< that were read
};

}  // namespace

Result<SurfaceModel> loadSurfaceAmt(const std::string& path, const AmtReadOptions& options,
                                    const RunContext& context) try {
  ARETE_TRY(const AmtContainer container, AmtContainer::open(path));
  return loadSurfaceAmt(container, options, context);
} catch (...) {
  return caughtFailure(path);
}

Result<SurfaceModel> loadSurfaceAmt(const AmtContainer& container, const AmtReadOptions& options,
                                    const RunContext& context) try {
  if (!container.isOfSurface())
    return failure(ErrorCode::unsupported, "is of terrain, and a surface is wanted here", container.path());
  const Result<SurfaceMetadata> metadata = fromSurfaceJson(container.metadata());
  if (!metadata) return container.corrupt(fmt::format("chunk META: {}", metadata.error().message));
  if (!container.isPaged())
    requireMemory(container.bytes().size(), "build a smaller surface, or write it in pages");
  return SurfaceReading(container, *metadata, options, context).run();
} catch (...) {
  return caughtFailure(container.path());
}

namespace {

Result<SurfaceMetadata> metadataIn(const AmtContainer& container) {
  Result<SurfaceMetadata> metadata = fromSurfaceJson(container.metadata());
  if (!metadata) return container.corrupt(fmt::format("chunk META: {}", metadata.error().message));
  return metadata;
}

}  // namespace

Result<SurfaceFacts> surfaceFacts(const AmtContainer& container) try {
  ARETE_TRY(const SurfaceMetadata metadata, metadataIn(container));
  return SurfaceFacts{metadata.counts.rootVertices + metadata.counts.nodes, metadata.summary};
} catch (...) {
  return caughtFailure(container.path());
}

Result<double> surfaceErrorBeyond(const AmtContainer& container, std::uint64_t nodes) try {
  const AmtChunk* const root = container.find(amt_tag::kPageRoot);
  if (root == nullptr) return 0;
  ARETE_TRY(const SurfaceMetadata metadata, metadataIn(container));
  ARETE_CHECK(container.load(container.bytes(*root)));
  return pagedErrorBeyond(container.bytes(*root), metadata.scale, nodes);
} catch (...) {
  return caughtFailure(container.path());
}

Result<std::vector<PageNeed>> surfacePagesFor(const AmtContainer& container, const RequiredError& wanted,
                                              const RunContext& context) try {
  if (!container.isPaged()) return std::vector<PageNeed>();
  ARETE_TRY(const SurfaceMetadata metadata, metadataIn(container));
  std::array<std::span<const std::byte>, 4> parts;  // as packed::PagedMt has them
  constexpr std::array kTags = {amt_tag::kPageRoot, amt_tag::kPackedTables, amt_tag::kPageBlocks,
                                amt_tag::kPackedNodes};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const AmtChunk* const chunk = container.find(kTags[i]);
    if (chunk == nullptr) return container.corrupt("has pages without their directory");
    parts[i] = container.bytes(*chunk);
  }
  ARETE_CHECK(container.load(parts[0]));
  auto needs = neededPages(
      metadata.scale, {parts[0], parts[1], parts[2], parts[3]}, wanted,
      [&](std::span<const FileImage::Part> blocks) { return container.loadParts(blocks, context); });
  ARETE_CHECK(container.loaded());
  if (!needs) return failure(needs.error().code, needs.error().message, container.path());
  return needs;
} catch (...) {
  return caughtFailure(container.path());
}

}  // namespace arete
