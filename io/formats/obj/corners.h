// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/formats/common/file.h"

namespace arete {

/// The texture coordinates and normals of an OBJ, and its corners: which of them each corner names. Corners
/// that name the same vertex, texture coordinates and normal are one wedge.
class ObjCorners {
 public:
  static constexpr std::uint32_t kNone = MeshAttributes::kNone;
  /// Indices from 0; kNone: the corner names none. They may be named before they are listed.
  struct Corner {
    std::uint32_t vertex = 0, texcoord = kNone, normal = kNone;
    bool operator==(const Corner&) const = default;
  };

  /// One to three numbers.
  void addTexcoord(std::span<const double> numbers);
  void addNormal(const std::array<double, 3>& numbers);
  std::uint32_t texcoordCount() const { return static_cast<std::uint32_t>(texcoords_.size() / 3); }
  std::uint32_t normalCount() const { return static_cast<std::uint32_t>(normals_.size() / 3); }

  /// Whether some corner so far has named more than a vertex. From the first such corner on, every triangle
  /// of the mesh has wedges.
  bool hasWedges() const { return hasWedges_; }
  /// Gives wedges to the triangles so far, whose corners name vertices alone.
  void begin(SurfaceMesh& mesh);
  /// Expected O(1). Precondition: fewer than 2^32 - 1 distinct corners.
  std::uint32_t wedgeOf(const Corner& corner);
  std::size_t wedgeCount() const { return corners_.size(); }

  /// Makes the wedges and their attributes of the mesh. An index beyond the lists counts as a missing one,
  /// with a warning. Where some corners have a value and others lack it, these get zeros, since the model
  /// knows no gaps and a NaN would spread. O(wedges).
  void finish(MeshFile& file);

 private:
  void grow(std::size_t slots);

  std::vector<double> texcoords_, normals_;  // three numbers for each
  int texcoordNumbers_ = 2;
  bool hasWedges_ = false;
  std::vector<Corner> corners_;  // by wedge
  std::vector<std::uint32_t>
      slots_;  // open addressing; a power of two of them, at most half of them occupied
};

}  // namespace arete
