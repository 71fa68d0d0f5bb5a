// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arrays must have the sizes that the reader requires (amtShapes()), so that what is written can be
// opened.
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/store/amt/chunk_writer.h"
#include "io/store/amt/file.h"
#include "io/store/amt/mt_chunks.h"
#include "io/store/format/metadata.h"
#include "io/store/packed/packed.h"

namespace arete {
namespace {

/// Writes one file.
class AmtWriting {
 public:
  AmtWriting(const std::string& path, const TerrainModel& model, const RunContext& context)
      : path_(path), model_(model), context_(context), chunks_(path, kAmtVersion, context) {}

  Status run(const AmtWriteOptions& options) {
    const AmtMetadata metadata =
        amtMetadataOf(model_, options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
    if (const auto problem = findAmtProblem(metadata)) return chunks_.refuse(*problem);
    const VertexArrays& vertices = model_.mt.vertices();
    if (model_.isRaster != vertices.isLattice() || model_.columns != vertices.columns)
      return chunks_.refuse("its vertices are not of its grid");
    json_ = toAmtJson(metadata);
    if (json_.size() > kAmtMaxMetadataBytes)
      return chunks_.refuse(
          fmt::format("{} bytes of metadata are more than {}", json_.size(), kAmtMaxMetadataBytes));

    chunks_.add(amt_tag::kMetadata, bytesOf(json_));
    if (options.isPacked) ARETE_CHECK(addPacked());
    addShaped(amtShapes(metadata, options.isPacked));
    if (!options.isPacked) chunks_.addSegmentChecksums();
    return chunks_.write();
  }

 private:
  /// The chunks whose sizes follow from the metadata.
  void addShaped(const std::vector<AmtShape>& shapes) {
    // IsolatedSample has padding of undefined bytes, so its members are written as two arrays.
    for (const IsolatedSample& sample : model_.isolated) {
      isolatedSamples_.push_back(sample.sample);
      isolatedHeights_.push_back(sample.height);
    }
    const MtArrays& a = model_.mt.arrays();
    std::vector<AmtChunkBytes> arrays = mtChunks(a);
    const AmtChunkBytes own[] = {
        {amt_tag::kBelow, bytesOf(a.below)},
        {amt_tag::kAbove, bytesOf(a.above)},
        {amt_tag::kSamples, bytesOf(a.vertices.samples)},
        {amt_tag::kPlan, bytesOf(a.vertices.plan)},
        {amt_tag::kHeights, a.vertices.rawHeights},
        {amt_tag::kIsolatedSamples, bytesOf(isolatedSamples_)},
        {amt_tag::kIsolatedHeights, bytesOf(isolatedHeights_)},
        {amt_tag::kFixedVertices, bytesOf(model_.options.fixedVertices)},
    };
    arrays.insert(arrays.end(), std::begin(own), std::end(own));
    for (const AmtShape& shape : shapes)
      for (const auto& [tag, bytes] : arrays)
        if (tag == shape.tag) chunks_.add(shape, bytes);
  }

  Status addPacked() {
    Result<PackedMt> packed = packMt(model_, context_);
    if (!packed) {
      if (packed.error().code == ErrorCode::interrupted) return chunks_.interrupted();
      return failure(packed.error().code, "the model cannot be packed: " + packed.error().message, path_);
    }
    packed_ = std::move(*packed);
    chunks_.add(amt_tag::kPackedDirectory, bytesOf(packed_.directory));
    chunks_.add(amt_tag::kPackedTables, bytesOf(packed_.tables));
    chunks_.add(amt_tag::kPackedNodes, bytesOf(packed_.nodes));
    return {};
  }

  const std::string& path_;
  const TerrainModel& model_;
  const RunContext& context_;
  AmtChunkWriter chunks_;
  std::string json_;  // this and the next three: what the chunks point to, beside the model
  PackedMt packed_;
  std::vector<std::uint32_t> isolatedSamples_;
  std::vector<double> isolatedHeights_;
};

}  // namespace

Status writeAmt(const std::string& path, const TerrainModel& model, const RunContext& context,
                const AmtWriteOptions& options) try {
  return AmtWriting(path, model, context).run(options);
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
