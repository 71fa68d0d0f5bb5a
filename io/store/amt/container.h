// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/files/file_image.h"
#include "io/store/format/layout.h"
#include "io/store/format/shapes.h"

namespace arete {

struct AmtOpenOptions {
  /// Reads parts into memory when they are used, and does not map the file: in programs that are not ours,
  /// which must not end because another one truncates it (io/files/copied_file.h).
  bool isCopied = false;
  /// Queries will read few parts of a large file: disables the system's read-ahead.
  bool randomAccess = false;
  /// Ends the opening of a file on a server. May be null; it is not kept.
  const std::atomic<bool>* cancel = nullptr;
};

/// An .amt file as a directory of chunks, whatever they hold: mapped, read piece by piece, or whole in
/// memory. Header, directory and the metadata's checksum have been checked, the other chunks have not been
/// read. Cheap to copy but for the directory.
class AmtContainer {
 public:
  /// Errors, naming the path: notFound; unreadable: permissions, an empty file, a file that is changed while
  /// it is open; unsupported: not an .amt
  /// file, another version or byte order, a required chunk that is not known; corrupt: cut short (the message
  /// says by how much), a wrong checksum, chunks out of range. O(1).
  static Result<AmtContainer> open(const std::string& path, const AmtOpenOptions& options = {});
  /// The same of bytes that were read elsewhere; `path` names them in errors.
  static Result<AmtContainer> open(const std::string& path, std::shared_ptr<const FileImage> image);

  AmtContainer() = default;
  const std::string& path() const { return path_; }
  std::span<const std::byte> bytes() const { return file_->bytes(); }
  /// Keeps the bytes.
  const std::shared_ptr<const FileImage>& owner() const { return file_; }
  /// Reads a part of bytes() from a file that is read piece by piece. Every part has to be loaded before it
  /// is used: it is zeros until then. Thread-safe. Errors: unreadable: the file was changed.
  Status load(std::span<const std::byte> part) const;
  /// The same of several parts, fetched together where they come from a server.
  Status loadParts(std::span<const FileImage::Part> parts, const RunContext& context = {}) const;
  Status loadAll(const RunContext& context = {}) const;
  /// The first error of load(), on any thread.
  Status loaded() const;
  /// The directory, in the order of the file.
  std::span<const AmtChunk> chunks() const { return chunks_; }
  bool isOfSurface() const {
    return find(amt_tag::kPlaces) != nullptr || find(amt_tag::kPackedNumbers) != nullptr;
  }
  bool isPaged() const { return find(amt_tag::kPageRoot) != nullptr; }
  bool isPacked() const { return isPaged() || find(amt_tag::kPackedDirectory) != nullptr; }
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
  /// Compares the checksums of all chunks but some, which are named by their tags. Errors: corrupt: names the
  /// chunk; interrupted. Reads the chunks, in parallel.
  Status checkSums(std::span<const AmtTag> leftOut, const RunContext& context) const;
  /// Checks that the bytes between chunks are zero. Errors: corrupt.
  Status checkZeros() const;
  /// That a chunk does not have its checksum.
  tl::unexpected<Error> altered(const AmtChunk& chunk) const;
  /// An error that names the file.
  tl::unexpected<Error> corrupt(const std::string& message) const;

 private:
  static Result<std::shared_ptr<const FileImage>> openImage(const std::string& path,
                                                            const AmtOpenOptions& options);
  Status readHeader(AmtHeader& header) const;
  Status readDirectory(const AmtHeader& header);
  Status checkMetadata() const;
  tl::unexpected<Error> truncated(std::uint64_t wanted) const;

  std::string path_;
  std::shared_ptr<const FileImage> file_;
  std::vector<AmtChunk> chunks_;
};

}  // namespace arete
