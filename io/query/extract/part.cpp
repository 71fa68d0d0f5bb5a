// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tolerance determines the nodes to read. A budget does not: the error that a number of triangles comes to
// is known only when the cut has been taken. So a guess is read, the nodes down to an error that about four
// times the triangles would reach, and the cut is taken of that part. A walk that refines the worst triangle
// first makes the same steps in a part as in the whole while that triangle's error exceeds the error that was
// read down to. If the cut ends at such an error it is the cut of the whole. Otherwise more is read.
//
// A camera does not determine the nodes either: the error that it allows a triangle depends on the triangle's
// corners and bounds. So the nodes that the camera is likely to need are read, and the cut is taken of that
// part. The part is enough if the cut misses nothing (Cut::missing). Otherwise more is read, finally
// everything.
//
// The cut that proves a part to be enough is the answer: it is returned with the part. Only the cuts of parts
// that were not enough are discarded.
#include "io/query/extract/part.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "engine/memory/required_memory.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/query/extract/view_footprint.h"
#include "io/query/request/criterion.h"

namespace arete {
namespace {

/// How many times more triangles the next guess provides for.
constexpr std::uint64_t kGuessGrowth = 8;

/// A request without an output is a cut alone.
bool needsAllSamples(const ExtractRequest& request) {
  return (!request.output.empty() && !meshFormatOf(request.output, request.format)) ||
         !request.certificate.empty() || !request.errorRaster.empty() ||
         request.normals.kind == NormalsKind::smooth;
}

/// Whether the spheres of nodes decide which nodes are in the cut. A packed file stores none, and those made
/// of a part are smaller.
bool dependsOnSpheres(const ExtractRequest& request) {
  const CutRequest& c = request.criterion;
  return c.method == CutMethod::saturated && (c.camera || c.focus || request.region);
}

/// The criterion with the smallest tolerance that rounding by the format may lead to.
CutRequest readFor(const ExtractRequest& request) {
  CutRequest criterion = request.criterion;
  const Result<MeshFormat> format = meshFormatOf(request.output, request.format);
  if (format && !format->holds.isExact && criterion.promisesMaxError(true))
    criterion.maxError = (1 - TinExtractor::kReadReserve) * *criterion.maxError;
  return criterion;
}

/// Terrain is refined worst first unless another order is stated.
bool isWorstFirst(const CutRequest& request) {
  return request.order == CutOrder::usual || request.order == CutOrder::worst;
}

/// Whether the request is a budget of triangles and nothing else, worst first.
bool isBudgetAlone(const ExtractRequest& request) {
  const CutRequest& c = request.criterion;
  return c.maxTriangles && !c.maxError && !c.camera && !c.focus && !request.region &&
         !c.deadlineMilliseconds && c.method == CutMethod::minimal && isWorstFirst(c) &&
         c.fit == CutFit::none;
}

Result<PartAndCut> readAll(const AmtFile& file, const RunContext& context) {
  ARETE_TRY(TerrainModel all, file.read({}, context));
  return PartAndCut{std::move(all), std::nullopt};
}

Result<Cut> takeCutOf(const TerrainModel& part, const CutRequest& requested, const RunContext& context) {
  ARETE_TRY(const auto criterion, engineCriterion(requested, std::nullopt, 0, part));
  ARETE_TRY(const auto options, engineOptions(requested, part));
  return takeCut(part.mt, *criterion, options, context);
}

Result<PartAndCut> readForBudget(const AmtFile& file, const CutRequest& requested,
                                 const RunContext& context) {
  const std::uint64_t nodes = file.nodeCount();
  // A node adds two triangles, and the least cut at an error has nearly all nodes down to it: these are twice
  // as many.
  for (std::uint64_t guess = *requested.maxTriangles; guess < nodes; guess *= kGuessGrowth) {
    const double error = file.errorBeyond(guess);
    if (!(error > 0)) break;
    ARETE_TRY(TerrainModel part, file.read({.wanted = [error](const Box3&) { return error; }}, context));
    ARETE_TRY(Cut cut, takeCutOf(part, requested, context));
    if (cut.missing.empty()) return PartAndCut{std::move(part), std::move(cut)};
  }
  return readAll(file, context);
}

/// Whether the criterion is an error in pixels of a camera, or a budget of triangles in its picture, worst
/// first.
bool isViewAlone(const ExtractRequest& request) {
  const CutRequest& c = request.criterion;
  const bool isMinimalWorstFirst = c.method == CutMethod::minimal && isWorstFirst(c);
  return c.camera && (!c.maxTriangles || isMinimalWorstFirst) && !c.deadlineMilliseconds;
}

/// The triangles that the least cut of a part adds to the root's; 0 where there is no such cut.
double refinedTriangles(const TerrainModel& part, const Criterion& criterion, const RunContext& context) {
  const Result<Cut> cut = takeCut(part.mt, criterion, {}, context);
  return cut ? static_cast<double>(cut->ids.size()) - part.mt.rootTriangleCount() : 0;
}

Result<PartAndCut> readForView(const AmtFile& file, const CutRequest& requested, const TerrainModel& outline,
                               const RunContext& context) {
  // The pixels that a budget comes to are not known. Half as many pixels take about twice the triangles.
  constexpr double kFirstGuess = 16, kMore = 1.5, kMost = 1.0 / 16;
  constexpr int kGuesses = 4;
  CutRequest guess = requested;
  guess.pixelError = requested.pixelError.value_or(kFirstGuess);
  for (int i = 0; i < kGuesses; ++i) {
    ARETE_TRY(const auto view, engineCriterion(guess, std::nullopt, 0, outline));
    ARETE_TRY(TerrainModel part,
              file.read({.wanted = requiredInView(static_cast<const ViewError&>(*view), outline)}, context));
    ARETE_TRY(Cut cut, takeCutOf(part, requested, context));
    if (cut.missing.empty()) return PartAndCut{std::move(part), std::move(cut)};
    if (requested.pixelError) break;
    const double aim = kMore * (1.0 + *requested.maxTriangles - part.mt.rootTriangleCount());
    *guess.pixelError *= std::clamp(refinedTriangles(part, *view, context) / aim, kMost, 1 / kMore);
  }
  return readAll(file, context);
}

}  // namespace

namespace {

Result<PartAndCut> readPart(const AmtFile& file, std::span<const ExtractRequest> requests,
                            const TerrainModel& outline, const RunContext& context) {
  std::vector<CutRequest> criteria;
  std::optional<Region> region;
  for (const ExtractRequest& request : requests) {
    if (needsAllSamples(request) || (file.isPacked() && dependsOnSpheres(request)))
      return readAll(file, context);
    criteria.push_back(readFor(request));
    region = request.region;
  }
  if (requests.size() == 1 && isBudgetAlone(requests[0]))
    return readForBudget(file, requests[0].criterion, context);
  if (requests.size() == 1 && isViewAlone(requests[0]))
    return readForView(file, requests[0].criterion, outline, context);
  ARETE_TRY(const RequiredError required, requiredBy(criteria, region, outline));
  ARETE_TRY(TerrainModel part, file.read({.wanted = required}, context));
  return PartAndCut{std::move(part), std::nullopt};
}

}  // namespace

Result<PartAndCut> readForExtract(const AmtFile& file, std::span<const ExtractRequest> requests,
                                  const TerrainModel& outline, const RunContext& context) try {
  ARETE_TRY(PartAndCut read, readPart(file, requests, outline, context));
  // What a cut of all nodes that were read takes for each of them, and the mesh that is written of it.
  constexpr std::uint64_t kBytesOfCut = 90;
  requireMemory(kBytesOfCut * read.model.mt.nodeCount(), "ask for a smaller part or a larger tolerance");
  return read;
} catch (...) {
  return caughtFailure(file.path());
}

}  // namespace arete
