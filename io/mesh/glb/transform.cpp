// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/glb/transform.h"

#include <fmt/format.h>

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

Result<Affine> nodeTransform(const Json& node) {
  if (node.contains("matrix")) {
    const auto m = numbersOf<16>(node, "matrix", {});
    if (!m) return tl::unexpected(m.error());
    const auto& c = *m;  // column by column
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
  const auto [x, y, z, w] = *r;
  const auto& k = *s;
  return Affine{{(1 - 2 * (y * y + z * z)) * k[0], 2 * (x * y - z * w) * k[1], 2 * (x * z + y * w) * k[2],
                 2 * (x * y + z * w) * k[0], (1 - 2 * (x * x + z * z)) * k[1], 2 * (y * z - x * w) * k[2],
                 2 * (x * z - y * w) * k[0], 2 * (y * z + x * w) * k[1], (1 - 2 * (x * x + y * y)) * k[2]},
                {(*t)[0], (*t)[1], (*t)[2]}};
}

}  // namespace arete
