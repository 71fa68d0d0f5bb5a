// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "io/store/amt/chunk_writer.h"
#include "io/store/format/schema.h"
#include "io/store/packed/packed.h"

namespace arete {

/// The bytes of an array or a text.
std::span<const std::byte> bytesOf(const auto& elements) {
  return std::as_bytes(std::span(elements));
}

/// Writes the file of a model of either kind, by walking over its schema. A row is written from where the
/// model has it, or from bytes that were made for it.
template <class Model>
class AmtModelWriter {
 public:
  AmtModelWriter(std::string path, const RunContext& context) : chunks_(std::move(path), context) {}

  AmtChunkWriter& chunks() { return chunks_; }

  /// The bytes of a column that no array of the model is. They outlive the writer.
  void make(const AmtTag& tag, std::span<const std::byte> bytes) { made_[tag] = bytes; }

  /// Makes the metadata. Errors: invalidData: it has a problem.
  template <class Metadata>
  Status describe(const Metadata& metadata) {
    if (const auto problem = findAmtProblem(metadata)) return chunks_.refuse(*problem);
    json_ = toAmtJson(metadata);
    if (json_.size() > kAmtMaxMetadataBytes)
      return chunks_.refuse(
          fmt::format("{} bytes of metadata are more than {}", json_.size(), kAmtMaxMetadataBytes));
    make(amt_tag::kMetadata, bytesOf(json_));
    return {};
  }

  /// Writes the chunks of the schema, in its order. Precondition: describe() was successful; what the schema
  /// says is made for a file of such facts was made. Errors: as AmtChunkWriter::write().
  Status write(const Model& model, const AmtFacts& facts) {
    for (const AmtRow<Model>& row : kAmtSchema<Model>) {
      if (!row.isIn(facts)) continue;
      const std::span<const std::byte> bytes = bytesFor(row, model);
      if (row.need == AmtNeed::whereFound && bytes.empty()) continue;
      chunks_.add(amtShapeOf(row, facts, bytes.size()), bytes, row.flags);
    }
    if (!facts.isPacked) chunks_.addSegmentChecksums();
    return chunks_.write(amtVersionOf<Model>(facts));
  }

 private:
  std::span<const std::byte> bytesFor(const AmtRow<Model>& row, const Model& model) const {
    if (row.mt) return row.mt.bytes(model.mt.arrays());
    if (const auto made = made_.find(row.tag); made != made_.end()) return made->second;
    return row.model ? row.model.bytes(model) : std::span<const std::byte>();
  }

  AmtChunkWriter chunks_;
  std::map<AmtTag, std::span<const std::byte>> made_;
  std::string json_;
};

/// The chunks that nodes of either kind are packed in.
template <class Model>
void makePacked(const PackedMt& packed, AmtModelWriter<Model>& file) {
  file.make(packed.blocks.empty() ? amt_tag::kPackedDirectory : amt_tag::kPageRoot,
            bytesOf(packed.directory));
  file.make(amt_tag::kPageBlocks, bytesOf(packed.blocks));
  file.make(amt_tag::kPackedTables, bytesOf(packed.tables));
  file.make(amt_tag::kPackedNodes, bytesOf(packed.nodes));
}

}  // namespace arete
