// SPDX-License-Identifier: GPL-3.0-or-later
//
// The three encodings are tried in the order of their size. Each attempt encodes in parallel, decodes every
// height again as a reader will, and fails at the first one that differs in a bit.
#include "terrain/model/height_encoding.h"

#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::size_t kAhead = 16;

bool isSameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <class Raw, class ToRaw>
bool tryEncode(std::span<const double> heights, std::span<const std::uint32_t> order, HeightEncoding encoding,
               const ToRaw& toRaw, EncodedHeights& out) {
  out.encoding = encoding;
  out.bytes = UninitializedVector<std::byte>(order.size() * sizeof(Raw));
  Raw* raw = reinterpret_cast<Raw*>(out.bytes.data());
  std::atomic<bool> fits = true;
  parallelFor(IndexRange<std::size_t>(0, order.size(), 8192), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end() && fits.load(std::memory_order_relaxed); ++i) {
      if (i + kAhead < range.end()) __builtin_prefetch(&heights[order[i + kAhead]]);
      const double z = heights[order[i]];
      if (!toRaw(z, raw[i]) || !isSameBits(raw[i] * encoding.scale + encoding.offset, z)) fits = false;
    }
  });
  return fits;
}

}  // namespace

EncodedHeights encodeHeights(std::span<const double> heights, std::span<const std::uint32_t> order,
                             double rawScale, double rawOffset) {
  EncodedHeights out;
  const auto toInteger = [&](double z, std::int16_t& raw) {
    const double value = std::nearbyint((z - rawOffset) / rawScale);
    if (!(value >= -32768 && value <= 32767)) return false;
    raw = static_cast<std::int16_t>(value);
    return true;
  };
  using Type = HeightEncoding::Type;
  if (tryEncode<std::int16_t>(heights, order, {Type::int16, rawScale, rawOffset}, toInteger, out)) return out;
  const auto toFloat = [](double z, float& raw) {
    if (!(std::abs(z) < 3e38)) return false;
    raw = static_cast<float>(z);
    return true;
  };
  // A negative zero offset keeps the sign of a negative zero height.
  if (tryEncode<float>(heights, order, {Type::float32, 1, -0.0}, toFloat, out)) return out;
  const auto toDouble = [](double z, double& raw) {
    raw = z;
    return true;
  };
  tryEncode<double>(heights, order, {Type::float64, 1, -0.0}, toDouble, out);
  return out;
}

}  // namespace arete
