// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/mesh_options.h"
#include "cli/arguments/normals_option.h"
#include "io/formats/exchange/axes.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/names.h"
#include "surface/edit/place.h"

namespace arete {
namespace {

struct PlaceArguments {
  std::string input, turn, move, about = "origin";
  double scale = 1;
  MeshOutput output;
  MeshPlacing placing;
  NormalsArguments normals;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

/// Three numbers; zeros where none are stated.
Result<Vec3> threeNumbers(const char* option, const std::string& text, const char* names) {
  if (text.empty()) return Vec3{};
  const std::string culprit = fmt::format("{} {}", option, text);
  ARETE_TRY(const auto numbers, parseNumbers(culprit, text));
  if (numbers.size() != 3)
    return failure(ErrorCode::usage, fmt::format("must be {}: three numbers, not {}", names, numbers.size()),
                   culprit);
  const Vec3 found{numbers[0], numbers[1], numbers[2]};
  if (!isFinite(found)) return failure(ErrorCode::usage, "must be finite", culprit);
  return found;
}

/// The place that is turned about and scaled from.
Result<Vec3> pivotOf(const std::string& about, const SurfaceMesh& mesh, bool isYUp) {
  if (about == "origin") return Vec3{};
  if (about != "middle" && about != "base")
    return threeNumbers("--about", about, "origin, middle, base or X,Y,Z");
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinite, kInfinite, kInfinite}, high = -low;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) {
      const Vec3& p = mesh.positions[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  Vec3 pivot = low / 2 + high / 2;
  if (!isFinite(pivot)) return Vec3{};  // it has no triangles
  if (about == "base") (isYUp ? pivot.y : pivot.z) = isYUp ? low.y : low.z;
  return pivot;
}

Status checkCrs(const PlaceArguments& a, const MeshFile& mesh) {
  if (!isGeographicCrs(mesh.crsWkt) || (a.turn.empty() && a.scale == 1)) return {};
  return failure(ErrorCode::usage, "turns and scales lengths, and the mesh is in degrees",
                 a.turn.empty() ? "--scale" : "--turn " + a.turn);
}

Status runPlace(const PlaceArguments& a, Session& session) {
  ARETE_TRY(const Vec3 angles, threeNumbers("--turn", a.turn, "HEADING,PITCH,ROLL"));
  ARETE_TRY(const Vec3 move, threeNumbers("--move", a.move, "X,Y,Z"));
  ARETE_TRY(const MeshTarget target, meshTarget(a.output, a.input, session));
  ARETE_TRY(MeshFile mesh, readMesh(a.input, session.context()));
  ARETE_CHECK(checkCrs(a, mesh));
  const MeshUp up = a.placing.up != MeshUp::unknown ? a.placing.up : mesh.up;
  const bool isYUp = up == MeshUp::y;
  if (up == MeshUp::unknown && (angles.x != 0 || angles.z != 0))
    session.note(fmt::format("{} does not say which axis is up: z is; --up y says otherwise", a.input));
  ARETE_TRY(const Vec3 pivot, pivotOf(a.about, mesh.mesh, isYUp));
  const Similarity zUp(Turn{angles.x, angles.y, angles.z}, a.scale, {});
  const Similarity turned = isYUp ? withYUp(zUp) : zUp;
  const Similarity placing(turned.axes(), a.scale, pivot + move - turned(pivot));
  if (Status placed = placeMesh(mesh, placing); !placed)
    return failure(placed.error().code, placed.error().message,
                   fmt::format("{}, {}", a.input, placed.error().culprit));
  ARETE_TRY(const ConvertedMesh converted, convertMesh(std::move(mesh), target.path,
                                                       {.format = a.output.format,
                                                        .existing = a.existing,
                                                        .placing = a.placing,
                                                        .normals = a.normals.options,
                                                        .packing = packingOf(a.output),
                                                        .flipsV = a.output.flipsV},
                                                       session.context()));
  warnOfConversion(converted, a.input, target.format.name, session);
  session.say(writtenText(target.path, converted));
  Json json = writtenJson(a.input, target.path, target.format.name, converted);
  json["turn"] = {angles.x, angles.y, angles.z};
  json["scale"] = a.scale;
  json["move"] = {move.x, move.y, move.z};
  json["about"] = {pivot.x, pivot.y, pivot.z};
  session.answer(json);
  return {};
}

}  // namespace

void addMeshPlaceCommand(CLI::App& mesh, Session& session) {
  auto arguments = std::make_shared<PlaceArguments>();
  CLI::App* command =
      session.addCommand(mesh, "place", "Scale, turn and move a mesh, in this order",
                         "  arete mesh place scan.ply -o placed.ply --turn 30,0,0 --move 409050,3801450,310\n"
                         "  arete mesh place part.stl -o upright.stl --turn 0,90,0 --about base\n"
                         "  arete mesh place model.obj -o metres.obj --scale 0.0254 --up y",
                         [arguments](Session& s) { return runPlace(*arguments, s); });
  addMeshFilesTo(*command, arguments->input, arguments->output, arguments->existing);
  command
      ->add_option("--turn", arguments->turn,
                   "Angles in degrees: clockwise seen from above, the front upwards, the right side "
                   "downwards; it rolls first and heads last")
      ->type_name("HEADING,PITCH,ROLL");
  command->add_option("--move", arguments->move, "Added to the coordinates of the input, at last")
      ->type_name("X,Y,Z");
  command->add_option("--scale", arguments->scale, "Multiplies all lengths (default 1)")
      ->check(finiteAbove(0))
      ->type_name("S");
  command
      ->add_option(
          "--about", arguments->about,
          "What stays where it is but for --move: origin (0,0,0, default), middle or base of its box, "
          "or a place")
      ->type_name("WHERE");
  arguments->normals.addTo(*command);
  addPlacingTo(*command, arguments->placing);
}

}  // namespace arete
