// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// Collects the attributes of the corners of faces, which a PLY has in lists of each face ("texcoord": two
/// numbers for each corner), and joins corners at one vertex that agree in all of them into wedges.
class PlyCorners {
 public:
  /// @param attributes Without values. Their components are 0 where the first list says how many there are.
  /// @param mostFill Bytes that lists of the wrong length may be replaced by: a bound on memory.
  PlyCorners(std::vector<Attribute> attributes, std::size_t mostFill);

  bool isEmpty() const { return lists_.empty(); }

  /// The bytes of a list of the face that is read, to be filled before addFace().
  std::vector<std::byte>& values(std::size_t list) { return lists_[list].values; }
  void clearValues();

  /// @param vertices At least three.
  /// @return Numbers of the corners, which stand for wedges until join(). Errors: unsupported, without
  /// culprit: more corners than numbers.
  Result<std::span<const std::uint32_t>> addFace(std::span<const std::uint32_t> vertices, std::uint64_t face);

  /// Replaces the corners in mesh.wedges by wedges, in the order of their first corners. Lists that fit no
  /// face are left out, named in `warnings` with those of the wrong length. O(corners) expected.
  void join(SurfaceMesh& mesh, Warnings& warnings);

 private:
  struct List {
    Attribute attribute;            // of all corners
    std::vector<std::byte> values;  // of the face that is read
    std::uint64_t misfits = 0, firstMisfit = 0;
    bool hadValues = false, isDropped = false;
  };
  void take(List& list, std::size_t corners, std::uint64_t face);

  std::vector<List> lists_;
  std::vector<std::uint32_t> vertexOf_;  // by corner
  std::vector<std::uint32_t> numbers_;   // of the face that was added
  std::size_t fill_ = 0, mostFill_;
};

}  // namespace arete
