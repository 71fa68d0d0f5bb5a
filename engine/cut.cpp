// SPDX-License-Identifier: GPL-3.0-or-later
//
// Minimal. The least closed set C such that every triangle whose creator is in C (or that is in the root) and
// that fails c(t) has its remover in C. It is unique, so the order of the walk does not matter: a stack of
// nodes to include; each asks for the creators of its floor (its parents) and for the removers of those of
// its ceiling that fail. With a budget the order does matter: triangles of the growing front wait in a heap,
// the largest error on top; its remover enters with the ancestors still missing, as long as the budget holds
// them.
//
// Saturated. Node n is in iff its saturated error exceeds what the criterion allows over its sphere. A
// parent's saturated error and sphere contain its child's (law 6), so the set is closed as it comes. For a
// uniform error it is a prefix of the nodes. With a budget: the longest prefix whose members keep it (the
// members of a prefix are closed too).
#include "engine/cut.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <queue>

#include "engine/with_threads.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;
constexpr std::size_t kCheckEvery = 1 << 16;

tl::unexpected<Error> interrupted() {
  return failure(ErrorCode::interrupted, "the cut was interrupted");
}

Status checkBudget(const MultiTriangulation& mt, std::optional<std::uint32_t> maxTriangles) {
  if (maxTriangles && *maxTriangles < mt.rootTriangleCount())
    return failure(ErrorCode::usage,
                   fmt::format("{} triangles are fewer than the {} of the root, the coarsest there is",
                               *maxTriangles, mt.rootTriangleCount()),
                   "--max-triangles");
  return {};
}

/// Whether a triangle satisfies the criterion; a uniform error is compared as a code, without the virtual
/// call.
class Test {
 public:
  Test(const MultiTriangulation& mt, const Criterion& criterion)
      : mt_(mt),
        criterion_(criterion),
        isUniform_(!std::isnan(criterion.uniformError())),
        code_(isUniform_ ? mt.arrays().scale.floorCode(criterion.uniformError()) : OutwardScale::Code(0)) {}

  bool passes(std::uint32_t id, NodeId creator) const {
    if (isUniform_) return mt_.arrays().error[id] <= code_;
    return criterion_.isFineEnough(mt_, TriangleId(id), mt_.corners(TriangleId(id), creator));
  }

 private:
  const MultiTriangulation& mt_;
  const Criterion& criterion_;
  bool isUniform_;
  OutwardScale::Code code_;
};

Result<NodeSet> minimalWithoutBudget(const MultiTriangulation& mt, const Criterion& criterion,
                                     const RunContext& context) {
  const MtArrays& a = mt.arrays();
  const Test test(mt, criterion);
  const std::uint32_t roots = mt.rootTriangleCount();
  NodeSet in(mt.nodeCount(), 0);
  std::vector<std::uint32_t> stack;
  const auto include = [&](std::uint32_t n) {
    if (n == kNone || in[n]) return;
    in[n] = 1;
    stack.push_back(n);
  };
  for (std::uint32_t t = 0; t < roots; ++t)
    if (a.remover[t] != kNone && !test.passes(t, {})) include(a.remover[t]);
  for (std::size_t steps = 0; !stack.empty(); ++steps) {
    if (steps % kCheckEvery == 0 && context.cancelled()) return interrupted();
    const std::uint32_t n = stack.back();
    stack.pop_back();
    for (const std::uint32_t t : mt.floor(NodeId(n))) include(mt.creator(TriangleId(t)).index());
    for (std::uint32_t s = a.slotBegin[n]; s < a.slotBegin[n + 1]; ++s) {
      const std::uint32_t r = a.remover[roots + s];
      if (r != kNone && !in[r] && !test.passes(roots + s, NodeId(n))) include(r);
    }
  }
  return in;
}

Result<NodeSet> minimalWithBudget(const MultiTriangulation& mt, const Criterion& criterion,
                                  std::uint32_t maxTriangles, const RunContext& context) {
  const MtArrays& a = mt.arrays();
  const Test test(mt, criterion);
  const std::uint32_t roots = mt.rootTriangleCount();
  NodeSet in(mt.nodeCount(), 0);
  // Largest error first, then the smaller id: (error, ~id).
  std::priority_queue<std::pair<std::uint16_t, std::uint32_t>> heap;
  const auto offer = [&](std::uint32_t id, NodeId creator) {
    const std::uint32_t r = a.remover[id];
    if (r != kNone && !in[r] && !test.passes(id, creator)) heap.emplace(a.error[id], ~id);
  };
  for (std::uint32_t t = 0; t < roots; ++t) offer(t, {});

  std::uint64_t triangles = roots;
  std::vector<std::uint32_t> missing, order;
  // Errors are not monotone down the graph: a refinement can raise the largest error (white noise does it).
  // The state kept is the last one with the least.
  std::uint16_t least = OutwardScale::kMaxCode;
  std::size_t best = 0;
  for (std::size_t steps = 0;; ++steps) {
    if (steps % kCheckEvery == 0 && context.cancelled()) return interrupted();
    while (!heap.empty() && in[a.remover[~heap.top().second]]) heap.pop();
    const std::uint16_t largest = heap.empty() ? OutwardScale::Code(0) : heap.top().first;
    if (largest <= least) {
      least = largest;
      best = order.size();
    }
    if (heap.empty()) break;
    const std::uint32_t wanted = a.remover[~heap.top().second];
    heap.pop();
    missing.assign(1, wanted);
    in[wanted] = 1;
    std::uint64_t added = 0;
    for (std::size_t i = 0; i < missing.size(); ++i) {
      const NodeId n(missing[i]);
      added += mt.isOpen(n) ? 1 : 2;
      for (const std::uint32_t t : mt.floor(n)) {
        const NodeId parent = mt.creator(TriangleId(t));
        if (!parent.isValid() || in[parent.index()]) continue;
        in[parent.index()] = 1;
        missing.push_back(parent.index());
      }
    }
    if (triangles + added > maxTriangles) {
      // The largest error left cannot be bettered within the budget; what is left of it would only hide that.
      for (const std::uint32_t n : missing) in[n] = 0;
      break;
    }
    triangles += added;
    order.insert(order.end(), missing.begin(), missing.end());
    for (const std::uint32_t n : missing)
      for (std::uint32_t s = a.slotBegin[n]; s < a.slotBegin[n + 1]; ++s) offer(roots + s, NodeId(n));
  }
  for (std::size_t i = best; i < order.size(); ++i) in[order[i]] = 0;
  return in;
}

}  // namespace

