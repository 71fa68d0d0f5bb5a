// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each step of opening relies only on what the steps before it have checked. Magic, byte order and version
// show whether the rest can be understood; the directory's range and checksum, whether it is as it was
// written; the file's length, whether it is complete. Then each chunk must begin where the one before it
// ends, rounded up, which excludes overlaps and gaps. Differences are computed only after comparisons, so
// that no number of a hostile file can wrap around.
#include "io/store/amt/container.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "engine/base/counted.h"
#include "io/files/copied_file.h"
#include "io/files/mapped_file.h"
#include "io/store/format/checksum.h"
#include "io/store/format/schema.h"

namespace arete {

static_assert(std::endian::native == std::endian::little, "the arrays are used as they lie in the file");

tl::unexpected<Error> AmtContainer::corrupt(const std::string& message) const {
  return failure(ErrorCode::corrupt, message, path_);
}

tl::unexpected<Error> AmtContainer::truncated(std::uint64_t wanted) const {
  return corrupt(fmt::format("is cut short: {} of its {} bytes {} missing", wanted - bytes().size(), wanted,
                             agreeing(wanted - bytes().size(), "is", "are")));
}

const AmtChunk* AmtContainer::find(AmtTag tag) const {
  const auto found = std::ranges::find(chunks_, tag, &AmtChunk::tag);
  return found == chunks_.end() ? nullptr : &*found;
}

std::string_view AmtContainer::metadata() const {
  const std::span<const std::byte> text = bytes(*find(amt_tag::kMetadata));
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

/// A file that is read piece by piece can fail at any piece; the image keeps the first problem, and this
/// returns it.
Status AmtContainer::loaded() const {
  const std::optional<Error> problem = file_->problem();
  return problem ? Status(tl::unexpected(*problem)) : Status();
}

Status AmtContainer::load(std::span<const std::byte> part) const {
  return file_->load(part) ? Status() : loaded();
}

Status AmtContainer::loadParts(std::span<const FileImage::Part> parts, const RunContext& context) const {
  return file_->loadParts(parts, context) ? Status() : loaded();
}

Status AmtContainer::loadAll(const RunContext& context) const {
  const FileImage::Part all = bytes();
  return loadParts({&all, 1}, context);
}

Result<std::shared_ptr<const FileImage>> AmtContainer::openImage(const std::string& path,
                                                                 const AmtOpenOptions& options) {
  if (options.isCopied) {
    ARETE_TRY(auto copied, CopiedFile::open(path));
    return std::shared_ptr<const FileImage>(std::move(copied));
  }
  ARETE_TRY(auto mapped, MappedFile::open(path));
  return std::shared_ptr<const FileImage>(std::move(mapped));
}

/// Tells a foreign file, one of another byte order and one of another version apart: each needs other advice.
/// A file shorter than the magic is judged by the bytes that it has.
Status AmtContainer::readHeader(AmtHeader& header) const {
  const auto front = bytes().first(std::min(bytes().size(), sizeof header));
  ARETE_CHECK(load(front));
  const std::size_t magicBytes = std::min(bytes().size(), kAmtMagic.size());
  if (std::memcmp(bytes().data(), kAmtMagic.data(), magicBytes) != 0)
    return failure(ErrorCode::unsupported, "is not an .amt file", path_);
  if (bytes().size() < sizeof header)
    return corrupt(fmt::format("is cut short: its {} bytes are {} too few for the header", bytes().size(),
                               sizeof header - bytes().size()));
  std::memcpy(&header, bytes().data(), sizeof header);
  if (header.byteOrder == kAmtByteOrderSwapped)
    return failure(ErrorCode::unsupported, "was written with its bytes in the other (big-endian) order",
                   path_);
  if (header.byteOrder != kAmtByteOrder) return corrupt("is not an .amt file: no byte order mark");
  if (header.version > kAmtNewestVersion)
    return failure(ErrorCode::unsupported,
                   fmt::format("was made by a newer Arete: format version {}, and this one reads {}",
                               header.version, kAmtNewestVersion),
                   path_);
  if (header.version != 0 && header.version < kAmtVersion)
    return failure(ErrorCode::unsupported,
                   fmt::format("was made by an older Arete: format version {}, and this one reads {}; build "
                               "it again from the terrain",
                               header.version, kAmtNewestVersion),
                   path_);
  if (header.version < kAmtVersion)
    return corrupt(fmt::format("has format version {}, which does not exist", header.version));
  return {};
}

Status AmtContainer::readDirectory(const AmtHeader& header) {
  if (header.headerBytes != sizeof(AmtHeader) || header.directoryOffset != sizeof(AmtHeader) ||
      header.chunkCount > kAmtMaxChunks ||
      header.directoryBytes != std::uint64_t{header.chunkCount} * sizeof(AmtChunk))
    return corrupt(fmt::format("has a damaged header: {} chunks in a directory of {} bytes at {}",
                               header.chunkCount, header.directoryBytes, header.directoryOffset));
  const std::uint64_t directoryEnd = header.directoryOffset + header.directoryBytes;
  if (bytes().size() < directoryEnd) return truncated(std::max(directoryEnd, header.fileBytes));
  ARETE_CHECK(load(bytes().first(directoryEnd)));

  // The checksum lies between the fields that it covers and the directory, so these are joined before it is
  // computed.
  std::vector<std::byte> front(offsetof(AmtHeader, checksum) + header.directoryBytes);
  std::memcpy(front.data(), bytes().data(), offsetof(AmtHeader, checksum));
  std::memcpy(front.data() + offsetof(AmtHeader, checksum), bytes().data() + header.directoryOffset,
              header.directoryBytes);
  if (amtChecksum(front) != header.checksum)
    return corrupt("has been altered: the checksum of its header and directory does not match");
  if (bytes().size() < header.fileBytes) return truncated(header.fileBytes);
  if (bytes().size() > header.fileBytes)
    return corrupt(fmt::format("has {} more than the {} it was written with",
                               counted(bytes().size() - header.fileBytes, "byte", "bytes"),
                               header.fileBytes));
  if (header.reserved != 0) return corrupt("has a header whose reserved field is not zero");

  // Only now are the chunks taken over: each begins at the first multiple of 64 behind the one before it, so
  // that a file has one layout and nothing hides between chunks.
  chunks_.resize(header.chunkCount);
  if (header.chunkCount != 0)
    std::memcpy(chunks_.data(), bytes().data() + header.directoryOffset, header.directoryBytes);
  std::uint64_t end = directoryEnd;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const AmtChunk& chunk = chunks_[i];
    const auto refuse = [&](const std::string& what) {
      return corrupt(
          fmt::format("chunk {} ({} bytes at {}) {}", chunk.name(), chunk.bytes, chunk.offset, what));
    };
    if (chunk.offset > header.fileBytes || chunk.bytes > header.fileBytes - chunk.offset)
      return refuse(fmt::format("reaches beyond the file's {} bytes", header.fileBytes));
    if (chunk.offset % kAmtAlignment != 0) return refuse("does not begin at a multiple of 64");
    if (chunk.offset < amtAligned(end)) return refuse("overlaps what lies before it");
    if (chunk.offset > amtAligned(end)) return refuse("leaves a gap before it");
    if ((chunk.flags & ~(header.version < kAmtNewestVersion ? 0u : kAmtRequired)) != 0)
      return refuse("has a reserved field that is not zero");
    if ((chunk.flags & kAmtRequired) != 0 && findAmtColumn(chunk.tag) == nullptr)
      return failure(ErrorCode::unsupported,
                     fmt::format("was made by a newer Arete: it has a chunk {}, which this one does not know",
                                 chunk.name()),
                     path_);
    for (std::size_t j = 0; j < i; ++j)
      if (chunks_[j].tag == chunk.tag) return refuse("occurs twice");
    end = chunk.offset + chunk.bytes;
  }
  if (header.fileBytes != amtAligned(end))
    return corrupt(fmt::format("has {} bytes where its chunks end at {}", header.fileBytes, end));
  return {};
}

Status AmtContainer::checkMetadata() const {
  const AmtChunk* const chunk = find(amt_tag::kMetadata);
  if (chunk == nullptr) return corrupt("has no chunk META");
  if (chunk->scalar != AmtScalar::u8 || chunk->elementBytes != 1 || chunk->bytes > kAmtMaxMetadataBytes)
    return corrupt(fmt::format("chunk META is not a text of at most {} bytes", kAmtMaxMetadataBytes));
  ARETE_CHECK(load(bytes(*chunk)));
  if (amtChecksum(bytes(*chunk)) != chunk->checksum)
    return corrupt("has been altered: the checksum of chunk META does not match");
  return {};
}

/// The metadata determines the type and the length of each column; afterwards a column can be used as an
/// array without further tests of its bounds.
Status AmtContainer::checkShapes(std::span<const AmtShape> shapes) const {
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
  return {};
}

tl::unexpected<Error> AmtContainer::altered(const AmtChunk& chunk) const {
  return corrupt(fmt::format("has been altered: the checksum of chunk {} does not match", chunk.name()));
}

/// Packets, and the blocks that describe them, have checksums of their own and are checked when they are
/// read: these are left out where only a part is wanted.
Status AmtContainer::checkSums(std::span<const AmtTag> leftOut, const RunContext& context) const {
  std::vector<const AmtChunk*> chunks;
  std::vector<std::span<const std::byte>> blocks;
  for (const AmtChunk& chunk : chunks_) {
    if (std::ranges::find(leftOut, chunk.tag) != leftOut.end()) continue;
    chunks.push_back(&chunk);
    blocks.push_back(bytes(chunk));
  }
  ARETE_CHECK(loadParts(blocks, context));
  const auto sums = amtChecksums(blocks, "check checksums", context);
  if (!sums) return failure(ErrorCode::interrupted, "the check was interrupted", path_);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (sums->blocks[i] != chunks[i]->checksum) return altered(*chunks[i]);
  return {};
}

/// The bytes that no checksum covers are the paddings, so with checkSums() every byte of the file is known.
Status AmtContainer::checkZeros() const {
  std::uint64_t end = sizeof(AmtHeader) + chunks_.size() * sizeof(AmtChunk);
  const auto isZeroUpTo = [&](std::uint64_t begin) {
    const auto padding = bytes().subspan(end, begin - end);
    if (!file_->load(padding)) return false;
    return std::ranges::all_of(padding, [](std::byte b) { return b == std::byte{0}; });
  };
  for (std::size_t i = 0; i <= chunks_.size(); ++i) {
    const bool isLast = i == chunks_.size();
    if (!isZeroUpTo(isLast ? bytes().size() : chunks_[i].offset))
      return !loaded() ? loaded()
                       : corrupt(fmt::format(
                             "has been altered: the bytes at {}, between its chunks, are not zero", end));
    if (!isLast) end = chunks_[i].offset + chunks_[i].bytes;
  }
  return {};
}

Result<AmtContainer> AmtContainer::open(const std::string& path, const AmtOpenOptions& options) {
  ARETE_TRY(auto image, openImage(path, options));
  if (options.randomAccess) image->adviseRandomAccess();
  return open(path, std::move(image));
}

Result<AmtContainer> AmtContainer::open(const std::string& path, std::shared_ptr<const FileImage> image) {
  AmtContainer container;
  container.path_ = path;
  container.file_ = std::move(image);
  AmtHeader header;
  Status status = container.readHeader(header);
  if (status) status = container.readDirectory(header);
  if (status) status = container.checkMetadata();
  if (!status) return tl::unexpected(status.error());
  return container;
}

}  // namespace arete
