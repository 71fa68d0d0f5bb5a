// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joined at its seams, welded if stated, mended, and written as a conversion is.
#include "cli/mesh/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/mesh_options.h"
#include "cli/mesh/diagnosis_json.h"
#include "cli/mesh/diagnosis_text.h"
#include "cli/mesh/findings.h"
#include "engine/base/counted.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/query/surface/mesh_input.h"
#include "surface/edit/joined_surface.h"
#include "surface/edit/small_components.h"
#include "surface/model/transfer.h"
#include "surface/repair/repair.h"

namespace arete {
namespace {

struct RepairArguments {
  std::string input, weld;
  MeshOutput output;
  MeshPlacing placing;
  RepairOptions options;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

/// The distance of --weld.
struct WeldDistance {
  double size = 0;              ///< in the unit of the file
  std::optional<double> share;  ///< percent of the diagonal, if it was stated so
};

Result<WeldDistance> weldDistance(const std::string& text, const TriangleMesh& mesh) {
  const bool isPercent = text.ends_with('%');
  ARETE_TRY(const auto number,
            parseNumbers(fmt::format("--weld {}", text), isPercent ? text.substr(0, text.size() - 1) : text));
  if (number.size() != 1 || !(number[0] >= 0) || !std::isfinite(number[0]))
    return failure(ErrorCode::usage,
                   "must be a distance of 0 or more, or such a number and % of the diagonal",
                   fmt::format("--weld {}", text));
  WeldDistance distance{.size = number[0], .share = {}};
  if (isPercent) {
    distance.share = distance.size;
    const double diagonal = diagonalOf(mesh);
    if (!std::isfinite(diagonal))
      return failure(ErrorCode::invalidData, "the diagonal of its box is too large for a number");
    distance.size = distance.size / 100 * diagonal;
  }
  return distance;
}

struct Welded {
  WeldDistance distance;
  bool isOfRounding = false;  ///< not stated: what rounding has moved apart
  double diagonal = 0;
  std::uint64_t vertices = 0, edges = 0;
  double farthestMove = 0;
};

/// Errors that the file states of its triangles, for the triangles that were made of them.
void carryErrors(MeshFile& file, const std::vector<std::uint32_t>& triangleOf, bool hasMoved) {
  if (file.triangleErrors.empty()) return;
  if (hasMoved || std::ranges::find(triangleOf, RepairedMesh::kNone) != triangleOf.end()) {
    file.triangleErrors.clear();
    file.warnings.push_back(
        {WarningCode::omitted, "the errors of its triangles do not hold for the mended surface: left out"});
    return;
  }
  std::vector<float> errors;
  for (const std::uint32_t t : triangleOf) errors.push_back(file.triangleErrors[t]);
  file.triangleErrors = std::move(errors);
}

/// Mends the mesh in the file.
Result<RepairedMesh> mend(MeshInput& input, const RepairArguments& arguments, bool hasMoved,
                          Session& session) {
  MeshFile& file = input.file;
  RepairOptions options = arguments.options;
  options.rounding = input.rounding;
  options.partOf = file.mesh.objectOf;
  Result<RepairedMesh> repaired = repair(file.mesh, options, session.context());
  if (!repaired) return repaired;
  file.warnings.clear();  // written already
  if (!repaired->counts.isNothing()) {
    carryErrors(file, repaired->triangleOf, hasMoved);
    ARETE_TRY(SurfaceMesh mended,
              transferAttributes(file.mesh, repaired->mesh, repaired->vertexOf, repaired->triangleOf));
    file.mesh = std::move(mended);
  } else if (hasMoved) {
    std::vector<std::uint32_t> same(file.mesh.triangles.size());
    std::iota(same.begin(), same.end(), 0u);
    carryErrors(file, same, hasMoved);
  }
  file.mesh.faceOf.clear();  // the triangles are the faces of what is written
  return repaired;
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
std::string mendedText(const MeshInput& input, const std::optional<Welded>& welded,
                       const RepairedMesh& repaired) {
  std::string text;
  const auto line = [&](std::uint64_t count, const std::string& what) {
    if (count > 0) text += fmt::format("  {}: {}\n", what, grouped(count));
  };
  line(input.joinedAtSeams, "vertices joined at seams");
  if (welded)
    text += fmt::format(
        "  {} joined within {:.6g}{} ({:.6g} % of the diagonal, {:.6g}); none moved farther than "
        "{:.6g}\n",
        grouped(welded->vertices, "vertex", "vertices"), welded->distance.size,
        welded->isOfRounding ? ", which rounding to the numbers of the file moves apart" : "",
        welded->distance.share ? *welded->distance.share
        : welded->diagonal > 0 ? 100 * welded->distance.size / welded->diagonal
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

// The JSON has every count, zeros included, so that programs need no defaults.
Json mendedJson(const RepairCounts& c) {
  return {{"turnedSolids", c.turnedSolids},         {"turnedCavities", c.turnedCavities},
          {"duplicateFaces", c.duplicateTriangles}, {"degenerateFaces", c.degenerateTriangles},
          {"joinedVertices", c.joinedVertices},     {"tJunctions", c.tJunctions},
          {"splitSheetEdges", c.splitSheetEdges},   {"turnedFaces", c.turnedTriangles},
          {"addedVertices", c.addedVertices},       {"filledHoles", c.filledHoles},
          {"fillingTriangles", c.fillingTriangles}, {"unusedVertices", c.unusedVertices}};
}

Json weldedJson(const Welded& welded) {
  return {{"distance", welded.distance.size},
          {"diagonal", welded.diagonal},
          {"isOfRounding", welded.isOfRounding},
          {"vertices", welded.vertices},
          {"edges", welded.edges},
          {"farthestMove", welded.farthestMove}};
}

/// How far apart the borders are that are one but for the rounding of the file; 0: there are none, or edges
/// of borders are too short for it.
Result<double> distanceOfNearBorders(const MeshInput& input, const RunContext& context) {
  const TriangleMesh& mesh = input.file.mesh;
  ARETE_TRY(
      const MeshDiagnosis d,
      diagnose(mesh, {.mostPlaces = 0, .selfIntersections = false, .rounding = input.rounding}, context));
  return d.farthestNear <= d.shortestBorderEdge / 4 ? d.farthestNear : 0;
}

// Borders are welded by a stated distance, or else by the distance that the rounding of the file explains.
Status runRepair(const RepairArguments& arguments, Session& session) {
  ARETE_TRY(const MeshTarget target, meshTarget(arguments.output, arguments.input, session));
  ARETE_TRY(MeshInput input, readMeshInput(arguments.input, session.context()));
  const bool isOfFloats = movedByFloats(input.file.mesh) == 0;
  session.warn(input.file.warnings, arguments.input);
  std::optional<Welded> welded;
  if (!arguments.weld.empty()) {
    SurfaceMesh& mesh = input.file.mesh;
    ARETE_TRY(const WeldDistance distance, weldDistance(arguments.weld, mesh));
    welded = Welded{.distance = distance, .diagonal = diagonalOf(mesh)};
  } else if (const auto distance = distanceOfNearBorders(input, session.context()); !distance) {
    return tl::unexpected(distance.error());
  } else if (*distance > 0) {
    welded = Welded{.distance = {.size = *distance, .share = {}},
                    .isOfRounding = true,
                    .diagonal = diagonalOf(input.file.mesh)};
  }
  if (welded) {
    SurfaceMesh& mesh = input.file.mesh;
    ARETE_TRY(
        const JoinedSurface joined,
        joinSurface(mesh, {.distance = welded->distance.size, .partOf = mesh.objectOf}, session.context()));
    welded->vertices = joined.joinedVertices;
    welded->edges = joined.joinedEdges;
    welded->farthestMove = joined.farthestMove;
  }
  // Errors that the mesh carries no longer hold where welding has moved a vertex, so mending is given that.
  ARETE_TRY(const RepairedMesh repaired, mend(input, arguments, welded && welded->farthestMove > 0, session));
  if (input.file.mesh.triangles.empty())
    return failure(ErrorCode::invalidData, "no face is left: all were without area", arguments.input);
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
                                                        .isOfFloats = isOfFloats},
                                                       session.context()));
  warnOfConversion(converted, arguments.input, target.format.name, session);
  const MeshNumbers numbers{.first = target.format.holds.firstIndex, .vertexOf = {}, .faceOf = {}};
  session.say(writtenText(target.path, converted) + mendedText(input, welded, repaired) +
              fmt::format("now: {}\n", verdictOf(*diagnosis)) + diagnosisText(*diagnosis, numbers));
  if (session.wantsAnswer()) {
    Json json = writtenJson(arguments.input, target.path, target.format.name, converted);
    json["joinedAtSeams"] = input.joinedAtSeams;
    json["welded"] = welded ? weldedJson(*welded) : Json();
    json["mended"] = mendedJson(repaired.counts);
    json["rounding"] = input.rounding;
    json["openHoles"] = repaired.openHoles;
    json["crossingParts"] = repaired.crossingParts;
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
  command->add_option("MESH", arguments->input, "Triangle mesh: " + readableMeshExtensions())
      ->required()
      ->type_name("");
  arguments->output.addTo(*command, "File to write", "");
  addOverwriteTo(*command, arguments->existing);
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
  addPlacingTo(*command, arguments->placing);
}

}  // namespace arete
