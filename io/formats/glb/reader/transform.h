// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "engine/base/result.h"
#include "engine/base/vec.h"

namespace arete {

/// The affine map x -> a x + t.
struct Affine {
  std::array<double, 9> a = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // row by row
  Vec3 t;

  Vec3 operator()(const Vec3& p) const {
    return {a[0] * p.x + a[1] * p.y + a[2] * p.z + t.x, a[3] * p.x + a[4] * p.y + a[5] * p.z + t.y,
            a[6] * p.x + a[7] * p.y + a[8] * p.z + t.z};
  }
  /// The composition: first `inner`, then this.
  Affine after(const Affine& inner) const {
    Affine result;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        result.a[3 * r + c] =
            a[3 * r] * inner.a[c] + a[3 * r + 1] * inner.a[3 + c] + a[3 * r + 2] * inner.a[6 + c];
    result.t = (*this)(inner.t);
    return result;
  }
  /// True if the determinant is negative: the map turns triangles over.
  bool mirrors() const {
    return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
               a[2] * (a[3] * a[7] - a[4] * a[6]) <
           0;
  }
  bool isIdentity() const { return *this == Affine{}; }
  /// True if directions are the same before and after: the map moves and enlarges.
  bool keepsDirections() const {
    return a[0] > 0 && a[0] == a[4] && a[0] == a[8] && a[1] == 0 && a[2] == 0 && a[3] == 0 && a[5] == 0 &&
           a[6] == 0 && a[7] == 0;
  }
  /// The direction of a vector after the map, of length 1; 0 and what is not finite stay.
  Vec3 directionOf(const Vec3& v) const;
  /// That of a normal, by the transposed inverse. Where that does not exist, the limit of those that do.
  Vec3 normalOf(const Vec3& n) const;

  /// True if every axis becomes an axis: numbers are exchanged and turned in sign, without rounding.
  bool permutesAxes() const;

  bool operator==(const Affine&) const = default;
};

/// A rotation of length 1, and whether the one of the file is far from it.
struct UnitRotation {
  std::array<double, 4> quaternion{0, 0, 0, 1};
  bool isFar = false;  ///< the length is further than kRotationSlack from 1
};

/// What rounding to the digits and the types of files may do to the length of a rotation.
inline constexpr double kRotationSlack = 0.01;

/// A quaternion divided by its length, which the standard wants to be 1. One that is 1 but for the rounding
/// of doubles stays to the bit. Errors: corrupt: its length is 0 or not finite.
Result<UnitRotation> unitRotation(const std::array<double, 4>& quaternion);

/// The map that turns by a quaternion (x, y, z, w) of length 1 after scaling, and moves. Not checked.
Affine affineOf(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                const std::array<double, 3>& scale);

/// The transform of a glTF node: its matrix, or its translation, rotation and scale.
/// Errors: corrupt: a wrong count of numbers, a matrix that is not affine; those of unitRotation().
/// @param farRotations counts a rotation whose length is far from 1.
Result<Affine> nodeTransform(const nlohmann::json& node, std::uint64_t& farRotations);

}  // namespace arete
