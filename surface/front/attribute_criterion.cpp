// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/front/attribute_criterion.h"

#include <algorithm>
#include <cmath>

namespace arete {

AttributeCriterion::AttributeCriterion(const BoundedCriterion& criterion, const SurfaceModel& model,
                                       const std::vector<AttributeTolerance>& tolerances)
    : criterion_(criterion) {
  for (const AttributeTolerance& t : tolerances) limits_.push_back({&model.attributeErrors[t.index], t.most});
}

bool AttributeCriterion::counts(const MultiTriangulation& mt, TriangleId t) const {
  const NodeId remover = mt.remover(t);
  return remover.isValid() && std::isfinite(criterion_.allowedError(mt.sphere(remover)));
}

bool AttributeCriterion::isFineEnough(const MultiTriangulation& mt, TriangleId t,
                                      const Corners& corners) const {
  if (!criterion_.isFineEnough(mt, t, corners)) return false;
  for (const Limit& limit : limits_)
    if (limit.errors->of(t.index()) > limit.most && counts(mt, t)) return false;
  return true;
}

double AttributeCriterion::severity(const MultiTriangulation& mt, TriangleId t,
                                    const Corners& corners) const {
  double most = criterion_.severity(mt, t, corners);
  const double whole = criterion_.severityLimit().value_or(criterion_.uniformError().value_or(0));
  for (const Limit& limit : limits_) {
    const double error = limit.errors->of(t.index());
    if (!(error > limit.most)) continue;
    const double times = limit.most > 0 ? std::min(error / limit.most, 1e6) : 1e6;
    most = std::max(most, times * (whole > 0 ? whole : limit.errors->length));
  }
  return most;
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

std::vector<double> attributeErrorsOf(const SurfaceModel& model, const Cut& cut) {
  std::vector<double> largest;
  for (const AttributeErrors& errors : model.attributeErrors) {
    double most = 0;
    for (const std::uint32_t t : cut.ids) most = std::max(most, errors.of(t));
    largest.push_back(most);
  }
  return largest;
}

}  // namespace arete
