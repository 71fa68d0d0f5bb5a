// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tolerance says itself what may be asked for. A budget does not: the error that so many triangles come to
// is known when the cut has been taken. So a guess is read, the nodes down to an error that about four times
// the triangles would reach, and the cut is taken of that. A walk that refines the worst triangle first does
// the same in a part as in the whole while that triangle's error is beyond what was read; so where the cut
// comes to such an error it is that of the whole, and the part is enough. Else more is read.
//
// Nor does a camera say it to the last triangle: what is allowed to one rests on its corners and bounds. So
// what the camera is likely to want is read, and the cut taken of that. A walk meets the same triangles in a
// part as in the whole until it comes to one that is too coarse and that nobody in the part removes. Where
// there is none, the part is enough; under a budget also where all of these are better than the worst
// triangle that is left, as the walk had not come to them yet. Else more is read, at last everything.
#include "io/extract/part.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "io/exchange/mesh_formats.h"
#include "io/extract/criterion.h"
#include "io/extract/view_footprint.h"

namespace arete {
namespace {

/// Where a guess is too little, it is by far.
constexpr std::uint64_t kTimes = 8;

bool needsAllSamples(const ExtractRequest& request) {
  return !meshFormatOf(request.output) || !request.certificate.empty() || !request.errorRaster.empty();
}

/// Whether balls decide about the triangles: a packed file has none, and of a part smaller ones would be
/// made.
bool asksAboutBalls(const ExtractRequest& request) {
  const ExtractCriterion& c = request.criterion;
  return c.method == CutMethod::saturated && (c.camera || c.focus || request.region);
}

/// What is asked for at least, where the format may take something off the tolerance for what it rounds.
ExtractCriterion readFor(const ExtractRequest& request) {
  ExtractCriterion criterion = request.criterion;
  const Result<MeshFormat> format = meshFormatOf(request.output);
  if (format && !format->holds.isExact && criterion.promisesMaxError())
    criterion.maxError = (1 - TinExtractor::kReadReserve) * *criterion.maxError;
  return criterion;
}

/// Whether a number of triangles is all that is asked for, worst first.
bool isBudgetAlone(const ExtractRequest& request) {
  const ExtractCriterion& c = request.criterion;
  return c.maxTriangles && !c.maxError && !c.camera && !c.focus && !request.region &&
         !c.deadlineMilliseconds && c.method == CutMethod::minimal && c.order == ExtractOrder::worst &&
         c.fit == ExtractFit::none;
}

Result<TerrainModel> readForBudget(const AmtFile& file, const ExtractCriterion& criterion,
                                   const RunContext& context) {
  const std::uint64_t nodes = file.nodeCount();
  // A node adds two triangles, and the least cut at an error has nearly all nodes down to it: these are twice
  // as many.
  for (std::uint64_t guess = *criterion.maxTriangles; guess < nodes; guess *= kTimes) {
    const double error = file.errorBeyond(guess);
    if (!(error > 0)) break;
    Result<TerrainModel> part = file.read({.wanted = [error](const Box2&) { return error; }}, context);
    if (!part) return part;
    const auto uniform = engineCriterion(criterion, std::nullopt, 0, *part);
    const auto options = engineOptions(criterion, *part);
    if (!uniform || !options) break;
    const Result<Cut> cut = takeCut(part->mt, **uniform, *options, context);
    if (!cut || cut->achievedError > error) return part;  // who asks for too little will hear it
  }
  return file.read({}, context);
}

/// Whether the pixels of a camera are asked for, or a number of triangles in its picture, worst first.
bool isViewAlone(const ExtractRequest& request) {
  const ExtractCriterion& c = request.criterion;
  const bool isWorstFirst = c.method == CutMethod::minimal && c.order == ExtractOrder::worst;
  return c.camera && (!c.maxTriangles || isWorstFirst) && !c.deadlineMilliseconds;
}

/// Whether a cut of a part is that of the whole, but for the balls that it asks about.
bool isEnough(const MultiTriangulation& part, const Criterion& criterion, const Cut& cut) {
  double worst = 0, worstThatStays = 0;  // of the triangles that are too coarse: removed in the part, or not
  for (std::size_t i = 0; i < cut.ids.size(); ++i) {
    const TriangleId t(cut.ids[i]);
    const bool stays = !part.remover(t).isValid();
    if (part.error(t) == 0 || (cut.isComplete && !stays)) continue;
    Criterion::Corners corners = cut.triangles[i];
    for (std::uint32_t& corner : corners) corner = cut.vertices[corner];
    if (isSatisfied(part, criterion, t, corners)) continue;
    double& of = stays ? worstThatStays : worst;
    of = std::max(of, criterion.severity(part, t, corners));
  }
  return worstThatStays == 0 || worstThatStays < worst;
}

/// How many triangles the least cut of a part for some error adds to the root's; nothing where there is none.
double refinedTriangles(const TerrainModel& part, const Criterion& criterion, const RunContext& context) {
  const Result<Cut> cut = takeCut(part.mt, criterion, {}, context);
  return cut ? static_cast<double>(cut->ids.size()) - part.mt.rootTriangleCount() : 0;
}

Result<TerrainModel> readForView(const AmtFile& file, const ExtractCriterion& asked,
                                 const TerrainModel& outline, const RunContext& context) {
  // Of a budget alone nobody knows how many pixels it comes to. Half as many take about twice the triangles.
  constexpr double kFirstGuess = 16, kMore = 1.5, kMost = 1.0 / 16;
  constexpr int kGuesses = 4;
  ExtractCriterion guess = asked;
  guess.pixelError = asked.pixelError.value_or(kFirstGuess);
  for (int i = 0; i < kGuesses; ++i) {
    const auto view = engineCriterion(guess, std::nullopt, 0, outline);
    if (!view) return tl::unexpected(view.error());
    Result<TerrainModel> part =
        file.read({.wanted = requiredInView(static_cast<const ViewError&>(**view), outline)}, context);
    if (!part) return part;
    const auto criterion = engineCriterion(asked, std::nullopt, 0, *part);
    const auto options = engineOptions(asked, *part);
    if (!criterion || !options) break;
    const Result<Cut> cut = takeCut(part->mt, **criterion, *options, context);
    if (!cut || isEnough(part->mt, **criterion, *cut)) return part;  // who asks for too little will hear it
    if (asked.pixelError) break;
    const double wanted = kMore * (1.0 + *asked.maxTriangles - part->mt.rootTriangleCount());
    *guess.pixelError *= std::clamp(refinedTriangles(*part, **view, context) / wanted, kMost, 1 / kMore);
  }
  return file.read({}, context);
}

}  // namespace

Result<TerrainModel> readForExtract(const AmtFile& file, std::span<const ExtractRequest> requests,
                                    const TerrainModel& outline, const RunContext& context) {
  std::vector<ExtractCriterion> criteria;
  std::optional<Region> region;
  for (const ExtractRequest& request : requests) {
    if (needsAllSamples(request) || (file.isPacked() && asksAboutBalls(request)))
      return file.read({}, context);
    criteria.push_back(readFor(request));
    region = request.region;
  }
  if (requests.size() == 1 && isBudgetAlone(requests[0]))
    return readForBudget(file, requests[0].criterion, context);
  if (requests.size() == 1 && isViewAlone(requests[0]))
    return readForView(file, requests[0].criterion, outline, context);
  const Result<RequiredError> wanted = requiredBy(criteria, region, outline);
  if (!wanted) return tl::unexpected(wanted.error());
  return file.read({.wanted = *wanted}, context);
}

}  // namespace arete
