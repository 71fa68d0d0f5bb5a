// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/format/checksum.h"
#include "io/store/format/layout.h"
#include "io/store/format/shapes.h"

namespace arete {

/// Writes a file of chunks: lays them out, computes the checksums from memory, then writes header, directory
/// and chunks in one forward stream. The file appears under its name whole or not at all.
class AmtChunkWriter {
 public:
  AmtChunkWriter(std::string path, const RunContext& context) : path_(std::move(path)), context_(context) {}

  /// Adds a chunk whose size is that of the shape, else write() refuses it. The bytes outlive the writer.
  void add(const AmtShape& shape, std::span<const std::byte> bytes, std::uint32_t flags = 0);
  /// Adds a chunk of bytes of any number.
  void add(AmtTag tag, std::span<const std::byte> bytes, std::uint32_t flags = 0) {
    add({tag, AmtScalar::u8, 1, bytes.size()}, bytes, flags);
  }
  /// Adds the checksums of the segments of all chunks before it.
  void addSegmentChecksums();

  /// Writes a file of this version of the format.
  ///
  /// Errors, naming the path: invalidData: a chunk has another size than its shape; notFound, unreadable:
  /// folder, permissions, disk full; interrupted. Every byte is read twice: for the checksums, in parallel by
  /// chunks, and for writing.
  Status write(std::uint32_t version);

  tl::unexpected<Error> refuse(const std::string& problem) const;
  tl::unexpected<Error> interrupted() const;

 private:
  struct Source {
    AmtShape shape;
    std::span<const std::byte> bytes;
    std::uint32_t flags;
  };

  Status layOut();
  bool seal();
  void sealSegments(const AmtChecksums& sums);
  Status stream() const;

  std::string path_;
  const RunContext& context_;
  std::vector<Source> sources_;  // in the order of the file
  std::vector<std::uint64_t> segmentChecksums_;
  AmtHeader header_;
  std::vector<AmtChunk> directory_;
};

}  // namespace arete
