// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "io/query/request/cut_request.h"
#include "io/query/surface/fit_front.h"
#include "surface/attributes/attribute_names.h"
#include "surface/front/front.h"
#include "surface/front/model_components.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The mesh that a surface is cut to, and what is certain of it.
struct TakenSurface {
  Cut whole;  ///< with the components that are left out
  Cut cut;    ///< without them
  /// By triangle of the whole cut: its number here, or MeshAttributes::kNone. Empty where nothing is left
  /// out.
  std::vector<std::uint32_t> numberOf;
  SurfaceFront front;  ///< of the cut, fitted or displaced
  std::optional<FitOutcome> fit = {};
  bool isDisplaced = false;
  /// Of a displaced cut: of attributes where its vertices were, and of those fitted to where they are.
  std::vector<AttributeRms> displacedAttributes = {};
  /// For every point of the source there is one of the cut within `error` whose attributes are at most this
  /// far off (statedAttributeErrors()). Empty where they are not bounded, or no longer hold.
  std::vector<AttributeNumber> attributeErrors = {};
  /// Where the request has an importance.
  struct OfImportance {
    double least = 0, largest = 0;  ///< in the source
    /// The largest product of a triangle's error and its importance: no point of the source is farther than
    /// this by its importance.
    double weighted = 0;
  };
  std::optional<OfImportance> importance = {};
  double error = 0;                   ///< no point of the source (but what is left out) is farther than this
  std::optional<double> pixels = {};  ///< with a camera: the worst error in its picture
  /// The largest error that rounding (SurfaceModel::positionError) leaves above what is asked for; 0: none.
  double leftByRounding = 0;
};

/// The components that a request leaves out. Nothing: it leaves out none by its wording. Errors: usage: it
/// leaves out all, culprit "dropParts". O(triangles of the source)
Result<std::optional<DroppedComponents>> componentsToDrop(const SurfaceModel& model,
                                                          const CutRequest& request);

/// Takes the cut of a request, leaves components out, and fits or displaces its vertices. Nothing is written.
/// @param dropped  componentsToDrop(); null: nothing is left out
/// Errors: as engineCriterion(), engineOptions(), takeCut() and fitFront(); usage, culprit
/// "maxTriangles": the budget is below the coarsest surface's. O(front), and O(source) for a fit.
Result<TakenSurface> takeSurface(const SurfaceModel& model, const CutRequest& request,
                                 const DroppedComponents* dropped = nullptr, const RunContext& context = {});

/// The finest front of what is not dropped.
SurfaceFront finestWithout(const SurfaceModel& model, const DroppedComponents* dropped);

/// Pairs of triangles of a mesh that cross. Errors: as diagnose().
Result<std::uint64_t> crossingsOf(const TriangleMesh& mesh, const RunContext& context);

}  // namespace arete
