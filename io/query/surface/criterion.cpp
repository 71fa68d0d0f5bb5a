// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/surface/criterion.h"

#include <fmt/format.h>

#include "engine/criteria/refine_order.h"
#include "engine/criteria/view_error.h"

namespace arete {
namespace {

/// The pixel error where a budget alone ends the cut.
constexpr double kLeastPixels = 1e-3;

}  // namespace

Result<std::unique_ptr<const BoundedCriterion>> engineCriterion(const SurfaceCriterion& c,
                                                                const SurfaceModel& model) {
  if (c.maxError && !(c.outsideError >= *c.maxError))
    return failure(
        ErrorCode::usage,
        fmt::format("{} is below the error {} inside; it must not be smaller", c.outsideError, *c.maxError),
        "outsideError");
  const MetricFrame& metric = model.mt.metric();
  if (c.region)
    return std::make_unique<SpaceRegionError>(c.region, metric, c.maxError.value_or(0), c.outsideError);
  if (c.camera) {
    ARETE_TRY(const View view, viewOf(*c.camera, model));
    const double pixels = c.pixelError.value_or(c.maxTriangles ? kLeastPixels : 1);
    return std::make_unique<ViewError>(
        ViewError::Options{.view = view, .pixels = pixels, .outsideError = c.outsideError}, metric);
  }
  return std::make_unique<UniformError>(c.maxError.value_or(0));
}

double errorLeftByRounding(const SurfaceModel& model, const Criterion& criterion, const Cut& cut) {
  double left = 0;
  if (model.positionError == 0) return left;
  for (const std::uint32_t id : cut.ids) {
    const TriangleId t(id);
    if (model.mt.remover(t).isValid() || model.mt.error(t) <= left) continue;
    if (!criterion.isFineEnough(model.mt, t, model.mt.corners(t))) left = model.mt.error(t);
  }
  return left;
}

CutOptions engineOptions(const SurfaceCriterion& c) {
  CutOptions options;
  options.method = c.method;
  options.maxTriangles = c.maxTriangles;
  if (c.maxTriangles && !c.region && !c.camera && c.method == CutMethod::minimal)
    options.order = std::make_shared<LargestSquaresFirst>();
  return options;
}

}  // namespace arete
