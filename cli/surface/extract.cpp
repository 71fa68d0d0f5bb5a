// SPDX-License-Identifier: GPL-3.0-or-later
//
// One request for each tolerance and each budget; SurfaceExtractor takes, writes and measures them. A broken
// promise is reported after all files are written.
#include "cli/surface/extract.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/level_files.h"
#include "cli/mesh/tolerance.h"
#include "cli/surface/criterion.h"
#include "cli/surface/extract_text.h"
#include "cli/surface/why_not_fewer.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/query/extract/extract.h"
#include "io/query/surface/surface_part.h"
#include "io/store/amt/surface_file.h"

namespace arete {
namespace {

struct Requests {
  std::vector<ExtractRequest> all;
  std::vector<bool> stateShares;  ///< by request: its budget is one of the finest triangles
};

/// The part of a file's name that stands for what is asked.
/// @param error, budget as they were stated; empty: they were not.
std::string tagOf(const CriterionArguments::OfSurface& asked, const std::string& error,
                  const std::string& budget) {
  if (!error.empty() && !budget.empty()) return fmt::format("{}_{}", error, budget);
  if (!error.empty() || !budget.empty()) return error + budget;
  if (asked.camera.empty() && asked.common.deadlineMilliseconds)
    return fmt::format("{}ms", *asked.common.deadlineMilliseconds);
  return fmt::format("{}px", asked.common.pixelError.value_or(1));
}

Result<Requests> requestsOf(const SurfaceExtractArguments& arguments, const SurfaceModel& model,
                            const RunContext& context) {
  const CriterionArguments::OfSurface& asked = arguments.asked;
  std::vector<std::optional<SurfaceTolerance>> tolerances(1);
  if (!asked.maxErrors.empty()) {
    ARETE_TRY(const auto stated,
              parseSurfaceTolerances("--max-error", asked.maxErrors, model.diagonal, spaceUnitOf(model)));
    tolerances.assign(stated.begin(), stated.end());
  }
  std::vector<std::optional<StatedTriangles>> budgets(1);
  if (!asked.maxTriangles.empty()) {
    ARETE_TRY(const auto stated, parseTriangleBudgets(asked.maxTriangles, model.finestTriangles()));
    budgets.assign(stated.begin(), stated.end());
  }
  const bool several = tolerances.size() * budgets.size() > 1;
  ARETE_CHECK(arguments.outputs.check(several));
  ARETE_TRY(CutRequest common, readSurfaceRequest(asked, model, context));
  common.isDisplaced = !arguments.staysUndisplaced;
  common.importance = arguments.importance;
  if (!arguments.attributeErrors.empty()) {
    auto stated = parseAttributeNumbers(arguments.attributeErrors);
    if (!stated) {
      stated.error().culprit = "--attribute-error " + stated.error().culprit;
      return tl::unexpected(stated.error());
    }
    common.attributeErrors = std::move(*stated);
  }
  if (!arguments.dropParts.empty()) {
    ARETE_TRY(const auto least, parseSurfaceTolerances("--drop-parts", arguments.dropParts, model.diagonal,
                                                       spaceUnitOf(model)));
    if (least.size() != 1) return failure(ErrorCode::usage, "takes one length", "--drop-parts");
    common.dropParts = least.front().distance;
  }
  Requests requests;
  for (const auto& tolerance : tolerances)
    for (const auto& budget : budgets) {
      CutRequest criterion = common;
      if (tolerance) criterion.maxError = tolerance->distance;
      if (budget) criterion.maxTriangles = budget->count;
      requests.stateShares.push_back(budget && budget->text.ends_with('%'));
      ARETE_CHECK(checkSurfaceRequest(criterion, asked, model));
      const std::string tag = tagOf(asked, tolerance ? tolerance->text : "", budget ? budget->text : "");
      requests.all.push_back(arguments.outputs.requestOf(criterion, tag, several));
      requests.all.back().dropAttributes = arguments.dropAttributes;
      requests.all.back().normals = arguments.normals;
      requests.all.back().measuresBothWays = arguments.measuresBothWays;
    }
  return requests;
}

Status checkFormats(const std::vector<ExtractRequest>& requests) {
  for (const ExtractRequest& request : requests) {
    const Result<MeshFormat> format = meshFormatOf(request.output, request.format);
    if (!format || !format->write)
      return failure(ErrorCode::usage,
                     format ? fmt::format("{} cannot be written", format->name) : format.error().message,
                     fmt::format("--output {}", request.output));
  }
  return {};
}

/// An error of the library, as the command line says it.
Error named(Error error, const SurfaceExtractArguments& arguments, const ExtractRequest& request,
            const SurfaceModel& model, const RunContext& context) {
  if (error.culprit == "dropParts") error.culprit = fmt::format("--drop-parts {}", arguments.dropParts);
  if (error.culprit == "maxTriangles" && request.criterion.maxTriangles) {
    const auto dropped = componentsToDrop(model, request.criterion);
    const DroppedComponents* const without = dropped && *dropped ? &**dropped : nullptr;
    const std::uint32_t least = model.mt.rootTriangleCount() - (without ? without->rootTriangles : 0);
    error.message =
        fmt::format("the coarsest surface has {}: it has {}", grouped(least, "triangle", "triangles"),
                    whyNotFewer(model, without, context));
    error.culprit = fmt::format("--max-triangles {}", *request.criterion.maxTriangles);
  }
  constexpr std::string_view kBounded = "attributeErrors ";
  if (error.culprit.starts_with(kBounded))
    error.culprit = "--attribute-error " + error.culprit.substr(kBounded.size());
  constexpr std::string_view kImportant = "importance ";
  if (error.culprit.starts_with(kImportant))
    error.culprit = "--importance " + error.culprit.substr(kImportant.size());
  constexpr std::string_view kDropped = "dropAttributes ";
  if (error.culprit.starts_with(kDropped))
    error.culprit = "--drop-attributes " + error.culprit.substr(kDropped.size());
  return error;
}

}  // namespace

Status extractSurface(const SurfaceExtractArguments& arguments, const AmtContainer& file, Session& session) {
  ARETE_TRY(SurfaceModel outline, readOutline(file, session.context()));
  ARETE_TRY(const Requests requests, requestsOf(arguments, outline, session.context()));
  ARETE_CHECK(checkFormats(requests.all));
  std::vector<std::string> inputs = {arguments.model};
  std::error_code ignored;
  if (std::filesystem::exists(arguments.asked.region, ignored)) inputs.push_back(arguments.asked.region);
  const bool areLevels = arguments.outputs.areLevels;
  ARETE_CHECK(checkOutputsOf(areLevels ? std::vector{requests.all.front()} : requests.all, inputs));
  std::optional<LevelFiles> levels;
  if (areLevels) {
    ARETE_TRY(levels, LevelFiles::create());
  }
  ARETE_TRY(const SurfaceModel model,
            readForExtract(file, requests.all, std::move(outline), session.context()));
  SurfaceExtractor extractor(
      model, arguments.model,
      [&](const ExtractRequest& request, double promised, std::uint64_t samples) {
        return surfaceCheckCommand(request, arguments.model, promised, samples);
      },
      [&] { return loadSurfaceAmt(file, {}, session.context()); });
  Json exports = Json::array();
  Status promise;
  for (std::size_t i = 0; i < requests.all.size(); ++i) {
    const ExtractRequest& request = requests.all[i];
    const Result<ExtractedSurface> found =
        extractor.extract(levels ? levels->redirected(request) : request, session.context());
    if (!found) return tl::unexpected(named(found.error(), arguments, request, model, session.context()));
    if (levels) levels->describe(found->error, found->triangles);
    Warnings warnings;
    for (const std::string& lost : found->written.lost)
      if (!isFineRounding(lost, model.diagonal, found->promisedError))
        warnings.push_back({WarningCode::omitted, fmt::format("cannot hold {}", lost)});
    session.warn(warnings, request.output);
    if (found->leftByRounding > 0) session.warn(leftByRoundingText(request, *found, model));
    session.say(extractText(request, *found, model, requests.stateShares[i]));
    exports.push_back(toJson(request, ExtractReport(*found)));
    if (!found->isKept && promise)
      promise = failure(ErrorCode::brokenPromise,
                        fmt::format("the measurement of the exported mesh contradicts the promised error {}",
                                    found->promisedError),
                        request.output);
  }
  if (levels) ARETE_CHECK(levels->join(requests.all.front(), session));
  session.answer({{"model", arguments.model},
                  {"kind", "surface"},
                  {"diagonal", model.diagonal},
                  {"finestTriangles", model.finestTriangles()},
                  {"exports", std::move(exports)}});
  return promise;
}

}  // namespace arete
