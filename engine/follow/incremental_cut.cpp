// SPDX-License-Identifier: GPL-3.0-or-later
//
// A saturated update asks about what may have changed (kinetic_update.cpp), unless the budget is too small
// for what is wanted, or a deadline comes with an order of its own.
//
// Any other update is one Pass. It looks at every triangle of the front: does it fail, is the node that it is
// the first triangle of a leaf whose floor would do? (Every leaf owns its whole ceiling in the front, so each
// is met once.) What fails is refined, ancestors first, in the order of the keys; leaves that are not needed
// leave, and their parents with them where they become leaves.
//
// Saturated, a node is wanted or not by itself, and wanted nodes are closed, so both steps together end at
// the cut from scratch. Minimal, the refined set holds the least cut, but a leaf stays when its floor fails,
// even where that floor lies below what the least cut has: the last step walks the least cut and lets the
// rest leave.
//
// Under a budget the leaf that matters least makes room for the triangle that matters most, as long as the
// one is less severe than the other. In one update no node comes after having gone or goes after having come,
// so the exchange ends.
//
// With a deadline the scan may use half of the time and goes on in the next update where it stopped; every
// other step asks before each modification.
#include "engine/follow/incremental_cut.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <queue>

#include "engine/cut/least_cut.h"
#include "engine/cut/refine.h"
#include "engine/follow/incremental_state.h"
#include "engine/follow/kinetic_update.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;
constexpr std::size_t kTrianglesPerBlock = 1024, kBlocksPerScan = 64;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A node that may enter, or leave, the smallest key first.
struct Waiting {
  RefineKey key;
  std::uint32_t node;
  bool operator<(const Waiting& other) const {
    return key != other.key ? key > other.key : node > other.node;
  }
};

bool isWorstFirst(const IncrementalOptions& options) {
  return !options.order || dynamic_cast<const WorstFirst*>(options.order.get()) != nullptr;
}

}  // namespace

class IncrementalCut::Pass {
 public:
  Pass(State& state, const Criterion& criterion, const IncrementalOptions& options, const RunContext& context)
      : s_(state),
        mt_(state.mt),
        criterion_(criterion),
        o_(options),
        context_(context),
        isSaturated_(options.method == CutMethod::saturated),
        isWorstFirst_(isWorstFirst(options)) {}

  /// Appends to the state's steps. Returns whether the update is complete.
  bool run() {
    if (!o_.maxTriangles && !o_.deadline && o_.exact && !isSaturated_) {
      goToLeast();
      return isComplete_;
    }
    scan();
    if (o_.maxTriangles) {
      coarsen();
      shrinkToBudget();
      refine();
    } else {
      // Refining alone could use up every deadline of a flight, and the front would only grow.
      if (o_.deadline) coarsen(o_.deadline->millisecondsLeft() / 2);
      refine();
      coarsen();
      if (isComplete_ && o_.exact && !isSaturated_) leaveWhatIsNotLeast();
    }
    return isComplete_;
  }

 private:
  struct Found {
    std::vector<Waiting> refinable;
    std::vector<Waiting> leaves;  // key: the severity of what they would leave behind
    std::vector<std::uint32_t> spare;
  };

  bool mustStop() {
    if (hasStopped_) return true;
    hasStopped_ = context_.cancelled() || (o_.deadline && o_.deadline->isOver());
    if (hasStopped_) isComplete_ = false;
    return hasStopped_;
  }

  // --- what the criterion says ----------------------------------------------------------------------------

  /// The saturated error of a node in units of what is allowed over its sphere: wanted above 1.
  double saturatedRatio(std::uint32_t n) const {
    const double error = mt_.saturatedError(NodeId(n));
    const double allowed = criterion_.allowedError(mt_.arrays().sphere[n]);
    if (error <= allowed) return 0;
    return allowed > 0 ? error / allowed : kInfinity;
  }

  RefineKey keyOf(TriangleId t, const Criterion::Corners& corners, std::uint64_t arrival) const {
    if (!isWorstFirst_) return o_.order->key(mt_, criterion_, t, corners, arrival);
    return {0,
            isSaturated_ ? -saturatedRatio(mt_.remover(t).index()) : -criterion_.severity(mt_, t, corners)};
  }

  void lookAtTriangle(std::uint32_t id, NodeId creator, std::uint64_t arrival, Found& found) const {
    const TriangleId t(id);
    const std::uint32_t remover = mt_.arrays().remover[id];
    if (remover == kNone) return;
    const Criterion::Corners corners = mt_.corners(t, creator);
    const bool fails = isSaturated_ ? saturatedRatio(remover) > 0 : !isSatisfied(mt_, criterion_, t, corners);
    if (fails) found.refinable.push_back({keyOf(t, corners, arrival), remover});
  }

