// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/reader/transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace arete {

namespace {

using Json = nlohmann::json;

/// An array of exactly N numbers; `fallback` if the node does not have it.
template <std::size_t N>
Result<std::array<double, N>> numbersOf(const Json& node, const char* key, std::array<double, N> fallback) {
  const auto found = node.find(key);
  if (found == node.end()) return fallback;
  bool good = found->is_array() && found->size() == N;
  for (std::size_t i = 0; good && i < N; ++i) {
    good = (*found)[i].is_number();
    if (good) fallback[i] = (*found)[i].template get<double>();
  }
  if (good) return fallback;
  return failure(ErrorCode::corrupt, fmt::format("a node has a \"{}\" that is not {} numbers", key, N));
}

}  // namespace

bool Affine::permutesAxes() const {
  for (std::size_t r = 0; r < 3; ++r) {
    const std::array<double, 3> row{std::abs(a[3 * r]), std::abs(a[3 * r + 1]), std::abs(a[3 * r + 2])};
    if (row[0] + row[1] + row[2] != 1 || std::abs(a[r]) + std::abs(a[r + 3]) + std::abs(a[r + 6]) != 1 ||
        row[0] * (1 - row[0]) + row[1] * (1 - row[1]) != 0)
      return false;
  }
  return true;
}

Vec3 Affine::directionOf(const Vec3& v) const {
  const Vec3 turned{a[0] * v.x + a[1] * v.y + a[2] * v.z, a[3] * v.x + a[4] * v.y + a[5] * v.z,
                    a[6] * v.x + a[7] * v.y + a[8] * v.z};
  if (permutesAxes()) return turned;
  const double length = std::hypot(turned.x, turned.y, turned.z);
  if (!(length > 0) || !std::isfinite(length)) return turned;
  return {turned.x / length, turned.y / length, turned.z / length};
}

Vec3 Affine::normalOf(const Vec3& n) const {
  // The cofactors are the transposed inverse times the determinant, and exist without it.
  const double sign = mirrors() ? -1 : 1;
  const Affine cofactors{{a[4] * a[8] - a[5] * a[7], a[5] * a[6] - a[3] * a[8], a[3] * a[7] - a[4] * a[6],
                          a[2] * a[7] - a[1] * a[8], a[0] * a[8] - a[2] * a[6], a[1] * a[6] - a[0] * a[7],
                          a[1] * a[5] - a[2] * a[4], a[2] * a[3] - a[0] * a[5], a[0] * a[4] - a[1] * a[3]},
                         {}};
  return cofactors.directionOf({sign * n.x, sign * n.y, sign * n.z});
}

Affine affineOf(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                const std::array<double, 3>& scale) {
  const auto [x, y, z, w] = rotation;
  const auto& k = scale;
  return Affine{{(1 - 2 * (y * y + z * z)) * k[0], 2 * (x * y - z * w) * k[1], 2 * (x * z + y * w) * k[2],
                 2 * (x * y + z * w) * k[0], (1 - 2 * (x * x + z * z)) * k[1], 2 * (y * z - x * w) * k[2],
                 2 * (x * z - y * w) * k[0], 2 * (y * z + x * w) * k[1], (1 - 2 * (x * x + y * y)) * k[2]},
                {translation[0], translation[1], translation[2]}};
}

Result<UnitRotation> unitRotation(const std::array<double, 4>& q) {
  // Scaled first, so that squares neither overflow nor vanish.
  double largest = 0;
  for (const double part : q) largest = std::isnan(part) ? part : std::max(largest, std::abs(part));
  if (!(largest > 0) || !std::isfinite(largest))
    return failure(ErrorCode::corrupt,
                   largest == 0 ? "a rotation that is 0, 0, 0, 0" : "a rotation that is not finite");
  double square = 0;
  for (const double part : q) square += (part / largest) * (part / largest);
  const double length = largest * std::sqrt(square);
  UnitRotation unit{.quaternion = q, .isFar = std::abs(length - 1) > kRotationSlack};
  constexpr double kOfDoubles = 4e-16;
  if (std::abs(length - 1) > kOfDoubles)
    for (double& part : unit.quaternion) part = part / largest / std::sqrt(square);
  return unit;
}

Result<Affine> nodeTransform(const Json& node, std::uint64_t& farRotations) {
  if (node.contains("matrix")) {
    ARETE_TRY(const auto m, numbersOf<16>(node, "matrix", {}));
    const auto& c = m;  // column by column
    if (c[3] != 0 || c[7] != 0 || c[11] != 0 || c[15] != 1)
      return failure(ErrorCode::corrupt, "a node has a matrix that is not affine");
    return Affine{{c[0], c[4], c[8], c[1], c[5], c[9], c[2], c[6], c[10]}, {c[12], c[13], c[14]}};
  }
  const auto t = numbersOf<3>(node, "translation", {0, 0, 0});
  const auto r = numbersOf<4>(node, "rotation", {0, 0, 0, 1});
  const auto s = numbersOf<3>(node, "scale", {1, 1, 1});
  if (!t) return tl::unexpected(t.error());
  if (!r) return tl::unexpected(r.error());
  if (!s) return tl::unexpected(s.error());
  const Result<UnitRotation> unit = unitRotation(*r);
  if (!unit) return failure(unit.error().code, "has " + unit.error().message);
  farRotations += unit->isFar ? 1 : 0;
  return affineOf(*t, unit->quaternion, *s);
}

}  // namespace arete
