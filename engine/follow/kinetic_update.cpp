// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether a node belongs to a saturated cut depends on itself alone, and the nodes that do are closed (law
// 6). So a cut equals the one from scratch when every leaf belongs to it and no node that can enter does.
// Only leaves and nodes that can enter have certificates. A certificate that is due is dropped if its node
// cannot change any more, renewed if the verdict is the same; otherwise the node leaves or enters. Either
// lets other nodes change, which are evaluated next.
//
// A node with a certificate that cannot change at the moment keeps it: it may be able to change again before
// the certificate is due, and the verdict does not depend on the cut.
//
// Under a deadline the search takes at most half of the time, and coarsening half of the rest: refining alone
// could use up every frame of a flight, and the front would only grow. Nodes with the largest ratio of error
// to allowed error enter first. What remains is evaluated first in the next update.
#include "engine/follow/kinetic_update.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

using Batch = KineticQueue::Batch;
constexpr std::size_t kBatchesAtOnce = 64;
/// Evaluating few at once costs more for each, but finds the worst of them sooner.
constexpr std::size_t kFewPending = 16;

}  // namespace

struct IncrementalCut::KineticUpdate::Verdicts {
  std::uint64_t exceeds;
  std::array<float, Batch::kMost> units;

  void evaluate(const BoundedCriterion& criterion, const Batch& batch, const Motion& rate) {
    const auto balls = std::span(batch.balls).first(batch.count);
    const auto errors = std::span(batch.errors).first(batch.count);
    if (const KineticCriterion* kinetic = criterion.kinetic()) {
      exceeds = kinetic->exceedingFor(balls, errors, rate, std::span(units).first(batch.count));
    } else {
      units.fill(0);
      exceeds = criterion.exceeding(balls, errors);
    }
  }
};

auto IncrementalCut::KineticUpdate::run() -> End {
  begin();
  do {
    search();
    // With a budget coarsening comes first, to make room.
    coarsen(o_.deadline && !o_.maxTriangles ? o_.deadline->millisecondsLeft() / 2 : 0);
    refine();
    coarsen(0);
  } while (isSearchCutShort_ && !isOverBudget_ && !mustStop());
  // What is left undone stays pending, and the next update begins with it.
  const bool isDone = leaving_.empty() && entering_.empty() && s_.pending.empty() && !isSearchCutShort_;
  for (const auto* left : {&leaving_, &entering_})
    for (const Change& change : *left) s_.pending.push_back(change.node);
  if (o_.maxTriangles && s_.triangles().size() > *o_.maxTriangles) isOverBudget_ = true;
  if (isOverBudget_) return End::overBudget;
  return isDone ? End::complete : End::stopped;
}

bool IncrementalCut::KineticUpdate::mustStop() {
  if (!hasStopped_) hasStopped_ = context_.cancelled() || (o_.deadline && o_.deadline->isOver());
  return hasStopped_;
}

void IncrementalCut::KineticUpdate::begin() {
  const KineticCriterion* const kinetic = criterion_.kinetic();
  if (!s_.hasCertificates) {
    // The first update requests a certificate for every node that can change.
    s_.hasCertificates = true;
    for (const std::uint32_t t : s_.triangles()) {
      const NodeId remover = s_.mt.remover(TriangleId(t));
      if (remover.isValid() && s_.canEnter(remover.index())) s_.requestCertificate(remover.index());
      const NodeId creator = s_.mt.creator(TriangleId(t));
      if (creator.isValid() && s_.isLeaf(creator.index())) s_.requestCertificate(creator.index());
    }
  } else {
    const auto moved = kinetic != nullptr && s_.lastCriterion ? kinetic->motionSince(*s_.lastCriterion)
                                                              : std::optional<Motion>();
    // Without a bound on the motion every certificate is due.
    if (moved)
      s_.queue.advance(*moved);
    else
      s_.queue.advanceToEnd();
  }
  s_.lastCriterion = kinetic != nullptr ? kinetic->clone() : nullptr;
}

void IncrementalCut::KineticUpdate::search() {
  // The first round runs even when little time is left, so that the search makes progress in every frame.
  const double enough = o_.deadline ? o_.deadline->millisecondsLeft() / 2 : 0;
  isSearchCutShort_ = false;
  for (bool isFirst = true; !s_.pending.empty() || s_.queue.dueCount() > 0; isFirst = false) {
    if (mustStop() || (!isFirst && o_.deadline && o_.deadline->millisecondsLeft() < enough)) {
      isSearchCutShort_ = true;
      return;
    }
    if (s_.pending.empty())
      evaluateDue();
    else
      evaluatePending();
  }
}

