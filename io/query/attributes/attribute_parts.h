// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "surface/attributes/attribute_names.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// Numbers for names, the same for the same name in several meshes.
class NumbersForNames {
 public:
  /// By triangle: the number of the name of its material, object or group; one more for no name.
  std::vector<std::uint32_t> of(const SurfaceMesh& mesh, NamedAttribute::Of kind);

 private:
  std::map<std::string, std::uint32_t> numbers_;
};

/// By triangle of two meshes: which material and object it belongs to, by their names. kNoPart in the source
/// where the other mesh has no triangle of these.
struct AttributeParts {
  std::vector<std::uint32_t> ofSource, ofOther;
};
AttributeParts partsByName(const SurfaceMesh& source, const SurfaceMesh& other);

}  // namespace arete
