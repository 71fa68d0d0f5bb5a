// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arrays must have the sizes that the reader requires (amtShapeOf()), so that what is written can be
// opened.
#include <string>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/store/amt/file.h"
#include "io/store/amt/model_writer.h"
#include "io/store/format/metadata.h"
#include "io/store/packed/packed.h"

namespace arete {
namespace {

/// Writes one file.
class AmtWriting {
 public:
  AmtWriting(const std::string& path, const TerrainModel& model, const RunContext& context)
      : path_(path), model_(model), context_(context), file_(path, context) {}

  Status run(const AmtWriteOptions& options) {
    const AmtMetadata metadata =
        amtMetadataOf(model_, options.writer.empty() ? "Arete " ARETE_VERSION : options.writer);
    ARETE_CHECK(file_.describe(metadata));
    const VertexArrays& vertices = model_.mt.vertices();
    if (model_.isRaster != vertices.isLattice() || model_.columns != vertices.columns)
      return file_.chunks().refuse("its vertices are not of its grid");
    if (options.isPacked) ARETE_CHECK(pack());
    // IsolatedSample has padding of undefined bytes, so its members are written as two arrays.
    for (const IsolatedSample& sample : model_.isolated) {
      isolatedSamples_.push_back(sample.sample);
      isolatedHeights_.push_back(sample.height);
    }
    file_.make(amt_tag::kIsolatedSamples, bytesOf(isolatedSamples_));
    file_.make(amt_tag::kIsolatedHeights, bytesOf(isolatedHeights_));
    AmtFacts facts = amtFactsOf(metadata);
    facts.isPacked = options.isPacked;
    return file_.write(model_, facts);
  }

 private:
  Status pack() {
    Result<PackedMt> packed = packMt(model_, context_);
    if (!packed) {
      if (packed.error().code == ErrorCode::interrupted) return file_.chunks().interrupted();
      return failure(packed.error().code, "the model cannot be packed: " + packed.error().message, path_);
    }
    packed_ = std::move(*packed);
    makePacked(packed_, file_);
    return {};
  }

  const std::string& path_;
  const TerrainModel& model_;
  const RunContext& context_;
  AmtModelWriter<TerrainModel> file_;
  PackedMt packed_;  // this and the next: what the chunks point to, beside the model
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
