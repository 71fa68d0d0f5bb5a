// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh/crop.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/mesh_options.h"
#include "cli/arguments/normals_option.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "surface/edit/crop.h"

namespace arete {
namespace {

struct CropArguments {
  std::string input, box;
  MeshOutput output;
  MeshPlacing placing;
  NormalsArguments normals;
  CropOptions options;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

/// Six numbers with commas between; one that is left out is infinite.
Result<Box3> parseBox(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  const std::string culprit = fmt::format("--box {}", text);
  if (parts.size() != 6)
    return failure(ErrorCode::usage,
                   fmt::format("must be x0,y0,z0,x1,y1,z1: six numbers, not {}", parts.size()), culprit);
  std::array<double, 6> bounds{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (parts[i].find_first_not_of(' ') == std::string::npos) {
      bounds[i] = i < 3 ? -Box3::kInfinity : Box3::kInfinity;
      continue;
    }
    ARETE_TRY(const auto number, parseNumbers(culprit, parts[i]));
    bounds[i] = number[0];
  }
  return Box3{{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}};
}

Status runCrop(const CropArguments& arguments, Session& session) {
  ARETE_TRY(const Box3 box, parseBox(arguments.box));
  ARETE_TRY(const MeshTarget target, meshTarget(arguments.output, arguments.input, session));
  ARETE_TRY(MeshFile mesh, readMesh(arguments.input, session.context()));
  ARETE_TRY(CroppedMesh cropped, crop(mesh.mesh, box, arguments.options, session.context()));
  const bool isOfFloats = movedByFloats(mesh.mesh) == 0;
  mesh.mesh = std::move(cropped.mesh);
  if (!mesh.triangleErrors.empty()) {
    std::vector<float> errors;
    for (const std::uint32_t t : cropped.triangleOf) errors.push_back(mesh.triangleErrors[t]);
    mesh.triangleErrors = std::move(errors);
  }
  ARETE_TRY(const ConvertedMesh converted, convertMesh(std::move(mesh), target.path,
                                                       {.format = arguments.output.format,
                                                        .existing = arguments.existing,
                                                        .placing = arguments.placing,
                                                        .normals = arguments.normals.options,
                                                        .isOfFloats = isOfFloats,
                                                        .packing = packingOf(arguments.output),
                                                        .flipsV = arguments.output.flipsV},
                                                       session.context()));
  warnOfConversion(converted, arguments.input, target.format.name, session);
  session.say(writtenText(target.path, converted) +
              (cropped.cutTriangles > 0 ? fmt::format("  {} cut at the box, {} made there\n",
                                                      grouped(cropped.cutTriangles, "triangle", "triangles"),
                                                      grouped(cropped.cutVertices, "vertex", "vertices"))
                                        : ""));
  Json json = writtenJson(arguments.input, target.path, target.format.name, converted);
  json["cutTriangles"] = cropped.cutTriangles;
  json["cutVertices"] = cropped.cutVertices;
  session.answer(json);
  return {};
}

}  // namespace

void addMeshCropCommand(CLI::App& mesh, Session& session) {
  auto arguments = std::make_shared<CropArguments>();
  CLI::App* command =
      session.addCommand(mesh, "crop", "Take the part of a mesh in a box, cut at its faces",
                         "  arete mesh crop scan.obj -o part.obj --box 0,0,0,10,10,2\n"
                         "  arete mesh crop scan.glb -o lower.glb --box ,,,,,1.5\n"
                         "  arete mesh crop scan.ply -o part.ply --box=-5,-5,-5,5,5,5 --whole",
                         [arguments](Session& s) { return runCrop(*arguments, s); });
  addMeshFilesTo(*command, arguments->input, arguments->output, arguments->existing);
  command
      ->add_option(
          "--box", arguments->box,
          "Box in the coordinates of the input; a bound that is left out, or -inf or inf, does not bound")
      ->required()
      ->type_name("X0,Y0,Z0,X1,Y1,Z1");
  command->add_flag("--whole", arguments->options.keepsWhole,
                    "Keep triangles that touch the box whole (default: they are cut at its faces)");
  arguments->normals.addTo(*command);
  addPlacingTo(*command, arguments->placing);
}

}  // namespace arete
