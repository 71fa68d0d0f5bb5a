// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tolerance, a region or a camera says which error is required of a box. A budget does not: what a number
// of triangles comes to is known when the cut has been taken. So the nodes down to an error that about four
// times the triangles would reach are read, and more as long as the cut misses any.
#include "io/query/surface/surface_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/criteria/ball_about_box.h"
#include "io/query/request/criterion.h"
#include "io/query/surface/take_surface.h"

namespace arete {
namespace {

constexpr std::uint64_t kGuessGrowth = 8;

bool needsSource(const ExtractRequest& request) {
  const CutRequest& c = request.criterion;
  const bool isByPlace = c.spaceRegion || c.spaceCamera || c.focus;
  return !request.certificate.empty() || !request.map.empty() || request.measuresBothWays ||
         c.dropParts > 0 || c.fit != CutFit::none || !c.importance.empty() || c.deadlineMilliseconds ||
         (c.method == CutMethod::saturated && isByPlace);
}

/// Whether nothing but the number of triangles ends the cut.
bool isBudgetAlone(const CutRequest& c) {
  return c.maxTriangles && !c.maxError && !c.pixelError;
}

/// The least error that a criterion allows in a box, or that is required everywhere.
RequiredError requiredBy(std::vector<std::shared_ptr<const BoundedCriterion>> criteria,
                         const MetricFrame& metric, double everywhere) {
  return [criteria = std::move(criteria), metric, everywhere](const Box3& box) {
    const Sphere around = ballAboutBox(box, metric);
    double least = everywhere;
    for (const auto& criterion : criteria) least = std::min(least, criterion->allowedError(around));
    return least;
  };
}

}  // namespace

Result<SurfaceModel> readOutline(const AmtContainer& file, const RunContext& context) {
  AmtReadOptions options;
  if (file.isPaged()) options.wanted = requiredNowhere();
  return loadSurfaceAmt(file, options, context);
}

Result<SurfaceModel> readForExtract(const AmtContainer& file, std::span<const ExtractRequest> requests,
                                    SurfaceModel outline, const RunContext& context) try {
  if (!outline.finestOfWhole) return outline;  // all of it
  std::vector<std::shared_ptr<const BoundedCriterion>> criteria;
  std::uint64_t budget = 0;
  for (const ExtractRequest& request : requests) {
    if (needsSource(request)) return loadSurfaceAmt(file, {}, context);
    const CutRequest& c = request.criterion;
    if (isBudgetAlone(c)) {
      budget = std::max<std::uint64_t>(budget, *c.maxTriangles);
      continue;
    }
    ARETE_TRY(const auto criterion, engineCriterion(c, outline));
    criteria.push_back(criterion);
  }
  const auto isEnough = [&](const SurfaceModel& part) {
    return std::ranges::all_of(requests, [&](const ExtractRequest& request) {
      const Result<TakenSurface> taken = takeSurface(part, request.criterion, nullptr, context);
      return taken && taken->whole.missing.empty();
    });
  };
  for (std::uint64_t guess = budget;; guess *= kGuessGrowth) {
    double everywhere = std::numeric_limits<double>::infinity();
    if (budget > 0) {
      ARETE_TRY(everywhere, surfaceErrorBeyond(file, guess));
      if (!(everywhere > 0)) break;
    }
    ARETE_TRY(
        SurfaceModel part,
        loadSurfaceAmt(file, {.wanted = requiredBy(criteria, outline.mt.metric(), everywhere)}, context));
    if (!part.finestOfWhole || isEnough(part)) return part;
    if (budget == 0) break;
  }
  return loadSurfaceAmt(file, {}, context);
} catch (...) {
  return caughtFailure(file.path());
}

}  // namespace arete
