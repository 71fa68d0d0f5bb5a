// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/file/mapped_file.h"
#include "io/format/layout.h"
#include "io/format/required_error.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct AmtMetadata;

/// The .amt file: a multitriangulation on disk, as docs/topics/amt-format.md states it. It is written whole
/// from a model in memory, and read back by mapping it: the arrays of a loaded model lie in the file. A
/// question that says what it wants has no more read, from the disk too, than that.

struct AmtWriteOptions {
  std::string writer = {};  ///< names the program in the file; empty = "Arete" and its version
  bool isPacked = false;    ///< compressed: see io/packed/packed.h for what changes
};

/// Writes the model. The same model and writer give the same bytes. The file appears under its name whole or
/// not at all (OutputFile); a model mapped from `path` itself may be written to it.
/// Errors, naming the path: invalidData (arrays or numbers at odds with what MtArrays states; nothing that
/// openAmt() would refuse is written), notFound and unreadable (folder, permissions, disk full), interrupted.
/// Every byte is read twice: for the checksums, which stand in front, in parallel by chunks, and for writing.
Status writeAmt(const std::string& path, const TerrainModel& model, const RunContext& context = {},
                const AmtWriteOptions& options = {});

/// What is checked beyond openAmt(). `none` is for files that one's own program has just written.
enum class AmtVerify { none, indices, all };

struct AmtReadOptions {
  AmtVerify verify = AmtVerify::all;
  /// What of the multitriangulation is read: see RequiredError. Null reads everything.
  RequiredError wanted = {};
};

struct AmtOpenOptions {
  /// Questions will touch few places of a large file: the system shall not read their neighbours ahead.
  bool randomAccess = false;
};

/// An open file whose header, directory and metadata make sense and whose arrays have not been looked at.
/// Cheap to copy; thread-safe: it is only read.
class AmtFile {
 public:
  const std::string& path() const { return path_; }
  std::span<const std::byte> bytes() const { return file_->bytes(); }
  /// The program that wrote it.
  const std::string& writer() const { return writer_; }
  /// The directory, in the file's order.
  std::span<const AmtChunk> chunks() const { return chunks_; }
  std::span<const std::byte> bytes(const AmtChunk& chunk) const {
    return file_->bytes().subspan(chunk.offset, chunk.bytes);
  }

  /// Whether the MT is packed: then model() has no MT, read() unpacks it.
  bool isPacked() const { return packedNodes_.data() != nullptr; }
  /// Whether segments of its arrays have checksums, so that a part of it can be read alone: all that are not
  /// packed, but for those of earlier builds of Arete.
  bool hasSegments() const { return segmentChecksums_.data() != nullptr; }
  std::span<const std::uint64_t> segmentChecksums() const { return segmentChecksums_; }

  /// What the metadata says.
  std::uint64_t nodeCount() const { return nodeCount_; }
  /// About the largest saturated error of all nodes but so many of the largest ones: no node beyond those
  /// that are read where this is wanted everywhere has more. It is what the file's pages, or the directory of
  /// its packed nodes, say, unchecked: a guess at what to read. 0 where nothing less than everything is
  /// known.
  double errorBeyond(std::uint64_t nodes) const;

  /// The model, as far as the options want it, checked as far as it is read. Its multitriangulation points
  /// into the mapped file and keeps it mapped, or is a part of it (io/amt/part.h), or unpacked
  /// (io/packed/packed.h). Errors: those of checkAmt() and unpackMt(), naming the path. O(what is wanted);
  /// O(triangles) without a wish, or of a file without segments.
  Result<TerrainModel> read(const AmtReadOptions& options = {}, const RunContext& context = {}) const;

  /// The model without its isolated samples and fixed vertices. Its arrays have the sizes stated in MtArrays;
  /// before checkAmtIndices() nothing else is known of them, so do not walk it.
  const TerrainModel& model() const { return model_; }

  std::span<const std::uint32_t> isolatedSamples() const { return isolatedSamples_; }
  std::span<const double> isolatedHeights() const { return isolatedHeights_; }
  std::span<const std::uint32_t> fixedVertices() const { return fixedVertices_; }

 private:
  friend class AmtOpener;
  AmtFile() = default;
  Result<MultiTriangulation> readMt(const AmtReadOptions& options, const RunContext& context) const;

  std::string path_, writer_;
  std::shared_ptr<const MappedFile> file_;
  std::shared_ptr<const AmtMetadata> metadata_;
  std::vector<AmtChunk> chunks_;
  TerrainModel model_;
  std::span<const std::uint32_t> isolatedSamples_, fixedVertices_;
  std::span<const double> isolatedHeights_;
  std::span<const std::uint64_t> segmentChecksums_;
  std::uint64_t nodeCount_ = 0;
  std::span<const std::byte> packedDirectory_, packedTables_, packedNodes_;
};

/// Maps the file and reads its header, directory and metadata, which lie together at its beginning; nothing
/// else is touched. Errors, naming the path: notFound, unreadable (permissions; empty), unsupported (not an
/// .amt file; made by a newer Arete, or for the other byte order), corrupt (cut short, saying by how much; a
/// checksum that does not match; chunks out of range or sizes at odds with each other). O(1).
Result<AmtFile> openAmt(const std::string& path, const AmtOpenOptions& options = {});

/// checkMtIndices(), and the same of what stands beside the multitriangulation: after this no algorithm of
/// the engine reads outside the arrays, whatever the file says. (Of a packed file only what is not packed is
/// checked: unpacking checks the rest.) Whether the geometry and the errors are right is for validate() to
/// tell. The first culprit is named, the same for any number of threads. Errors: corrupt, interrupted.
/// O(triangles), parallel.
Status checkAmtIndices(const AmtFile& file, const RunContext& context = {});

/// The checksums of all segments, or of every chunk where there are no segments, and zeros between the chunks:
/// with these and what openAmt() checks, no byte of the file has changed since it was written. (Of a packed
/// file the packed nodes are not looked at: unpacking checks what it reads.) Errors: corrupt, naming the
/// chunk; interrupted. Reads the whole file, in parallel.
Status checkAmtChecksums(const AmtFile& file, const RunContext& context = {});

/// All that `verify` asks for, all = checksums and indices. Errors: those of the two.
Status checkAmt(const AmtFile& file, AmtVerify verify, const RunContext& context = {});

struct AmtLoadOptions {
  AmtVerify verify = AmtVerify::all;
  AmtOpenOptions open;
  RequiredError wanted = {};  ///< see AmtReadOptions
};

/// Opens and reads. Errors: those of openAmt() and AmtFile::read().
Result<TerrainModel> loadAmt(const std::string& path, const AmtLoadOptions& options = {},
                             const RunContext& context = {});

}  // namespace arete
