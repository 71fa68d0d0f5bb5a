// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/vec.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// How much an attribute of a source has changed in a coarser mesh of it.
struct AttributeChange {
  std::string name = {};       ///< as options have it: "uv"
  std::string unit = {};       ///< AttributeDistance::unit(); "" of what is equal or not
  bool isEquality = false;     ///< labels, materials, objects, groups: `unequal` says all
  double largest = 0;          ///< the largest change found; may be infinite
  std::uint64_t compared = 0;  ///< faces of the source
  std::uint64_t unequal = 0;   ///< of these, those that are infinitely far

  bool operator==(const AttributeChange&) const = default;
};

/// A face of a source, and the triangle of the coarser mesh that stands for its middle.
struct ComparedFace {
  std::array<std::uint32_t, 3> vertices{}, wedges{};
  std::uint32_t face = 0;
  Vec3 middle;
  std::uint32_t triangle = 0;
};

/// Of every attribute that both meshes have, at the middles of faces of the source: between the mean of its
/// corners and the value at the nearest point of the triangle that stands for it. This samples the change:
/// elsewhere it may be larger. O(faces)
std::vector<AttributeChange> attributeChanges(const MeshAttributes& source, const SurfaceMesh& result,
                                              std::span<const ComparedFace> faces);

/// The same of a whole mesh, or of every second, third ... of its faces.
/// @param triangleFor by face of the source: the triangle of the result that stands for it, or
///        MeshAttributes::kNone
std::vector<AttributeChange> attributeChanges(const SurfaceMesh& source, const SurfaceMesh& result,
                                              std::span<const std::uint32_t> triangleFor,
                                              std::uint64_t mostFaces = 50'000);

}  // namespace arete
