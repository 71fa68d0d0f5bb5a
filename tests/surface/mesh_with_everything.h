// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "surface/families.h"
#include "surface/model/surface_mesh.h"

namespace arete::shapes {

/// A surface with everything that a mesh can have.
inline SurfaceMesh everything(bool hasDoubles, std::uint32_t side = 16) {
  SurfaceMesh mesh(hills(side, 3));
  if (!hasDoubles)
    for (Vec3& p : mesh.positions) p = {float(p.x), float(p.y), float(p.z)};
  Attribute quality{.name = "quality", .type = ScalarType::float64};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    quality.append(std::vector<double>{1.0 / double(v + 1)});
  mesh.vertexAttributes = {quality};
  Attribute label{.name = "label", .type = ScalarType::int16, .components = 2};
  Attribute texcoord{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    label.append(std::vector<double>{double(t / 128) - 100, 7});  // lines between blocks
    mesh.wedges.push_back(mesh.triangles[t]);
    mesh.objectOf.push_back(t % 2 == 0 ? 0 : MeshAttributes::kNone);
    mesh.materialOf.push_back(mesh.positions[mesh.triangles[t][0]].x < 8 ? 0 : 1);
    mesh.groupOf.push_back(static_cast<std::uint32_t>(t % 3));
    mesh.faceOf.push_back(static_cast<std::uint32_t>(t / 2));
  }
  std::ranges::fill(mesh.objectOf, 0u);
  mesh.wedgeCount = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t w = 0; w < mesh.wedgeCount; ++w) texcoord.append(std::vector<double>{double(w) / 7, 0.25});
  mesh.wedgeAttributes = {texcoord};
  mesh.triangleAttributes = {label};
  mesh.objects = {"a \"quoted\" one"};
  mesh.groups = {"g0", "g1", std::string("\xff\xfe not UTF-8")};
  mesh.materials = {{.name = "stone", .textures = {{"baseColor", "#0", 0}}, .verbatim = {{"mtl", "Ns 10\n"}}},
                    {.name = "grass", .baseColor = {0.1, 0.2, 1.0 / 3, 0.5}, .alphaMode = "BLEND"}};
  mesh.pictures = {{"stone.png", "image/png", {std::byte{1}, std::byte{2}, std::byte{0}}}};
  return mesh;
}

}  // namespace arete::shapes
