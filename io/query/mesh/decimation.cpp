// SPDX-License-Identifier: GPL-3.0-or-later
//
// `measured` builds the multitriangulation in memory, takes the cut that is wanted and fits it; the other
// operators are those of surface/decimate/decimate.h.
#include "io/query/mesh/decimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "io/files/text/grouped.h"
#include "io/query/mesh/seams.h"
#include "io/query/request/cut_request.h"
#include "io/query/surface/changes_of_cut.h"
#include "io/query/surface/take_surface.h"
#include "surface/attributes/attribute_names.h"
#include "surface/attributes/picture_length.h"
#include "surface/builder/build.h"
#include "surface/decimate/decimate.h"
#include "surface/edit/small_components.h"
#include "surface/front/face_map.h"
#include "surface/front/front.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

using Operator = std::pair<std::string_view, DecimateOperator>;
constexpr std::array<Operator, 6> kOperators = {{{"qem", DecimateOperator::edge},
                                                 {"lindstrom-turk", DecimateOperator::lindstromTurk},
                                                 {"half-edge", DecimateOperator::halfEdge},
                                                 {"vertex-pair", DecimateOperator::vertexPair},
                                                 {"face", DecimateOperator::face},
                                                 {"cluster", DecimateOperator::cluster}}};

/// @param mesh   whose attributes and parts keep more
/// @param shapes what the shape alone comes to; empty: not known
Error tooFew(std::uint32_t budget, std::uint64_t least, const std::string& method, const SurfaceMesh& mesh,
             std::optional<std::uint64_t> shapes) {
  const std::string seams = seamsText(mesh);
  const bool areDear = !seams.empty() && shapes && *shapes < least;
  return {ErrorCode::usage,
          fmt::format(
              "the least that {} reaches is {}: components, handles, borders, seams and edges between "
              "objects, materials or labels of faces stay, edges of more than two faces too, and no triangle "
              "turns over{}{}",
              method, grouped(least, "triangle", "triangles"),
              areDear ? fmt::format("; lines between attributes and parts cost {} of them",
                                    grouped(least - *shapes, "triangle", "triangles"))
                      : "",
              seams),
          fmt::format("maxTriangles {}", budget)};
}

/// All attributes of vertices and wedges that a list names, or without a list those that count.
Result<std::vector<AttributeWeight>> weightsOf(const SurfaceMesh& mesh, const DecimationRequest& request) {
  const std::string& list = request.attributeWeights;
  std::vector<AttributeWeight> weights;
  if (list.empty()) {
    const double diagonal = diagonalOf(mesh),
                 usual = request.method == "measured" ? kMeasuredTexcoordWeight : kUsualTexcoordWeight;
    for (const bool ofWedges : {false, true})
      for (const Attribute& attribute : ofWedges ? mesh.wedgeAttributes : mesh.vertexAttributes) {
        if (attribute.meaning == AttributeMeaning::color)
          weights.push_back({attribute.name, kUsualColorWeight});
        if (attribute.meaning != AttributeMeaning::textureCoords) continue;
        const double length = lengthOfPictureUnit(mesh, attribute, ofWedges);
        const double share = length > 0 && diagonal > 0 ? length / (kUsualLength * diagonal) : 1;
        weights.push_back({attribute.name, usual * std::min(1.0, share)});
      }
    return weights;
  }
  ARETE_TRY(const std::vector<AttributeNumber> numbers, parseAttributeNumbers(list));
  for (const AttributeNumber& asked : numbers) {
    const std::string culprit = fmt::format("attributeWeight {}:{}{}", asked.name, asked.number, asked.unit);
    if (!asked.unit.empty())
      return failure(ErrorCode::usage, "a weight has no unit: it is how many diagonals a change of 1 counts",
                     culprit);
    Result<std::vector<NamedAttribute>> found = findAttributes(mesh, asked.name);
    if (!found)
      return failure(ErrorCode::usage, found.error().message,
                     fmt::format("attributeWeight {}", found.error().culprit));
    for (const NamedAttribute& one : *found) {
      const bool isOfCorners = one.of == NamedAttribute::Of::wedges;
      if (!isOfCorners && one.of != NamedAttribute::Of::vertices)
        return failure(
            ErrorCode::usage,
            "belongs neither to vertices nor to corners: edges between faces that differ stay anyway",
            culprit);
      const Attribute& attribute =
          isOfCorners ? mesh.wedgeAttributes[one.index] : mesh.vertexAttributes[one.index];
      if (isLabel(attribute))
        return failure(ErrorCode::usage, "has labels, which are not averaged and have no distance", culprit);
      weights.push_back({attribute.name, asked.number});
    }
  }
  return weights;
}

