// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/file/mapped_file.h"
#include "io/format/layout.h"
#include "io/format/shapes.h"

namespace arete {

struct AmtOpenOptions {
  /// Queries will read few parts of a large file: disables the system's read-ahead.
  bool randomAccess = false;
};

/// A mapped .amt file as a directory of chunks, whatever they hold. Header, directory and the metadata's
/// checksum have been checked, the other chunks have not been read. Cheap to copy but for the directory.
class AmtContainer {
 public:
  /// Errors, naming the path: notFound; unreadable: permissions, an empty file; unsupported: not an .amt
  /// file, another version or byte order, a required chunk that is not known; corrupt: cut short (the message
  /// says by how much), a wrong checksum, chunks out of range. O(1).
  static Result<AmtContainer> open(const std::string& path, const AmtOpenOptions& options = {});

  AmtContainer() = default;
  const std::string& path() const { return path_; }
  std::span<const std::byte> bytes() const { return file_->bytes(); }
  /// Keeps the bytes mapped.
  const std::shared_ptr<const MappedFile>& owner() const { return file_; }
  /// The directory, in the order of the file.
  std::span<const AmtChunk> chunks() const { return chunks_; }
  bool isOfSurface() const {
    return find(amt_tag::kPlaces) != nullptr || find(amt_tag::kPackedNumbers) != nullptr;
  }
  bool isPacked() const { return find(amt_tag::kPackedDirectory) != nullptr; }
  /// Null if there is no such chunk.
  const AmtChunk* find(AmtTag tag) const;
  std::span<const std::byte> bytes(const AmtChunk& chunk) const {
    return file_->bytes().subspan(chunk.offset, chunk.bytes);
  }
  std::string_view metadata() const;

  /// Whether every chunk is there, with elements of that type and of that number. Errors: corrupt.
  Status checkShapes(std::span<const AmtShape> shapes) const;
  /// The elements of a chunk. Precondition: checkShapes() found the chunk with such elements.
  template <class T>
  std::span<const T> elements(AmtTag tag) const {
    const AmtChunk& chunk = *find(tag);
    return {reinterpret_cast<const T*>(file_->bytes().data() + chunk.offset), chunk.bytes / sizeof(T)};
  }
  /// Compares the checksums of chunks, but for those of one tag, and checks that the bytes between chunks are
  /// zero. Errors: corrupt: names the chunk; interrupted. Reads the whole file, in parallel.
  Status checkSums(const AmtTag& leftOut, const RunContext& context) const;
  Status checkZeros() const;
  /// That a chunk does not have its checksum.
  tl::unexpected<Error> altered(const AmtChunk& chunk) const;
  /// An error that names the file.
  tl::unexpected<Error> corrupt(const std::string& message) const;

 private:
  Status readHeader(AmtHeader& header) const;
  Status readDirectory(const AmtHeader& header);
  Status checkMetadata() const;
  tl::unexpected<Error> truncated(std::uint64_t wanted) const;

  std::string path_;
  std::shared_ptr<const MappedFile> file_;
  std::vector<AmtChunk> chunks_;
};

}  // namespace arete
