// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh is read whole and written anew; what the format cannot hold is a warning. An .amt is written plain
// or packed.
#include "cli/commands/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/arguments/conversion_report.h"
#include "cli/arguments/drop_attributes.h"
#include "cli/arguments/mesh_options.h"
#include "cli/arguments/normals_option.h"
#include "cli/arguments/option_kinds.h"
#include "cli/surface/convert.h"
#include "io/files/text_scan.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/bent/target.h"
#include "io/query/extract/model_file.h"
#include "io/store/amt/file.h"

namespace arete {
namespace {

struct ConvertArguments {
  std::string input, crs;
  MeshOutput output;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
  MeshPlacing placing;
  PlaceTarget place;
  NormalsArguments normals;
  std::vector<std::string> dropAttributes;
  OptionKinds kinds;
};

bool isAmt(const std::string& path) {
  return text::lowerExtension(path) == "amt";
}

/// Writes a multitriangulation in the plain or the packed form.
Status convertAmt(const ConvertArguments& arguments, Session& session) {
  const std::string& output = arguments.output.path;
  // Options for meshes are refused one by one, because each sentence names another way.
  if (!arguments.output.format.empty())
    return failure(ErrorCode::usage, "is for meshes; an .amt is written as .amt",
                   fmt::format("--format {}", arguments.output.format));
  if (!isAmt(output))
    return failure(ErrorCode::usage,
                   "must be another .amt for a multitriangulation; arete extract writes meshes",
                   fmt::format("--output {}", output));
  if (!arguments.crs.empty())
    return failure(ErrorCode::usage, "an .amt has the CRS of its DEM",
                   fmt::format("--crs {}", arguments.crs));
  if (!arguments.dropAttributes.empty())
    return failure(ErrorCode::usage, "is for meshes; build the .amt without them", "--drop-attributes");
  if (arguments.output.flipsV)
    return failure(ErrorCode::usage, "is for meshes; `arete extract` has it too", "--flip-v");
  if (!arguments.placing.isNothing())
    return failure(ErrorCode::usage, "is for meshes; an .amt states its axes and units",
                   arguments.placing.unit.empty() ? "--up" : "--unit");
  if (arguments.normals.options != NormalsOptions{})
    return failure(ErrorCode::usage,
                   "is for meshes, as --crease-angle is; arete extract makes normals of a cut", "--normals");
  if (arguments.place.isStated())
    return failure(ErrorCode::usage, "is for meshes; `arete extract` leads a cut there",
                   arguments.place.isMetric ? "--metric" : fmt::format("--to-crs {}", arguments.place.crs));
  ARETE_CHECK(checkOutput("--output", output, {arguments.input}));
  const bool isPacked = arguments.output.isPacked || arguments.output.isPaged;
  ARETE_TRY(AmtContainer file, openModelFile(arguments.input));
  ARETE_CHECK(arguments.kinds.refuseOther(kindOf(file)));
  if (file.isOfSurface())
    return convertSurfaceFile({output, isPacked, arguments.output.isPaged, arguments.output.positionBits},
                              file, session);
  ARETE_TRY(const AmtFile terrain, openAmt(std::move(file)));
  ARETE_TRY(const TerrainModel model, terrain.read({}, session.context()));
  const AmtWriteOptions options{.isPacked = isPacked, .isPaged = arguments.output.isPaged};
  ARETE_CHECK(writeAmt(output, model, session.context(), options));
  // The size is only reported, so a failure to read it is not one of the command.
  std::error_code error;
  const auto size = std::filesystem::file_size(output, error);
  const std::uint64_t bytes = error ? 0 : size, samples = model.mt.vertexCount() + model.isolated.size();
  const double perSample = static_cast<double>(bytes) / static_cast<double>(samples);
  session.say(fmt::format("{}: {}, {:.1f} bytes a sample\n", output, byteCount(bytes), perSample));
  session.answer({{"input", arguments.input},
                  {"output", output},
                  {"format", "AMT"},
                  {"isPacked", isPacked},
                  {"isPaged", arguments.output.isPaged},
                  {"bytes", bytes},
                  {"bytesPerSample", perSample}});
  return {};
}

Status runConvert(const ConvertArguments& arguments, Session& session) {
  if (isAmt(arguments.input)) return convertAmt(arguments, session);
  if (arguments.output.isPaged)
    return failure(ErrorCode::usage, "is for an .amt, and this is a mesh", "--paged");
  ARETE_TRY(const MeshTarget target, meshTarget(arguments.output, arguments.input, session));
  ARETE_TRY(MeshFile mesh, readMesh(arguments.input, session.context()));
  ARETE_CHECK(dropNamed(mesh.mesh, arguments.dropAttributes));
  const Result<ConvertedMesh> converted = convertMesh(std::move(mesh), target.path,
                                                      {.crs = arguments.crs,
                                                       .format = arguments.output.format,
                                                       .existing = arguments.existing,
                                                       .placing = arguments.placing,
                                                       .place = arguments.place,
                                                       .normals = arguments.normals.options,
                                                       .packing = packingOf(arguments.output),
                                                       .flipsV = arguments.output.flipsV},
                                                      session.context());
  if (!converted) {
    Error error = converted.error();
    // The library names the text of the CRS; on the command line it belongs to an option.
    if (error.code == ErrorCode::usage && error.culprit == arguments.crs)
      error.culprit = fmt::format("--crs {}", arguments.crs);
    return tl::unexpected(std::move(error));
  }
  warnOfConversion(*converted, arguments.input, target.format.name, session);
  session.say(writtenText(target.path, *converted));
  session.answer(writtenJson(arguments.input, target.path, target.format.name, *converted));
  return {};
}

}  // namespace

void addConvertCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command =
      session.addCommand(app, "convert", "Write a mesh in another format, with all that the format can hold",
                         "  arete convert tin.ply -o tin.glb\n"
                         "  arete convert tin.stl -o tin.gpkg --crs EPSG:32611\n"
                         "  arete convert tin.gpkg -o tin.2dm --json\n"
                         "  arete convert scan.obj -o scan.glb --up z --unit mm\n"
                         "  arete convert tin.ply -o tin.stl --metric\n"
                         "  arete convert scan.gltf -o - --format ply | gzip > scan.ply.gz\n"
                         "  arete convert scan.glb -o tiny.glb --packed --position-bits 14\n"
                         "  arete convert dem.amt -o small.amt --packed\n"
                         "  arete convert dem.amt -o served.amt --paged",
                         [arguments](Session& s) { return runConvert(*arguments, s); });
  command->add_option("MESH", arguments->input, "Triangle mesh: " + readableMeshExtensions() + "; or .amt")
      ->required()
      ->type_name("");
  arguments->output.addTo(*command, "File to write", "; .amt from .amt", {".amt"});
  addOverwriteTo(*command, arguments->existing);
  arguments->kinds.ofSurfaces(arguments->output.positionBitsOption);
  command
      ->add_option("--crs", arguments->crs,
                   "CRS of the coordinates, where the file has none; --to-crs leads them into another")
      ->type_name("CRS");
  addDropAttributesTo(*command, arguments->dropAttributes);
  command->add_flag(
      "--paged", arguments->output.isPaged,
      "Write an .amt in its packed form, in pages: a query reads those that it needs, from disk or\n"
      "from a server");
  arguments->normals.addTo(*command);
  addPlacingTo(*command, arguments->placing);
  addPlaceTo(*command, arguments->place);
}

}  // namespace arete
