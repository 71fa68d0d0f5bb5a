// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each step of opening relies only on what the steps before it have checked. Magic, byte order and version
// show whether the rest can be understood; the directory's range and checksum, whether it is as it was
// written; the file's length, whether it is complete. Then each chunk must begin where the one before it
// ends, rounded up, which excludes overlaps and gaps, and have the size that follows from the counts in the
// metadata. Differences are computed only after comparisons, so that no number of a hostile file can wrap
// around.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/mt/node_blocks.h"
#include "io/amt/file.h"
#include "io/amt/part.h"
#include "io/format/checksum.h"
#include "io/format/metadata.h"
#include "io/packed/packed.h"

namespace arete {

class AmtOpener {
 public:
  static Result<AmtFile> open(const std::string& path, const AmtOpenOptions& options);

 private:
  explicit AmtOpener(AmtFile& file) : file_(file), all_(file.file_->bytes()) {}

  Status readHeader();
  Status readDirectory();
  Status readMetadata(AmtMetadata& metadata) const;
  Status placeArrays(const AmtMetadata& metadata);

  const AmtChunk* find(AmtTag tag) const {
    for (const AmtChunk& chunk : file_.chunks_)
      if (chunk.tag == tag) return &chunk;
    return nullptr;
  }
  tl::unexpected<Error> corrupt(const std::string& message) const {
    return failure(ErrorCode::corrupt, message, file_.path_);
  }
  tl::unexpected<Error> truncated(std::uint64_t wanted) const {
    return corrupt(fmt::format("is cut short: {} of its {} bytes are missing", wanted - all_.size(), wanted));
  }
  template <class T>
  void place(AmtTag tag, std::span<const T>& to) const {
    const AmtChunk& chunk = *find(tag);
    to = {reinterpret_cast<const T*>(all_.data() + chunk.offset), chunk.bytes / sizeof(T)};
  }

