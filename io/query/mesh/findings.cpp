// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/mesh/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/files/text/grouped.h"

namespace arete {
namespace {

template <MeshFindings MeshDiagnosis::*kMember>
const MeshFindings* member(const MeshDiagnosis& diagnosis) {
  return &(diagnosis.*kMember);
}

const MeshFindings* crossing(const MeshDiagnosis& diagnosis) {
  return diagnosis.selfIntersections ? &*diagnosis.selfIntersections : nullptr;
}

using D = MeshDiagnosis;
using E = FindingElements;

constexpr std::array kKinds = {
    FindingKind{member<&D::nonManifoldEdges>, E::edge, "nonManifoldEdges", "edge of more than two faces",
                "edges of more than two faces", true},
    FindingKind{member<&D::nonManifoldVertices>, E::vertices, "nonManifoldVertices",
                "vertex where several fans of faces meet", "vertices where several fans of faces meet", true},
    FindingKind{member<&D::turnedEdges>, E::edge, "turnedEdges",
                "edge whose two faces are oriented against each other",
                "edges whose two faces are oriented against each other", true},
    FindingKind{member<&D::nonOrientable>, E::edge, "nonOrientable", "part that cannot be oriented",
                "parts that cannot be oriented", true},
    FindingKind{member<&D::duplicateTriangles>, E::faces, "duplicateFaces", "duplicate face",
                "duplicate faces", true},
    FindingKind{member<&D::degenerateTriangles>, E::faces, "degenerateFaces", "face without area",
                "faces without area", true},
    FindingKind{member<&D::tJunctions>, E::vertexAndEdge, "tJunctions", "T-junction", "T-junctions", true},
    FindingKind{member<&D::nearBorders>, E::edge, "nearBorders",
                "border edge that is another one but for rounding",
                "border edges that are others but for rounding", true},
    FindingKind{crossing, E::faces, "selfIntersections", "pair of faces that cross or touch",
                "pairs of faces that cross or touch", true},
    FindingKind{member<&D::doubleSided>, E::faces, "doubleSidedFaces", "double-sided face",
                "double-sided faces", false},
    FindingKind{member<&D::doubleVertices>, E::vertices, "coincidentVertices",
                "vertex at the position of another one", "vertices at the position of another one", false},
    FindingKind{member<&D::unusedVertices>, E::vertices, "unusedVertices", "vertex without a face",
                "vertices without a face", false},
};

}  // namespace

std::span<const FindingKind> findingKinds() {
  return kKinds;
}

std::string countText(const FindingKind& kind, std::uint64_t count) {
  return grouped(count, kind.one, kind.several);
}

bool isManifold(const MeshDiagnosis& d) {
  return d.nonManifoldEdges.count == 0 && d.nonManifoldVertices.count == 0;
}

bool isClosed(const MeshDiagnosis& d) {
  return !d.components.empty() && d.borders.empty();
}

bool isOrientable(const MeshDiagnosis& d) {
  return std::ranges::all_of(d.components, &ComponentDiagnosis::isOrientable);
}

bool isSolid(const MeshDiagnosis& d) {
  return isClosed(d) && d.nonManifoldEdges.count == 0 && d.turnedEdges.count == 0 && isOrientable(d);
}

std::string verdictOf(const MeshDiagnosis& d) {
  if (d.triangles == 0) return "no faces";
  std::vector<std::string> faults;
  for (const FindingKind& kind : kKinds)
    if (const MeshFindings* found = kind.of(d); kind.isFault && found && found->count > 0)
      faults.push_back(countText(kind, found->count));
  std::string parts = grouped(d.components.size(), "component", "components");
  if (d.components.size() == 1 && d.components[0].genus)
    parts += fmt::format(", genus {}", *d.components[0].genus);
  if (!d.borders.empty()) parts += fmt::format(", {}", grouped(d.borders.size(), "border", "borders"));
  if (!isManifold(d)) return fmt::format("not manifold: {}; {}", fmt::join(faults, ", "), parts);
  std::string text = fmt::format("{}manifold, {}", isClosed(d) ? "closed " : "", parts);
  if (!faults.empty()) text += fmt::format(": {}", fmt::join(faults, ", "));
  return text;
}

}  // namespace arete
