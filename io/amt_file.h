// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/result.h"
#include "engine/run_context.h"
#include "io/amt_layout.h"
#include "io/mapped_file.h"
#include "io/packed_amt.h"
#include "terrain/terrain_model.h"

namespace arete {

/// The .amt file: a multitriangulation on disk, as docs/topics/amt-format.md states it. It is written whole
/// from a model in memory, and read back by mapping it: the arrays of a loaded model lie in the file, and
/// only what a question touches is read from the disk.

struct AmtWriteOptions {
  std::string writer = {};  ///< names the program in the file; empty = "Arete" and its version
  bool isPacked = false;    ///< compressed: see io/packed_amt.h for what changes
};

/// Writes the model. The same model and writer give the same bytes. The file appears under its name whole or
/// not at all (OutputFile); a model mapped from `path` itself may be written to it.
/// Errors, naming the path: invalidData (arrays or numbers at odds with what MtArrays states; nothing that
/// openAmt() would refuse is written), notFound and unreadable (folder, permissions, disk full), interrupted.
/// Every byte is read twice: for the checksums, which stand in front, in parallel by chunks, and for writing.
Status writeAmt(const std::string& path, const TerrainModel& model, const RunContext& context = {},
                const AmtWriteOptions& options = {});

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
  /// The model: its multitriangulation points into the mapped file and keeps it mapped, or is unpacked, as
  /// far as `options` want it. Errors: those of unpackMt(), naming the path. Precondition: checkAmt().
  Result<TerrainModel> read(const UnpackOptions& options = {}, const RunContext& context = {}) const;

  /// The model without its isolated samples and fixed vertices. Its arrays have the sizes stated in MtArrays;
  /// before checkAmtIndices() nothing else is known of them, so do not walk it.
  const TerrainModel& model() const { return model_; }

  std::span<const std::uint32_t> isolatedSamples() const { return isolatedSamples_; }
  std::span<const double> isolatedHeights() const { return isolatedHeights_; }
  std::span<const std::uint32_t> fixedVertices() const { return fixedVertices_; }

 private:
  friend class AmtOpener;
  AmtFile() = default;

  std::string path_, writer_;
  std::shared_ptr<const MappedFile> file_;
  std::shared_ptr<const AmtMetadata> metadata_;
  std::vector<AmtChunk> chunks_;
  TerrainModel model_;
  std::span<const std::uint32_t> isolatedSamples_, fixedVertices_;
  std::span<const double> isolatedHeights_;
  std::span<const std::byte> packedDirectory_, packedTables_, packedNodes_;
};

/// Maps the file and reads its header, directory and metadata, which lie together at its beginning; nothing
/// else is touched. Errors, naming the path: notFound, unreadable (permissions; empty), unsupported (not an
/// .amt file; made by a newer Arete, or for the other byte order), corrupt (cut short, saying by how much; a
/// checksum that does not match; chunks out of range or sizes at odds with each other). O(1).
Result<AmtFile> openAmt(const std::string& path, const AmtOpenOptions& options = {});

/// Every index in range, every link, floor, remover and creator as MtArrays states them, spheres that hold
/// their children's, every coordinate finite: after this every cut is closed and its front whole, and no
/// algorithm of the engine reads outside the arrays, whatever the file says. (Of a packed file only what is
/// not packed is checked: unpacking checks the rest.) Whether the geometry and the errors are right is for
/// validate() to tell. The first culprit is named, the same for any number of threads. Errors: corrupt,
/// interrupted. O(triangles), parallel.
Status checkAmtIndices(const AmtFile& file, const RunContext& context = {});

/// The checksum of every chunk, and zeros between the chunks: with these and what openAmt() checks, no byte
/// of the file has changed since it was written. (Of a packed file the packed nodes are not looked at:
/// unpacking checks what it reads.) Errors: corrupt, naming the chunk; interrupted. Reads the whole file,
/// chunks in parallel.
Status checkAmtChecksums(const AmtFile& file, const RunContext& context = {});

/// What is checked beyond openAmt(). `none` is for files that one's own program has just written.
enum class AmtVerify { none, indices, all };

/// All that `verify` asks for, all = checksums and indices. Errors: those of the two.
Status checkAmt(const AmtFile& file, AmtVerify verify, const RunContext& context = {});

struct AmtLoadOptions {
  AmtVerify verify = AmtVerify::all;
  AmtOpenOptions open;
  UnpackOptions unpack = {};  ///< of packed files
};

/// Opens, checks and reads. Errors: those of openAmt(), checkAmt() and AmtFile::read().
Result<TerrainModel> loadAmt(const std::string& path, const AmtLoadOptions& options = {},
                             const RunContext& context = {});

}  // namespace arete
