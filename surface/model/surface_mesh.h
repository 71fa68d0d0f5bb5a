// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/triangle_mesh.h"
#include "surface/model/attribute.h"

namespace arete {

/// A texture of a material.
struct TextureUse {
  std::string role;                 ///< baseColor, normal, emissive, occlusion,
                                    ///< metallicRoughness, or an MTL key ("map_Kd")
  std::string picture;              ///< its path, relative to the mesh's file; or "#" and
                                    ///< its number among the mesh's pictures
  std::uint32_t textureCoords = 0;  ///< which set of texture coordinates
  bool operator==(const TextureUse&) const = default;
};

/// What surfaces are made of. What only one format has is kept as that format
/// writes it.
struct Material {
  std::string name;
  std::array<double, 4> baseColor{1, 1, 1, 1};  ///< linear; with alpha
  bool isDoubleSided = false;
  std::string alphaMode = "OPAQUE";  ///< OPAQUE, MASK or BLEND
  double alphaCutoff = 0.5;
  std::vector<TextureUse> textures = {};
  /// By format ("mtl", "gltf"): the statements of the file, to be written to
  /// the same format again.
  std::map<std::string, std::string> verbatim = {};
  bool operator==(const Material&) const = default;
};

/// A picture that came inside the mesh's file.
struct EmbeddedPicture {
  std::string name, mimeType;
  std::vector<std::byte> bytes;
  bool operator==(const EmbeddedPicture&) const = default;
};

/// Everything that a file says of a triangle mesh but its positions and triangles.
///
/// A wedge is what corners at one vertex share that have the same attributes: a texture seam splits the
/// corners of a vertex into two wedges. Attributes of corners belong to wedges; without any, `wedges` is
/// empty.
struct MeshAttributes {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::vector<Attribute> vertexAttributes = {}, wedgeAttributes = {}, triangleAttributes = {};

  std::uint32_t wedgeCount = 0;
  /// By triangle: the wedges of its corners. Empty, or one for each triangle.
  std::vector<std::array<std::uint32_t, 3>> wedges = {};

  /// By triangle: the number in the file, from 0, of the face it is a part of. Empty: triangles are the
  /// faces.
  std::vector<std::uint32_t> faceOf = {};

  std::vector<std::string> objects = {}, groups = {};
  /// By triangle, kNone: in none; empty: none is.
  std::vector<std::uint32_t> objectOf = {}, groupOf = {};

  std::vector<Material> materials = {};
  std::vector<std::uint32_t> materialOf = {};  ///< by triangle, kNone: none; empty: none has one
  std::vector<EmbeddedPicture> pictures = {};

  bool hasWedges() const { return !wedges.empty(); }

  bool operator==(const MeshAttributes&) const = default;
};

/// A triangle mesh with everything that its file says of it.
struct SurfaceMesh : TriangleMesh, MeshAttributes {
  SurfaceMesh() = default;
  explicit SurfaceMesh(TriangleMesh mesh) : TriangleMesh(std::move(mesh)) {}

  /// Positions and triangles alone.
  TriangleMesh& shape() { return *this; }
  const TriangleMesh& shape() const { return *this; }

  /// Checks the triangles, the sizes of all arrays, and every index. Errors: invalidData. O(size).
  Status validate() const;

  bool operator==(const SurfaceMesh&) const = default;
};

/// Refers to a mesh with attributes or without. Valid as long as the mesh is.
struct MeshRef {
  const TriangleMesh& shape;
  const MeshAttributes& attributes;

  MeshRef(const TriangleMesh& mesh);  // NOLINT(google-explicit-constructor): without attributes
  MeshRef(const SurfaceMesh& mesh) : shape(mesh), attributes(mesh) {}  // NOLINT(google-explicit-constructor)

  /// As SurfaceMesh::validate().
  Status validate() const;
};

}  // namespace arete
