// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joined at its seams, welded if stated, mended, and written as a conversion is.
#include "cli/mesh/repair.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/mesh_options.h"
#include "cli/arguments/normals_option.h"
#include "cli/mesh/diagnosis_text.h"
#include "cli/mesh/tolerance.h"
#include "engine/base/counted.h"
#include "io/files/text/length_unit.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/query/mesh/diagnosis_json.h"
#include "io/query/mesh/findings.h"
#include "io/query/mesh/mend.h"
#include "io/query/surface/mesh_input.h"
#include "surface/edit/small_components.h"
#include "surface/repair/repair.h"

namespace arete {
namespace {

struct RepairArguments {
  std::string input, weld;
  MeshOutput output;
  MeshPlacing placing;
  NormalsArguments normals;
  RepairOptions options;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

/// The distance of --weld.
struct WeldDistance {
  double size = 0;              ///< in the unit of the file
  std::optional<double> share;  ///< percent of the diagonal, if it was stated so
};

Result<WeldDistance> weldDistance(const std::string& text, const MeshFile& file) {
  const TriangleMesh& mesh = file.mesh;
  const bool isPercent = text.ends_with('%');
  const std::string culprit = fmt::format("--weld {}", text);
  ARETE_TRY(const StatedLength length,
            parseLength(isPercent ? text.substr(0, text.size() - 1) : text, culprit));
  ARETE_TRY(const double number, inDataUnit(length, spaceUnitOf(file), culprit));
  if ((isPercent && length.hasUnit()) || !(number >= 0) || !std::isfinite(number))
    return failure(ErrorCode::usage,
                   "must be a distance of 0 or more, or such a number and % of the diagonal",
                   fmt::format("--weld {}", text));
  WeldDistance distance{.size = number, .share = {}};
  if (isPercent) {
    distance.share = distance.size;
    const double diagonal = diagonalOf(mesh);
    if (!std::isfinite(diagonal))
      return failure(ErrorCode::invalidData, "the diagonal of its box is too large for a number");
    distance.size = distance.size / 100 * diagonal;
  }
  return distance;
}

using Line = std::pair<std::uint64_t, const char*>;

/// Every count has its words here; mendedText() leaves out what did not occur.
std::vector<Line> mendedLines(const RepairCounts& c) {
  return {{c.duplicateTriangles, "duplicate faces left out"},
          {c.degenerateTriangles, "faces without area left out"},
          {c.joinedVertices, "vertices joined with others at their positions"},
          {c.tJunctions, "edges split at T-junctions"},
          {c.splitSheetEdges, "edges of more than two faces split into sheets"},
          {c.turnedTriangles, "faces turned"},
          {c.turnedSolids, "closed parts turned as a whole, outwards"},
          {c.turnedCavities, "cavities turned as a whole, inwards"},
          {c.addedVertices, "vertices added, one for each further fan"},
          {c.filledHoles, "holes filled"},
          {c.fillingTriangles, "triangles added in holes"},
          {c.unusedVertices, "vertices without a face left out"}};
}

// A weld is said with its distance, also one that the rounding of the file has called for; then it would be
// wrong to say that there was nothing to mend.
std::string mendedText(const MeshInput& input, const std::optional<WeldOutcome>& welded,
                       std::optional<double> share, const RepairedMesh& repaired) {
  std::string text;
  const auto line = [&](std::uint64_t count, const std::string& what) {
    if (count > 0) text += fmt::format("  {}: {}\n", what, grouped(count));
  };
  line(input.joinedAtSeams, "vertices joined at seams");
  if (welded)
    text += fmt::format(
        "  {} joined within {:.6g}{} ({:.6g} % of the diagonal, {:.6g}); none moved farther than "
        "{:.6g}\n",
        grouped(welded->vertices, "vertex", "vertices"), welded->distance,
        welded->isOfRounding ? ", which rounding to the numbers of the file moves apart" : "",
        share                  ? *share
        : welded->diagonal > 0 ? 100 * welded->distance / welded->diagonal
                               : 0,
        welded->diagonal, welded->farthestMove);
  for (const auto& [count, what] : mendedLines(repaired.counts)) line(count, what);
  if (repaired.counts.isNothing() && !(welded && welded->isOfRounding)) text += "  nothing to mend\n";
  if (repaired.openHoles > 0)
    text += fmt::format(
        "  left open: {}, as {} would have an edge that exists, lie upon the surface or cross it, or would "
        "follow sides that turn against each other\n",
        grouped(repaired.openHoles, "hole", "holes"),
        agreeing(repaired.openHoles, "its filling", "their fillings"));
  if (repaired.crossingParts > 0)
    text += fmt::format(
        "  {} cross each other: none is a cavity of another, and they are turned alike, as the largest\n",
        grouped(repaired.crossingParts, "closed part", "closed parts"));
  return text;
}

// Borders are welded by a stated distance, or else by the distance that the rounding of the file explains.
Status runRepair(const RepairArguments& arguments, Session& session) {
  ARETE_TRY(const MeshTarget target, meshTarget(arguments.output, arguments.input, session));
  ARETE_TRY(MeshInput input, readMeshInput(arguments.input, session.context()));
  const bool isOfFloats = movedByFloats(input.file.mesh) == 0;
  session.warn(input.file.warnings, arguments.input);
  MendOptions options{.weld = {}, .repair = arguments.options};
  std::optional<double> share;
  if (!arguments.weld.empty()) {
    ARETE_TRY(const WeldDistance distance, weldDistance(arguments.weld, input.file));
    options.weld = distance.size;
    share = distance.share;
  }
  Result<MendedMesh> mended = mendMesh(input, options, session.context());
  if (!mended && mended.error().culprit.empty()) mended.error().culprit = arguments.input;
  if (!mended) return tl::unexpected(mended.error());
  const RepairedMesh& repaired = mended->repaired;
  // The report of the repair holds examples only; JSON lists all, so the result is examined once more.
  Result<MeshDiagnosis> diagnosis = repaired.diagnosis;
  if (session.wantsAnswer())
    diagnosis = diagnose(repaired.mesh,
                         {.mostPlaces = std::numeric_limits<std::size_t>::max(),
                          .selfIntersections = false,
                          .rounding = input.rounding},
                         session.context());
  if (!diagnosis) return tl::unexpected(diagnosis.error());
  ARETE_TRY(const ConvertedMesh converted, convertMesh(std::move(input.file), target.path,
                                                       {.format = arguments.output.format,
                                                        .existing = arguments.existing,
                                                        .placing = arguments.placing,
                                                        .normals = arguments.normals.options,
                                                        .isOfFloats = isOfFloats,
                                                        .packing = packingOf(arguments.output),
                                                        .flipsV = arguments.output.flipsV},
                                                       session.context()));
  warnOfConversion(converted, arguments.input, target.format.name, session);
  const MeshNumbers numbers{.first = target.format.holds.firstIndex, .vertexOf = {}, .faceOf = {}};
  session.say(writtenText(target.path, converted) + mendedText(input, mended->welded, share, repaired) +
              fmt::format("now: {}\n", verdictOf(*diagnosis)) + diagnosisText(*diagnosis, numbers));
  if (session.wantsAnswer()) {
    Json json = writtenJson(arguments.input, target.path, target.format.name, converted);
    json["joinedAtSeams"] = input.joinedAtSeams;
    json.update(mendJson(*mended, input.rounding));
    json["result"] = diagnosisJson(*diagnosis, numbers);
    session.answer(json);
  }
  return {};
}

}  // namespace

void addMeshRepairCommand(CLI::App& mesh, Session& session) {
  auto arguments = std::make_shared<RepairArguments>();
  CLI::App* command = session.addCommand(
      mesh, "repair",
      "Mend a mesh without guessing: duplicate faces, faces without area, T-junctions, fans, orientation",
      "  arete mesh repair scan.obj -o clean.obj\n"
      "  arete mesh repair scan.stl -o clean.ply --weld 0.001% --fill-holes 12\n"
      "  arete mesh repair parts.glb -o parts.obj --split-sheets --json",
      [arguments](Session& s) { return runRepair(*arguments, s); });
  addMeshFilesTo(*command, arguments->input, arguments->output, arguments->existing);
  command
      ->add_option(
          "--weld", arguments->weld,
          "Join border vertices within this distance, in the unit of the file, or with % in hundredths\n"
          "of the diagonal of its box (default: none are joined)")
      ->type_name("E|E%");
  command
      ->add_option("--fill-holes", arguments->options.mostHoleEdges,
                   "Fill borders of at most so many edges (default 0: none)")
      ->check(wholeNumber(0, 1'000'000'000))
      ->type_name("N");
  command->add_flag("--split-sheets", arguments->options.splitsSheets,
                    "Split edges of more than two faces into sheets");
  arguments->normals.addTo(*command);
  addPlacingTo(*command, arguments->placing);
}

}  // namespace arete
