// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/formats/glb/document.h"
#include "io/formats/glb/draco.h"
#include "io/formats/glb/elements.h"
#include "io/formats/glb/reader/left_out.h"

namespace arete {

/// An attribute of the vertices of a primitive.
struct GltfAttribute {
  std::string name;          ///< as in the file: "POSITION", "TEXCOORD_0", "_HEAT"
  std::uint64_t source = 0;  ///< equal for equal elements: the accessor, or the Draco mesh and its attribute
  GltfElements elements;
};

/// A morph target that moves an attribute, with its weight.
struct GltfMorph {
  std::string name;  ///< of the attribute
  std::uint64_t accessor = 0;
  double weight = 0;
  GltfElements moves;  ///< one for each vertex
};

/// A primitive of triangles.
struct GltfPrimitive {
  enum class Mode : std::uint8_t { list = 4, strip = 5, fan = 6 };

  std::vector<GltfAttribute> attributes;  ///< positions are the first; those of skins are left out
  std::vector<GltfMorph> morphs;          ///< those with a weight
  Mode mode = Mode::list;
  std::uint64_t corners = 0;
  std::optional<GltfElements> indices;  ///< missing: 0, 1, 2, ...
  std::uint32_t material = 0xFFFFFFFF;  ///< MeshAttributes::kNone: none

  std::uint64_t vertices() const { return attributes.front().elements.count; }
  std::uint64_t triangles() const { return mode == Mode::list ? corners / 3 : corners < 3 ? 0 : corners - 2; }
  /// The vertex of a corner; at least vertices() in a damaged file.
  std::uint32_t vertexAt(std::uint64_t corner) const {
    return indices ? indices->index(corner) : static_cast<std::uint32_t>(corner);
  }
  /// The corners of a triangle, as section 3.7.2.1 of the standard says.
  std::array<std::uint64_t, 3> cornersOf(std::uint64_t triangle) const {
    if (mode == Mode::list) return {3 * triangle, 3 * triangle + 1, 3 * triangle + 2};
    if (mode == Mode::fan) return {triangle + 1, triangle + 2, 0};
    return {triangle, triangle + (1 + triangle % 2), triangle + (2 - triangle % 2)};
  }
};

/// Reads primitives, and decodes those that Draco compressed, each once.
class GltfPrimitives {
 public:
  GltfPrimitives(const GltfDocument& document, GltfLeftOut& leftOut, const RunContext& context)
      : document_(document), leftOut_(leftOut), context_(context) {}

  /// @param weights Of the morph targets; empty: all 0.
  /// @return Nothing for points, lines and what has no positions, which `leftOut` counts.
  ///
  /// Errors, without a culprit: those of readAccessor(). corrupt: another shape than the standard allows.
  /// unsupported: positions of 32-bit whole numbers.
  Result<std::optional<GltfPrimitive>> read(const nlohmann::json& primitive,
                                            const std::vector<double>& weights);

 private:
  struct Draco {
    std::uint64_t view = 0;
    std::shared_ptr<const DracoMesh> mesh;
    const nlohmann::json* attributes = nullptr;  // name -> unique id
  };

  Result<std::optional<Draco>> dracoOf(const nlohmann::json& primitive);
  Status readAttributes(const nlohmann::json& attributes, const std::optional<Draco>& draco,
                        GltfPrimitive& to);
  Result<GltfAttribute> attributeOf(const std::string& name, const nlohmann::json& attributes,
                                    const std::optional<Draco>& draco) const;
  Status readIndices(const nlohmann::json& primitive, const std::optional<Draco>& draco,
                     GltfPrimitive& to) const;
  Status readTargets(const nlohmann::json& primitive, const std::vector<double>& weights,
                     GltfPrimitive& to) const;

  const GltfDocument& document_;
  GltfLeftOut& leftOut_;
  const RunContext& context_;
  std::map<std::uint64_t, std::shared_ptr<const DracoMesh>> draco_;  // by bufferView
};

}  // namespace arete
