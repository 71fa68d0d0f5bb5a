// SPDX-License-Identifier: GPL-3.0-or-later
//
// A node is required if its saturated error exceeds the error required of the box around its sphere. Nodes
// are sorted by falling bands of errors, so where the same error is required everywhere these are the first
// nodes and a few more. Otherwise the spheres and largest errors of pages (1024 nodes), then of blocks (64
// nodes), exclude most nodes without a test. A node's sphere lies in those of its parents, whose errors are
// no smaller, so the parents of a required node are required too; where rounding breaks this they are added.
//
// The checksums of all segments that were read are compared before the data are used, and the indices of the
// part are checked before they are followed. If an index is wrong the whole file is checked, so that the
// culprit is named by its number in the file.
//
// Data are touched and then loaded before they are used, as many at once as can be: where the file is read
// piece by piece they are zeros until then, and each load may be a round of requests to a server.
#include "io/store/amt/part.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "engine/mt/node_blocks.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "io/store/amt/checks.h"
#include "io/store/amt/index_check.h"
#include "io/store/amt/mt_part.h"
#include "io/store/amt/segments.h"
#include "io/store/format/schema.h"

namespace arete {
namespace {

constexpr std::uint32_t kNodesPerBlock = MultiTriangulation::kNodesPerBlock,
                        kNodesPerPage = MultiTriangulation::kNodesPerPage,
                        kSlotsPerHint = MultiTriangulation::kSlotsPerHint,
                        kBlocksPerPage = kNodesPerPage / kNodesPerBlock;
static_assert(kNodesPerBlock == RankedNodes::kNodesPerWord);

class PartReader {
 public:
  PartReader(const AmtFile& file, const RequiredError& wanted, AmtVerify verify, const RunContext& context)
      : file_(file),
        whole_(file.model().mt),
        a_(whole_.arrays()),
        required_(wanted),
        verify_(verify),
        context_(context),
        segments_(file) {
    for (const AmtMtColumn& column : amtMtColumns(a_))
      columns_.push_back({column.per, segments_.of(column.tag)});
  }

  Result<MultiTriangulation> run() {
    touchBeside();
    const auto sums = std::as_bytes(file_.segmentChecksums());
    ARETE_CHECK(segments_.load(context_, verify_ == AmtVerify::all ? sums : std::span<const std::byte>()));
    ARETE_CHECK(checkSegmentChecksums());
    choosePages();
    if (isTheSameEverywhere()) return readPrefix();
    touchPages();
    ARETE_CHECK(segments_.load(context_));
    RankedNodes nodes = chooseNodes();
    if (context_.cancelled()) return interrupted();
    return 2 * std::uint64_t{nodes.size()} >= end_ ? readPrefix() : readSubset(std::move(nodes));
  }

 private:
  struct Column {
    AmtPer per;
    AmtSegments::Chunk chunk;
  };

  bool isRequired(OutwardScale::Code saturatedError, double error) const {
    return !(error > 0) || a_.scale.decode(saturatedError) > error;
  }

  /// The error required of the box around a ball; 0 if the box is not finite.
  double requiredOf(const Sphere& ball) const {
    const MetricFrame& metric = a_.metric;
    const double reach = ball.radius * (1 + 1e-6) + 1e-6 * (std::fabs(ball.x) + std::fabs(ball.y));
    const double x[2] = {(ball.x - reach) / metric.scale.x + metric.origin.x,
                         (ball.x + reach) / metric.scale.x + metric.origin.x};
    const double y[2] = {(ball.y - reach) / metric.scale.y + metric.origin.y,
                         (ball.y + reach) / metric.scale.y + metric.origin.y};
    if (!std::isfinite(x[0] + x[1] + y[0] + y[1])) return 0;
    Box3 box;
    box.low = {std::min(x[0], x[1]), std::min(y[0], y[1]), box.low.z};
    box.high = {std::max(x[0], x[1]), std::max(y[0], y[1]), box.high.z};
    return required_(box);
  }

  Status checkSegmentChecksums() const {
    if (verify_ != AmtVerify::all) return {};
    return checkAmtChunk(file_, amt_tag::kSegmentChecksums);
  }

