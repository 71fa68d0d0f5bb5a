// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sizes of all chunks are known in advance, so their offsets are too. The checksums are computed first,
// from memory; then header, directory, metadata and arrays are written in one forward stream. The arrays must
// have the sizes that the reader requires (amtShapes()), so that what is written can be opened.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/amt/file.h"
#include "io/file/file_writer.h"
#include "io/format/checksum.h"
#include "io/format/metadata.h"
#include "io/packed/packed.h"

namespace arete {
namespace {

constexpr std::size_t kWriteBytes = std::size_t{1} << 23;

struct Source {
  AmtTag tag;
  std::span<const std::byte> bytes;
};

template <class Range>
Source source(AmtTag tag, const Range& elements) {
  return {tag, std::as_bytes(std::span(elements))};
}

std::string_view asText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void pad(FileWriter& out, std::uint64_t& at) {
  static constexpr char zeros[kAmtAlignment] = {};
  const std::uint64_t count = amtAligned(at) - at;
  out.write({zeros, static_cast<std::size_t>(count)});
  at += count;
}

/// Writes one file: collects its chunks, lays them out, computes the checksums, writes.
class AmtWriting {
 public:
  AmtWriting(const std::string& path, const TerrainModel& model, const RunContext& context)
      : path_(path), model_(model), context_(context) {}

  Status run(const AmtWriteOptions& options) {
    const AmtMetadata metadata =
        amtMetadataOf(model_, options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
    if (const auto problem = findAmtProblem(metadata)) return refuse(*problem);
    const VertexArrays& vertices = model_.mt.vertices();
    if (model_.isRaster != vertices.isLattice() || model_.columns != vertices.columns)
      return refuse("its vertices are not of its grid");
    json_ = toAmtJson(metadata);
    if (json_.size() > kAmtMaxMetadataBytes)
      return refuse(fmt::format("{} bytes of metadata are more than {}", json_.size(), kAmtMaxMetadataBytes));

    add(source(amt_tag::kMetadata, json_));
    if (!options.isPacked) {
      addArrays();
    } else if (Status packed = addPacked(); !packed) {
      return packed;
    }
    addExtras();
    for (const AmtShape& shape : amtShapes(metadata, options.isPacked)) shapes_.push_back(shape);
    if (!options.isPacked) addSegmentChecksums();
    if (Status placed = layOut(); !placed) return placed;
    if (!seal()) return interrupted();
    return write();
  }

 private:
  tl::unexpected<Error> refuse(const std::string& problem) const {
    return failure(ErrorCode::invalidData, fmt::format("the model cannot be written: {}", problem), path_);
  }
  tl::unexpected<Error> interrupted() const {
    return failure(ErrorCode::interrupted, "writing was interrupted; the file is as it was before", path_);
  }

  /// A chunk of bytes whose size does not follow from the metadata.
  void add(const Source& bytes) {
    sources_.push_back(bytes);
    shapes_.push_back({bytes.tag, AmtScalar::u8, 1, bytes.bytes.size()});
  }

  void addArrays() {
    const MtArrays& a = model_.mt.arrays();
    const Source arrays[] = {
        source(amt_tag::kRootTriangles, a.rootTriangles),
        source(amt_tag::kSlotBegin, a.slotBegin),
        source(amt_tag::kLink, a.link),
        source(amt_tag::kRemover, a.remover),
        source(amt_tag::kError, a.error),
        source(amt_tag::kBelow, a.below),
        source(amt_tag::kAbove, a.above),
        source(amt_tag::kFloor, a.floor),
        source(amt_tag::kSaturatedError, a.saturatedError),
        source(amt_tag::kSphere, a.sphere),
        source(amt_tag::kBlockError, a.blockError),
        source(amt_tag::kBlockSphere, a.blockSphere),
        source(amt_tag::kCreatorHint, a.creatorHint),
        model_.isRaster ? source(amt_tag::kSamples, a.vertices.samples)
                        : source(amt_tag::kPlan, a.vertices.plan),
        source(amt_tag::kHeights, a.vertices.rawHeights),
    };
    sources_.insert(sources_.end(), std::begin(arrays), std::end(arrays));
  }

  Status addPacked() {
    Result<PackedMt> packed = packMt(model_, context_);
    if (!packed) {
      if (packed.error().code == ErrorCode::interrupted) return interrupted();
      return failure(packed.error().code, "the model cannot be packed: " + packed.error().message, path_);
    }
    packed_ = std::move(*packed);
    add(source(amt_tag::kPackedDirectory, packed_.directory));
    add(source(amt_tag::kPackedTables, packed_.tables));
    add(source(amt_tag::kPackedNodes, packed_.nodes));
    return {};
  }

  /// IsolatedSample has padding of undefined bytes, so its members are written as two arrays.
  void addExtras() {
    for (const IsolatedSample& sample : model_.isolated) {
      isolatedSamples_.push_back(sample.sample);
      isolatedHeights_.push_back(sample.height);
    }
    sources_.push_back(source(amt_tag::kIsolatedSamples, isolatedSamples_));
    sources_.push_back(source(amt_tag::kIsolatedHeights, isolatedHeights_));
    sources_.push_back(source(amt_tag::kFixedVertices, model_.options.fixedVertices));
  }

  /// Reserves the chunk; sealSegments() fills it.
  void addSegmentChecksums() {
    std::uint64_t count = 0;
    for (const Source& s : sources_) count += amtSegmentCount(s.tag, s.bytes.size());
    segmentChecksums_.resize(count);
    sources_.push_back(source(amt_tag::kSegmentChecksums, segmentChecksums_));
    shapes_.push_back(amtSegmentShape(count));
  }

  /// Fills the header and the directory, except for checksums.
  Status layOut() {
    header_.chunkCount = static_cast<std::uint32_t>(sources_.size());
    header_.directoryBytes = sources_.size() * sizeof(AmtChunk);
    directory_.resize(sources_.size());
    std::uint64_t at = header_.directoryOffset + header_.directoryBytes;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const AmtShape& shape = shapes_[i];
      AmtChunk& chunk = directory_[i];
      chunk.tag = shape.tag;
      chunk.scalar = shape.scalar;
      chunk.elementBytes = shape.elementBytes;
      chunk.offset = amtAligned(at);
      chunk.bytes = sources_[i].bytes.size();
      if (sources_[i].tag != shape.tag || chunk.bytes != shape.count * shape.elementBytes)
        return refuse(fmt::format("its {} array has {} bytes instead of the {} of its counts", chunk.name(),
                                  chunk.bytes, shape.count * shape.elementBytes));
      at = chunk.offset + chunk.bytes;
    }
    header_.fileBytes = amtAligned(at);
    return {};
  }

