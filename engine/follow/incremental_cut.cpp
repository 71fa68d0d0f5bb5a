// SPDX-License-Identifier: GPL-3.0-or-later
//
// An update evaluates what may have changed (kinetic_update.cpp). A cut that exceeds its budget has no such
// shortcut: which nodes it has depends on all others. It is taken from scratch, and the nodes in which it
// differs are undone, children first, then applied, parents first, as difference() does, but found from the
// front and from the new members, not by a scan of all nodes of the MT.
#include "engine/follow/incremental_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/cut/saturated_cut.h"
#include "engine/follow/incremental_state.h"
#include "engine/follow/kinetic_update.h"
#include "engine/parallel/with_threads.h"

namespace arete {

/// Replaces the cut by one taken from scratch within the budget.
class IncrementalCut::Replacement {
 public:
  Replacement(State& state, const IncrementalOptions& options, const RunContext& context)
      : s_(state), o_(options), context_(context) {}

  /// Appends to the state's steps.
  /// @return Whether the cut is now the given one, unless the data break law 6.
  bool run(const MemberSet& members) { return undoOthers(members.lookup()) && applyMissing(members); }

 private:
  bool mustStop() const { return context_.cancelled() || (o_.deadline && o_.deadline->isOver()); }

  /// Undoes the nodes that are not members. The budget is kept even when time is over.
  bool undoOthers(const MemberSet::Lookup& members) {
    std::vector<std::uint32_t> leaves;
    for (const std::uint32_t t : s_.triangles()) {
      const NodeId n = s_.mt.creator(TriangleId(t));
      // A leaf has all of its ceiling in the front: its first triangle occurs once.
      if (n.isValid() && t == s_.mt.slotTriangle(n, 0).index() && s_.isLeaf(n.index()))
        leaves.push_back(n.index());
    }
    std::vector<std::uint32_t> leaving, staying;
    for (const std::uint32_t n : leaves) (members.contains(n) ? staying : leaving).push_back(n);
    const auto undo = [&](std::vector<std::uint32_t>& list) {
      const std::uint32_t n = list.back();
      list.pop_back();
      s_.leave(n, [&](std::uint32_t leaf) { (members.contains(leaf) ? staying : leaving).push_back(leaf); });
    };
    while (!leaving.empty() && (isOverBudget() || !mustStop())) undo(leaving);
    // Members are within the budget, unless errors or spheres break law 6 and the set is not closed.
    while (isOverBudget() && !staying.empty()) undo(staying);
    return leaving.empty();
  }

  bool applyMissing(const MemberSet& members) {
    bool isDone = true;
    members.visit([&](std::uint32_t n) {
      if (!isDone || s_.isIn(n) || !s_.canEnter(n)) return;
      isDone = !mustStop();
      if (isDone && s_.triangles().size() + (s_.mt.isOpen(NodeId(n)) ? 1 : 2) <= *o_.maxTriangles)
        s_.enter(n);
    });
    return isDone;
  }

  bool isOverBudget() const { return s_.triangles().size() > *o_.maxTriangles; }

  State& s_;
  const IncrementalOptions& o_;
  const RunContext& context_;
};

IncrementalCut::IncrementalCut(MultiTriangulation mt) : state_(std::make_unique<State>(std::move(mt))) {}
IncrementalCut::~IncrementalCut() = default;
IncrementalCut::IncrementalCut(IncrementalCut&&) noexcept = default;
IncrementalCut& IncrementalCut::operator=(IncrementalCut&&) noexcept = default;

Result<IncrementalCut::Update> IncrementalCut::update(const Criterion& criterion,
                                                      const IncrementalOptions& options,
                                                      const RunContext& context) try {
  State& s = *state_;
  ARETE_CHECK(checkCut(s.mt, criterion, CutMethod::saturated, options.maxTriangles));
  const BoundedCriterion& bounded = *criterion.bounded();
  return withThreads(context, [&] {
    s.steps.clear();
    Update update;
    // A cut that was over its budget most likely still is.
    using End = KineticUpdate::End;
    const End end = s.isOverBudget && options.maxTriangles
                        ? End::overBudget
                        : KineticUpdate(s, bounded, options, context).run();
    update.isComplete = end == End::complete;
    s.isOverBudget = end == End::overBudget;
    if (s.isOverBudget) {
      s.clearCertificates();
      const SaturatedMembers taken = saturatedMembers(s.mt, bounded, options.maxTriangles);
      update.isComplete = Replacement(s, options, context).run(taken.members) && taken.isComplete;
      s.isOverBudget = !taken.isComplete;
    }
    for (const CutStep& step : s.steps) ++(step.isRefinement ? update.refined : update.coarsened);
    return update;
  });
} catch (...) {
  return caughtFailure();
}

std::span<const CutStep> IncrementalCut::lastSteps() const {
  return state_->steps;
}

Status IncrementalCut::apply(std::span<const CutStep> steps) try {
  State& s = *state_;
  s.clearCertificates();
  // A copy: the steps may be this cut's own last ones.
  const std::vector<CutStep> copied(steps.begin(), steps.end());
  s.steps.clear();
  for (const CutStep& step : copied) {
    const std::uint32_t n = step.node.index();
    // A step fits if its node can enter, with all triangles of its floor in the front, or is a leaf.
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
} catch (...) {
  return caughtFailure();
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

Status IncrementalCut::validate() const try {
  const State& s = *state_;
  const NodeSet set = nodes();
  const auto broken = [](std::string what) { return failure(ErrorCode::brokenPromise, std::move(what)); };
  // A closed set stays as it is when it is closed.
  NodeSet closed = set;
  if (closeUpwards(s.mt, closed) != s.nodeCount() || closed != set)
    return broken("the incremental cut is not closed or miscounts its nodes");
  std::vector<std::uint32_t> counts(set.size(), 0);
  // A member counts the triangles of its star that are refined, another node the missing ones of its floor.
  for (std::uint32_t n = 0; n < set.size(); ++n)
    for (const std::uint32_t t : s.mt.floor(NodeId(n))) {
      const NodeId parent = s.mt.creator(TriangleId(t));
      if (set[n] && parent.isValid()) ++counts[parent.index()];
      if (!set[n] && parent.isValid() && !set[parent.index()]) ++counts[n];
    }
  for (std::uint32_t n = 0; n < set.size(); ++n) {
    if (counts[n] != s.count(n))
      return broken(fmt::format("node {} counts {} and has {}", n, s.count(n), counts[n]));
    if (s.hasCertificates && counts[n] == 0 && !s.hasCertificate(n))
      return broken(fmt::format("node {} can change and has no certificate", n));
  }
  std::vector<std::uint32_t> ids = s.triangles();
  std::ranges::sort(ids);
  if (ids != arete::front(s.mt, set).ids)
    return broken("the incremental cut's front is not that of its nodes");
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
