// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is left out still has its triangles in every cut: a budget is raised by them, and a minimal cut asks
// nothing of them. A saturated cut has no such criterion; it spends on them what it must.
#include "io/query/surface/take_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "engine/base/float_bounds.h"
#include "io/query/request/check_request.h"
#include "io/query/request/criterion.h"
#include "io/query/surface/attribute_tolerances.h"
#include "io/query/surface/named_importance.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/displacement/displaced_places.h"
#include "surface/fit/attribute_fit.h"
#include "surface/front/attribute_criterion.h"
#include "surface/model/wedges.h"

namespace arete {
namespace {

Result<Cut> cutOf(const CutRequest& request, const SurfaceModel& model, const Criterion& criterion,
                  const Importance* importance, const DroppedComponents* dropped, const RunContext& context) {
  ARETE_TRY(CutOptions options, engineOptions(request, model));
  if (importance && options.order && request.order == CutOrder::usual)
    options.order = std::make_shared<ImportantFirst>(options.order, *importance);
  const std::uint32_t droppedTriangles = dropped ? dropped->rootTriangles : 0;
  if (options.maxTriangles) *options.maxTriangles += droppedTriangles;
  std::optional<KeptComponentsCriterion> keptCriterion;
  if (dropped && request.method == CutMethod::minimal) keptCriterion.emplace(criterion, *dropped);
  Result<Cut> cut = takeCut(
      model.mt, keptCriterion ? static_cast<const Criterion&>(*keptCriterion) : criterion, options, context);
  const std::uint32_t least = model.mt.rootTriangleCount() - droppedTriangles;
  if (!cut && request.maxTriangles && *request.maxTriangles < least)
    return failure(ErrorCode::usage,
                   fmt::format("the coarsest surface has {}", counted(least, "triangle", "triangles")),
                   "maxTriangles");
  return cut;
}

Cut finestCutWithout(const SurfaceModel& model, const DroppedComponents* dropped) {
  Cut whole = frontOfPrefix(model.mt, model.mt.nodeCount());
  return dropped ? withoutDropped(model.mt, whole, *dropped).cut : whole;
}

/// Fits the attributes of a cut to where its vertices are now.
Result<std::vector<AttributeRms>> attributesAtPlaces(const SurfaceModel& model, TakenSurface& taken,
                                                     const std::vector<Vec3>& before,
                                                     const DroppedComponents* dropped,
                                                     const RunContext& context) {
  SurfaceMesh& mesh = taken.front.mesh;
  const bool hasAny = !mesh.vertexAttributes.empty() || !mesh.wedgeAttributes.empty();
  if (!hasAny || mesh.positions == before) return std::vector<AttributeRms>();
  const Cut finest = finestCutWithout(model, dropped);
  const ChartsOfCut charts = chartsOfCut(model, finest, taken.cut);
  return fitAttributes(mesh, before, finestWithout(model, dropped).mesh, {charts.ofSource, charts.ofCut}, 0,
                       context);
}

}  // namespace

Result<std::optional<DroppedComponents>> componentsToDrop(const SurfaceModel& model,
                                                          const CutRequest& request) try {
  if (!(request.dropParts > 0)) return std::optional<DroppedComponents>();
  std::optional<DroppedComponents> dropped = componentsBelow(model, request.dropParts);
  if (dropped->rootTriangles >= model.mt.rootTriangleCount())
    return failure(ErrorCode::usage, "leaves nothing: every component is smaller", "dropParts");
  return dropped;
} catch (...) {
  return caughtFailure();
}

SurfaceFront finestWithout(const SurfaceModel& model, const DroppedComponents* dropped) {
  return dropped ? surfaceOf(model, finestCutWithout(model, dropped)) : finestSurfaceOf(model);
}

Result<TakenSurface> takeSurface(const SurfaceModel& model, const CutRequest& request,
                                 const DroppedComponents* dropped, const RunContext& context) try {
  ARETE_CHECK(checkRequest(request, ModelKind::surface));
  ARETE_TRY(std::shared_ptr<const BoundedCriterion> criterion, engineCriterion(request, model));
  const auto ofShape = criterion;
  ARETE_TRY(const std::optional<Importance> importance, importanceNamed(model, request.importance));
  if (importance) criterion = std::make_shared<ImportanceCriterion>(*ofShape, *importance);
  ARETE_TRY(const auto tolerances, attributeTolerances(model, request.attributeErrors));
  const AttributeCriterion ofBoth(*criterion, model, tolerances);
  const Criterion& asked = tolerances.empty() ? static_cast<const Criterion&>(*criterion) : ofBoth;
  TakenSurface taken;
  ARETE_TRY(Cut whole, cutOf(request, model, asked, importance ? &*importance : nullptr, dropped, context));
  taken.whole = std::move(whole);
  if (dropped) {
    KeptCut rest = withoutDropped(model.mt, taken.whole, *dropped);
    taken.cut = std::move(rest.cut);
    taken.numberOf = std::move(rest.numberOf);
  } else {
    taken.cut = taken.whole;
  }
  taken.front = surfaceOf(model, taken.cut);
  taken.error = taken.cut.achievedError;
  if (request.spaceCamera) taken.pixels = worstSeverity(model.mt, *ofShape, taken.cut);
  if (importance) {
    taken.importance = {.least = importance->least, .largest = importance->largest};
    for (const std::uint32_t id : taken.cut.ids)
      taken.importance->weighted = std::max(taken.importance->weighted,
                                            model.mt.error(TriangleId(id)) * importance->of(TriangleId(id)));
  }
  if (request.fit == CutFit::rms) {
    // A cut that a budget ended does not keep the tolerance before the fit.
    ARETE_TRY(const auto fitted, fitFront(taken.front, finestWithout(model, dropped).mesh,
                                          chartsOfCut(model, finestCutWithout(model, dropped), taken.cut),
                                          model.options.keepsBorders, taken.cut.achievedError,
                                          taken.whole.isComplete ? request.maxError : std::nullopt, context,
                                          model.positionError));
    taken.fit = fitted;
    taken.error = fitted.distance;
  } else if (!model.displacement.isEmpty() && request.isDisplaced && request.attributeErrors.empty() &&
             !importance) {
    const std::vector<double> promised = promisedErrors(model.mt, taken.cut, criterion.get());
    const std::vector<Vec3> before = taken.front.mesh.positions;
    taken.front.mesh.positions = displacedPlaces(model.mt, model.displacement, taken.cut, promised);
    for (std::size_t t = 0; t < promised.size(); ++t) taken.front.errors[t] = floatAtLeast(promised[t]);
    taken.isDisplaced = true;
    ARETE_TRY(auto attributes, attributesAtPlaces(model, taken, before, dropped, context));
    taken.displacedAttributes = std::move(attributes);
  } else {
    const StatedAttributes stated = statedAttributes(model, taken.cut, ofBoth);
    taken.attributeErrors = statedAttributeErrors(model, stated);
    taken.error = std::max(taken.error, stated.error);
  }
  // Wedges that only creases part are one for every other program.
  if (model.creaseEdges > 0) joinEqualWedges(taken.front.mesh);
  // A fit is measured by itself, and may keep what the stored errors cannot promise.
  const bool isKeptByFit = taken.fit && request.maxError && taken.fit->distance <= *request.maxError;
  if (request.statesError() && !isKeptByFit)
    taken.leftByRounding = errorLeftByRounding(model, *criterion, taken.cut);
  return taken;
} catch (...) {
  return caughtFailure();
}

Result<std::uint64_t> crossingsOf(const TriangleMesh& mesh, const RunContext& context) {
  ARETE_TRY(const MeshDiagnosis d, diagnose(mesh, {.mostPlaces = 1}, context));
  return d.selfIntersections ? d.selfIntersections->count : 0;
}

}  // namespace arete