std::uint32_t uniformPrefix(const MultiTriangulation& mt, double maxError) {
  const auto& saturated = mt.arrays().saturatedError;
  const OutwardScale::Code code = mt.arrays().scale.floorCode(maxError);
  return static_cast<std::uint32_t>(
      std::partition_point(saturated.begin(), saturated.end(), [&](std::uint16_t s) { return s > code; }) -
      saturated.begin());
}

std::uint32_t closeUpwards(const MultiTriangulation& mt, NodeSet& set) {
  // Parents have smaller indices: one backward sweep reaches every ancestor.
  std::uint32_t members = 0;
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    if (!set[n]) continue;
    ++members;
    for (const std::uint32_t t : mt.floor(NodeId(n))) {
      const NodeId parent = mt.creator(TriangleId(t));
      if (parent.isValid()) set[parent.index()] = 1;
    }
  }
  return members;
}

Result<NodeSet> minimalNodes(const MultiTriangulation& mt, const Criterion& criterion,
                             std::optional<std::uint32_t> maxTriangles, const RunContext& context) {
  if (const Status budget = checkBudget(mt, maxTriangles); !budget) return tl::unexpected(budget.error());
  if (context.cancelled()) return interrupted();
  return maxTriangles ? minimalWithBudget(mt, criterion, *maxTriangles, context)
                      : minimalWithoutBudget(mt, criterion, context);
}

Result<NodeSet> saturatedNodes(const MultiTriangulation& mt, const Criterion& criterion,
                               std::optional<std::uint32_t> maxTriangles, const RunContext& context) {
  if (const Status budget = checkBudget(mt, maxTriangles); !budget) return tl::unexpected(budget.error());
  if (!criterion.isMonotone())
    return failure(
        ErrorCode::usage,
        "this criterion has no bound over a sphere, so a saturated cut cannot take it; use the minimal cut");
  if (context.cancelled()) return interrupted();
  const MtArrays& a = mt.arrays();
  NodeSet in(mt.nodeCount(), 0);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mt.nodeCount(), 4096), [&](const auto& range) {
    for (std::uint32_t n = range.begin(); n != range.end(); ++n)
      in[n] = a.scale.decode(a.saturatedError[n]) > criterion.allowedError(a.sphere[n]) ? 1 : 0;
  });
  if (maxTriangles) {
    std::uint64_t triangles = mt.rootTriangleCount();
    std::uint32_t n = 0;
    for (; n < mt.nodeCount(); ++n) {
      if (!in[n]) continue;
      triangles += mt.isOpen(NodeId(n)) ? 1 : 2;
      if (triangles > *maxTriangles) break;
    }
    std::fill(in.begin() + n, in.end(), std::uint8_t(0));
  }
  return in;
}

namespace {

Result<Cut> takeCutHere(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options,
                        const RunContext& context) {
  if (options.method == CutMethod::saturated && !std::isnan(criterion.uniformError())) {
    if (const Status budget = checkBudget(mt, options.maxTriangles); !budget)
      return tl::unexpected(budget.error());
    if (context.cancelled()) return interrupted();
    std::uint32_t nodes = uniformPrefix(mt, criterion.uniformError());
    if (options.maxTriangles) {
      std::uint64_t triangles = mt.rootTriangleCount();
      for (std::uint32_t n = 0; n < nodes; ++n) {
        triangles += mt.isOpen(NodeId(n)) ? 1 : 2;
        if (triangles > *options.maxTriangles) nodes = n;
      }
    }
    return frontOfPrefix(mt, nodes);
  }
  const Result<NodeSet> nodes = options.method == CutMethod::saturated
                                    ? saturatedNodes(mt, criterion, options.maxTriangles, context)
                                    : minimalNodes(mt, criterion, options.maxTriangles, context);
  if (!nodes) return tl::unexpected(nodes.error());
  return front(mt, *nodes);
}

}  // namespace

Result<Cut> takeCut(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options,
                    const RunContext& context) {
  return withThreads(context, [&] { return takeCutHere(mt, criterion, options, context); });
}

}  // namespace arete
