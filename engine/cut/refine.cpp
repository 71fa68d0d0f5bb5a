// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles of the growing front that fail the criterion are in a heap, keyed by the order. The first
// one's remover is applied, and before it its missing ancestors, one modification at a time: parents have
// smaller indices, so a rising list keeps the set closed after each. Their triangles are counted before (a
// node adds two, one on a border), so the budget is never exceeded. Equal keys go by the place of the vertex
// that refines, so that a file which numbers the same nodes otherwise (packed, in pages) has the same cut.
//
// Worst first, the walk passes through least cuts: when the worst severity left falls below all it was
// before, to s, every member was required by a triangle worse than s, so the set is the least one for
// "severity at most s". Therefore the last such state is the result. For a uniform error the walk need not
// start at the root: it would pass through the least set for the least error that fits the budget, which is
// found faster (least_cut.h). For a criterion with a severity limit the walk starts at the least set for some
// s that fits: the sets of all smaller s contain it. (If a bound over a ball accepted a triangle worse than
// s, the set is smaller, and the walk continues from it.)
#include "engine/cut/refine.h"

#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/cut/front.h"
#include "engine/cut/least_cut.h"

namespace arete {
namespace {

constexpr std::size_t kRefinementsPerCheck = 1 << 12;
constexpr std::uint8_t kClaimed = 2;  // about to enter
/// With fewer than one triangle for this many nodes, a plain walk is faster than searching for a limit of
/// severity first.
constexpr std::uint64_t kShortWalk = 256;

struct Waiting {
  RefineKey key;
  std::uint32_t triangle;
};

/// Of two triangles, whether the first is refined later. The top of a heap in this order is refined first.
class IsLater {
 public:
  explicit IsLater(const MultiTriangulation& mt) : mt_(&mt) {}
  bool operator()(const Waiting& a, const Waiting& b) const {
    if (a.key != b.key) return a.key > b.key;
    const NodeId ofA = mt_->remover(TriangleId(a.triangle)), ofB = mt_->remover(TriangleId(b.triangle));
    if (ofA != ofB) {
      const Vec3 p = mt_->position(mt_->apex(ofA)), q = mt_->position(mt_->apex(ofB));
      const auto place = [](const Vec3& at) { return std::tie(at.x, at.y, at.z); };
      if (place(p) != place(q)) return place(p) > place(q);
    }
    return a.triangle > b.triangle;
  }

 private:
  const MultiTriangulation* mt_;
};

bool isWorstFirst(const CutOptions& options) {
  return !options.order || dynamic_cast<const WorstFirst*>(options.order.get()) != nullptr;
}

class Walk {
 public:
  Walk(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options)
      : mt_(mt),
        criterion_(criterion),
        options_(options),
        isWorstFirst_(isWorstFirst(options)),
        cut_{{}, true},
        heap_(IsLater(mt)) {}

  /// @param start A state that the walk passes through.
  Result<NodeCut> run(const MemberSet& start, const RunContext& context) {
    cut_.nodes = start.toNodeSet(mt_.nodeCount());
    std::uint64_t triangles = frontSize(mt_, start);
    for (std::uint32_t t = 0; t < mt_.rootTriangleCount(); ++t) offer(t, {});
    start.visit([&](std::uint32_t n) { offerCeiling(n); });
    std::vector<std::uint32_t> missing;
    const auto claim = [&](std::uint32_t n) {
      if (cut_.nodes[n] != 0) return false;
      cut_.nodes[n] = kClaimed;
      return true;
    };
    for (std::size_t steps = 0;; ++steps) {
      if (steps % kRefinementsPerCheck == 0 && context.cancelled())
        return failure(ErrorCode::interrupted, "the cut was interrupted");
      while (!heap_.empty() && isIn(mt_.remover(TriangleId(heap_.top().triangle)).index())) heap_.pop();
      recordState();
      if (heap_.empty()) break;
      collectMissing(mt_, mt_.remover(TriangleId(heap_.top().triangle)).index(), claim, missing);
      heap_.pop();
      std::uint64_t added = 0;
      for (const std::uint32_t n : missing) added += mt_.isOpen(NodeId(n)) ? 1 : 2;
      // The worst triangle cannot be refined within the budget. Spending the rest elsewhere would not lower
      // it.
      cut_.isComplete = !(options_.maxTriangles && triangles + added > *options_.maxTriangles);
      for (std::size_t i = 0; cut_.isComplete && i < missing.size(); ++i) {
        cut_.isComplete = !(options_.deadline && options_.deadline->isOver());
        if (cut_.isComplete) enter(missing[i]);
      }
      if (!cut_.isComplete) {
        for (const std::uint32_t n : missing)
          if (!isIn(n)) cut_.nodes[n] = 0;
        break;
      }
      triangles += added;
    }
    if (!isWorstFirst_) best_ = entered_.size();
    for (std::size_t i = best_; i < entered_.size(); ++i) cut_.nodes[entered_[i]] = 0;
    return std::move(cut_);
  }

