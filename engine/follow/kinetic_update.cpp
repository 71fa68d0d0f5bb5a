// SPDX-License-Identifier: GPL-3.0-or-later
//
// Saturated, a node is wanted or not by itself, and wanted nodes are closed (law 6). So a cut is the one from
// scratch when every leaf is wanted and no node that can enter is; only these are watched. A watch that is
// due is dropped when its node cannot change any more, put back when the verdict is as before, and otherwise
// the node leaves or enters; either makes others able to change, which are watched from then on.
//
// A node that is watched and cannot change at the moment keeps its watch: it may be able to again before it
// is due, and the verdict does not depend on what is in.
//
// Under a deadline the search takes half of the time at most, coarsening half of what is left, as refining
// alone could use up every deadline of a flight, and the front would only grow; what is most in need enters
// first. What is not done is asked about again in the next update, before anything else.
#include "engine/follow/kinetic_update.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace arete {
namespace {

using Block = KineticQueue::Block;
constexpr std::size_t kBlocksAtOnce = 64;
/// Asking about few is dearer for each, but the worst of them are known sooner.
constexpr std::size_t kFewUnasked = 16;

}  // namespace

struct IncrementalCut::KineticUpdate::Answers {
  std::uint64_t exceeds;
  std::array<float, Block::kMost> units;

  void ask(const Criterion& criterion, const Block& block, const Motion& rate) {
    exceeds = criterion.exceedingFor(std::span(block.balls).first(block.count),
                                     std::span(block.errors).first(block.count), rate,
                                     std::span(units).first(block.count));
  }
};

auto IncrementalCut::KineticUpdate::run() -> End {
  begin();
  do {
    search();
    // With a budget room is made first.
    coarsen(o_.deadline && !o_.maxTriangles ? o_.deadline->millisecondsLeft() / 2 : 0);
    refine();
    coarsen(0);
  } while (isSearchCut_ && !isOverBudget_ && !mustStop());
  const bool isDone = leaving_.empty() && entering_.empty() && s_.unasked.empty() && !isSearchCut_;
  for (const auto* left : {&leaving_, &entering_})
    for (const Change& change : *left) s_.unasked.push_back(change.node);
  if (o_.maxTriangles && s_.triangles().size() > *o_.maxTriangles) isOverBudget_ = true;
  if (isOverBudget_) return End::overBudget;
  return isDone ? End::complete : End::stopped;
}

bool IncrementalCut::KineticUpdate::mustStop() {
  if (!hasStopped_) hasStopped_ = context_.cancelled() || (o_.deadline && o_.deadline->isOver());
  return hasStopped_;
}

void IncrementalCut::KineticUpdate::begin() {
  if (!s_.isWatching) {
    s_.isWatching = true;
    for (const std::uint32_t t : s_.triangles()) {
      const std::uint32_t remover = s_.mt.arrays().remover[t];
      if (remover != MultiTriangulation::kNone && s_.canEnter(remover)) s_.watch(remover);
      const NodeId creator = s_.mt.creator(TriangleId(t));
      if (creator.isValid() && s_.isLeaf(creator.index())) s_.watch(creator.index());
    }
  } else if (const auto moved = s_.asked ? criterion_.motionSince(*s_.asked) : std::nullopt) {
    s_.calendar.pass(*moved);
  } else {
    s_.calendar.passAll();
  }
  s_.asked = criterion_.remembered();
}

void IncrementalCut::KineticUpdate::search() {
  const double enough = o_.deadline ? o_.deadline->millisecondsLeft() / 2 : 0;
  isSearchCut_ = false;
  for (bool isFirst = true; !s_.unasked.empty() || s_.calendar.dueCount() > 0; isFirst = false) {
    if (mustStop() || (!isFirst && o_.deadline && o_.deadline->millisecondsLeft() < enough)) {
      isSearchCut_ = true;
      return;
    }
    if (s_.unasked.empty())
      askDue();
    else
      askUnasked();
  }
}

void IncrementalCut::KineticUpdate::askUnasked() {
  const MtArrays& a = s_.mt.arrays();
  Block block;
  while (!s_.unasked.empty() && block.count < Block::kMost) {
    const std::uint32_t n = s_.unasked.back();
    s_.unasked.pop_back();
    block.put(a.sphere[n], a.scale.decode(a.saturatedError[n]), n);
  }
  Answers answers;
  answers.ask(criterion_, block, s_.calendar.rate());
  settle(block, answers);
}

