// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checksum is XXH3 with 128 bits over the shape, the positions and the heights; every NaN is replaced by
// the same one, and -0 by 0, so that the file format does not change the checksum.
#include "terrain/model/heights_checksum.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace arete {

struct HeightsChecksum::State {
  State() : xxh(XXH3_createState()) {
    if (xxh == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(xxh);
  }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  XXH3_state_t* xxh;
};

HeightsChecksum::HeightsChecksum(std::uint64_t columns, std::uint64_t rows)
    : state_(std::make_unique<State>()) {
  const std::uint64_t shape[2] = {columns, rows};
  XXH3_128bits_update(state_->xxh, shape, sizeof shape);
}

HeightsChecksum::~HeightsChecksum() = default;

void HeightsChecksum::add(std::span<const Vec2> positions) {
  if (!positions.empty()) XXH3_128bits_update(state_->xxh, positions.data(), positions.size_bytes());
}

void HeightsChecksum::add(std::span<const double> heights) {
  constexpr std::size_t kChunk = 4096;
  double buffer[kChunk];
  for (std::size_t begin = 0; begin < heights.size(); begin += kChunk) {
    const std::size_t n = std::min(kChunk, heights.size() - begin);
    for (std::size_t i = 0; i < n; ++i) {
      const double z = heights[begin + i];
      buffer[i] = std::isnan(z) ? std::numeric_limits<double>::quiet_NaN() : z + 0.0;
    }
    XXH3_128bits_update(state_->xxh, buffer, n * sizeof(double));
  }
}

std::string HeightsChecksum::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return fmt::format("xxh3-128:{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace arete
