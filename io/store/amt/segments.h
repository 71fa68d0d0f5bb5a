// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/file.h"

namespace arete {

/// The segments of a file's arrays that an answer depends on, and the check of their checksums (chunk PSUM).
/// Not thread-safe.
class AmtSegments {
 public:
  /// Precondition: AmtFile::hasSegments().
  explicit AmtSegments(const AmtFile& file);

  /// A chunk, by its index in the directory.
  struct Chunk {
    std::size_t index = 0;
  };
  /// Precondition: the file has the chunk, and the chunk has segments.
  Chunk of(const AmtTag& tag) const;

  /// Marks the segments of elements [begin, end) of a chunk as used; load() is to be called before they are
  /// used. Precondition: the chunk has these elements.
  void touch(Chunk chunk, std::uint64_t begin, std::uint64_t end);
  void touchAll(Chunk chunk);
  void touchAll();

  /// Loads what was touched since the last call (AmtContainer::loadParts()), and `beside`. Errors:
  /// unreadable, which check() returns too.
  Status load(const RunContext& context, std::span<const std::byte> beside = {});

  /// Compares the checksums of the segments that are marked and not checked yet. Errors: corrupt: the message
  /// names the first altered chunk; interrupted; unreadable: what could not be loaded. Parallel.
  Status check(const RunContext& context);

 private:
  struct Position {
    std::size_t first = 0;  // the first segment of the chunk
    std::uint32_t elementBytes = 1;
  };
  std::size_t chunkOf(std::size_t segment) const;

  const AmtFile& file_;
  std::vector<Position> positions_;   // per chunk, and the end
  std::vector<std::uint8_t> states_;  // per segment
  std::vector<FileImage::Part> unloaded_;
};

}  // namespace arete
