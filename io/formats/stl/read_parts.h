// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the readers of binary and of ASCII STL share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "io/formats/common/file.h"
#include "io/geo/crs/local_origin.h"

namespace arete {

constexpr std::size_t kStlHeaderSize = 80, kStlPreambleSize = 84, kStlRecordSize = 50;
constexpr std::size_t kStlTrianglesPerCancelCheck = 1 << 16;
constexpr std::uint64_t kMostStlTriangles = std::numeric_limits<std::uint32_t>::max() / 3;
/// What Arete's headers begin with. The second is before the name of an object.
constexpr std::string_view kStlOriginKey = "arete origin ", kStlObjectKey = "arete object ";
/// Before a place of the source that the coordinates are metres from (MeshFile::metresAbout).
constexpr std::string_view kStlMetresKey = "arete metres_about ";

/// @param file of at least kStlPreambleSize bytes and all of its triangles.
Result<MeshFile> readBinaryStl(std::string_view file, std::uint32_t count, std::string path,
                               const RunContext& context);
Result<MeshFile> readAsciiStl(std::string_view file, std::string path, const RunContext& context);

/// Whether a word is `lower` in any case.
inline bool equalsStlWord(std::string_view a, std::string_view lower) {
  return std::ranges::equal(a, lower,
                            [](char c, char d) { return (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) == d; });
}

/// Takes the triangles of an STL, with vertices of their own.
class StlTriangles {
 public:
  void reserve(std::size_t triangles) {
    mesh_.positions.reserve(3 * triangles);
    mesh_.triangles.reserve(triangles);
  }
  std::size_t size() const { return mesh_.triangles.size(); }

  /// @param corners before the origin is added.
  void add(const std::array<Vec3, 3>& corners, const Vec3& origin, const Vec3& normal) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const Vec3& p : corners) {
      largest_ = {std::max(largest_.x, std::abs(p.x)), std::max(largest_.y, std::abs(p.y)),
                  std::max(largest_.z, std::abs(p.z))};
      mesh_.positions.push_back({origin.x + p.x, origin.y + p.y, origin.z + p.z});
    }
    mesh_.triangles.push_back({first, first + 1, first + 2});
    compare(corners, normal);
  }

  /// Sets the mesh of the file and its rounding, and warns of normals that most facets contradict.
  void finish(MeshFile& file, const Vec3& origin);

 private:
  /// Counts normals that the turn of the corners contradicts. What is no unit vector is no normal.
  void compare(const std::array<Vec3, 3>& c, const Vec3& n) {
    const double length = n.x * n.x + n.y * n.y + n.z * n.z;
    if (!(length > 0.5 && length < 2)) return;
    const Vec3 a{c[1].x - c[0].x, c[1].y - c[0].y, c[1].z - c[0].z};
    const Vec3 b{c[2].x - c[0].x, c[2].y - c[0].y, c[2].z - c[0].z};
    const Vec3 m{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    const double along = m.x * n.x + m.y * n.y + m.z * n.z;
    // Within some degrees of the plane a normal is noise.
    if (along < 0 && along * along > 0.01 * (m.x * m.x + m.y * m.y + m.z * m.z)) ++against_;
  }

  TriangleMesh mesh_;
  Vec3 largest_;  // |coordinate| of each axis
  std::size_t against_ = 0;
};

}  // namespace arete