void IncrementalCut::KineticUpdate::askDue() {
  const std::size_t count = std::min(s_.calendar.dueCount(), kBlocksAtOnce);
  std::array<Answers, kBlocksAtOnce> answers;
  const auto ask = [&](std::size_t i) { answers[i].ask(criterion_, s_.calendar.due(i), s_.calendar.rate()); };
  if (count < kBlocksAtOnce)
    for (std::size_t i = 0; i < count; ++i) ask(i);
  else
    tbb::parallel_for(std::size_t(0), count, ask);
  for (std::size_t i = 0; i < count; ++i) settle(s_.calendar.due(i), answers[i]);
  s_.calendar.take(count);
}

void IncrementalCut::KineticUpdate::settle(const Block& block, const Answers& answers) {
  for (std::uint32_t i = 0; i < block.count; ++i) {
    const std::uint32_t n = block.nodes[i];
    const bool isIn = s_.isIn(n), isWanted = (answers.exceeds >> i & 1) != 0;
    if (!(isIn ? s_.isLeaf(n) : s_.canEnter(n))) {
      s_.unwatch(n);
    } else if (isIn == isWanted) {
      s_.calendar.add(block.balls[i], block.errors[i], n, answers.units[i]);
    } else if (isIn) {
      leaving_.push_back({n, answers.units[i], 0, block.balls[i], block.errors[i]});
    } else {
      const double allowed = o_.deadline ? criterion_.allowedError(block.balls[i]) : 0;
      entering_.push_back(
          {n, answers.units[i],
           allowed > 0 ? double(block.errors[i]) / allowed : std::numeric_limits<double>::infinity(),
           block.balls[i], block.errors[i]});
      if (o_.deadline) std::push_heap(entering_.begin(), entering_.end());
    }
  }
}

/// The change is made: from now on the node stays as it is.
void IncrementalCut::KineticUpdate::keep(const Change& change) {
  s_.calendar.add(change.ball, change.error, change.node, change.units);
}

/// Changes are taken from the end.
void IncrementalCut::KineticUpdate::prefetchNext(const std::vector<Change>& changes) const {
  constexpr std::size_t kAhead = 6;
  if (changes.size() > 2 * kAhead) s_.prefetchSlots(changes[changes.size() - 1 - 2 * kAhead].node);
  if (changes.size() > kAhead) s_.prefetchTriangles(changes[changes.size() - 1 - kAhead].node);
}

void IncrementalCut::KineticUpdate::coarsen(double millisecondsToLeave) {
  while (!leaving_.empty()) {
    if (millisecondsToLeave > 0 && o_.deadline->millisecondsLeft() < millisecondsToLeave) return;
    if (mustStop()) return;
    prefetchNext(leaving_);
    const Change change = leaving_.back();
    leaving_.pop_back();
    leave(change);
    if (leaving_.empty() || s_.unasked.size() >= Block::kMost)
      while (!isSearchCut_ && !s_.unasked.empty()) askUnasked();
  }
}

void IncrementalCut::KineticUpdate::leave(const Change& change) {
  if (!s_.isLeaf(change.node)) return s_.unwatch(change.node);
  s_.leave(change.node, [&](std::uint32_t leaf) { s_.watch(leaf); });
  keep(change);
}

void IncrementalCut::KineticUpdate::refine() {
  const std::size_t many = o_.deadline ? kFewUnasked : Block::kMost;
  while (!entering_.empty() && !isOverBudget_) {
    if (mustStop()) return;
    if (o_.deadline)
      std::pop_heap(entering_.begin(), entering_.end());
    else
      prefetchNext(entering_);
    const Change change = entering_.back();
    entering_.pop_back();
    enter(change);
    if (entering_.empty() || s_.unasked.size() >= many)
      while (!isSearchCut_ && !s_.unasked.empty()) askUnasked();
  }
}

void IncrementalCut::KineticUpdate::enter(const Change& change) {
  const NodeId node(change.node);
  if (!s_.canEnter(change.node)) return s_.unwatch(change.node);
  if (o_.maxTriangles && s_.triangles().size() + (s_.mt.isOpen(node) ? 1 : 2) > *o_.maxTriangles) {
    isOverBudget_ = true;
    entering_.push_back(change);
    return;
  }
  s_.enter(change.node, [&](std::uint32_t next) { s_.watch(next); });
  keep(change);
}

}  // namespace arete
