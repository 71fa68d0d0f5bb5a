// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/mesh/facts.h"

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "engine/base/warning.h"
#include "io/formats/common/files_beside.h"
#include "io/geo/crs/names.h"
#include "io/query/mesh/diagnosis_json.h"
#include "io/query/mesh/findings.h"
#include "surface/diagnosis/sizes.h"
#include "surface/edit/joined_surface.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::array kTypeNames = {"int8",  "uint8",  "int16",   "uint16",
                                   "int32", "uint32", "float32", "float64"};

Json attributesJson(const std::vector<Attribute>& attributes) {
  Json json = Json::array();
  for (const Attribute& a : attributes)
    json.push_back({{"name", a.name},
                    {"type", nameOf(a.type)},
                    {"components", a.components},
                    {"isNormalized", a.isNormalized}});
  return json;
}

}  // namespace

std::string_view nameOf(ScalarType type) {
  return kTypeNames[static_cast<std::size_t>(type)];
}

bool hasPicture(const MeshFile& file, const std::string& picture) {
  if (picture.starts_with('#')) {
    const std::string number = picture.substr(1);
    for (std::size_t i = 0; i < file.mesh.pictures.size(); ++i)
      if (std::to_string(i) == number) return true;
    return false;
  }
  const Result<std::string> found = FilesBeside(file.folder).find(picture);
  std::error_code ignored;
  return found && fs::is_regular_file(file.folder / *found, ignored);
}

Result<MeshFacts> meshFactsOf(const SurfaceMesh& mesh, const DiagnosisOptions& options,
                              const RunContext& context) {
  MeshFacts facts;
  ARETE_TRY(facts.diagnosis, diagnose(mesh, options, context));
  facts.area = areaOf(mesh);
  if (isSolid(facts.diagnosis)) facts.volume = volumeOf(mesh);
  facts.seamEdges = countSeamEdges(mesh);
  return facts;
}

Json meshFactsJson(const std::string& path, const MeshInput& input, const MeshFacts& facts) {
  const SurfaceMesh& mesh = input.file.mesh;
  Json materials = Json::array();
  for (const Material& material : mesh.materials) {
    Json textures = Json::array();
    for (const TextureUse& texture : material.textures)
      textures.push_back({{"role", texture.role},
                          {"picture", texture.picture},
                          {"isThere", hasPicture(input.file, texture.picture)}});
    materials.push_back({{"name", material.name}, {"textures", std::move(textures)}});
  }
  const MeshDiagnosis& d = facts.diagnosis;
  const MeshUp up = input.file.up;
  Json json = {{"file", path},
               {"format", input.format},
               {"countsFrom", input.numbers.first},
               {"vertices", input.fileVertices},
               {"faces", input.fileFaces},
               {"triangles", mesh.triangles.size()},
               {"joinedVertices", input.file.joinedVertices},
               {"joinedAtSeams", input.joinedAtSeams},
               {"seamEdges", facts.seamEdges},
               {"objects", mesh.objects},
               {"groups", mesh.groups},
               {"materials", std::move(materials)},
               {"embeddedPictures", mesh.pictures.size()},
               {"attributes",
                {{"vertices", attributesJson(mesh.vertexAttributes)},
                 {"corners", attributesJson(mesh.wedgeAttributes)},
                 {"faces", attributesJson(mesh.triangleAttributes)}}},
               {"crs", crsName(input.file.crsWkt)},
               {"verticalUnit", input.file.verticalUnit},
               {"up", up == MeshUp::y   ? "y"
                      : up == MeshUp::z ? "z"
                                        : "unknown"},
               {"box", {{"low", positionJson(d.boxLow)}, {"high", positionJson(d.boxHigh)}}},
               {"diagonal", d.diagonal},
               {"area", facts.area},
               {"volume", facts.volume ? Json(*facts.volume) : Json()}};
  // The findings name vertices and faces by the numbers of the file, as the text does.
  json.update(diagnosisJson(d, input.numbers));
  json["warnings"] = Json::array();
  json["warningCodes"] = Json::array();
  for (const Warning& warning : input.file.warnings) {
    json["warnings"].push_back(warning.sentence);
    json["warningCodes"].push_back(nameOf(warning.code));
  }
  return json;
}

}  // namespace arete
