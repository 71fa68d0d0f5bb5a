// SPDX-License-Identifier: GPL-3.0-or-later
//
// The corners at a vertex are few, so each direction is compared with the different ones before it.
#include "surface/edit/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "surface/edit/joined_surface.h"
#include "surface/model/wedges.h"

namespace arete {
namespace {

bool isDirection(const Attribute& a) {
  return (a.meaning == AttributeMeaning::normal && a.components == 3) ||
         (a.meaning == AttributeMeaning::tangent && a.components == 4);
}

/// As directions of length 1, and the sign of a tangent.
struct Direction {
  Vec3 v;
  double sign = 0;
};

Direction directionAt(const Attribute& attribute, std::uint32_t element) {
  const std::vector<double> numbers = attribute.numbers(element);
  Vec3 v{numbers[0], numbers[1], numbers[2]};
  const double length = std::hypot(v.x, v.y, v.z);
  if (length > 0 && std::isfinite(length)) v = {v.x / length, v.y / length, v.z / length};
  return {v, numbers.size() > 3 ? numbers[3] : 0};
}

bool agree(const Direction& a, const Direction& b, double tolerance) {
  const double apart = std::hypot(a.v.x - b.v.x, a.v.y - b.v.y, a.v.z - b.v.z);
  return apart <= tolerance && a.sign == b.sign;
}

/// By vertex: its wedges, each once, in the order of the corners.
class WedgesOfVertices {
 public:
  explicit WedgesOfVertices(const SurfaceMesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) pairs_.emplace_back(mesh.triangles[t][k], mesh.wedges[t][k]);
    std::ranges::sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  }
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs() const { return pairs_; }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

/// At most so many different directions of a vertex are compared.
constexpr std::size_t kMostLeaders = 64;

void joinAt(Attribute& attribute, const WedgesOfVertices& wedges) {
  struct Leader {
    Direction direction;
    std::uint32_t wedge;
  };
  std::vector<Leader> leaders;
  std::uint32_t vertex = MeshAttributes::kNone;
  const std::size_t size = attribute.elementBytes();
  for (const auto& [v, w] : wedges.pairs()) {
    if (v != vertex) leaders.clear();
    vertex = v;
    const Direction direction = directionAt(attribute, w);
    const auto same = std::ranges::find_if(
        leaders, [&](const Leader& l) { return agree(l.direction, direction, kSameDirection); });
    if (same == leaders.end()) {
      if (leaders.size() < kMostLeaders) leaders.push_back({direction, w});
      continue;
    }
    std::memcpy(attribute.values.data() + w * size, attribute.values.data() + same->wedge * size, size);
  }
}

/// Whether some wedge is at several vertices: then what one vertex says of it is not for the others.
bool sharesWedges(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> vertexOf(mesh.wedgeCount, MeshAttributes::kNone);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& vertex = vertexOf[mesh.wedges[t][k]];
      if (vertex != MeshAttributes::kNone && vertex != mesh.triangles[t][k]) return true;
      vertex = mesh.triangles[t][k];
    }
  return false;
}

/// Whether the corners of nearly all triangles have one normal each. The file's rounding counts as equal.
bool areOfFlatFaces(const SurfaceMesh& mesh) {
  constexpr double kOfRounding = 2e-3, kNearlyAll = 0.95;
  std::uint64_t flat = 0;
  for (const Attribute& attribute : mesh.wedgeAttributes) {
    if (attribute.meaning != AttributeMeaning::normal || attribute.components != 3) continue;
    for (const auto& wedges : mesh.wedges) {
      const Direction first = directionAt(attribute, wedges[0]);
      flat += agree(first, directionAt(attribute, wedges[1]), kOfRounding) &&
              agree(first, directionAt(attribute, wedges[2]), kOfRounding);
    }
    return double(flat) >= kNearlyAll * double(mesh.wedges.size());
  }
  return true;  // tangents alone
}

}  // namespace

std::uint64_t joinAgreeingNormals(SurfaceMesh& mesh) {
  if (!mesh.hasWedges() || std::ranges::none_of(mesh.wedgeAttributes, isDirection)) return 0;
  const std::uint32_t before = mesh.wedgeCount;
  if (sharesWedges(mesh)) moveToWedges(mesh);
  const WedgesOfVertices wedges(mesh);
  for (Attribute& attribute : mesh.wedgeAttributes)
    if (isDirection(attribute)) joinAt(attribute, wedges);
  moveToVertices(mesh);
  return mesh.wedgeCount < before ? before - mesh.wedgeCount : 0;
}

bool dropFlatNormals(SurfaceMesh& mesh) {
  const auto isNormal = [](const Attribute& a) {
    return a.meaning == AttributeMeaning::normal || a.meaning == AttributeMeaning::tangent;
  };
  if (!mesh.hasWedges() || std::ranges::none_of(mesh.wedgeAttributes, isNormal)) return false;
  const std::uint64_t edges = 3 * std::uint64_t{mesh.triangles.size()} / 2;
  if (2 * countSeamEdges(mesh) <= edges || !areOfFlatFaces(mesh)) return false;
  SurfaceMesh without = mesh;
  std::erase_if(without.wedgeAttributes, isNormal);
  moveToVertices(without);
  if (2 * countSeamEdges(without) > edges) return false;
  mesh = std::move(without);
  return true;
}

std::vector<SeamAttribute> seamAttributes(const SurfaceMesh& mesh) {
  std::vector<SeamAttribute> seams;
  if (!mesh.hasWedges()) return seams;
  for (const Attribute& attribute : mesh.wedgeAttributes) {
    SurfaceMesh alone(mesh.shape());
    alone.wedges = mesh.wedges;
    alone.wedgeCount = mesh.wedgeCount;
    alone.wedgeAttributes = {attribute};
    moveToVertices(alone);
    if (const std::uint64_t edges = countSeamEdges(alone); edges > 0)
      seams.push_back({attribute.name, edges});
  }
  std::ranges::stable_sort(seams,
                           [](const SeamAttribute& a, const SeamAttribute& b) { return a.edges > b.edges; });
  return seams;
}

}  // namespace arete
