// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs validateModel() and lists the laws it has checked (docs/topics lists them too). A raster in pages for
// which the memory budget is too small is checked part by part.
#include "cli/commands/validate.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "cli/arguments/arguments.h"
#include "cli/arguments/option_kinds.h"
#include "cli/surface/validate.h"
#include "engine/base/counted.h"
#include "engine/laws/law.h"
#include "io/files/text/address_text.h"
#include "io/query/extract/model_file.h"
#include "io/query/parts/validate_parts.h"
#include "io/store/amt/file.h"
#include "terrain/laws/compare_source.h"
#include "terrain/laws/validate_model.h"

namespace arete {
namespace {

struct ValidateArguments {
  std::string model;
  DemArguments source;
  ValidateModelOptions options;
  OptionKinds kinds;
};

/// Whether the model claims the law: law 9 holds for the Delaunay shape with exact rims only.
bool isClaimed(const Law& law, const TerrainModel& model) {
  return law.number != 9 || (model.options.shape == HoleShape::delaunay && model.options.rimTolerance == 0);
}

/// How the source is read: as the command says, or as it was read for the build.
SourceReading readingOf(const SourceReading& stated, const SourceReading& built) {
  SourceReading reading = stated;
  if (!reading.band) reading.band = built.band;
  if (reading.layer.empty()) reading.layer = built.layer;
  if (reading.zField.empty()) reading.zField = built.zField;
  if (reading.crs.empty()) reading.crs = built.crs;
  if (!reading.nodata) reading.nodata = built.nodata;
  return reading;
}

/// Compares every height with the source.
/// @return the number of heights compared
Result<std::uint64_t> compare(const ValidateArguments& arguments, const TerrainModel& model,
                              Session& session) {
  DemArguments source = arguments.source;
  source.reading = readingOf(source.reading, model.reading);
  source.staysPoints = !model.isRaster;
  ARETE_TRY(const DemRead dem, source.read(session));
  return std::visit([&](const auto& field) { return compareWithSource(model, field); }, dem.heightfield);
}

/// The checks of a terrain, whole or in parts.
struct Checked {
  Status valid;
  TerrainModel model;  ///< in parts: nothing of its triangles
  ErrorsChecked errors;
  std::optional<ValidatedParts> parts;
};

Checked checkTerrain(const ValidateArguments& arguments, const AmtFile& file, const Session& session) {
  Checked checked{.valid = {}, .model = file.model(), .errors = {}, .parts = {}};
  Result<TerrainModel> whole = file.read({}, session.context());
  if (whole) {
    checked.model = std::move(*whole);
    checked.valid = validateModel(checked.model, arguments.options, session.context(), &checked.errors);
  } else {
    checked.valid = tl::unexpected(whole.error());
  }
  const bool isTooLarge = !checked.valid && checked.valid.error().code == ErrorCode::outOfMemory;
  if (!isTooLarge || !file.isPaged() || !file.model().isRaster || !arguments.source.path.empty())
    return checked;
  whole = failure(ErrorCode::outOfMemory, {});
  checked.model = file.model();
  auto parts = validateInParts(file, {.laws = arguments.options}, session.context());
  checked.valid = parts ? Status() : Status(tl::unexpected(parts.error()));
  if (!parts) return checked;
  checked.errors = parts->errors;
  checked.parts = *parts;
  return checked;
}

/// What the checks of a law covered, where that is not everything.
std::string scopeOf(const Law& law, const ErrorsChecked& checked, bool isInParts) {
  if (law.number != 10) return {};
  if (isInParts)
    return checked.areAll() ? std::string(" (all triangles of each part)")
                            : fmt::format(" ({} of the parts; --full checks all)",
                                          grouped(checked.checked, "triangle", "triangles"));
  return checked.areAll() ? fmt::format(" (all of {})", counted(checked.triangles, "triangle", "triangles"))
                          : fmt::format(" ({} of {}; --full checks all)", checked.checked,
                                        counted(checked.triangles, "triangle", "triangles"));
}

// A violation is an answer and not a failure of the command, so it is reported as JSON too before the exit
// code tells of it.
Status runValidate(const ValidateArguments& arguments, Session& session) {
  ARETE_TRY(AmtContainer container, openModelFile(arguments.model));
  ARETE_CHECK(arguments.kinds.refuseOther(kindOf(container)));
  if (container.isOfSurface())
    return validateSurfaceFile(container, {.everySample = arguments.options.everyTriangle}, session);
  ARETE_TRY(const AmtFile file, openAmt(std::move(container)));
  const Checked found = checkTerrain(arguments, file, session);
  const TerrainModel& model = found.model;
  const ErrorsChecked& checked = found.errors;
  Status valid = found.valid;
  // A run that ended otherwise says nothing of the laws.
  if (!valid && valid.error().code != ErrorCode::brokenPromise) return valid;
  std::uint64_t compared = 0;
  if (valid && !arguments.source.path.empty()) {
    const auto same = compare(arguments, model, session);
    if (same)
      compared = *same;
    else if (same.error().code != ErrorCode::brokenPromise)
      return tl::unexpected(same.error());
    else
      valid = tl::unexpected(same.error());
  }
  if (valid) {
    std::string text = fmt::format("{}: checksums, indices and every law hold\n", arguments.model);
    for (const Law& law : kLaws)
      text +=
          fmt::format("  law {}  {}  {}{}\n", law.number, isClaimed(law, model) ? "holds" : "is not claimed",
                      law.ofTerrain, scopeOf(law, checked, found.parts.has_value()));
    if (found.parts)
      text += fmt::format("  in {}, since the whole does not fit into the memory; all {} were read\n",
                          grouped(found.parts->parts, "part", "parts"),
                          grouped(found.parts->pages, "page", "pages"));
    text += arguments.source.path.empty() ? "  heights not compared with the source (--against)\n"
                                          : fmt::format("  heights all {} are those of {}\n", compared,
                                                        nameWithoutQuery(arguments.source.path));
    session.say(text);
  }
  // The laws are listed only if all hold, since the check ends at the first violation.
  Json laws = Json::array();
  for (const Law& law : kLaws)
    if (valid)
      laws.push_back({{"law", law.number}, {"says", law.ofTerrain}, {"claimed", isClaimed(law, model)}});
  Json json = {{"file", arguments.model},
               {"holds", valid.has_value()},
               {"randomFronts", arguments.options.randomFronts},
               {"seed", arguments.options.seed}};
  if (found.parts) json["parts"] = {{"count", found.parts->parts}, {"pages", found.parts->pages}};
  if (valid) {
    json["errorsChecked"] = {{"triangles", checked.checked}, {"of", checked.triangles}};
    json["heightsCompared"] = arguments.source.path.empty()
                                  ? Json("not compared")
                                  : Json({{"with", arguments.source.path}, {"heights", compared}});
  }
  if (valid)
    json["laws"] = std::move(laws);
  else
    json["violation"] = valid.error().message;
  session.answer(json);
  if (!valid) return failure(valid.error().code, valid.error().message, arguments.model);
  return {};
}

}  // namespace

void addValidateCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = session.addCommand(app, "validate", "Check all laws of a multitriangulation",
                                         "  arete validate dem.amt\n"
                                         "  arete validate dem.amt --full --against dem.tif\n"
                                         "  arete validate dem.amt --fronts 100 --seed 7",
                                         [arguments](Session& s) { return runValidate(*arguments, s); });
  OptionKinds& kinds = arguments->kinds;
  command->add_option("FILE.amt", arguments->model, "Multitriangulation")->required()->type_name("");
  kinds.ofTerrain(command
                      ->add_option("--fronts", arguments->options.randomFronts,
                                   "Number of random fronts to check, beside the uniform ones (default 8)")
                      ->check(wholeNumber(0, 1'000'000))
                      ->type_name("N"));
  kinds.ofTerrain(command
                      ->add_option("--seed", arguments->options.seed,
                                   "Seed of the random fronts and of the triangles of law 10 (default 1)")
                      ->check(wholeNumber(0, std::numeric_limits<std::int64_t>::max()))
                      ->type_name("N"));
  command->add_flag(
      "--full", arguments->options.everyTriangle,
      "Check law 10 on every triangle (default: on 65 536 where there are more); of a surface by more\n"
      "samples");
  CLI::Option* against =
      kinds.ofTerrain(command
                          ->add_option("--against", arguments->source.path,
                                       "DEM that the model was built from: every height is compared")
                          ->type_name("DEM"));
  arguments->source.addTo(*command);
  kinds.groupOfTerrain(*command, DemArguments::kGroup);
  for (CLI::Option* reading : command->get_options(
           [](const CLI::Option* option) { return option->get_group() == DemArguments::kGroup; }))
    reading->needs(against);
}

}  // namespace arete
