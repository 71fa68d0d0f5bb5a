// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checksum is XXH3 with 128 bits over the shape, the positions and the heights; every NaN is replaced by
// the same one, and -0 by 0, so that the file format does not change the checksum.
#include "terrain/model/heightfield.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <limits>
#include <memory>
#include <new>

#include "engine/base/caught_failure.h"

namespace arete {

Status RasterHeightfield::validate() const try {
  if (heights.size() != std::size_t(columns) * rows)
    return failure(ErrorCode::invalidData,
                   fmt::format("{} heights for {} columns and {} rows", heights.size(), columns, rows),
                   source);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (std::isinf(heights[i]))
      return failure(ErrorCode::invalidData,
                     fmt::format("the height at column {}, row {} is infinite", i % columns, i / columns),
                     source);
  const double determinant = georeference.determinant();
  if (determinant == 0 || !std::isfinite(determinant))
    return failure(ErrorCode::invalidData, "the geotransform is not invertible", source);
  return {};
} catch (...) {
  return caughtFailure();
}

Status PointHeightfield::validate() const try {
  if (heights.size() != positions.size())
    return failure(ErrorCode::invalidData,
                   fmt::format("{} heights for {} positions", heights.size(), positions.size()), source);
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!std::isfinite(heights[i]) || !std::isfinite(positions[i].x) || !std::isfinite(positions[i].y))
      return failure(ErrorCode::invalidData, fmt::format("point {} has a coordinate that is not finite", i),
                     source);
  return {};
} catch (...) {
  return caughtFailure();
}

namespace {

struct StateDeleter {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

std::string checksumOf(std::uint64_t a, std::uint64_t b, const std::vector<Vec2>& positions,
                       const std::vector<double>& heights) {
  const std::unique_ptr<XXH3_state_t, StateDeleter> state(XXH3_createState());
  if (!state) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  const std::uint64_t shape[2] = {a, b};
  XXH3_128bits_update(state.get(), shape, sizeof shape);
  if (!positions.empty()) XXH3_128bits_update(state.get(), positions.data(), positions.size() * sizeof(Vec2));
  constexpr std::size_t kChunk = 4096;
  double buffer[kChunk];
  for (std::size_t begin = 0; begin < heights.size(); begin += kChunk) {
    const std::size_t n = std::min(kChunk, heights.size() - begin);
    for (std::size_t i = 0; i < n; ++i) {
      const double z = heights[begin + i];
      buffer[i] = std::isnan(z) ? std::numeric_limits<double>::quiet_NaN() : z + 0.0;
    }
    XXH3_128bits_update(state.get(), buffer, n * sizeof(double));
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("xxh3-128:{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

std::string heightsChecksum(const RasterHeightfield& heightfield) {
  return checksumOf(heightfield.columns, heightfield.rows, {}, heightfield.heights);
}

std::string heightsChecksum(const PointHeightfield& heightfield) {
  return checksumOf(heightfield.size(), 0, heightfield.positions, heightfield.heights);
}

}  // namespace arete