  /// The worst severity of the result. Precondition: the order is worst first.
  double leastWorst() const { return leastWorst_; }

 private:
  bool isIn(std::uint32_t n) const { return cut_.nodes[n] == 1; }

  void offer(std::uint32_t id, NodeId creator) {
    const TriangleId t(id);
    const NodeId remover = mt_.remover(t);
    if (!remover.isValid() || isIn(remover.index())) return;
    const Criterion::Corners corners = mt_.corners(t, creator);
    if (isSatisfied(mt_, criterion_, t, corners)) return;
    const RefineKey key = options_.order ? options_.order->key(mt_, criterion_, t, corners, arrivals_)
                                         : worstFirst_.key(mt_, criterion_, t, corners, arrivals_);
    heap_.push({key, id});
    ++arrivals_;
  }

  void enter(std::uint32_t n) {
    cut_.nodes[n] = 1;
    entered_.push_back(n);
    offerCeiling(n);
  }

  void offerCeiling(std::uint32_t n) {
    for (std::uint32_t i = 0; i < mt_.ceilingSize(NodeId(n)); ++i)
      offer(mt_.slotTriangle(NodeId(n), i).index(), NodeId(n));
  }

  /// Records the state if it is the best so far.
  void recordState() {
    if (!isWorstFirst_) return;
    const double worst = heap_.empty() ? -std::numeric_limits<double>::infinity() : -heap_.top().key.rank;
    if (worst > leastWorst_) return;
    leastWorst_ = worst;
    best_ = entered_.size();
  }

  const MultiTriangulation& mt_;
  const Criterion& criterion_;
  const CutOptions& options_;
  const WorstFirst worstFirst_;
  const bool isWorstFirst_;
  NodeCut cut_;
  std::priority_queue<Waiting, std::vector<Waiting>, IsLater> heap_;
  std::vector<std::uint32_t> entered_;
  std::size_t best_ = 0;
  double leastWorst_ = std::numeric_limits<double>::infinity();
  std::uint64_t arrivals_ = 0;
};

}  // namespace

Result<NodeCut> refineWithin(const MultiTriangulation& mt, const Criterion& criterion,
                             const CutOptions& options, const RunContext& context) {
  if (!isWorstFirst(options) || !options.maxTriangles || options.deadline)
    return Walk(mt, criterion, options).run(MemberSet::prefix(0), context);
  const auto stop = [&] { return context.cancelled(); };
  const auto interrupted = [] { return failure(ErrorCode::interrupted, "the cut was interrupted"); };
  const BoundedCriterion* const bounded = criterion.bounded();
  if (bounded != nullptr && bounded->uniformError()) {
    const auto least = leastMembersWithin(mt, *bounded->uniformError(), *options.maxTriangles, stop);
    if (!least) return interrupted();
    return Walk(mt, criterion, options).run(*least, context);
  }
  const bool isLong = kShortWalk * std::uint64_t{*options.maxTriangles} > mt.nodeCount();
  if (isLong && bounded != nullptr && bounded->severityLimit()) {
    const auto start = membersOfSeverityWithin(mt, *bounded, *options.maxTriangles, stop);
    if (!start) return interrupted();
    Walk walk(mt, criterion, options);
    Result<NodeCut> cut = walk.run(start->members, context);
    if (!cut || walk.leastWorst() <= start->severity) return cut;
  }
  return Walk(mt, criterion, options).run(MemberSet::prefix(0), context);
}

}  // namespace arete
