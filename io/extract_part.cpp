// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tolerance says itself what may be asked for. A budget does not: the error that so many triangles come to
// is known when the cut has been taken. So a guess is read, the nodes down to an error that about four times
// the triangles would reach, and the cut is taken of that. A walk that refines the worst triangle first does
// the same in a part as in the whole while that triangle's error is beyond what was read; so where the cut
// comes to such an error it is that of the whole, and the part is enough. Else more is read.
#include "io/extract_part.h"

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/cut.h"
#include "io/extract_criterion.h"
#include "io/mesh_file.h"

namespace arete {
namespace {

/// Where a guess is too little, it is by far.
constexpr std::uint64_t kTimes = 8;

bool needsAllSamples(const ExtractRequest& request) {
  const Result<MeshFormat> format = meshFormatOf(request.output);
  return !format || !format->holds.isExact || !request.certificate.empty() || !request.errorRaster.empty();
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

}  // namespace

Result<TerrainModel> readForExtract(const AmtFile& file, std::span<const ExtractRequest> requests,
                                    const TerrainModel& outline, const RunContext& context) {
  std::vector<ExtractCriterion> criteria;
  std::optional<Region> region;
  for (const ExtractRequest& request : requests) {
    if (needsAllSamples(request)) return file.read({}, context);
    criteria.push_back(request.criterion);
    region = request.region;
  }
  if (requests.size() == 1 && isBudgetAlone(requests[0]))
    return readForBudget(file, requests[0].criterion, context);
  const Result<WantedError> wanted = wantedBy(criteria, region, outline);
  if (!wanted) return tl::unexpected(wanted.error());
  return file.read({.wanted = *wanted}, context);
}

}  // namespace arete