  AmtFile& file_;
  std::span<const std::byte> all_;
  AmtHeader header_;
};

static_assert(std::endian::native == std::endian::little, "the arrays are used as they lie in the file");
static_assert(sizeof(Vec2) == 16 && sizeof(Sphere) == 16 && sizeof(std::array<std::uint32_t, 3>) == 12);

Status AmtOpener::readHeader() {
  const std::size_t magicBytes = std::min(all_.size(), kAmtMagic.size());
  if (std::memcmp(all_.data(), kAmtMagic.data(), magicBytes) != 0)
    return failure(ErrorCode::unsupported, "is not an .amt file", file_.path_);
  if (all_.size() < sizeof header_)
    return corrupt(fmt::format("is cut short: its {} bytes are {} too few for the header", all_.size(),
                               sizeof header_ - all_.size()));
  std::memcpy(&header_, all_.data(), sizeof header_);
  if (header_.byteOrder == kAmtByteOrderSwapped)
    return failure(ErrorCode::unsupported, "was written with its bytes in the other (big-endian) order",
                   file_.path_);
  if (header_.byteOrder != kAmtByteOrder) return corrupt("is not an .amt file: no byte order mark");
  if (header_.version > kAmtVersion)
    return failure(ErrorCode::unsupported,
                   fmt::format("was made by a newer Arete: format version {}, and this one reads {}",
                               header_.version, kAmtVersion),
                   file_.path_);
  if (header_.version != 0 && header_.version < kAmtVersion)
    return failure(ErrorCode::unsupported,
                   fmt::format("was made by an older Arete: format version {}, and this one reads {}; build "
                               "it again from the terrain",
                               header_.version, kAmtVersion),
                   file_.path_);
  if (header_.version != kAmtVersion)
    return corrupt(fmt::format("has format version {}, which does not exist", header_.version));
  return {};
}

Status AmtOpener::readDirectory() {
  if (header_.headerBytes != sizeof(AmtHeader) || header_.directoryOffset != sizeof(AmtHeader) ||
      header_.chunkCount > kAmtMaxChunks ||
      header_.directoryBytes != std::uint64_t{header_.chunkCount} * sizeof(AmtChunk))
    return corrupt(fmt::format("has a damaged header: {} chunks in a directory of {} bytes at {}",
                               header_.chunkCount, header_.directoryBytes, header_.directoryOffset));
  const std::uint64_t directoryEnd = header_.directoryOffset + header_.directoryBytes;
  if (all_.size() < directoryEnd) return truncated(std::max(directoryEnd, header_.fileBytes));

  std::vector<std::byte> front(offsetof(AmtHeader, checksum) + header_.directoryBytes);
  std::memcpy(front.data(), all_.data(), offsetof(AmtHeader, checksum));
  std::memcpy(front.data() + offsetof(AmtHeader, checksum), all_.data() + header_.directoryOffset,
              header_.directoryBytes);
  if (amtChecksum(front) != header_.checksum)
    return corrupt("has been altered: the checksum of its header and directory does not match");
  if (all_.size() < header_.fileBytes) return truncated(header_.fileBytes);
  if (all_.size() > header_.fileBytes)
    return corrupt(fmt::format("has {} bytes more than the {} it was written with",
                               all_.size() - header_.fileBytes, header_.fileBytes));
  if (header_.reserved != 0) return corrupt("has a header whose reserved field is not zero");

  file_.chunks_.resize(header_.chunkCount);
  if (header_.chunkCount != 0)
    std::memcpy(file_.chunks_.data(), all_.data() + header_.directoryOffset, header_.directoryBytes);
  std::uint64_t end = directoryEnd;
  for (std::size_t i = 0; i < file_.chunks_.size(); ++i) {
    const AmtChunk& chunk = file_.chunks_[i];
    const auto refuse = [&](const std::string& what) {
      return corrupt(
          fmt::format("chunk {} ({} bytes at {}) {}", chunk.name(), chunk.bytes, chunk.offset, what));
    };
    if (chunk.offset > header_.fileBytes || chunk.bytes > header_.fileBytes - chunk.offset)
      return refuse(fmt::format("reaches beyond the file's {} bytes", header_.fileBytes));
    if (chunk.offset % kAmtAlignment != 0) return refuse("does not begin at a multiple of 64");
    if (chunk.offset < amtAligned(end)) return refuse("overlaps what lies before it");
    if (chunk.offset > amtAligned(end)) return refuse("leaves a gap before it");
    if (chunk.reserved != 0) return refuse("has a reserved field that is not zero");
    for (std::size_t j = 0; j < i; ++j)
      if (file_.chunks_[j].tag == chunk.tag) return refuse("occurs twice");
    end = chunk.offset + chunk.bytes;
  }
  if (header_.fileBytes != amtAligned(end))
    return corrupt(fmt::format("has {} bytes where its chunks end at {}", header_.fileBytes, end));
  return {};
}

Status AmtOpener::readMetadata(AmtMetadata& metadata) const {
  const AmtChunk* const chunk = find(amt_tag::kMetadata);
  if (chunk == nullptr) return corrupt("has no chunk META");
  if (chunk->scalar != AmtScalar::u8 || chunk->elementBytes != 1 || chunk->bytes > kAmtMaxMetadataBytes)
    return corrupt(fmt::format("chunk META is not a text of at most {} bytes", kAmtMaxMetadataBytes));
  const std::span<const std::byte> bytes = file_.bytes(*chunk);
  if (amtChecksum(bytes) != chunk->checksum)
    return corrupt("has been altered: the checksum of chunk META does not match");
  Result<AmtMetadata> read = fromAmtJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (!read) return corrupt(fmt::format("chunk META: {}", read.error().message));
  metadata = std::move(*read);
  return {};
}

Status AmtOpener::placeArrays(const AmtMetadata& metadata) {
  const bool isPacked = find(amt_tag::kPackedDirectory) != nullptr;
  std::vector<AmtShape> shapes = amtShapes(metadata, isPacked);
  if (isPacked)
    for (const AmtTag tag : {amt_tag::kPackedDirectory, amt_tag::kPackedTables, amt_tag::kPackedNodes})
      shapes.push_back({tag, AmtScalar::u8, 1, find(tag) == nullptr ? 0 : find(tag)->bytes});
  const bool hasSegments = find(amt_tag::kSegmentChecksums) != nullptr;
  if (hasSegments) {
    std::uint64_t segments = 0;
    for (const AmtChunk& chunk : file_.chunks_) segments += amtSegmentCount(chunk.tag, chunk.bytes);
    shapes.push_back(amtSegmentShape(segments));
  }
  for (const AmtShape& shape : shapes) {
    const AmtChunk* const chunk = find(shape.tag);
    if (chunk == nullptr)
      return corrupt(fmt::format("has no chunk {}", std::string_view(shape.tag.data(), shape.tag.size())));
    if (chunk->scalar != shape.scalar || chunk->elementBytes != shape.elementBytes)
      return corrupt(
          fmt::format("chunk {} has elements of another type than its metadata says", chunk->name()));
    if (chunk->bytes != shape.count * shape.elementBytes)
      return corrupt(fmt::format("chunk {} has {} bytes instead of {} elements of {} bytes", chunk->name(),
                                 chunk->bytes, shape.count, shape.elementBytes));
  }

  file_.writer_ = metadata.writer;
  file_.model_ = metadata.model;
  file_.nodeCount_ = metadata.counts.nodes;
  MtArrays a;
  a.rootVertices = static_cast<std::uint32_t>(metadata.counts.rootVertices);
  place(amt_tag::kIsolatedSamples, file_.isolatedSamples_);
  place(amt_tag::kIsolatedHeights, file_.isolatedHeights_);
  place(amt_tag::kFixedVertices, file_.fixedVertices_);
  if (hasSegments) place(amt_tag::kSegmentChecksums, file_.segmentChecksums_);
  if (isPacked) {
    place(amt_tag::kPackedDirectory, file_.packedDirectory_);
    place(amt_tag::kPackedTables, file_.packedTables_);
    place(amt_tag::kPackedNodes, file_.packedNodes_);
    file_.metadata_ = std::make_shared<const AmtMetadata>(metadata);
    file_.model_.mt = MultiTriangulation(a, file_.file_);
    return {};
  }
  place(amt_tag::kRootTriangles, a.rootTriangles);
  place(amt_tag::kSlotBegin, a.slotBegin);
  place(amt_tag::kLink, a.link);
  place(amt_tag::kRemover, a.remover);
  place(amt_tag::kError, a.error);
  place(amt_tag::kBelow, a.below);
  place(amt_tag::kAbove, a.above);
  place(amt_tag::kFloor, a.floor);
  place(amt_tag::kSaturatedError, a.saturatedError);
  place(amt_tag::kSphere, a.sphere);
  place(amt_tag::kBlockError, a.blockError);
  place(amt_tag::kBlockSphere, a.blockSphere);
  place(amt_tag::kCreatorHint, a.creatorHint);
  if (metadata.model.isRaster)
    place(amt_tag::kSamples, a.vertices.samples);
  else
    place(amt_tag::kPlan, a.vertices.plan);
  a.vertices.columns = metadata.model.columns;
  a.vertices.encoding = metadata.encoding;
  place(amt_tag::kHeights, a.vertices.rawHeights);
  a.scale = metadata.scale;
  a.metric = metadata.metric;
  file_.model_.mt = MultiTriangulation(a, file_.file_);
  return {};
}

Result<AmtFile> AmtOpener::open(const std::string& path, const AmtOpenOptions& options) {
  auto mapped = MappedFile::open(path);
  if (!mapped) return tl::unexpected(mapped.error());
  AmtFile file;
  file.path_ = path;
  file.file_ = std::move(*mapped);
  if (options.randomAccess) file.file_->adviseRandomAccess();
  AmtOpener opener(file);
  AmtMetadata metadata;
  Status status = opener.readHeader();
  if (status) status = opener.readDirectory();
  if (status) status = opener.readMetadata(metadata);
  if (status) status = opener.placeArrays(metadata);
  if (!status) return tl::unexpected(status.error());
  return file;
}

double AmtFile::errorBeyond(std::uint64_t nodes) const {
  if (isPacked()) return packedErrorBeyond(packedDirectory_, metadata_->scale, nodes);
  if (!hasSegments()) return 0;
  const MtArrays& a = model_.mt.arrays();
  const std::uint64_t page = nodes / MultiTriangulation::kNodesPerPage + 1,
                      entry = nodeBlockCount(nodeCount_) + page;
  return entry < a.blockError.size() ? a.scale.decode(a.blockError[entry]) : 0;
}

Result<MultiTriangulation> AmtFile::readMt(const AmtReadOptions& options, const RunContext& context) const {
  const bool isPart = options.wanted && options.verify != AmtVerify::none && !isPacked() && hasSegments();
  if (isPart) return readAmtPart(*this, options.wanted, options.verify, context);
  if (Status checked = checkAmt(*this, options.verify, context); !checked)
    return tl::unexpected(checked.error());
  if (!isPacked()) return model_.mt;
  Result<MultiTriangulation> mt =
      unpackMt(*metadata_, packedDirectory_, packedTables_, packedNodes_, options.wanted, context);
  if (!mt) return failure(mt.error().code, mt.error().message, path_);
  return mt;
}

Result<TerrainModel> AmtFile::read(const AmtReadOptions& options, const RunContext& context) const try {
  Result<MultiTriangulation> mt = readMt(options, context);
  if (!mt) return tl::unexpected(mt.error());
  TerrainModel model = model_;
  model.mt = std::move(*mt);
  model.options.fixedVertices.assign(fixedVertices_.begin(), fixedVertices_.end());
  model.isolated.reserve(isolatedSamples_.size());
  for (std::size_t i = 0; i < isolatedSamples_.size(); ++i)
    model.isolated.push_back({isolatedSamples_[i], isolatedHeights_[i]});
  return model;
} catch (...) {
  return caughtFailure(path_);
}

Result<AmtFile> openAmt(const std::string& path, const AmtOpenOptions& options) try {
  return AmtOpener::open(path, options);
} catch (...) {
  return caughtFailure(path);
}

Result<TerrainModel> loadAmt(const std::string& path, const AmtLoadOptions& options,
                             const RunContext& context) try {
  const Result<AmtFile> file = openAmt(path, options.open);
  if (!file) return tl::unexpected(file.error());
  return file->read({options.verify, options.wanted}, context);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