Result<DecimatedOutcome> measured(SurfaceMesh mesh, const DecimationRequest& asked,
                                  const RunContext& context) {
  const std::optional<std::uint32_t> maxTriangles = asked.maxTriangles;
  SurfaceBuildOptions options;
  options.keepsBorders = asked.keepsBorders;
  // Nothing but a stated weight makes a tolerance's result larger.
  std::vector<AttributeWeight> weights;
  if (maxTriangles || !asked.attributeWeights.empty()) {
    ARETE_TRY(weights, weightsOf(mesh, asked));
  }
  // A cut of so many triangles has what is coarser than a quarter of them whole.
  ARETE_TRY(const SurfaceModel model,
            buildSurface(std::move(mesh), options, context, maxTriangles.value_or(0) / 4, weights));
  CutRequest request;
  request.fit = CutFit::rms;
  request.maxTriangles = maxTriangles;
  if (maxTriangles && *maxTriangles < model.mt.rootTriangleCount()) {
    const SurfaceMesh finest = finestSurfaceOf(model).mesh;
    std::optional<std::uint64_t> ofShape;
    if (const auto bare = buildSurface(SurfaceMesh(finest.shape()), options, context))
      ofShape = bare->mt.rootTriangleCount();
    return tl::unexpected(tooFew(*maxTriangles, model.mt.rootTriangleCount(), "measured", finest, ofShape));
  }
  if (asked.maxError) request.maxError = asked.maxError->of(model.diagonal);
  ARETE_TRY(TakenSurface taken, takeSurface(model, request, nullptr, context));
  DecimatedOutcome outcome;
  if (asked.wantsFaces) outcome.triangleFor = facesOf(model, taken.whole);
  outcome.attributeChanges = changesOfCut(model, taken);
  outcome.mesh = std::move(taken.front.mesh);
  outcome.vertexOf = std::move(taken.front.vertexOf);
  outcome.fit = taken.fit;
  ARETE_TRY(const std::uint64_t crossings, crossingsOf(outcome.mesh, context));
  outcome.crossings = crossings;
  if (crossings > 0) {
    ARETE_TRY(const std::uint64_t ofSource, crossingsOf(finestSurfaceOf(model).mesh, context));
    outcome.sourceCrossings = ofSource;
  }
  outcome.isComplete = taken.whole.isComplete;
  if (2 * model.mt.rootTriangleCount() > model.mt.finestTriangleCount())
    outcome.seams = seamsText(finestSurfaceOf(model).mesh);
  outcome.maxError = request.maxError;
  outcome.dropsFlatNormals = model.mending.dropsFlatNormals;
  return outcome;
}

