// SPDX-License-Identifier: GPL-3.0-or-later
//
// All sizes are known beforehand, so the places of the chunks are too. The checksums are taken first, from
// memory; then header, directory, metadata and arrays go out in one forward stream. The model is held against
// the same table of sizes that the reader uses: what is written can be opened.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "io/amt_checksum.h"
#include "io/amt_file.h"
#include "io/amt_metadata.h"
#include "io/file_writer.h"
#include "io/packed_amt.h"

namespace arete {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 23;

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

tl::unexpected<Error> interrupted(const std::string& path) {
  return failure(ErrorCode::interrupted, "writing was interrupted; the file is as it was before", path);
}

}  // namespace

Status writeAmt(const std::string& path, const TerrainModel& model, const RunContext& context,
                const AmtWriteOptions& options) {
  const MtArrays& a = model.mt.arrays();
  const AmtMetadata metadata =
      amtMetadataOf(model, options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
  const auto refuse = [&](const std::string& problem) {
    return failure(ErrorCode::invalidData, fmt::format("the model cannot be written: {}", problem), path);
  };
  if (const auto problem = findAmtProblem(metadata)) return refuse(*problem);
  if (model.isRaster != a.vertices.isLattice() || model.columns != a.vertices.columns)
    return refuse("its vertices are not of its grid");
  const std::string json = toAmtJson(metadata);
  if (json.size() > kAmtMaxMetadataBytes)
    return refuse(fmt::format("{} bytes of metadata are more than {}", json.size(), kAmtMaxMetadataBytes));

  // IsolatedSample has padding, whose bytes are anyone's: the file keeps its members apart.
  std::vector<std::uint32_t> isolatedSamples;
  std::vector<double> isolatedHeights;
  for (const IsolatedSample& sample : model.isolated) {
    isolatedSamples.push_back(sample.sample);
    isolatedHeights.push_back(sample.height);
  }
  std::vector<Source> sources = {source(amt_tag::kMetadata, json)};
  std::vector<AmtShape> shapes = {{amt_tag::kMetadata, AmtScalar::u8, 1, json.size()}};
  PackedMt packed;
  if (options.isPacked) {
    Result<PackedMt> result = packMt(model, context);
    if (!result) {
      if (result.error().code == ErrorCode::interrupted) return interrupted(path);
      return failure(result.error().code, "the model cannot be packed: " + result.error().message, path);
    }
    packed = std::move(*result);
    for (const Source& part :
         {source(amt_tag::kPackedDirectory, packed.directory), source(amt_tag::kPackedTables, packed.tables),
          source(amt_tag::kPackedNodes, packed.nodes)}) {
      sources.push_back(part);
      shapes.push_back({part.tag, AmtScalar::u8, 1, part.bytes.size()});
    }
  } else {
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
        model.isRaster ? source(amt_tag::kSamples, a.vertices.samples)
                       : source(amt_tag::kPlan, a.vertices.plan),
        source(amt_tag::kHeights, a.vertices.rawHeights),
    };
    sources.insert(sources.end(), std::begin(arrays), std::end(arrays));
  }
  sources.push_back(source(amt_tag::kIsolatedSamples, isolatedSamples));
  sources.push_back(source(amt_tag::kIsolatedHeights, isolatedHeights));
  sources.push_back(source(amt_tag::kFixedVertices, model.options.fixedVertices));
  for (const AmtShape& shape : amtShapes(metadata, options.isPacked)) shapes.push_back(shape);

  AmtHeader header;
  header.chunkCount = static_cast<std::uint32_t>(sources.size());
  header.directoryBytes = sources.size() * sizeof(AmtChunk);
  std::vector<AmtChunk> directory(sources.size());
  std::vector<std::span<const std::byte>> blocks;
  std::uint64_t at = header.directoryOffset + header.directoryBytes;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const AmtShape& shape = shapes[i];
    AmtChunk& chunk = directory[i];
    chunk.tag = shape.tag;
    chunk.scalar = shape.scalar;
    chunk.elementBytes = shape.elementBytes;
    chunk.offset = amtAligned(at);
    chunk.bytes = sources[i].bytes.size();
    if (sources[i].tag != shape.tag || chunk.bytes != shape.count * shape.elementBytes)
      return refuse(fmt::format("its {} array has {} bytes where its counts ask for {}", chunk.name(),
                                chunk.bytes, shape.count * shape.elementBytes));
    blocks.push_back(sources[i].bytes);
    at = chunk.offset + chunk.bytes;
  }
  header.fileBytes = amtAligned(at);

  const auto sums = amtChecksums(blocks, "checksum", context);
  if (!sums) return interrupted(path);
  for (std::size_t i = 0; i < directory.size(); ++i) directory[i].checksum = (*sums)[i];
  std::vector<std::byte> front(offsetof(AmtHeader, checksum) + header.directoryBytes);
  std::memcpy(front.data(), &header, offsetof(AmtHeader, checksum));
  std::memcpy(front.data() + offsetof(AmtHeader, checksum), directory.data(), header.directoryBytes);
  header.checksum = amtChecksum(front);

  Result<FileWriter> out = FileWriter::create(path);
  if (!out) return tl::unexpected(out.error());
  out->write(asText(std::as_bytes(std::span(&header, 1))));
  out->write(asText(std::as_bytes(std::span(directory))));
  at = header.directoryOffset + header.directoryBytes;
  for (const auto& block : blocks) {
    pad(*out, at);
    for (std::size_t begin = 0; begin < block.size(); begin += kPiece) {
      context.report("write", static_cast<double>(at) / static_cast<double>(header.fileBytes));
      if (context.cancelled()) return interrupted(path);
      const auto piece = block.subspan(begin, std::min(kPiece, block.size() - begin));
      out->write(asText(piece));
      at += piece.size();
    }
  }
  pad(*out, at);
  if (context.cancelled()) return interrupted(path);
  if (const Status finished = out->finish(); !finished) return finished;
  context.report("write", 1);
  return {};
}

}  // namespace arete
