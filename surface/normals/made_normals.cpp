// SPDX-License-Identifier: GPL-3.0-or-later
//
// Corners with one normal and one former wedge become one wedge.
#include "surface/normals/made_normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "surface/model/wedges.h"
#include "surface/normals/smooth_corners.h"

namespace arete {
namespace {

bool isDirectionAttribute(const Attribute& a) {
  return a.meaning == AttributeMeaning::normal || a.meaning == AttributeMeaning::tangent;
}

/// By corner: the normal that the mesh states, zero where it states none; empty without normals.
std::vector<Vec3> statedNormals(const SurfaceMesh& mesh) {
  const auto find = [](const std::vector<Attribute>& list) {
    return std::ranges::find_if(list, [](const Attribute& a) {
      return a.meaning == AttributeMeaning::normal && a.name == kNormalName && a.components == 3;
    });
  };
  const auto ofWedges = find(mesh.wedgeAttributes), ofVertices = find(mesh.vertexAttributes);
  const bool isOfWedges = mesh.hasWedges() && ofWedges != mesh.wedgeAttributes.end();
  if (!isOfWedges && ofVertices == mesh.vertexAttributes.end()) return {};
  const Attribute& attribute = isOfWedges ? *ofWedges : *ofVertices;
  std::vector<Vec3> stated;
  stated.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<double> n = attribute.numbers(isOfWedges ? mesh.wedges[t][k] : mesh.triangles[t][k]);
      const Vec3 v{n[0], n[1], n[2]};
      stated.push_back(isFinite(v) ? v : Vec3{});
    }
  return stated;
}

/// Whether nearly all triangles have one normal at their corners.
bool areAllFlat(std::span<const Vec3> stated) {
  constexpr double kOfRounding = 0.1, kNearlyAllFaces = 0.95;  // degrees, a share
  std::size_t flat = 0;
  for (std::size_t c = 0; c < stated.size(); c += 3)
    flat +=
        !isCrease(stated[c], stated[c + 1], kOfRounding) && !isCrease(stated[c], stated[c + 2], kOfRounding);
  return double(flat) >= kNearlyAllFaces * double(stated.size()) / 3;
}

Attribute normalAttribute() {
  return {.name = std::string(kNormalName),
          .meaning = AttributeMeaning::normal,
          .type = ScalarType::float32,
          .components = 3};
}

/// A zero has no sign, so that equal normals are equal to the bit.
void appendNormal(Attribute& to, const Vec3& n) {
  const std::array<double, 3> numbers{n.x + 0.0, n.y + 0.0, n.z + 0.0}, up{0, 0, 1};
  to.append(std::span<const double>(norm(n) > 0 ? numbers : up));
}

/// Gives corners these normals; the former ones are left out before.
void putNormals(SurfaceMesh& mesh, const CornerNormals& made) {
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  // a former wedge and a normal
  std::vector<Pair> pairs;
  const auto pairAt = [&](std::size_t t, std::size_t k) {
    return Pair(mesh.hasWedges() ? mesh.wedges[t][k] : 0, made.normalOf[t][k]);
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) pairs.push_back(pairAt(t, k));
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Attribute> attributes;
  for (const Attribute& old : mesh.wedgeAttributes) {
    attributes.push_back(emptyLike(old));
    for (const Pair& p : pairs) attributes.back().append(old.element(p.first));
  }
  attributes.push_back(normalAttribute());
  for (const Pair& p : pairs) appendNormal(attributes.back(), made.normals[p.second]);
  std::vector<std::array<std::uint32_t, 3>> wedges(mesh.triangles.size());
  for (std::size_t t = 0; t < wedges.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      wedges[t][k] =
          static_cast<std::uint32_t>(std::ranges::lower_bound(pairs, pairAt(t, k)) - pairs.begin());
  mesh.wedges = std::move(wedges);
  mesh.wedgeCount = static_cast<std::uint32_t>(pairs.size());
  mesh.wedgeAttributes = std::move(attributes);
  moveToVertices(mesh);
}

/// Vertices without a face have zeros, which are no direction.
void pointUnusedUpwards(SurfaceMesh& mesh) {
  for (Attribute& a : mesh.vertexAttributes) {
    if (a.meaning != AttributeMeaning::normal) continue;
    Attribute pointed = emptyLike(a);
    for (std::size_t v = 0; v < a.elementCount(); ++v) {
      const std::vector<double> n = a.numbers(v);
      appendNormal(pointed, {n[0], n[1], n[2]});
    }
    a = std::move(pointed);
  }
}

}  // namespace

Result<MadeNormals> makeNormals(SurfaceMesh& mesh, const NormalsOptions& options) try {
  if (!(options.creaseAngleDegrees >= 0 && options.creaseAngleDegrees <= 180))
    return failure(ErrorCode::usage, "must be an angle of 0 to 180 degrees",
                   fmt::format("creaseAngleDegrees {}", options.creaseAngleDegrees));
  MadeNormals made;
  if (options.kind == NormalsKind::keep) return made;
  ARETE_CHECK(mesh.validate());
  std::vector<Vec3> stated = statedNormals(mesh);
  if (areAllFlat(stated)) stated.clear();
  const CornerNormals normals = options.kind == NormalsKind::flat
                                    ? flatCorners(mesh)
                                    : smoothCorners(mesh, options.creaseAngleDegrees, stated);
  for (auto* list : {&mesh.vertexAttributes, &mesh.wedgeAttributes}) {
    made.leavesOutTangents |=
        std::ranges::any_of(*list, [](const Attribute& a) { return a.meaning == AttributeMeaning::tangent; });
    std::erase_if(*list, isDirectionAttribute);
  }
  if (mesh.wedgeAttributes.empty()) {
    mesh.wedges.clear();
    mesh.wedgeCount = 0;
  }
  putNormals(mesh, normals);
  pointUnusedUpwards(mesh);
  return made;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
