// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/amt/file.h"

namespace arete {

/// Which segments of a file's arrays an answer rests on, to be held against their checksums (chunk PSUM). For
/// one thread.
class AmtSegments {
 public:
  /// Precondition: AmtFile::hasSegments().
  explicit AmtSegments(const AmtFile& file);

  /// One of the chunks, by its place in the directory.
  struct Chunk {
    std::size_t index = 0;
  };
  /// Precondition: the file has such a chunk, and it has segments.
  Chunk of(const AmtTag& tag) const;

  /// Elements [begin, end) of the chunk have been, or will be, read. Precondition: there are so many.
  void touch(Chunk chunk, std::uint64_t begin, std::uint64_t end);
  void touchAll(Chunk chunk);
  void touchAll();

  /// Holds what was touched since the last call against its checksums. Errors: corrupt, naming the chunk;
  /// interrupted. Parallel.
  Status check(const RunContext& context);

 private:
  struct Place {
    std::size_t first = 0;  // of its segments
    std::uint32_t elementBytes = 1;
  };
  std::size_t chunkOf(std::size_t segment) const;

  const AmtFile& file_;
  std::vector<Place> places_;  // of each chunk, and the end
  std::vector<std::uint8_t> isTouched_;
};

}  // namespace arete
