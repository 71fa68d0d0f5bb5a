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
// there is none, the part is enough. Else everything is read.
#include "io/extract_part.h"

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/cut.h"
#include "engine/view_error.h"
#include "io/extract_criterion.h"
#include "io/mesh_file.h"
#include "io/wanted_view.h"

namespace arete {
namespace {

/// Where a guess is too little, it is by far.
constexpr std::uint64_t kTimes = 8;

bool needsAllSamples(const ExtractRequest& request) {
  return !meshFormatOf(request.output) || !request.certificate.empty() || !request.errorRaster.empty();
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

/// Whether the pixels of a camera are all that is asked for.
bool isViewAlone(const ExtractRequest& request) {
  const ExtractCriterion& c = request.criterion;
  return c.camera && c.pixelError && !c.maxTriangles && !c.deadlineMilliseconds && c.fit == ExtractFit::none;
}

/// Whether a triangle of a cut is too coarse, though nobody removes it.
bool lacksNodes(const MultiTriangulation& part, const Criterion& criterion, const Cut& cut) {
  for (std::size_t i = 0; i < cut.ids.size(); ++i) {
    const TriangleId t(cut.ids[i]);
    if (part.remover(t).isValid() || part.error(t) == 0) continue;
    Criterion::Corners corners = cut.triangles[i];
    for (std::uint32_t& corner : corners) corner = cut.vertices[corner];
    if (!criterion.isFineEnough(part, t, corners)) return true;
  }
  return false;
}

Result<TerrainModel> readForView(const AmtFile& file, const ExtractCriterion& criterion,
                                 const TerrainModel& outline, const RunContext& context) {
  const auto asked = engineCriterion(criterion, std::nullopt, 0, outline);
  if (!asked) return tl::unexpected(asked.error());
  const auto& view = static_cast<const ViewError&>(**asked);
  Result<TerrainModel> part = file.read({.wanted = wantedInView(view, outline)}, context);
  if (!part) return part;
  const Result<Cut> cut = takeCut(part->mt, view, {.method = criterion.method}, context);
  if (!cut) return tl::unexpected(cut.error());
  if (!lacksNodes(part->mt, view, *cut)) return part;
  return file.read({}, context);
}

}  // namespace

Result<TerrainModel> readForExtract(const AmtFile& file, std::span<const ExtractRequest> requests,
                                    const TerrainModel& outline, const RunContext& context) {
  std::vector<ExtractCriterion> criteria;
  std::optional<Region> region;
  for (const ExtractRequest& request : requests) {
    if (needsAllSamples(request)) return file.read({}, context);
    criteria.push_back(readFor(request));
    region = request.region;
  }
  if (requests.size() == 1 && isBudgetAlone(requests[0]))
    return readForBudget(file, requests[0].criterion, context);
  if (requests.size() == 1 && isViewAlone(requests[0]))
    return readForView(file, requests[0].criterion, outline, context);
  const Result<WantedError> wanted = wantedBy(criteria, region, outline);
  if (!wanted) return tl::unexpected(wanted.error());
  return file.read({.wanted = *wanted}, context);
}

}  // namespace arete
