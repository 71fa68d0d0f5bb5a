// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "datasets/asteroid.h"
#include "surface/model/surface_mesh.h"

namespace arete::shapes {

/// A closed rock with what a picture shows of a mesh: texture coordinates with a seam where x is 0, colours
/// and normals of its vertices, and two materials, of which the upper one has a picture.
inline SurfaceMesh paintedRock(std::uint32_t vertices, std::vector<std::byte> png) {
  SurfaceMesh mesh(generateAsteroid({.vertices = vertices, .seed = 4}));
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  Attribute color{
      .name = "color", .meaning = AttributeMeaning::color, .type = ScalarType::uint8, .components = 3};
  Attribute normal{.name = "normal", .meaning = AttributeMeaning::normal, .components = 3};
  for (const Vec3& p : mesh.positions) {
    const auto shade = [](double x) { return std::floor(127.5 + 127 * std::sin(9 * x)); };
    color.append(std::vector<double>{shade(p.x), shade(p.y), 255});
    const double length = norm(p);
    normal.append(std::vector<double>{p.x / length, p.y / length, p.z / length});
  }
  Attribute texcoord{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  for (std::uint32_t w = 0; w < 2 * count; ++w) {
    const Vec3& p = mesh.positions[w % count];
    texcoord.append(std::vector<double>{p.y * 2 + (w < count ? 0 : 0.5), p.z * 2});
  }
  for (const auto& triangle : mesh.triangles) {
    Vec3 middle;
    for (const std::uint32_t v : triangle) middle = middle + mesh.positions[v] / 3.0;
    mesh.materialOf.push_back(middle.z > 0 ? 0 : 1);
    mesh.wedges.push_back(triangle);
    for (std::uint32_t& w : mesh.wedges.back()) w += middle.x < 0 ? 0 : count;
  }
  mesh.vertexAttributes = {color, normal};
  mesh.wedgeAttributes = {texcoord};
  mesh.wedgeCount = 2 * count;
  mesh.materials = {{.name = "painted", .textures = {{"baseColor", "#0", 0}}},
                    {.name = "plain", .baseColor = {0.9, 0.3, 0.2, 1}}};
  mesh.pictures = {{"paint.png", "image/png", std::move(png)}};
  return mesh;
}

}  // namespace arete::shapes