  /// Computes the checksums. Returns false if cancelled.
  bool seal() {
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

  void sealSegments(const AmtChecksums& sums) {
    auto to = segmentChecksums_.begin();
    for (std::size_t i = 0; i < sums.segments.size(); ++i)
      if (sources_[i].tag != amt_tag::kMetadata) to = std::ranges::copy(sums.segments[i], to).out;
    directory_.back().checksum = amtChecksum(sources_.back().bytes);
  }

  Status write() const {
    Result<FileWriter> out = FileWriter::create(path_);
    if (!out) return tl::unexpected(out.error());
    out->write(asText(std::as_bytes(std::span(&header_, 1))));
    out->write(asText(std::as_bytes(std::span(directory_))));
    std::uint64_t at = header_.directoryOffset + header_.directoryBytes;
    for (const Source& s : sources_) {
      pad(*out, at);
      for (std::size_t begin = 0; begin < s.bytes.size(); begin += kWriteBytes) {
        context_.report("write", static_cast<double>(at) / static_cast<double>(header_.fileBytes));
        if (context_.cancelled()) return interrupted();
        const auto span = s.bytes.subspan(begin, std::min(kWriteBytes, s.bytes.size() - begin));
        out->write(asText(span));
        at += span.size();
      }
    }
    pad(*out, at);
    if (context_.cancelled()) return interrupted();
    if (Status finished = out->finish(); !finished) return finished;
    context_.report("write", 1);
    return {};
  }

  const std::string& path_;
  const TerrainModel& model_;
  const RunContext& context_;
  std::string json_;  // this and the next four: what sources_ points to, beside the model
  PackedMt packed_;
  std::vector<std::uint64_t> segmentChecksums_;
  std::vector<std::uint32_t> isolatedSamples_;
  std::vector<double> isolatedHeights_;
  std::vector<Source> sources_;   // the chunks, in the order of the file
  std::vector<AmtShape> shapes_;  // what each is by the metadata
  AmtHeader header_;
  std::vector<AmtChunk> directory_;
};

}  // namespace

Status writeAmt(const std::string& path, const TerrainModel& model, const RunContext& context,
                const AmtWriteOptions& options) try {
  return AmtWriting(path, model, context).run(options);
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
