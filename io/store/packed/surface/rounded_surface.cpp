// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/surface/rounded_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/box3.h"

namespace arete::packed {
namespace {

/// The exponent of the last bit of x that is set. Precondition: x is finite and not 0.
int lastBit(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  const auto bits = static_cast<std::uint64_t>(std::ldexp(std::fabs(mantissa), 53));
  return exponent - 53 + std::countr_zero(bits);
}

/// The largest power of two that all coordinates are multiples of, where they are below `most` steps; else 0.
double commonStep(const VertexArrays& vertices, double most) {
  int last = 2000;
  double largest = 0;
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const Vec3 p = vertices.place(VertexId(v));
    for (const double x : {p.x, p.y, p.z}) {
      if (x == 0) {
        if (std::signbit(x)) return 0;  // it would lose its sign
        continue;
      }
      last = std::min(last, lastBit(x));
      largest = std::max(largest, std::fabs(x));
    }
  }
  const double step = std::ldexp(1.0, std::clamp(last, -1022, 1000));
  return largest > 0 && last > -1022 && largest / step < most ? step : 0;
}

/// What a rounded surface has instead of its source's arrays.
struct Rounded {
  std::vector<Vec3> places64;
  std::vector<std::array<float, 3>> places32;
  std::vector<std::uint16_t> error, rms;
  MultiTriangulation source;  ///< keeps the others
};

/// Rounds the places. @return the largest move
double roundPlaces(const VertexArrays& vertices, double step, Rounded& to) {
  double squared = 0;
  bool areFloats = true;
  to.places64.reserve(vertices.size());
  const auto rounded = [&](double x) { return std::floor(x / step + 0.5) * step + 0.0; };
  const auto isFloat = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const Vec3 p = vertices.place(VertexId(v)), q{rounded(p.x), rounded(p.y), rounded(p.z)};
    squared =
        std::max(squared, (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y) + (q.z - p.z) * (q.z - p.z));
    areFloats = areFloats && isFloat(q.x) && isFloat(q.y) && isFloat(q.z);
    to.places64.push_back(q);
  }
  if (areFloats) {
    to.places32.reserve(to.places64.size());
    for (const Vec3& q : to.places64)
      to.places32.push_back({static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)});
    to.places64 = {};
  }
  return std::sqrt(squared) * (1 + 0x1p-50);
}

/// Errors of a rounded surface are rounded upwards to 2^kCoarseShift codes, 1/128 of an octave.
constexpr unsigned kCoarseShift = 4;

/// The codes of larger magnitudes, outwards. Precondition: they are below kMaxCode by a coarse step.
std::vector<std::uint16_t> raised(std::span<const std::uint16_t> codes, const OutwardScale& from, double by,
                                  const OutwardScale& to) {
  std::array<std::uint16_t, std::size_t{OutwardScale::kMaxCode} + 1> table;
  const double most = to.decode(OutwardScale::kMaxCode - (1u << kCoarseShift));
  for (std::size_t code = 0; code < table.size(); ++code) {
    const double more = static_cast<double>(from.decode(static_cast<OutwardScale::Code>(code))) + by;
    const unsigned fine = to.encode(std::min(more, most));
    table[code] =
        static_cast<std::uint16_t>((fine + (1u << kCoarseShift) - 1) >> kCoarseShift << kCoarseShift);
  }
  std::vector<std::uint16_t> result;
  result.reserve(codes.size());
  for (const std::uint16_t code : codes) result.push_back(table[code]);
  return result;
}

}  // namespace

Result<RoundedSurface> roundedSurface(const MultiTriangulation& mt, int positionBits) {
  const VertexArrays& vertices = mt.vertices();
  if (positionBits == 0) {
    const double most = vertices.places64.empty() ? 0x1p24 : 0x1p53;
    return RoundedSurface{mt, commonStep(vertices, most), 0};
  }
  if (positionBits < kLeastPositionBits || positionBits > kMostPositionBits)
    return failure(ErrorCode::invalidData, fmt::format("positions have {} to {} bits, not {}",
                                                       kLeastPositionBits, kMostPositionBits, positionBits));
  Box3 box = Box3::empty();
  for (std::uint32_t v = 0; v < vertices.size(); ++v) box.include(vertices.place(VertexId(v)));
  const double side = box.longestSide();
  double farthest = 0;
  for (const Vec3& p : {box.low, box.high})
    farthest = std::max({farthest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  int exponent = 0;
  // Rounding each end to a multiple can add one step.
  const double fraction = std::frexp(side / (std::ldexp(1.0, positionBits) - 2), &exponent);
  const double step = std::ldexp(1.0, fraction == 0.5 ? exponent - 1 : exponent);
  // Where a coordinate has no bit that fine, or a step is no number, the places stay.
  if (!(side > 0) || !std::isnormal(step) || farthest / step >= 0x1p52) return roundedSurface(mt, 0);
  const auto rounded = std::make_shared<Rounded>();
  RoundedSurface result;
  result.step = step;
  result.moved = roundPlaces(vertices, step, *rounded);
  MtArrays a = mt.arrays();
  rounded->source = mt;
  a.vertices.places32 = rounded->places32;
  a.vertices.places64 = rounded->places64;
  if (result.moved > 0) {
    const auto largest = std::ranges::max_element(a.error);
    const double by = 2 * result.moved,
                 most = largest == a.error.end() ? by : static_cast<double>(a.scale.decode(*largest)) + by;
    const OutwardScale scale(most * 1.01);  // room for a coarse step
    rounded->error = raised(a.error, a.scale, by, scale);
    rounded->rms = raised(a.columns.of(kRms), a.scale, by, scale);
    a.error = rounded->error;
    a.columns.set(kRms, rounded->rms);
    a.scale = scale;
  }
  result.mt = MultiTriangulation(a, rounded);
  return result;
}

}  // namespace arete::packed
