// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizes of all chunks are known in advance, so their offsets are too.
#include "io/store/amt/chunk_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "io/files/file_writer.h"

namespace arete {
namespace {

constexpr std::size_t kWriteBytes = std::size_t{1} << 23;

std::string_view asText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void pad(FileWriter& out, std::uint64_t& at) {
  static constexpr char zeros[kAmtAlignment] = {};
  const std::uint64_t count = amtAligned(at) - at;
  out.write({zeros, static_cast<std::size_t>(count)});
  at += count;
}

}  // namespace

void AmtChunkWriter::add(const AmtShape& shape, std::span<const std::byte> bytes, std::uint32_t flags) {
  sources_.push_back({shape, bytes, flags});
}

void AmtChunkWriter::addSegmentChecksums() {
  std::uint64_t count = 0;
  for (const Source& s : sources_) count += amtSegmentCount(s.shape.tag, s.bytes.size());
  segmentChecksums_.resize(count);
  add({amt_tag::kSegmentChecksums, AmtScalar::u32, 8, count}, std::as_bytes(std::span(segmentChecksums_)));
}

tl::unexpected<Error> AmtChunkWriter::refuse(const std::string& problem) const {
  return failure(ErrorCode::invalidData, fmt::format("the model cannot be written: {}", problem), path_);
}

tl::unexpected<Error> AmtChunkWriter::interrupted() const {
  return failure(ErrorCode::interrupted, "writing was interrupted; the file is as it was before", path_);
}

Status AmtChunkWriter::write(std::uint32_t version) {
  header_.version = version;
  ARETE_CHECK(layOut());
  if (!seal()) return interrupted();
  return stream();
}

/// Fills the header and the directory, except for checksums.
Status AmtChunkWriter::layOut() {
  header_.chunkCount = static_cast<std::uint32_t>(sources_.size());
  header_.directoryBytes = sources_.size() * sizeof(AmtChunk);
  directory_.resize(sources_.size());
  std::uint64_t at = header_.directoryOffset + header_.directoryBytes;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const AmtShape& shape = sources_[i].shape;
    AmtChunk& chunk = directory_[i];
    chunk.tag = shape.tag;
    chunk.scalar = shape.scalar;
    chunk.elementBytes = shape.elementBytes;
    chunk.flags = sources_[i].flags;
    chunk.offset = amtAligned(at);
    chunk.bytes = sources_[i].bytes.size();
    if (chunk.bytes != shape.count * shape.elementBytes)
      return refuse(fmt::format("its {} array has {} bytes instead of the {} of its counts", chunk.name(),
                                chunk.bytes, shape.count * shape.elementBytes));
    at = chunk.offset + chunk.bytes;
  }
  header_.fileBytes = amtAligned(at);
  return {};
}

/// Computes the checksums. Returns false if cancelled.
bool AmtChunkWriter::seal() {
  std::vector<std::span<const std::byte>> blocks;
  for (const Source& s : sources_) blocks.push_back(s.bytes);
  const bool hasSegments = !segmentChecksums_.empty();
  if (hasSegments) blocks.pop_back();
  const auto sums = amtChecksums(blocks, "checksum", context_);
  if (!sums) return false;
  for (std::size_t i = 0; i < blocks.size(); ++i) directory_[i].checksum = sums->blocks[i];
  if (hasSegments) sealSegments(*sums);
  std::vector<std::byte> front(offsetof(AmtHeader, checksum) + header_.directoryBytes);
  std::memcpy(front.data(), &header_, offsetof(AmtHeader, checksum));
  std::memcpy(front.data() + offsetof(AmtHeader, checksum), directory_.data(), header_.directoryBytes);
  header_.checksum = amtChecksum(front);
  return true;
}

void AmtChunkWriter::sealSegments(const AmtChecksums& sums) {
  auto to = segmentChecksums_.begin();
  for (std::size_t i = 0; i < sums.segments.size(); ++i)
    if (sources_[i].shape.tag != amt_tag::kMetadata) to = std::ranges::copy(sums.segments[i], to).out;
  directory_.back().checksum = amtChecksum(sources_.back().bytes);
}

Status AmtChunkWriter::stream() const {
  ARETE_TRY(FileWriter out, FileWriter::create(path_));
  out.write(asText(std::as_bytes(std::span(&header_, 1))));
  out.write(asText(std::as_bytes(std::span(directory_))));
  std::uint64_t at = header_.directoryOffset + header_.directoryBytes;
  for (const Source& s : sources_) {
    pad(out, at);
    for (std::size_t begin = 0; begin < s.bytes.size(); begin += kWriteBytes) {
      context_.report("write", static_cast<double>(at) / static_cast<double>(header_.fileBytes));
      if (context_.cancelled()) return interrupted();
      const auto span = s.bytes.subspan(begin, std::min(kWriteBytes, s.bytes.size() - begin));
      out.write(asText(span));
      at += span.size();
    }
  }
  pad(out, at);
  if (context_.cancelled()) return interrupted();
  ARETE_CHECK(out.finish());
  context_.report("write", 1);
  return {};
}

}  // namespace arete
