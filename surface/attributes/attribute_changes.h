// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// How much an attribute of a source has changed in a coarser mesh of it.
struct AttributeChange {
  std::string name;            ///< as options have it: "uv"
  std::string unit;            ///< AttributeDistance::unit(); "" of what is equal or not
  bool isEquality = false;     ///< labels, materials, objects, groups: `unequal` says all
  double largest = 0;          ///< the largest change found; may be infinite
  std::uint64_t compared = 0;  ///< vertices, corners or faces of the source
  std::uint64_t unequal = 0;   ///< of these, those that are infinitely far

  bool operator==(const AttributeChange&) const = default;
};

/// Of every attribute that both meshes have, at the vertices of the source: between its value there and that
/// at the nearest point of the triangle that stands for a face around it; of several such faces the least
/// change counts, so each side of a seam is compared with its own. This samples the change: between the
/// vertices it may be larger. O(faces of the source)
/// @param triangleFor by face of the source: the triangle of the result that stands for it, or
///        MeshAttributes::kNone
/// @param mostVertices of a larger source every second, third ... vertex is looked at
std::vector<AttributeChange> attributeChanges(const SurfaceMesh& source, const SurfaceMesh& result,
                                              std::span<const std::uint32_t> triangleFor,
                                              std::uint64_t mostVertices = 100'000);

}  // namespace arete
