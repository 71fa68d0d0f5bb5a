// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh is examined as it is joined (io/query/surface/mesh_input.h), and what is found is said in the
// numbers of the file.
#include "cli/mesh/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/mesh/diagnosis_text.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/names.h"
#include "io/query/mesh/facts.h"
#include "io/query/mesh/findings.h"
#include "io/query/surface/mesh_input.h"
#include "surface/diagnosis/diagnosis.h"

namespace arete {
namespace {

struct InfoArguments {
  std::string input;
  bool leavesOutSelfIntersections = false;
};

/// "3: a, b, c", of long lists the first.
std::string listText(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  std::string text = fmt::format("{}:", grouped(names.size()));
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += fmt::format("{} \"{}\"", i == 0 ? "" : ",", names[i]);
  if (names.size() > kMost) text += fmt::format(" and {} more", grouped(names.size() - kMost));
  return text;
}

std::vector<std::string> materialTexts(const MeshFile& file) {
  std::vector<std::string> texts;
  for (const Material& material : file.mesh.materials) {
    std::string text = fmt::format("\"{}\"", material.name);
    for (const TextureUse& texture : material.textures)
      text += fmt::format(", {} {}{}", texture.role, texture.picture,
                          hasPicture(file, texture.picture) ? "" : " (missing)");
    texts.push_back(std::move(text));
  }
  return texts;
}

std::string attributeText(const Attribute& attribute) {
  return fmt::format("{} ({} {})", attribute.name, attribute.components, nameOf(attribute.type));
}

std::string attributesText(const std::vector<Attribute>& attributes) {
  std::vector<std::string> texts;
  for (const Attribute& attribute : attributes) texts.push_back(attributeText(attribute));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string positionText(const Vec3& p) {
  return fmt::format("{:.9g}, {:.9g}, {:.9g}", p.x, p.y, p.z);
}

std::string factsText(const MeshInput& input, const MeshFacts& facts) {
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<11} {}\n", what, value);
  };
  const SurfaceMesh& mesh = input.file.mesh;
  const MeshDiagnosis& d = facts.diagnosis;
  line("format", fmt::format("{}; vertices and faces count from {}", input.format, input.numbers.first));
  line("vertices", grouped(input.fileVertices));
  // Triangles with corners of their own are joined by the reader, or every edge would count as a border.
  if (input.file.joinedVertices > 0)
    line("",
         fmt::format("{} joined: every triangle had corners of its own", grouped(input.file.joinedVertices)));
  if (input.joinedAtSeams > 0)
    line("", fmt::format("{} joined at seams to examine the surface", grouped(input.joinedAtSeams)));
  line("faces", input.fileFaces == mesh.triangles.size()
                    ? grouped(input.fileFaces)
                    : fmt::format("{} ({})", grouped(input.fileFaces),
                                  grouped(mesh.triangles.size(), "triangle", "triangles")));
  if (!mesh.objects.empty()) line("objects", listText(mesh.objects));
  if (!mesh.groups.empty()) line("groups", listText(mesh.groups));
  if (!mesh.materials.empty()) {
    line("materials", grouped(mesh.materials.size()));
    const std::vector<std::string> materials = materialTexts(input.file);
    for (std::size_t i = 0; i < std::min<std::size_t>(materials.size(), 10); ++i) line("", materials[i]);
    if (materials.size() > 10) line("", fmt::format("and {} more", grouped(materials.size() - 10)));
  }
  for (const auto& [what, attributes] :
       {std::pair{"of vertices", &mesh.vertexAttributes}, std::pair{"of corners", &mesh.wedgeAttributes},
        std::pair{"of faces", &mesh.triangleAttributes}})
    if (!attributes->empty()) line(what, attributesText(*attributes));
  if (facts.seamEdges > 0) line("seams", grouped(facts.seamEdges, "edge", "edges"));
  if (!input.file.crsWkt.empty()) line("CRS", crsName(input.file.crsWkt));
  line("box", fmt::format("{} to {}", positionText(d.boxLow), positionText(d.boxHigh)));
  line("diagonal", fmt::format("{:.9g}", d.diagonal));
  line("area", fmt::format("{:.9g}", facts.area));
  // Only solids have a volume; it is negative where the faces turn inwards.
  if (facts.volume)
    line("volume", fmt::format("{:.9g}{}", *facts.volume, *facts.volume < 0 ? " (faces turn inwards)" : ""));
  if (!d.selfIntersections) line("crossings", "not searched for");
  return text;
}

Status runInfo(const InfoArguments& arguments, Session& session) {
  ARETE_TRY(const MeshInput input, readMeshInput(arguments.input, session.context()));
  session.warn(input.file.warnings, arguments.input);
  const SurfaceMesh& mesh = input.file.mesh;
  DiagnosisOptions options{.selfIntersections = !arguments.leavesOutSelfIntersections,
                           .rounding = input.rounding};
  // The text shows the first places of a finding, JSON lists all of them.
  if (session.wantsAnswer()) options.mostPlaces = std::numeric_limits<std::size_t>::max();
  ARETE_TRY(const MeshFacts facts, meshFactsOf(mesh, options, session.context()));
  session.say(fmt::format("{}: {}\n{}{}", arguments.input, verdictOf(facts.diagnosis),
                          factsText(input, facts), diagnosisText(facts.diagnosis, input.numbers)));
  if (session.wantsAnswer()) session.answer(meshFactsJson(arguments.input, input, facts));
  return {};
}

}  // namespace

void addMeshInfoCommand(CLI::App& mesh, Session& session) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command =
      session.addCommand(mesh, "info", "Say what is in a mesh file, and what is the matter with it",
                         "  arete mesh info scan.ply\n"
                         "  arete mesh info scan.glb --no-self-intersections\n"
                         "  arete mesh info scan.obj --json | jq .findings.tJunctions.places",
                         [arguments](Session& s) { return runInfo(*arguments, s); });
  command->add_option("MESH", arguments->input, "Triangle mesh: " + readableMeshExtensions())
      ->required()
      ->type_name("");
  command->add_flag("--no-self-intersections", arguments->leavesOutSelfIntersections,
                    "Do not search for faces that cross, which takes most of the time");
}

}  // namespace arete