void IncrementalCut::KineticUpdate::evaluatePending() {
  const MultiTriangulation& mt = s_.mt;
  Batch batch;
  while (!s_.pending.empty() && batch.count < Batch::kMost) {
    const std::uint32_t n = s_.pending.back();
    s_.pending.pop_back();
    batch.put(mt.sphere(NodeId(n)), mt.scale().decode(mt.saturatedCode(NodeId(n))), n);
  }
  Verdicts verdicts;
  verdicts.evaluate(criterion_, batch, s_.queue.rate());
  settle(batch, verdicts);
}

void IncrementalCut::KineticUpdate::evaluateDue() {
  const std::size_t count = std::min(s_.queue.dueCount(), kBatchesAtOnce);
  std::array<Verdicts, kBatchesAtOnce> verdicts;
  const auto evaluate = [&](std::size_t i) {
    verdicts[i].evaluate(criterion_, s_.queue.due(i), s_.queue.rate());
  };
  // A few batches are not worth other threads.
  if (count < kBatchesAtOnce)
    for (std::size_t i = 0; i < count; ++i) evaluate(i);
  else
    parallelFor(std::size_t(0), count, evaluate);
  for (std::size_t i = 0; i < count; ++i) settle(s_.queue.due(i), verdicts[i]);
  s_.queue.removeDue(count);
}

void IncrementalCut::KineticUpdate::settle(const Batch& batch, const Verdicts& verdicts) {
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    const std::uint32_t n = batch.nodes[i];
    const bool isIn = s_.isIn(n), belongs = (verdicts.exceeds >> i & 1) != 0;
    if (!(isIn ? s_.isLeaf(n) : s_.canEnter(n))) {
      s_.dropCertificate(n);
    } else if (isIn == belongs) {
      s_.queue.add(batch.balls[i], batch.errors[i], n, verdicts.units[i]);
    } else if (isIn) {
      leaving_.push_back({n, verdicts.units[i], 0, batch.balls[i], batch.errors[i]});
    } else {
      // The ratio only orders nodes under a deadline; without one all of them enter.
      const double allowed = o_.deadline ? criterion_.allowedError(batch.balls[i]) : 0;
      entering_.push_back(
          {n, verdicts.units[i],
           allowed > 0 ? double(batch.errors[i]) / allowed : std::numeric_limits<double>::infinity(),
           batch.balls[i], batch.errors[i]});
      if (o_.deadline) std::push_heap(entering_.begin(), entering_.end());
    }
  }
}

/// After the change the verdict is: no change.
void IncrementalCut::KineticUpdate::addCertificate(const Change& change) {
  s_.queue.add(change.ball, change.error, change.node, change.units);
}

/// Changes are made from the end of the list.
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
    if (leaving_.empty() || s_.pending.size() >= Batch::kMost)
      while (!isSearchCutShort_ && !s_.pending.empty()) evaluatePending();
  }
}

void IncrementalCut::KineticUpdate::leave(const Change& change) {
  if (!s_.isLeaf(change.node)) return s_.dropCertificate(change.node);
  s_.leave(change.node, [&](std::uint32_t leaf) { s_.requestCertificate(leaf); });
  addCertificate(change);
}

void IncrementalCut::KineticUpdate::refine() {
  const std::size_t many = o_.deadline ? kFewPending : Batch::kMost;
  while (!entering_.empty() && !isOverBudget_) {
    if (mustStop()) return;
    if (o_.deadline)
      std::pop_heap(entering_.begin(), entering_.end());
    else
      prefetchNext(entering_);
    const Change change = entering_.back();
    entering_.pop_back();
    enter(change);
    if (entering_.empty() || s_.pending.size() >= many)
      while (!isSearchCutShort_ && !s_.pending.empty()) evaluatePending();
  }
}

void IncrementalCut::KineticUpdate::enter(const Change& change) {
  const NodeId node(change.node);
  if (!s_.canEnter(change.node)) return s_.dropCertificate(change.node);
  if (o_.maxTriangles && s_.triangles().size() + (s_.mt.isOpen(node) ? 1 : 2) > *o_.maxTriangles) {
    isOverBudget_ = true;
    entering_.push_back(change);
    return;
  }
  s_.enter(change.node, [&](std::uint32_t next) { s_.requestCertificate(next); });
  addCertificate(change);
}

}  // namespace arete
