// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/mesh/diagnosis_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "io/query/mesh/findings.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

Json findingJson(FindingElements kind, const MeshFinding& finding, const MeshNumbers& numbers) {
  Json named = Json::array();
  for (const std::uint32_t e : finding.elements)
    named.push_back(kind == FindingElements::faces ? numbers.face(e) : numbers.vertex(e));
  Json json;
  switch (kind) {
    case FindingElements::edge:
      json["edge"] = std::move(named);
      break;
    case FindingElements::faces:
      json["faces"] = std::move(named);
      break;
    case FindingElements::vertexAndEdge:
      json["vertex"] = named[0];
      json["edge"] = {named[1], named[2]};
      break;
    default:
      json["vertices"] = std::move(named);
  }
  json["at"] = positionJson(finding.place);
  return json;
}

}  // namespace

Json positionJson(const Vec3& p) {
  return Json::array({p.x, p.y, p.z});
}

Json diagnosisJson(const MeshDiagnosis& d, const MeshNumbers& numbers) {
  Json components = Json::array(), borders = Json::array(), findings;
  for (const ComponentDiagnosis& c : d.components)
    components.push_back({{"firstFace", numbers.face(c.firstTriangle)},
                          {"triangles", c.triangles},
                          {"edges", c.edges},
                          {"vertices", c.vertices},
                          {"eulerNumber", c.eulerNumber},
                          {"genus", c.genus ? Json(*c.genus) : Json()},
                          {"borders", c.borders},
                          {"isManifold", c.isManifold()},
                          {"isClosed", c.isClosed()},
                          {"isOrientable", c.isOrientable},
                          {"nonManifoldEdges", c.nonManifoldEdges},
                          {"nonManifoldVertices", c.nonManifoldVertices},
                          {"turnedEdges", c.turnedEdges}});
  for (const MeshBorder& b : d.borders)
    borders.push_back({{"component", b.component},
                       {"edges", b.edgeCount},
                       {"length", b.length},
                       {"firstVertex", numbers.vertex(b.firstVertex)},
                       {"isClosed", b.isClosed}});
  for (const FindingKind& kind : findingKinds()) {
    const MeshFindings* const found = kind.of(d);
    if (found == nullptr) {
      findings[kind.key] = nullptr;
      continue;
    }
    Json places = Json::array();
    for (const MeshFinding& finding : found->places)
      places.push_back(findingJson(kind.elements, finding, numbers));
    findings[kind.key] = {{"count", found->count}, {"places", std::move(places)}};
  }
  return {{"verdict", verdictOf(d)},
          {"isManifold", isManifold(d)},
          {"isClosed", isClosed(d)},
          {"isOrientable", isOrientable(d)},
          {"isCoherent", d.turnedEdges.count == 0},
          {"components", std::move(components)},
          {"borders", std::move(borders)},
          {"findings", std::move(findings)}};
}

}  // namespace arete