  /// Finds the pages that may hold a required node, and the end of the last one.
  void choosePages() {
    const std::uint32_t blocks = static_cast<std::uint32_t>(nodeBlockCount(whole_.nodeCount()));
    const std::uint32_t all = static_cast<std::uint32_t>(a_.blockError.size()) - blocks;
    isPageRequired_.resize(all);
    parallelFor(std::uint32_t{0}, all, [&](std::uint32_t page) {
      isPageRequired_[page] =
          isRequired(a_.blockError[blocks + page], requiredOf(a_.blockSphere[blocks + page]));
    });
    for (std::uint32_t page = 0; page < all; ++page)
      if (isPageRequired_[page] != 0) pages_ = page + 1;
    end_ = std::min(whole_.nodeCount(), pages_ * kNodesPerPage);
  }

  /// Whether the first block of each page requires the same error. Then the required nodes are taken to be
  /// the first ones, without testing each of them.
  bool isTheSameEverywhere() const {
    std::vector<double> required(pages_);
    parallelFor(std::uint32_t{0}, pages_, [&](std::uint32_t page) {
      required[page] = requiredOf(a_.blockSphere[std::size_t{page} * kBlocksPerPage]);
    });
    return std::ranges::adjacent_find(
               required, [](double x, double y) { return x != y && (x > 0 || y > 0); }) == required.end();
  }

  Result<MultiTriangulation> readPrefix() {
    touch(AmtPer::nodeOrEnd, end_, end_ + 1);
    ARETE_CHECK(segments_.load(context_));
    if (!areSlots(0, end_, 0, a_.slotBegin[end_])) return culprit();
    touchNodes(0, end_, 0, a_.slotBegin[end_]);
    ARETE_CHECK(segments_.load(context_));
    const auto part = prefixOfMt(whole_, end_);
    if (!part) return culprit();
    ARETE_CHECK(checkSegments());
    return checked(*part);
  }

  Result<MultiTriangulation> readSubset(RankedNodes nodes) {
    ARETE_TRY(bool areSound, loadSubset(nodes));
    if (!areSound) return culprit();
    MtSubset part = subsetOfMt(whole_, nodes);
    if (part.problem != MtSubset::Problem::none) {
      // Parents may be nodes of which nothing is loaded.
      const FileImage::Part arrays[] = {std::as_bytes(a_.slotBegin), std::as_bytes(a_.floor),
                                        std::as_bytes(a_.creatorHint)};
      ARETE_CHECK(file_.container().loadParts(arrays, context_));
      if (!addParents(whole_, nodes)) return culprit();
      nodes.rank();
      ARETE_TRY(areSound, loadSubset(nodes));
      if (!areSound) return culprit();
      part = subsetOfMt(whole_, nodes);
    }
    if (part.problem != MtSubset::Problem::none) return culprit();
    ARETE_CHECK(checkSegments());
    return checked(part.mt);
  }

  void touchPages() {
    for (std::uint32_t page = 0; page < pages_; ++page) {
      if (isPageRequired_[page] == 0) continue;
      const std::uint64_t begin = std::uint64_t{page} * kNodesPerPage,
                          end = std::min<std::uint64_t>(begin + kNodesPerPage, whole_.nodeCount());
      touch(AmtPer::node, begin, end);
    }
  }

  RankedNodes chooseNodes() {
    RankedNodes nodes(whole_.nodeCount());
    parallelFor(std::uint32_t{0}, pages_, [&](std::uint32_t page) {
      if (isPageRequired_[page] == 0 || context_.cancelled()) return;
      const auto end = std::min<std::size_t>((page + 1) * kBlocksPerPage, nodes.wordCount());
      for (std::size_t block = page * kBlocksPerPage; block < end; ++block)
        if (isRequired(a_.blockError[block], requiredOf(a_.blockSphere[block])))
          nodes.setWord(block, requiredNodesOf(block));
    });
    nodes.rank();
    return nodes;
  }

  std::uint64_t requiredNodesOf(std::size_t block) const {
    const auto begin = static_cast<std::uint32_t>(block) * kNodesPerBlock,
               end = std::min(begin + kNodesPerBlock, whole_.nodeCount());
    std::uint64_t members = 0;
    for (std::uint32_t n = begin; n < end; ++n)
      members |= std::uint64_t{isRequired(a_.saturatedError[n], requiredOf(a_.sphere[n]))} << (n - begin);
    return members;
  }

  /// The arrays that are read whole.
  void touchBeside() {
    for (const AmtTag& tag : {amt_tag::kIsolatedSamples, amt_tag::kIsolatedHeights, amt_tag::kFixedVertices})
      segments_.touchAll(segments_.of(tag));
    for (const Column& column : columns_)
      if (column.per == AmtPer::rootTriangle || column.per == AmtPer::block) segments_.touchAll(column.chunk);
    touch(AmtPer::vertex, 0, a_.rootVertices);
    touch(AmtPer::triangle, 0, a_.rootTriangles.size());
  }

