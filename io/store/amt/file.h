// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/container.h"
#include "io/store/format/columns.h"
#include "io/store/format/layout.h"
#include "io/store/format/page_need.h"
#include "io/store/format/required_error.h"
#include "io/store/format/summary.h"
#include "terrain/model/terrain_model.h"

namespace arete {

struct AmtMetadata;

/// The .amt file: a multitriangulation on disk, as docs/topics/amt-format.md states it. A file is written
/// whole from a model in memory and read by mapping it: the arrays of a loaded model lie in the file (or,
/// with AmtOpenOptions::isCopied, in memory of their own). A query that states what it requires
/// (RequiredError) reads only that part, from the disk too. Every function below that returns a Result or a
/// Status also returns outOfMemory if an allocation fails.

/// How writeAmt() writes.
struct AmtWriteOptions {
  std::string writer = {};  ///< names the program in the file; empty = "Arete" and its version
  bool isPacked = false;    ///< compressed: see io/store/packed/packed.h for what changes
  bool isPaged = false;     ///< compressed, in pages that are read one by one
};

/// Writes the model. The same model and writer give the same bytes. The file appears under its name whole or
/// not at all (OutputFile); a model that is mapped from `path` may be written to it.
/// Errors, naming the path: invalidData: arrays or numbers that contradict each other (nothing that openAmt()
/// would refuse is written); notFound, unreadable: folder, permissions, disk full; interrupted. Every byte is
/// read twice: for the checksums, in parallel by chunks, and for writing.
Status writeAmt(const std::string& path, const TerrainModel& model, const RunContext& context = {},
                const AmtWriteOptions& options = {});

/// What is checked beyond openAmt(): nothing (for files that the same program has just written), indices, or
/// indices and checksums.
enum class AmtVerify { none, indices, all };

struct AmtReadOptions {
  AmtVerify verify = AmtVerify::all;
  /// The part of the multitriangulation that is read. Null reads everything.
  RequiredError wanted = {};
};

/// An open file. Header, directory and metadata have been checked, the arrays have not been read. Cheap to
/// copy. Thread-safe: it is only read.
class AmtFile {
 public:
  const std::string& path() const { return container_.path(); }
  /// Of a file that is read piece by piece (AmtOpenOptions::isCopied) only what was read.
  std::span<const std::byte> bytes() const { return container_.bytes(); }
  /// Loads everything but packed nodes and the directory of pages below its root. Errors: unreadable: the
  /// file was changed while it was open.
  Status loadAllButPacked(const RunContext& context = {}) const;
  const AmtContainer& container() const { return container_; }
  /// The program that wrote the file.
  const std::string& writer() const { return writer_; }
  /// The directory, in the order of the file.
  std::span<const AmtChunk> chunks() const { return container_.chunks(); }
  std::span<const std::byte> bytes(const AmtChunk& chunk) const { return container_.bytes(chunk); }

  /// Whether the MT is packed. Then model() has no MT, and read() unpacks it.
  bool isPacked() const { return packedNodes_.data() != nullptr; }
  /// Whether it is packed in pages.
  bool isPaged() const { return pageBlocks_.data() != nullptr; }
  /// Whether the segments of the arrays have checksums, so that a part can be read alone. True for files that
  /// are not packed, except those of earlier builds of Arete.
  bool hasSegments() const { return segmentChecksums_.data() != nullptr; }
  std::span<const std::uint64_t> segmentChecksums() const { return segmentChecksums_; }

  /// What its metadata says of a file in pages; of another file nothing (AmtSummary::isThere()).
  const AmtSummary& summary() const { return summary_; }
  const AmtCounts& counts() const { return counts_; }
  /// The number of nodes, of the metadata.
  std::uint64_t nodeCount() const { return nodeCount_; }
  /// Approximately the largest saturated error outside the `nodes` nodes with the largest ones. Reading with
  /// this error required everywhere reads about so many nodes; no other node has a larger error. It
  /// comes from the unchecked errors of the file's pages, or from the directory of its packed nodes: a guess
  /// at what to read.
  /// @return 0 if everything has to be read
  double errorBeyond(std::uint64_t nodes) const;

