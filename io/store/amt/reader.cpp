// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of terrain (of surfaces: surface_reader.cpp). Chunks must have the sizes that follow from the counts
// in the metadata (model_columns.h). A file is opened first and read later, in part where a query needs no
// more.
#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/memory/required_memory.h"
#include "engine/mt/node_blocks.h"
#include "io/store/amt/block_parts.h"
#include "io/store/amt/file.h"
#include "io/store/amt/model_columns.h"
#include "io/store/amt/part.h"
#include "io/store/format/metadata.h"
#include "io/store/packed/packed.h"

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

namespace {
constexpr std::string_view kPagesNeedLess = "of a model in pages (`paged`) only what is asked for is read";
}  // namespace

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
  // The arrays of a plain file are used where they are mapped, and all of them may be touched.
  if (!isPacked()) requireMemory(container_.bytes().size(), kPagesNeedLess);
  const bool isPart = options.wanted && options.verify != AmtVerify::none && !isPacked() && hasSegments();
  if (isPart) return readAmtPart(*this, options.wanted, options.verify, context);
  ARETE_CHECK(loadAllButPacked(context));
  ARETE_CHECK(checkAmt(*this, options.verify, context));
  if (!isPacked()) return model_.mt;
  const AmtContainer& all = container_;
  const LoadParts load = [&](std::span<const FileImage::Part> parts) {
    return all.loadParts(isPaged() && all.owner()->isFar()
                             ? withBlocksJoined(parts, pageBlocks_, packedNodes_)
                             : std::vector(parts.begin(), parts.end()),
                         context);
  };
  Result<MultiTriangulation> mt =
      isPaged() ? unpackMt(*metadata_, {packedDirectory_, packedTables_, pageBlocks_, packedNodes_},
                           options.wanted, context, load)
                : unpackMt(*metadata_, packedDirectory_, packedTables_, packedNodes_, options.wanted, context,
                           load);
  if (memoryBudget() > 0 && !container_.owner()->isFar()) {
    container_.owner()->forget(packedNodes_);
    container_.owner()->forget(pageBlocks_);
  }
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
      metadata_->scale, {packedDirectory_, packedTables_, pageBlocks_, packedNodes_}, wanted,
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

}  // namespace arete