  /// Loads all of a subset: where its slots are, and then what they need.
  /// @return false if the slots are damaged
  Result<bool> loadSubset(const RankedNodes& nodes) {
    const auto forRuns = [&](const auto& visit) {
      for (std::size_t word = 0; word < nodes.wordCount(); ++word) {
        const std::uint64_t members = nodes.word(word);
        if (members == 0) continue;
        const auto first = static_cast<std::uint32_t>(word) * kNodesPerBlock;
        const std::uint32_t end =
            first + kNodesPerBlock - static_cast<std::uint32_t>(std::countl_zero(members));
        if (!visit(first + static_cast<std::uint32_t>(std::countr_zero(members)), end)) return false;
      }
      return true;
    };
    forRuns([&](std::uint32_t begin, std::uint32_t end) {
      touch(AmtPer::nodeOrEnd, begin, end + 1);
      return true;
    });
    ARETE_CHECK(segments_.load(context_));
    const bool areSound = forRuns([&](std::uint32_t begin, std::uint32_t end) {
      if (!areSlots(begin, end, a_.slotBegin[begin], a_.slotBegin[end])) return false;
      touchNodes(begin, end, a_.slotBegin[begin], a_.slotBegin[end]);
      return true;
    });
    ARETE_CHECK(segments_.load(context_));
    return areSound;
  }

  /// Whether nodes [begin, end) may have the slots [slots, slotsEnd).
  bool areSlots(std::uint64_t begin, std::uint64_t end, std::uint64_t slots, std::uint64_t slotsEnd) const {
    return slots >= 3 * begin && slotsEnd >= slots + 3 * (end - begin) && slotsEnd <= a_.link.size() &&
           slotsEnd - 2 * end <= a_.floor.size();
  }

  /// The data of nodes [begin, end), whose slots are [slots, slotsEnd).
  void touchNodes(std::uint64_t begin, std::uint64_t end, std::uint64_t slots, std::uint64_t slotsEnd) {
    touch(AmtPer::nodeOrEnd, begin, end + 1);
    touch(AmtPer::slot, slots, slotsEnd);
    touch(AmtPer::floorTriangle, slots - 2 * begin, slotsEnd - 2 * end);
    touch(AmtPer::node, begin, end);
    touch(AmtPer::hint, slots / kSlotsPerHint, (slotsEnd + kSlotsPerHint - 1) / kSlotsPerHint);
    touch(AmtPer::triangle, a_.rootTriangles.size() + slots, a_.rootTriangles.size() + slotsEnd);
    touch(AmtPer::vertex, a_.rootVertices + begin, a_.rootVertices + end);
  }
  /// These elements of every column that is per such.
  void touch(AmtPer per, std::uint64_t begin, std::uint64_t end) {
    for (const Column& column : columns_)
      if (column.per == per) segments_.touch(column.chunk, begin, end);
  }

  Status checkSegments() {
    ARETE_CHECK(file_.container().loaded());
    if (verify_ != AmtVerify::all) return {};
    return segments_.check(context_);
  }

  Result<MultiTriangulation> checked(const MultiTriangulation& part) const {
    const Status indices = checkMtIndices(part, amtGridSamples(file_), context_);
    if (!indices && indices.error().code == ErrorCode::interrupted) return interrupted();
    if (!indices) return culprit();
    ARETE_CHECK(checkAmtExtras(file_));
    return part;
  }

  tl::unexpected<Error> culprit() const {
    ARETE_CHECK(file_.container().loaded());
    ARETE_CHECK(checkAmt(file_, verify_, context_));
    return failure(ErrorCode::corrupt, "has nodes that contradict each other", file_.path());
  }
  tl::unexpected<Error> interrupted() const {
    return failure(ErrorCode::interrupted, "the check was interrupted", file_.path());
  }

  const AmtFile& file_;
  const MultiTriangulation& whole_;
  const MtArrays& a_;
  const RequiredError& required_;
  AmtVerify verify_;
  const RunContext& context_;
  AmtSegments segments_;
  std::vector<Column> columns_;  // of the MT
  std::vector<std::uint8_t> isPageRequired_;
  std::uint32_t pages_ = 0, end_ = 0;  // up to the end of the last required page; end_ in nodes
};

}  // namespace

Result<MultiTriangulation> readAmtPart(const AmtFile& file, const RequiredError& wanted, AmtVerify verify,
                                       const RunContext& context) {
  return withThreads(context, [&] { return PartReader(file, wanted, verify, context).run(); });
}

}  // namespace arete