  /// Precondition: n is a leaf.
  void lookAtLeaf(std::uint32_t n, Found& found) const {
    double severity = 0;
    bool isSpare = true;
    if (isSaturated_) {
      severity = saturatedRatio(n);
      isSpare = severity == 0;
    } else {
      for (const std::uint32_t t : mt_.floor(NodeId(n))) {
        const Criterion::Corners corners = mt_.corners(TriangleId(t));
        if (isSatisfied(mt_, criterion_, TriangleId(t), corners)) continue;
        isSpare = false;
        if (!o_.maxTriangles) return;
        severity = std::max(severity, criterion_.severity(mt_, TriangleId(t), corners));
      }
    }
    if (isSpare)
      found.spare.push_back(n);
    else if (o_.maxTriangles)
      found.leaves.push_back({{0, severity}, n});
  }

  // --- looking --------------------------------------------------------------------------------------------

  void scan() {
    const std::vector<std::uint32_t>& triangles = s_.triangles();
    const std::size_t count = triangles.size();
    const double enough = o_.deadline ? o_.deadline->millisecondsLeft() / 2 : 0;
    std::vector<Found> blocks(kBlocksPerScan);
    s_.cursor = s_.cursor < count ? s_.cursor : 0;
    for (std::size_t done = 0; done < count;) {
      if (mustStop()) return;
      if (done > 0 && o_.deadline && o_.deadline->millisecondsLeft() < enough) {
        isComplete_ = false;
        break;
      }
      const std::size_t now = std::min(count - done, kBlocksPerScan * kTrianglesPerBlock);
      const std::size_t used = (now + kTrianglesPerBlock - 1) / kTrianglesPerBlock;
      tbb::parallel_for(std::size_t(0), used, [&](std::size_t b) {
        const std::size_t end = std::min(now, (b + 1) * kTrianglesPerBlock);
        for (std::size_t i = b * kTrianglesPerBlock; i < end; ++i) {
          const std::uint32_t t = triangles[(s_.cursor + i) % count];
          const NodeId creator = mt_.creator(TriangleId(t));
          lookAtTriangle(t, creator, done + i, blocks[b]);
          if (creator.isValid() && s_.isLeaf(creator.index()) && t == mt_.slotTriangle(creator, 0).index())
            lookAtLeaf(creator.index(), blocks[b]);
        }
      });
      for (std::size_t b = 0; b < used; ++b) take(blocks[b]);
      done += now;
      s_.cursor = (s_.cursor + now) % count;
    }
    arrivals_ = count;
  }

  void take(Found& found) {
    for (const Waiting& w : found.refinable) refinable_.push(w);
    for (const Waiting& w : found.leaves) leaves_.push(w);
    spare_.insert(spare_.end(), found.spare.begin(), found.spare.end());
    found.refinable.clear();
    found.leaves.clear();
    found.spare.clear();
  }

  // --- changing -------------------------------------------------------------------------------------------

  void enter(std::uint32_t n) {
    s_.enter(n);
    if (o_.maxTriangles) entered_.insert(n);
    for (std::uint32_t i = 0; i < mt_.ceilingSize(NodeId(n)); ++i)
      lookAtTriangle(mt_.slotTriangle(NodeId(n), i).index(), NodeId(n), arrivals_++, fresh_);
    take(fresh_);
  }

  void leave(std::uint32_t n) {
    s_.leave(n, [&](std::uint32_t leaf) { lookAtLeaf(leaf, fresh_); });
    take(fresh_);
  }

  /// Undoes what is finer than needed, until no more than so much is left of the time.
  void coarsen(double millisecondsToLeave = 0) {
    while (!spare_.empty()) {
      if (millisecondsToLeave > 0 && o_.deadline->millisecondsLeft() < millisecondsToLeave) return;
      const std::uint32_t n = spare_.back();
      if (!s_.isLeaf(n)) {
        spare_.pop_back();
        continue;
      }
      if (mustStop()) return;
      spare_.pop_back();
      leave(n);
    }
  }

  std::uint32_t added(std::uint32_t n) const { return mt_.isOpen(NodeId(n)) ? 1 : 2; }

  /// The leaf that matters least, or kNone.
  std::uint32_t leastLeaf() {
    while (!leaves_.empty() && (!s_.isLeaf(leaves_.top().node) || entered_.contains(leaves_.top().node)))
      leaves_.pop();
    return leaves_.empty() ? kNone : leaves_.top().node;
  }

