// SPDX-License-Identifier: GPL-3.0-or-later
//
// Selects the algorithm. Minimal: least_cut.cpp; with a budget or a deadline refine.cpp. Saturated:
// saturated_cut.cpp. Then front.cpp writes the triangles.
#include "engine/cut/cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "engine/cut/front.h"
#include "engine/cut/least_cut.h"
#include "engine/cut/missing.h"
#include "engine/cut/refine.h"
#include "engine/cut/saturated_cut.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

tl::unexpected<Error> interrupted() {
  return failure(ErrorCode::interrupted, "the cut was interrupted");
}

}  // namespace

Status checkCut(const MultiTriangulation& mt, const Criterion& criterion, CutMethod method,
                std::optional<std::uint32_t> maxTriangles) try {
  if (maxTriangles && *maxTriangles < mt.rootTriangleCount())
    return failure(
        ErrorCode::usage,
        fmt::format("{} {} fewer than the {} of the root, the coarsest there is", *maxTriangles,
                    agreeing(*maxTriangles, "triangle is", "triangles are"), mt.rootTriangleCount()),
        "maxTriangles");
  if (method == CutMethod::saturated && criterion.bounded() == nullptr)
    return failure(
        ErrorCode::usage,
        "this criterion has no bound over a sphere, so a saturated cut cannot take it; use the minimal cut");
  return {};
} catch (...) {
  return caughtFailure();
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

bool isSatisfied(const MultiTriangulation& mt, const Criterion& criterion, TriangleId t,
                 const Criterion::Corners& corners) {
  // The bound is the cheaper test, and passes most.
  const BoundedCriterion* const bounded = criterion.bounded();
  if (const NodeId remover = mt.remover(t); remover.isValid() && bounded != nullptr) {
    const double allowed = bounded->allowedError(mt.sphere(remover));
    if (mt.error(t) <= allowed) return true;
  }
  return criterion.isFineEnough(mt, t, corners);
}

double worstSeverity(const MultiTriangulation& mt, const Criterion& criterion, const Cut& cut) {
  return parallelReduce(
      IndexRange<std::size_t>(0, cut.ids.size(), 4096), 0.0,
      [&](const auto& range, double worst) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          Criterion::Corners corners = cut.triangles[i];
          for (std::uint32_t& corner : corners) corner = cut.vertices[corner];
          worst = std::max(worst, criterion.severity(mt, TriangleId(cut.ids[i]), corners));
        }
        return worst;
      },
      [](double a, double b) { return std::max(a, b); });
}

Cut front(const MultiTriangulation& mt, const NodeSet& closed) {
  return frontOf(mt, MemberSet(closed));
}

Cut frontOfPrefix(const MultiTriangulation& mt, std::uint32_t nodes) {
  return frontOf(mt, MemberSet::prefix(nodes));
}

std::uint32_t uniformTriangleCount(const MultiTriangulation& mt, double maxError) {
  const OutwardScale::Code code = mt.scale().floorCode(maxError);
  const std::uint32_t band = MultiTriangulation::bandOf(code), certain = mt.bandBegin(band);
  std::uint32_t count = mt.prefixTriangleCount(certain);
  for (std::uint32_t n = certain; n < mt.bandEnd(band); ++n)
    if (mt.saturatedCode(NodeId(n)) > code) count += mt.isOpen(NodeId(n)) ? 1 : 2;
  return count;
}

namespace {

Status checkOptions(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options) {
  ARETE_CHECK(checkCut(mt, criterion, options.method, options.maxTriangles));
  if (options.method == CutMethod::minimal) return {};
  if (options.deadline || options.order)
    return failure(ErrorCode::usage,
                   "a saturated cut is one test per node, in no order and with no time to stop at; use the "
                   "minimal cut for a deadline or an order");
  return {};
}

}  // namespace

Result<NodeCut> takeNodes(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options,
                          const RunContext& context) try {
  ARETE_CHECK(checkOptions(mt, criterion, options));
  if (context.cancelled()) return interrupted();
  return withThreads(context, [&]() -> Result<NodeCut> {
    if (options.method == CutMethod::saturated) {
      const SaturatedMembers cut = saturatedMembers(mt, *criterion.bounded(), options.maxTriangles);
      return NodeCut{cut.members.toNodeSet(mt.nodeCount()), cut.isComplete};
    }
    if (options.maxTriangles || options.deadline) return refineWithin(mt, criterion, options, context);
    const auto least = leastMembers(mt, criterion, [&] { return context.cancelled(); });
    if (!least) return interrupted();
    return NodeCut{least->toNodeSet(mt.nodeCount()), true};
  });
} catch (...) {
  return caughtFailure();
}

namespace {

Result<Cut> takenCut(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options,
                     const RunContext& context) {
  if (options.method == CutMethod::saturated) {
    const SaturatedMembers taken = saturatedMembers(mt, *criterion.bounded(), options.maxTriangles);
    Cut cut = frontOfClosure(mt, taken.members);
    cut.isComplete = taken.isComplete;
    return cut;
  }
  if (!options.maxTriangles && !options.deadline) {
    const auto least = leastMembers(mt, criterion, [&] { return context.cancelled(); });
    if (!least) return interrupted();
    return frontOfClosure(mt, *least);
  }
  ARETE_TRY(const NodeCut nodes, refineWithin(mt, criterion, options, context));
  Cut cut = front(mt, nodes.nodes);
  cut.isComplete = nodes.isComplete;
  return cut;
}

}  // namespace

Result<Cut> takeCut(const MultiTriangulation& mt, const Criterion& criterion, const CutOptions& options,
                    const RunContext& context) try {
  ARETE_CHECK(checkOptions(mt, criterion, options));
  if (context.cancelled()) return interrupted();
  return withThreads(context, [&]() -> Result<Cut> {
    ARETE_TRY(Cut cut, takenCut(mt, criterion, options, context));
    cut.missing = missingIn(mt, criterion, options.maxTriangles || options.deadline, cut);
    return cut;
  });
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
