// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/warning.h"
#include "io/formats/glb/reader/vertex_group.h"
#include "surface/model/attribute.h"

namespace arete {

/// Puts the attributes of all groups of vertices into one list for the mesh. Numbers keep the type of the
/// file, bit by bit. Normals and tangents are turned by the nodes, then they are 32-bit floats, of length 1.
/// Where primitives have one attribute in several types, it becomes one that holds them all; where some do
/// not have it, its elements are 0, those of colors 1.
class GltfVertexAttributes {
 public:
  /// @param isOfFrame The file has Arete's frame: its normals and errors are computed from the mesh, and left
  /// out.
  explicit GltfVertexAttributes(bool isOfFrame) : isOfFrame_(isOfFrame) {}

  /// How many bytes all attributes take after add(group, first, count).
  std::uint64_t bytesAfter(const VertexGroup& group, std::uint64_t first, std::uint64_t count) const;

  /// Adds the vertices of a group that was numbered.
  ///
  /// @param first The number of its first vertex; that of the last call plus its count.
  void add(const VertexGroup& group, std::uint64_t first, std::uint64_t count);

  /// @param vertices Of the mesh.
  /// @param warnings Gets a sentence for each attribute that was completed or changed its type.
  std::vector<Attribute> finish(std::uint64_t vertices, Warnings& warnings);

 private:
  struct Column {
    std::string fileName;
    Attribute attribute;
    std::uint64_t filled = 0;  ///< elements of groups that have it
    bool hasSeveralTypes = false, isGuessed = false;
  };

  /// Where and as what the attribute of a group goes; without elements.
  Column columnOf(const VertexGroup& group, const GltfAttribute& attribute) const;
  bool isLeftOut(const GltfAttribute& attribute) const;
  Column* find(const std::string& fileName);

  bool isOfFrame_;
  std::vector<Column> columns_;
  bool hasTooMany_ = false;
};

}  // namespace arete
