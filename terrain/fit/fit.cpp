// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fewest triangles: begins with the least cut, which is within the tolerance, and removes one leaf after the
// other for which the heights around it can be changed so that all samples stay within the tolerance
// (removals.cpp). Every state is within the tolerance, and every state is a cut of the model: conforming,
// Delaunay where the model is, with the same rims. (Fitting a coarser cut instead would need repairs wherever
// the fit misses the tolerance.)
//
// The errors returned are computed from the final heights and the samples, not taken from the solver.
#include "terrain/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/criteria/criterion.h"
#include "terrain/fit/mesh.h"
#include "terrain/fit/samples.h"
#include "terrain/fit/steps.h"

namespace arete {
namespace {

/// By which part of itself an error in doubles may exceed the exact one. More than it ever does, so that no
/// triangle is lost; where heights have changed, the solver stays as far below the tolerance (removal.cpp).
constexpr double kRounding = 0x1p-40;

/// Outside the region the bound is no larger than the achieved error of the cut: otherwise vertices out there
/// would be moved far, for the sake of a sample at the region's edge.
FitBounds boundsOf(const TerrainModel& model, const FitTolerance& tolerance, const Cut& cut) {
  const MultiTriangulation& mt = model.mt;
  FitBounds bounds{.everywhere = tolerance.maxError, .rounding = kRounding * tolerance.maxError};
  if (tolerance.region == nullptr) return bounds;
  const double outside = std::max(tolerance.maxError, std::min(tolerance.outsideError, cut.achievedError));
  bounds.of.resize(mt.vertexCount());
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v)
    bounds.of[v] =
        tolerance.region->contains(mt.vertices().planPosition(VertexId(v))) ? tolerance.maxError : outside;
  return bounds;
}

void fixHeights(const TerrainModel& model, FitMesh& mesh) {
  std::vector<std::uint32_t> fixed = model.options.fixedVertices;
  std::ranges::sort(fixed);
  for (std::uint32_t v = 0; v < mesh.vertexCount() && mesh.mtVertex(v) < model.mt.rootVertexCount(); ++v) {
    const std::uint32_t sample =
        model.isRaster ? model.mt.vertices().samples[mesh.mtVertex(v)] : mesh.mtVertex(v);
    if (std::ranges::binary_search(fixed, sample)) mesh.fix(v);
  }
}

Result<FitMesh> meshOf(const TerrainModel& model, const Cut& cut, FitBounds bounds, const FitOptions& options,
                       const RunContext& context) {
  ARETE_TRY(auto samples, shareSamples(model.mt, cut, nodesOf(model.mt, cut), context));
  FitMesh mesh(model.mt, cut, std::move(samples), std::move(bounds));
  if (options.keepsFixedHeights) fixHeights(model, mesh);
  return mesh;
}

tl::unexpected<Error> notOneCut() {
  return failure(ErrorCode::invalidData, "the triangles of the model are not those of a multitriangulation");
}

/// Mean z_TIN - z_sample. O(samples).
double meanResidual(const FitMesh& mesh) {
  double sum = 0, count = 0;
  for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
    if (!mesh.isLive(t)) continue;
    const FitMesh::Corners& corners = mesh.triangle(t).corners;
    const FitMesh::Weights weights = mesh.weights(corners);
    mesh.forSamples(t, [&](std::uint32_t s) {
      sum += mesh.residual(corners, weights.of(mesh.plan(s)), s);
      ++count;
    });
  }
  return count > 0 ? sum / count : 0;
}