  void shrinkToBudget() {
    while (s_.triangles().size() > *o_.maxTriangles) {
      std::uint32_t n = leastLeaf();
      // A scan that ran out of time may not have met a leaf yet: the budget comes first, whatever it costs.
      if (n == kNone) n = anyLeaf();
      giveUp(n);
      isComplete_ = false;
    }
  }

  /// For the budget's sake, not to come back in this update.
  void giveUp(std::uint32_t n) {
    left_.insert(n);
    leave(n);
  }

  std::uint32_t anyLeaf() const {
    for (const std::uint32_t t : s_.triangles())
      if (const NodeId n = mt_.creator(TriangleId(t)); n.isValid() && s_.isLeaf(n.index())) return n.index();
    return kNone;
  }

  void refine() {
    std::vector<std::uint32_t> missing;
    while (!refinable_.empty()) {
      const Waiting top = refinable_.top();
      if (s_.isIn(top.node)) {
        refinable_.pop();
        continue;
      }
      if (mustStop()) return;
      claimed_.clear();
      collectMissing(
          mt_, top.node, [&](std::uint32_t n) { return !s_.isIn(n) && claimed_.insert(n).second; }, missing);
      if (o_.maxTriangles) {
        std::uint64_t more = 0;
        bool hasLeft = false;
        for (const std::uint32_t n : missing) {
          more += added(n);
          hasLeft = hasLeft || left_.contains(n);
        }
        const bool fits = s_.triangles().size() + more <= *o_.maxTriangles;
        if (hasLeft || !fits) isComplete_ = false;
        if (hasLeft) {
          refinable_.pop();
          continue;
        }
        if (!fits) {
          const std::uint32_t least = isWorstFirst_ ? leastLeaf() : kNone;
          if (least == kNone || !(leaves_.top().key.rank < -top.key.rank)) return;
          giveUp(least);
          continue;
        }
      }
      refinable_.pop();
      for (const std::uint32_t n : missing) {
        if (mustStop()) return;
        enter(n);
      }
    }
  }

  /// Nothing hurries: the least cut is found first, and what differs changes.
  void goToLeast() {
    const auto members = leastMembers(mt_, criterion_, [&] { return mustStop(); });
    if (!members) return;
    const MemberSet::Lookup least = members->lookup();
    // Children have larger indices.
    for (std::uint32_t n = mt_.nodeCount(); n-- > 0;) {
      if (!s_.isIn(n) || least.contains(n)) continue;
      if (mustStop()) return;
      s_.leave(n);
    }
    for (std::uint32_t n = 0; n < mt_.nodeCount(); ++n) {
      if (s_.isIn(n) || !least.contains(n)) continue;
      if (mustStop()) return;
      s_.enter(n);
    }
  }

  void leaveWhatIsNotLeast() {
    const auto find = o_.deadline ? leastMembersByWalk : leastMembers;
    const auto members = find(mt_, criterion_, [&] { return mustStop(); });
    if (!members) return;
    const MemberSet::Lookup least = members->lookup();
    const auto goes = [&](std::uint32_t n) { return s_.isLeaf(n) && !least.contains(n); };
    std::vector<std::uint32_t> leaving;
    for (const std::uint32_t t : s_.triangles())
      if (const NodeId n = mt_.creator(TriangleId(t));
          n.isValid() && t == mt_.slotTriangle(n, 0).index() && goes(n.index()))
        leaving.push_back(n.index());
    while (!leaving.empty()) {
      if (mustStop()) return;
      const NodeId n(leaving.back());
      leaving.pop_back();
      s_.leave(n.index(), [&](std::uint32_t leaf) {
        if (goes(leaf)) leaving.push_back(leaf);
      });
    }
  }

  State& s_;
  const MultiTriangulation& mt_;
  const Criterion& criterion_;
  const IncrementalOptions& o_;
  const RunContext& context_;
  const bool isSaturated_, isWorstFirst_;
  bool isComplete_ = true, hasStopped_ = false;

  std::priority_queue<Waiting> refinable_, leaves_;
  std::vector<std::uint32_t> spare_;
  Found fresh_;
  std::uint64_t arrivals_ = 0;
  tsl::robin_set<std::uint32_t, ScatteredId> entered_, left_;  // under a budget: in this update
  tsl::robin_set<std::uint32_t, ScatteredId> claimed_;
};

IncrementalCut::IncrementalCut(MultiTriangulation mt) : state_(std::make_unique<State>(std::move(mt))) {}
IncrementalCut::~IncrementalCut() = default;
IncrementalCut::IncrementalCut(IncrementalCut&&) noexcept = default;
IncrementalCut& IncrementalCut::operator=(IncrementalCut&&) noexcept = default;

