// SPDX-License-Identifier: GPL-3.0-or-later
//
// A queue of leaves, by rising saturated error. A batch of them is tried on the same mesh, in parallel, and
// the feasible removals are then carried out one after the other. A trial that depends on a vertex whose
// height or star was changed by an earlier removal of the batch is discarded, and its leaf goes back into the
// queue. The size of a batch depends on the mesh alone, so the result does not depend on the number of
// threads; it is small compared with the mesh, so few trials (some percent) are discarded.
//
// A successful removal puts the leaves of its link into the queue (again): nodes that have become leaves, and
// neighbours that failed before heights changed.

#include <algorithm>
#include <queue>
#include <utility>
#include <vector>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/per_thread.h"
#include "engine/parallel/with_threads.h"
#include "terrain/fit/removal.h"
#include "terrain/fit/steps.h"

namespace arete {
namespace {

class Removals {
 public:
  Removals(FitMesh& mesh, std::uint32_t rings, const RunContext& context)
      : mesh_(mesh),
        rings_(rings),
        context_(context),
        isQueued_(mesh.vertexCount(), false),
        changed_(mesh.vertexCount(), 0),
        patches_([&] { return FitPatches(mesh_); }) {}

  Status run() {
    for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v) enqueue(v);
    const double most = static_cast<double>(std::max<std::size_t>(1, queue_.size()));
    double done = 0, reported = 0;
    while (!queue_.empty()) {
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the fit was interrupted");
      takeBatch();
      parallelFor(IndexRange<std::size_t>(0, batch_, 1), [&](const auto& range) {
        FitPatches& patches = patches_.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i)
          patches.tryRemoval(trials_[i].node, rings_, trials_[i]);
      });
      ++round_;
      for (std::size_t i = 0; i < batch_; ++i) conclude(trials_[i]);
      done += static_cast<double>(batch_);
      reported = std::max(reported, done / std::max(most, done + static_cast<double>(queue_.size())));
      context_.report("fitting", reported);
    }
    return {};
  }

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // saturated error, ~node: later nodes come first

  void enqueue(std::uint32_t vertex) {
    const std::uint32_t v = mesh_.mtVertex(vertex), roots = mesh_.mt().rootVertexCount();
    if (v < roots || isQueued_[vertex] || !mesh_.isIn(vertex)) return;
    const NodeId node(v - roots);
    if (mesh_.isFixed(vertex) || !mesh_.isLeaf(node)) return;
    isQueued_[vertex] = true;
    queue_.push({mesh_.mt().saturatedCode(node), ~node.index()});
  }

  void takeBatch() {
    const std::size_t most = std::clamp<std::size_t>(mesh_.triangleCount() / 1024, 4, 256);
    for (batch_ = 0; batch_ < most && !queue_.empty(); queue_.pop()) {
      const NodeId node(~queue_.top().second);
      const std::uint32_t vertex = mesh_.indexOf(mesh_.mt().apex(node).index());
      isQueued_[vertex] = false;
      if (!mesh_.isIn(vertex) || !mesh_.isLeaf(node)) continue;
      if (trials_.size() == batch_) trials_.emplace_back();
      trials_[batch_++].node = node;
    }
  }

  void conclude(RemovalTrial& trial) {
    const std::uint32_t apex = trial.read[0];
    if (std::ranges::any_of(trial.read, [&](std::uint32_t v) { return changed_[v] == round_; })) {
      enqueue(apex);
      return;
    }
    if (!trial.isFeasible) return;
    mesh_.remove(trial.node, {trial.floor.data(), trial.floorSize});
    for (std::size_t i = 0; i < trial.moved.size(); ++i) {
      mesh_.raise(trial.moved[i], trial.rise[i]);
      changed_[trial.moved[i]] = round_;
    }
    changed_[apex] = round_;
    for (const std::uint32_t v : mesh_.mt().link(trial.node)) {
      const std::uint32_t vertex = mesh_.indexOf(v);
      changed_[vertex] = round_;
      enqueue(vertex);
    }
  }

  FitMesh& mesh_;
  const std::uint32_t rings_;
  const RunContext& context_;
  std::priority_queue<Key, std::vector<Key>, std::greater<Key>> queue_;
  std::vector<bool> isQueued_;
  std::vector<std::uint32_t> changed_;  // per vertex: the round that last changed it
  std::uint32_t round_ = 0;
  std::vector<RemovalTrial> trials_;
  std::size_t batch_ = 0;
  PerThread<FitPatches> patches_;
};

}  // namespace

Status removeWhatFits(FitMesh& mesh, std::uint32_t rings, const RunContext& context) {
  return withThreads(context, [&] { return Removals(mesh, rings, context).run(); });
}

}  // namespace arete