/// The cut that the mesh represents now, with the errors of its triangles. An error above the tolerance by no
/// more than rounding is set to the tolerance.
Result<FittedCut> fittedCut(const FitMesh& mesh, const Cut& before, double meanBefore, double tolerance) {
  const MultiTriangulation& mt = mesh.mt();
  NodeSet nodes(mt.nodeCount(), 0);
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v)
    if (mesh.isIn(v) && mesh.mtVertex(v) >= mt.rootVertexCount())
      nodes[mesh.mtVertex(v) - mt.rootVertexCount()] = 1;
  FittedCut fitted{.cut = front(mt, nodes),
                   .trianglesBefore = before.triangles.size(),
                   .errorBefore = before.achievedError,
                   .meanBefore = meanBefore};
  fitted.cut.isComplete = before.isComplete;
  fitted.heights.reserve(fitted.cut.vertices.size());
  for (const std::uint32_t v : fitted.cut.vertices) {
    const std::uint32_t vertex = mesh.indexOf(v);
    if (vertex == FitMesh::kNone) return notOneCut();
    fitted.heights.push_back(mesh.heights()[vertex]);
  }

  std::vector<double> errors = mesh.errors();
  for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
    if (!mesh.isLive(t)) continue;
    double& error = errors[t];
    // Where no height has changed, the stored error is an upper bound too.
    const bool isUnchanged = std::ranges::all_of(mesh.triangle(t).corners, [&](std::uint32_t v) {
      return mesh.heights()[v] == mt.vertices().height(VertexId(mesh.mtVertex(v)));
    });
    if (isUnchanged) error = std::min(error, mt.error(TriangleId(mesh.triangle(t).id)));
    if (error > tolerance && error <= tolerance * (1 + 2 * kRounding)) error = tolerance;
  }
  std::vector<std::pair<std::uint32_t, double>> byId;
  for (std::uint32_t t = 0; t < mesh.slotCount(); ++t)
    if (mesh.isLive(t)) byId.emplace_back(mesh.triangle(t).id, errors[t]);
  std::ranges::sort(byId);
  fitted.errors.reserve(fitted.cut.ids.size());
  fitted.cut.achievedError = 0;
  for (const std::uint32_t id : fitted.cut.ids) {
    const auto found = std::ranges::lower_bound(byId, id, {}, &std::pair<std::uint32_t, double>::first);
    if (found == byId.end() || found->first != id) return notOneCut();
    if (!std::isfinite(found->second))
      return failure(ErrorCode::invalidData, "the heights of the model are too large for their errors");
    fitted.errors.push_back(found->second);
    fitted.cut.achievedError = std::max(fitted.cut.achievedError, fitted.errors.back());
  }
  return fitted;
}

Status checkTolerance(const FitTolerance& tolerance) {
  if (!(tolerance.maxError >= 0))
    return failure(ErrorCode::usage, "the tolerance must not be negative", "maxError");
  if (!(tolerance.outsideError >= tolerance.maxError))
    return failure(ErrorCode::usage, "the tolerance outside the region must not be smaller than inside",
                   "outsideError");
  return {};
}

Result<Cut> leastCut(const TerrainModel& model, const FitTolerance& tolerance, const RunContext& context) {
  if (tolerance.region == nullptr) return takeCut(model.mt, UniformError(tolerance.maxError), {}, context);
  return takeCut(
      model.mt, RegionError(*tolerance.region, model.mt.metric(), tolerance.maxError, tolerance.outsideError),
      {}, context);
}

}  // namespace

Result<FittedCut> fitFewestTriangles(const TerrainModel& model, const FitTolerance& tolerance,
                                     const FitOptions& options, const RunContext& context) try {
  ARETE_CHECK(checkTolerance(tolerance));
  ARETE_TRY(const Cut cut, leastCut(model, tolerance, context));
  FitBounds bounds = boundsOf(model, tolerance, cut);
  ARETE_TRY(auto mesh, meshOf(model, cut, std::move(bounds), options, context));
  const double meanBefore = meanResidual(mesh);
  // With the tolerance 0 no height can change, and with an infinite one the cut is the root already.
  if (tolerance.maxError > 0 && std::isfinite(tolerance.maxError)) {
    mesh.setAccepted(1 + kRounding);
    ARETE_CHECK(removeWhatFits(mesh, std::max(1u, options.rings), context));
  }
  return fittedCut(mesh, cut, meanBefore, tolerance.maxError);
} catch (...) {
  return caughtFailure();
}

Result<FittedCut> fitLeastError(const TerrainModel& model, const Cut& cut, const FitOptions& options,
                                const RunContext& context) try {
  ARETE_TRY(auto mesh, meshOf(model, cut, {.everywhere = 1, .rounding = kRounding * cut.achievedError},
                              options, context));
  const double meanBefore = meanResidual(mesh);
  ARETE_CHECK(minimizeLargestError(mesh, std::max(1u, options.rings), context));
  return fittedCut(mesh, cut, meanBefore, 0);
} catch (...) {
  return caughtFailure();
}

Result<FittedCut> fitUnbiased(const TerrainModel& model, const Cut& cut, const FitTolerance& tolerance,
                              const FitOptions& options, const RunContext& context) try {
  ARETE_CHECK(checkTolerance(tolerance));
  FitTolerance finite = tolerance;
  if (!std::isfinite(tolerance.maxError)) finite.maxError = cut.achievedError;
  ARETE_TRY(auto mesh, meshOf(model, cut, boundsOf(model, finite, cut), options, context));
  const double meanBefore = meanResidual(mesh);
  if (mesh.bounds().everywhere > 0) ARETE_CHECK(removeMeanErrors(mesh, context));
  return fittedCut(mesh, cut, meanBefore, tolerance.maxError);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