Result<IncrementalCut::Update> IncrementalCut::update(const Criterion& criterion,
                                                      const IncrementalOptions& options,
                                                      const RunContext& context) {
  if (const Status ok = checkCut(state_->mt, criterion, options.method, options.maxTriangles); !ok)
    return tl::unexpected(ok.error());
  return withThreads(context, [&] {
    State& s = *state_;
    s.steps.clear();
    Update update;
    update.isComplete = bring(s, criterion, options, context);
    for (const CutStep& step : s.steps) ++(step.isRefinement ? update.refined : update.coarsened);
    return update;
  });
}

/// Returns whether the update is complete.
bool IncrementalCut::bring(State& s, const Criterion& criterion, const IncrementalOptions& options,
                           const RunContext& context) {
  const bool isOrderFree = !options.deadline || isWorstFirst(options);
  if (options.method == CutMethod::saturated && isOrderFree && !(options.maxTriangles && s.isBudgetTight)) {
    using End = KineticUpdate::End;
    const End end = KineticUpdate(s, criterion, options, context).run();
    if (end != End::overBudget) {
      s.isBudgetTight = false;
      return end == End::complete;
    }
  }
  s.forgetWatches();
  const bool isComplete = Pass(s, criterion, options, context).run();
  constexpr double kTight = 0.9;
  s.isBudgetTight = options.maxTriangles && !isComplete &&
                    double(s.triangles().size()) > kTight * double(*options.maxTriangles);
  return isComplete;
}

std::span<const CutStep> IncrementalCut::lastSteps() const {
  return state_->steps;
}

Status IncrementalCut::apply(std::span<const CutStep> steps) {
  State& s = *state_;
  s.forgetWatches();
  // The steps may be this cut's own last ones.
  const std::vector<CutStep> playing(steps.begin(), steps.end());
  s.steps.clear();
  for (const CutStep& step : playing) {
    const std::uint32_t n = step.node.index();
    const bool fits =
        n < s.mt.nodeCount() &&
        (step.isRefinement
             ? !s.isIn(n) && std::ranges::all_of(s.mt.floor(step.node),
                                                 [&](std::uint32_t t) { return s.hasTriangle(t); })
             : s.isLeaf(n));
    if (!fits)
      return failure(
          ErrorCode::invalidData,
          fmt::format("this cut is not one in which it can be {}", step.isRefinement ? "applied" : "undone"),
          fmt::format("node {}", n));
    if (step.isRefinement)
      s.enter(n);
    else
      s.leave(n);
  }
  return {};
}

const MultiTriangulation& IncrementalCut::mt() const {
  return state_->mt;
}

bool IncrementalCut::contains(NodeId n) const {
  return state_->isIn(n.index());
}

std::uint32_t IncrementalCut::nodeCount() const {
  return state_->nodeCount();
}

std::span<const std::uint32_t> IncrementalCut::triangles() const {
  return state_->triangles();
}

NodeSet IncrementalCut::nodes() const {
  NodeSet set(state_->mt.nodeCount());
  for (std::uint32_t n = 0; n < set.size(); ++n) set[n] = state_->isIn(n) ? 1 : 0;
  return set;
}

Cut IncrementalCut::front() const {
  return arete::front(state_->mt, nodes());
}

Status IncrementalCut::validate() const {
  const State& s = *state_;
  const NodeSet set = nodes();
  const auto broken = [](std::string what) { return failure(ErrorCode::brokenPromise, std::move(what)); };
  NodeSet closed = set;
  if (closeUpwards(s.mt, closed) != s.nodeCount() || closed != set)
    return broken("the incremental cut is not closed or miscounts its nodes");
  std::vector<std::uint32_t> counts(set.size(), 0);
  for (std::uint32_t n = 0; n < set.size(); ++n)
    for (const std::uint32_t t : s.mt.floor(NodeId(n))) {
      const NodeId parent = s.mt.creator(TriangleId(t));
      if (set[n] && parent.isValid()) ++counts[parent.index()];
      if (!set[n] && parent.isValid() && !set[parent.index()]) ++counts[n];
    }
  for (std::uint32_t n = 0; n < set.size(); ++n) {
    if (counts[n] != s.count(n))
      return broken(fmt::format("node {} counts {} and has {}", n, s.count(n), counts[n]));
    if (s.isWatching && counts[n] == 0 && !s.isWatched(n))
      return broken(fmt::format("node {} can change and is not watched", n));
  }
  std::vector<std::uint32_t> ids = s.triangles();
  std::ranges::sort(ids);
  if (ids != arete::front(s.mt, set).ids)
    return broken("the incremental cut's front is not that of its nodes");
  return {};
}

}  // namespace arete
