// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/front/attribute_criterion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace arete {
namespace {

std::size_t slotOf(const SurfaceModel& model, TriangleId t, std::size_t level) {
  return level * model.mt.triangleIdCount() + t.index();
}

/// How many levels are within an error: the first always is, for cuts test the errors of triangles
/// themselves. What rounding has moved the source by adds to the distances.
std::size_t levelsWithin(const SurfaceModel& model, double error) {
  std::size_t levels = 1;
  for (const double distance : model.attributeDistances)
    levels += distance + model.positionError <= error ? 1 : 0;
  return levels;
}

/// The first level from `first` on that is taken and where all attributes together are least off; `end`:
/// none.
template <class IsTaken>
std::size_t leastLevel(const SurfaceModel& model, TriangleId t, std::size_t first, std::size_t end,
                       const IsTaken& isTaken) {
  std::size_t best = end;
  double least = 0;
  for (std::size_t level = first; level < end; ++level) {
    if (!isTaken(level)) continue;
    double squares = 0;
    for (const AttributeErrors& errors : model.attributeErrors) {
      const double off = errors.length * std::min(errors.atSlot(slotOf(model, t, level)), 1e30);
      squares += off * off;
    }
    if (best < end && !(squares < least)) continue;
    best = level;
    least = squares;
  }
  return best;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A tolerance that nothing reaches is exceeded by this much, so that such triangles are still compared.
constexpr double kMostTimes = 1e6;

}  // namespace

AttributeCriterion::AttributeCriterion(const BoundedCriterion& criterion, const SurfaceModel& model,
                                       const std::vector<AttributeTolerance>& tolerances)
    : criterion_(criterion), model_(model) {
  for (const AttributeTolerance& t : tolerances) limits_.push_back({&model.attributeErrors[t.index], t.most});
}

double AttributeCriterion::allowed(const MultiTriangulation& mt, TriangleId t) const {
  const NodeId remover = mt.remover(t);
  if (!remover.isValid()) return kInfinity;
  if (const std::optional<double> everywhere = criterion_.uniformError()) return *everywhere;
  return criterion_.allowedError(mt.sphere(remover));
}

double AttributeCriterion::excess(TriangleId t, double within) const {
  double least = kInfinity;
  for (std::size_t level = 0; level < levelsWithin(model_, within); ++level) {
    double most = 0;
    for (const Limit& limit : limits_) {
      const double error = limit.errors->atSlot(slotOf(model_, t, level));
      if (error > limit.most)
        most = std::max(most, limit.most > 0 ? std::min(error / limit.most, kMostTimes) : kMostTimes);
    }
    least = std::min(least, most);
  }
  return least;
}

bool AttributeCriterion::isFineEnough(const MultiTriangulation& mt, TriangleId t,
                                      const Corners& corners) const {
  if (!criterion_.isFineEnough(mt, t, corners)) return false;
  const double within = allowed(mt, t);
  return !std::isfinite(within) || excess(t, within) == 0;
}

double AttributeCriterion::severity(const MultiTriangulation& mt, TriangleId t,
                                    const Corners& corners) const {
  const double ofShape = criterion_.severity(mt, t, corners), within = allowed(mt, t);
  const double times = excess(t, std::isfinite(within) ? within : 0);
  if (!(times > 0)) return ofShape;
  double whole = criterion_.severityLimit().value_or(criterion_.uniformError().value_or(0));
  if (!(whole > 0))
    for (const Limit& limit : limits_) whole = std::max(whole, limit.errors->length);
  return std::max(ofShape, times * whole);
}

std::size_t AttributeCriterion::statedLevel(const MultiTriangulation& mt, TriangleId t,
                                            double cutError) const {
  const double most = allowed(mt, t);
  const std::size_t own = levelsWithin(model_, cutError),
                    all = std::isfinite(most) ? std::max(own, levelsWithin(model_, most)) : own;
  const auto keeps = [&](std::size_t level) {
    return std::ranges::all_of(limits_, [&](const Limit& limit) {
      return limit.errors->atSlot(slotOf(model_, t, level)) <= limit.most;
    });
  };
  const std::size_t kept = leastLevel(model_, t, 0, own, keeps);
  if (kept < own) return kept;
  const std::size_t beyond = leastLevel(model_, t, own, all, keeps);
  return beyond < all ? beyond : leastLevel(model_, t, 0, own, [](std::size_t) { return true; });
}

RefineKey LargestChangesFirst::key(const MultiTriangulation& mt, const Criterion&, TriangleId t,
                                   const Criterion::Corners& corners, std::uint64_t) const {
  const auto at = [&](std::size_t i) { return mt.position(VertexId(corners[i])); };
  const double rms = mt.decoded(kRms, t);
  double squares = rms * rms;
  for (const AttributeErrors& errors : model_.attributeErrors) {
    const double off = errors.of(t.index());
    if (std::isfinite(off)) squares += 0.25 * errors.length * errors.length * off * off;
  }
  return {0, -squares * norm(cross(at(1) - at(0), at(2) - at(0)))};
}

StatedAttributes statedAttributes(const SurfaceModel& model, const Cut& cut,
                                  const AttributeCriterion& asked) {
  StatedAttributes stated{cut.achievedError, std::vector<double>(model.attributeErrors.size(), 0.0)};
  if (model.attributeErrors.empty()) return stated;
  for (const std::uint32_t id : cut.ids) {
    const TriangleId t(id);
    const std::size_t level = asked.statedLevel(model.mt, t, cut.achievedError);
    if (level > 0)
      stated.error = std::max(stated.error, model.attributeDistances[level - 1] + model.positionError);
    for (std::size_t a = 0; a < stated.largest.size(); ++a)
      stated.largest[a] =
          std::max(stated.largest[a], model.attributeErrors[a].atSlot(slotOf(model, t, level)));
  }
  return stated;
}

std::vector<double> attributeErrorsOf(const SurfaceModel& model, const Cut& cut) {
  const UniformError ofCut(cut.achievedError);
  return statedAttributes(model, cut, AttributeCriterion(ofCut, model, {})).largest;
}

}  // namespace arete