Result<DecimatedOutcome> contracted(const SurfaceMesh& mesh, const DecimationRequest& asked,
                                    const RunContext& context) {
  const std::uint32_t maxTriangles = *asked.maxTriangles;
  DecimateOptions options;
  for (const auto& [name, method] : kOperators)
    if (asked.method == name) options.method = method;
  options.queue = asked.queue == "greedy"     ? DecimateQueue::greedy
                  : asked.queue == "estimate" ? DecimateQueue::estimate
                                              : DecimateQueue::lazy;
  options.maxTriangles = maxTriangles;
  options.weighsByArea = asked.quadricWeight == "area";
  options.keepsClusterVertices = asked.clusterVertices == "original";
  options.keepsBorders = asked.keepsBorders;
  options.forbidsCrossings = asked.forbidsCrossings;
  ARETE_TRY(options.attributeWeights, weightsOf(mesh, asked));
  ARETE_TRY(DecimatedMesh decimated, decimate(mesh, options, context));
  if (decimated.mesh.triangles.size() > maxTriangles) {
    // As few as the shape alone comes to.
    DecimateOptions ofShape = options;
    ofShape.attributeWeights.clear();
    ofShape.maxTriangles = 1;
    const Result<DecimatedMesh> bare = decimate(SurfaceMesh(mesh.shape()), ofShape, context);
    return tl::unexpected(
        tooFew(maxTriangles, decimated.mesh.triangles.size(), asked.method, decimated.mesh,
               bare ? std::optional<std::uint64_t>(bare->mesh.triangles.size()) : std::nullopt));
  }
  DecimatedOutcome outcome;
  outcome.mesh = std::move(decimated.mesh);
  outcome.vertexOf = std::move(decimated.vertexOf);
  outcome.triangleFor = std::move(decimated.triangleFor);
  outcome.lost = std::move(decimated.lost);
  outcome.evaluations = decimated.evaluations;
  outcome.steps = decimated.steps;
  outcome.dropsFlatNormals = decimated.dropsFlatNormals;
  outcome.attributeChanges = attributeChanges(mesh, outcome.mesh, outcome.triangleFor);
  return outcome;
}

}  // namespace

Status checkDecimation(const DecimationRequest& a) {
  const auto refuse = [&](const char* option, const std::string& method) {
    return failure(ErrorCode::usage, fmt::format("is for `operator` {}, not {}", method, a.method), option);
  };
  if (a.method != "measured" && std::ranges::find(kOperators, a.method, &Operator::first) == kOperators.end())
    return failure(ErrorCode::usage, fmt::format("{} is unknown", a.method), "operator");
  const auto isOneOf = [](const std::string& word, std::initializer_list<const char*> words) {
    return std::ranges::find(words, word) != words.end();
  };
  if (!isOneOf(a.queue, {"lazy", "greedy", "estimate"}))
    return failure(ErrorCode::usage, fmt::format("{} is not one of lazy, greedy, estimate", a.queue),
                   "queue");
  if (!isOneOf(a.quadricWeight, {"area", "none"}))
    return failure(ErrorCode::usage, fmt::format("{} is neither area nor none", a.quadricWeight),
                   "quadricWeight");
  if (!isOneOf(a.clusterVertices, {"quadric", "original"}))
    return failure(ErrorCode::usage, fmt::format("{} is neither quadric nor original", a.clusterVertices),
                   "clusterVertices");
  if (!a.maxTriangles && !a.maxError)
    return failure(ErrorCode::usage, "one of `maxTriangles` and `maxError` is required");
  if (a.maxError && a.method != "measured") return refuse("maxError", "measured, which measures");
  const bool hasQueue =
      a.method == "qem" || a.method == "half-edge" || a.method == "vertex-pair" || a.method == "face";
  if (a.queue != "lazy" && !hasQueue) return refuse("queue", "qem, half-edge, vertex-pair or face");
  if (a.quadricWeight != "area" && !hasQueue && a.method != "cluster")
    return refuse("quadricWeight", "qem, half-edge, vertex-pair, face or cluster");
  if (a.forbidsCrossings && (!hasQueue || a.method == "vertex-pair"))
    return refuse("noCrossings", "qem, half-edge or face");
  if (!a.attributeWeights.empty() && a.method == "lindstrom-turk")
    return refuse("attributeWeight", "measured, qem, half-edge, vertex-pair, face or cluster");
  if (!a.attributeWeights.empty())
    if (const auto numbers = parseAttributeNumbers(a.attributeWeights); !numbers)
      return failure(numbers.error().code, numbers.error().message,
                     fmt::format("attributeWeight {}", numbers.error().culprit));
  if (a.clusterVertices != "quadric" && a.method != "cluster") return refuse("clusterVertices", "cluster");
  if (a.keepsBorders && a.method == "cluster")
    return failure(ErrorCode::usage, "cannot be combined with `operator` cluster", "keepBorders");
  return {};
}

Result<DecimatedOutcome> decimateMesh(SurfaceMesh mesh, const DecimationRequest& request,
                                      const RunContext& context) {
  ARETE_CHECK(checkDecimation(request));
  return request.method == "measured" ? measured(std::move(mesh), request, context)
                                      : contracted(mesh, request, context);
}

}  // namespace arete
