// SPDX-License-Identifier: GPL-3.0-or-later
//
// A view is widened by pixels at its sides, so that a pixel stays as large as it is. What differs between the
// kinds of models is the error that a view requires of a box: of terrain a box of the plan is a column of all
// heights.
#include "io/query/pages/view_demand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/criteria/ball_about_box.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "engine/mt/exaggerated_mt.h"
#include "io/query/extract/view_footprint.h"

namespace arete {
namespace {

/// How much wider a picture is around another, and how much smaller its tolerance.
constexpr double kWider = 1.25, kFiner = 0.8;
constexpr double kWidestAngle = 2.6;  // radians

View widened(const View& view) {
  View wide = view;
  double factor = kWider;
  if (view.isParallel()) {
    wide.parallelHeight *= factor;
  } else {
    const double slope = std::tan(view.verticalFieldOfView / 2);
    const double widest = std::max(slope, std::tan(kWidestAngle / 2));
    factor = std::min(factor, widest / slope);
    wide.verticalFieldOfView = 2 * std::atan(factor * slope);
  }
  wide.widthPixels *= factor;
  wide.heightPixels *= factor;
  return wide;
}

Vec3 mixed(const Vec3& from, const Vec3& to, double times) {
  return {to.x + times * (to.x - from.x), to.y + times * (to.y - from.y), to.z + times * (to.z - from.z)};
}

/// The model in the space of the view.
TerrainModel stretched(const TerrainModel& model, double stretch) {
  TerrainModel drawn = model;
  if (stretch != 1) drawn.mt = exaggerated(model.mt, stretch);
  return drawn;
}

/// The demand of what views require.
///
/// @param required maps a view and its tolerance to the error that they require of boxes
template <class Required>
PageDemand demandBy(const ViewDemand& demand, const Required& required) {
  if (demand.error) return {.needed = [error = *demand.error](const Box3&) { return error; }};
  PageDemand pages{.needed = required(demand.view, demand.pixels)};
  // The smaller of both in every box: a ball of the wider view may be seen from another side of it.
  pages.around = [needed = pages.needed, wide = required(widened(demand.view), kFiner * demand.pixels)](
                     const Box3& box) { return std::min(needed(box), wide(box)); };
  if (demand.expected) pages.ahead = required(widened(*demand.expected), demand.pixels);
  return pages;
}

}  // namespace

PageDemand demandOf(const ViewDemand& demand, const TerrainModel& outline) {
  const TerrainModel drawn = stretched(outline, demand.stretch);
  return demandBy(demand, [&](const View& view, double pixels) {
    return requiredInView(ViewError({.view = view, .pixels = pixels}, drawn.mt.metric()), drawn);
  });
}

PageDemand demandOf(const ViewDemand& demand, const SurfaceModel& outline) {
  const MetricFrame metric = outline.mt.metric();
  return demandBy(demand, [&](const View& view, double pixels) -> RequiredError {
    return [error = ViewError({.view = view, .pixels = pixels}, metric), metric](const Box3& box) {
      return error.allowedError(ballAboutBox(box, metric));
    };
  });
}

std::optional<View> viewAhead(const View& before, const View& now, double times) {
  if (before.isParallel() != now.isParallel()) return std::nullopt;
  View ahead = now;
  ahead.eye = mixed(before.eye, now.eye, times);
  ahead.forward = mixed(before.forward, now.forward, times);
  ahead.up = mixed(before.up, now.up, times);
  const bool isStill = norm(ahead.eye - now.eye) == 0 && norm(ahead.forward - now.forward) == 0;
  if (isStill || !ahead.validate()) return std::nullopt;
  return ahead;
}

Result<DrawnOfPart> missingInView(const MultiTriangulation& part, const ViewDemand& demand,
                                  const RunContext& context) {
  const MultiTriangulation mt = demand.stretch == 1 ? part : exaggerated(part, demand.stretch);
  const ViewError seen({.view = demand.view, .pixels = demand.pixels}, mt.metric());
  const UniformError chosen(demand.error.value_or(0));
  const BoundedCriterion& criterion = demand.error ? static_cast<const BoundedCriterion&>(chosen) : seen;
  ARETE_TRY(const Cut cut, takeCut(mt, criterion, {.method = CutMethod::saturated}, context));
  DrawnOfPart drawn{.missing = static_cast<std::uint32_t>(cut.missing.size())};
  for (const std::uint32_t t : cut.missing)
    drawn.pixels = std::max(drawn.pixels, seen.severity(mt, TriangleId(t), mt.corners(TriangleId(t))));
  return drawn;
}

}  // namespace arete