  /// Reads the model, or the part that the options require, and checks what it reads. The multitriangulation
  /// points into the mapped file and keeps it mapped, or is a copied part (io/store/amt/part.h), or unpacked
  /// (io/store/packed/packed.h). Errors, naming the path: those of checkAmt() and unpackMt(). O(size of the
  /// part); O(triangles) if everything is required, or the file is plain and has no checksums of segments.
  Result<TerrainModel> read(const AmtReadOptions& options = {}, const RunContext& context = {}) const;

  /// The pages of a paged file that read() would use for a requirement, in the order of the file, without
  /// reading one. Of another file nothing. Errors, naming the path: those of neededPages() and of loading the
  /// directory. O(blocks of the directory used + pages in them).
  Result<std::vector<PageNeed>> pagesFor(const RequiredError& wanted, const RunContext& context = {}) const;

  /// The model without its isolated samples and fixed vertices. Its arrays have the sizes that engine/mt
  /// states. Their content is unchecked: no algorithm may follow their indices before checkAmtIndices().
  const TerrainModel& model() const { return model_; }

  std::span<const std::uint32_t> isolatedSamples() const { return isolatedSamples_; }
  std::span<const double> isolatedHeights() const { return isolatedHeights_; }
  std::span<const std::uint32_t> fixedVertices() const { return fixedVertices_; }

 private:
  friend class AmtOpener;
  AmtFile() = default;
  Result<MultiTriangulation> readMt(const AmtReadOptions& options, const RunContext& context) const;

  AmtContainer container_;
  std::string writer_;
  std::shared_ptr<const AmtMetadata> metadata_;
  TerrainModel model_;
  std::span<const std::uint32_t> isolatedSamples_, fixedVertices_;
  std::span<const double> isolatedHeights_;
  std::span<const std::uint64_t> segmentChecksums_;
  std::uint64_t nodeCount_ = 0;
  AmtCounts counts_;
  AmtSummary summary_;
  std::span<const std::byte> packedDirectory_, packedTables_, packedNodes_, pageBlocks_;
};

/// Maps or opens the file and reads its header, directory and metadata, which lie together at its beginning;
/// nothing else is read. Errors, naming the path: notFound; unreadable: permissions, an empty file;
/// unsupported: not an .amt file, another version or byte order; corrupt: cut short (the message says by how
/// much), a wrong checksum, chunks out of range, sizes that contradict each other. O(1).
Result<AmtFile> openAmt(const std::string& path, const AmtOpenOptions& options = {});
/// The same of what is open. Errors: those after AmtContainer::open().
Result<AmtFile> openAmt(AmtContainer container);

/// Checks all indices: checkMtIndices(), and the arrays beside the multitriangulation. After this no
/// algorithm of the engine reads outside the arrays, whatever the file holds. Of a packed file only the
/// arrays that are not packed are checked; unpackMt() checks the rest. Geometry and errors are checked by
/// validate(), not here. Errors: corrupt: names the first culprit, the same for any number of threads;
/// interrupted. O(triangles), parallel.
Status checkAmtIndices(const AmtFile& file, const RunContext& context = {});

/// Checks the checksums of all segments, or of every chunk where the file has none of segments, and the zeros
/// between the chunks. Together with openAmt() this finds any changed byte. The nodes of a packed file are
/// left out; unpackMt() checks those that it reads. Errors: corrupt: names the chunk; interrupted. Reads the
/// whole file, in parallel.
Status checkAmtChecksums(const AmtFile& file, const RunContext& context = {});

/// Runs the checks that `verify` names. Errors: those of checkAmtIndices() and checkAmtChecksums().
Status checkAmt(const AmtFile& file, AmtVerify verify, const RunContext& context = {});

/// How loadAmt() opens and reads.
struct AmtLoadOptions {
  AmtVerify verify = AmtVerify::all;
  AmtOpenOptions open;
  RequiredError wanted = {};  ///< see AmtReadOptions
};

/// Opens and reads a file. Errors: those of openAmt() and AmtFile::read().
Result<TerrainModel> loadAmt(const std::string& path, const AmtLoadOptions& options = {},
                             const RunContext& context = {});

}  // namespace arete
