// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/base/triangle_mesh.h"
#include "io/formats/glb/writer/framed.h"
#include "surface/model/attribute.h"

namespace arete {

/// An attribute of vertices as glTF holds it.
struct GltfValues {
  std::string semantic;      ///< "NORMAL", "TEXCOORD_0", "_QUALITY"
  std::string name;          ///< of the attribute, where the semantic does not say it; else empty
  Attribute values;          ///< of a type and with components that glTF has, in its conventions
  bool isQuantized = false;  ///< its type is one of KHR_mesh_quantization
};

/// The attributes of the vertices of a mesh.
struct GltfVertexValues {
  std::vector<GltfValues> values;
  std::set<std::string> leftOut;  ///< names of attributes that glTF cannot hold at all
  std::vector<std::string> lost;  ///< what the others lose, as in MeshWriteReport
  /// By set of the mesh, the set of the glTF, where these are numbered from 0 without gaps.
  std::map<std::uint32_t, std::uint32_t> textureSets;
};

/// How directions are written.
enum class GltfDirections : std::uint8_t {
  asTheyAre,
  turned,      ///< from z up to y up
  recomputed,  ///< normals are made from the triangles, tangents are left out
};

/// Converts the attributes of vertices: texture coordinates are counted from the upper side, colors are
/// linear, normals and tangents have unit length, numbers are finite; 32-bit integers take 16 bits if these
/// hold all values, else 32-bit floats if these do; doubles become 32-bit floats.
///
/// @param attributes Moved from.
/// @param positions As written; with the triangles they give normals where the mesh has unusable ones.
/// O(size).
GltfVertexValues gltfVertexValues(std::vector<Attribute> attributes, const TriangleMesh& mesh,
                                  const std::vector<Float3>& positions, GltfDirections directions);

}  // namespace arete
