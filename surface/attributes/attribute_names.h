// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// One thing that a mesh says beside its shape, as options name it.
struct NamedAttribute {
  enum class Of { vertices, wedges, triangles, materials, objects, groups };

  /// "uv", "uv2" (the second set), "color", "normal", "material", "object", "group", or the file's own.
  std::string name;
  std::string inFile;  ///< "texcoord1" of "uv2"; "materials" of "material"
  Of of = Of::vertices;
  std::size_t index = 0;  ///< of an attribute, among those of the same elements

  bool operator==(const NamedAttribute&) const = default;
};

/// The name that options have for an attribute of a file.
std::string optionNameOf(std::string_view inFile);

/// All that a mesh has: attributes of vertices, wedges and triangles, then materials, objects and groups.
/// Where wedges and vertices have one of the same name, each counts.
std::vector<NamedAttribute> namedAttributes(const MeshAttributes& mesh);

/// All of a name, or of a file's own name. Errors: usage, with the name as culprit: the mesh lacks it; lists
/// the names that there are.
Result<std::vector<NamedAttribute>> findAttributes(const MeshAttributes& mesh, std::string_view name);

/// An attribute and a number for it, as a list of options states them.
struct AttributeNumber {
  std::string name;
  double number = 0;
  std::string unit = {};  ///< what is behind the number: "px", or empty

  bool operator==(const AttributeNumber&) const = default;
};

/// Reads "uv:2px,normal:10,color:8". Names may have colons: the number is behind the last one. Errors: usage,
/// with the part that is wrong as culprit: no number, one that is negative or not finite, an unknown unit, a
/// name twice.
Result<std::vector<AttributeNumber>> parseAttributeNumbers(std::string_view list);

}  // namespace arete
