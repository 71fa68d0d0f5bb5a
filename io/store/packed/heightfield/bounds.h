// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/mt/multitriangulation.h"
#include "engine/mt/outward_scale.h"

namespace arete::packed {

/// The two bounds of a triangle as one or two bytes, rounded outwards.

/// Bounds are rounded outwards to steps of a quarter of an octave: 2^kBoundShift codes.
inline constexpr int kBoundShift = 9;
/// The least step that is not below a code, and the code of a step.
inline std::uint32_t boundStep(std::uint32_t code) {
  constexpr std::uint32_t step = 1u << kBoundShift;
  return (code + step - 1) / step;
}
inline std::uint16_t boundCode(std::uint32_t step) {
  return static_cast<std::uint16_t>(std::min<std::uint32_t>(step << kBoundShift, OutwardScale::kMaxCode));
}
inline constexpr std::uint32_t kBoundSteps = 129;

/// By how many steps the lesser bound may lie below the greater one. Other differences are rounded outwards
/// to the next smaller one; the last entry stands for a bound of 0.
inline constexpr std::array<std::uint8_t, 13> kBoundDrops = {0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 255};
/// The step that the greater bound is compared with: in one byte it is this step or one of the next 8.
/// @param errorCode  of the triangle; if 0 the reference follows from the band
inline std::uint32_t boundReference(std::uint32_t errorCode, std::uint32_t band) {
  if (errorCode != 0) return boundStep(errorCode);
  return band > 0 ? (band << (MultiTriangulation::kBandShift - kBoundShift)) - 3 : 0;
}

/// The two bounds of a triangle, in steps.
struct BoundSteps {
  std::uint32_t below, above;
};
/// The nearest bounds outwards that kBoundDrops allows.
inline BoundSteps roundedBounds(std::uint32_t below, std::uint32_t above) {
  const std::uint32_t greater = std::max(below, above), lesser = std::min(below, above);
  if (lesser == 0) return {below, above};
  const auto drop = std::upper_bound(kBoundDrops.begin(), kBoundDrops.end() - 1, greater - lesser) - 1;
  const std::uint32_t rounded = greater - *drop;
  return below >= above ? BoundSteps{greater, rounded} : BoundSteps{rounded, greater};
}
/// Twice the index of the difference in kBoundDrops, plus 1 if `below` is the lesser bound. Precondition: the
/// bounds come from roundedBounds().
inline unsigned lesserSymbol(BoundSteps b) {
  const std::uint32_t greater = std::max(b.below, b.above), lesser = std::min(b.below, b.above);
  const auto drop = lesser == 0 ? kBoundDrops.end() - 1
                                : std::lower_bound(kBoundDrops.begin(), kBoundDrops.end(), greater - lesser);
  return static_cast<unsigned>(drop - kBoundDrops.begin()) * 2 + (b.below >= b.above ? 0 : 1);
}
inline constexpr unsigned kLesserSymbols = 2 * static_cast<unsigned>(kBoundDrops.size());
/// One byte says that both bounds are 0 (kNoBounds), or how far the greater bound lies above the reference
/// and the lesser symbol (from kNearBounds). Two bytes (the first from kFarBounds) hold the greater bound's
/// step and the lesser symbol.
inline constexpr unsigned kNoBounds = 1, kNearBounds = 2, kNearRises = 9;
inline constexpr unsigned kFarBounds = kNearBounds + kNearRises * kLesserSymbols, kFarShift = 5;
static_assert(kLesserSymbols <= 1u << kFarShift &&
              kFarBounds + ((kBoundSteps << kFarShift) >> 8) < 256);  // the first byte suffices
/// The second byte counts only if the first is far.
struct BoundBytes {
  std::uint8_t first, second;
  bool isFar() const { return first >= kFarBounds; }
};
/// Precondition: the bounds come from roundedBounds().
inline BoundBytes bytesOf(BoundSteps b, std::uint32_t reference) {
  const std::uint32_t greater = std::max(b.below, b.above);
  if (greater == 0) return {kNoBounds, 0};
  const unsigned lesser = lesserSymbol(b);
  if (greater >= reference && greater < reference + kNearRises)
    return {static_cast<std::uint8_t>(kNearBounds + (greater - reference) * kLesserSymbols + lesser), 0};
  const unsigned both = greater << kFarShift | lesser;
  return {static_cast<std::uint8_t>(kFarBounds + (both >> 8)), static_cast<std::uint8_t>(both)};
}
/// The inverse of bytesOf(). Bytes that bytesOf() does not return (of a damaged file) give some bounds, which
/// may lie beyond the last step. Branch-free: a processor cannot predict whether one byte comes or two.
inline BoundSteps boundsOf(BoundBytes bytes, std::uint32_t reference) {
  // How far the bounds lie above the reference, or, of two bytes, above the greater one.
  struct Rise {
    std::int16_t below, above;
  };
  constexpr unsigned kFirstFar = 256;
  static constexpr auto kRises = [] {
    const auto rise = [](unsigned greater, unsigned lesser) {
      const auto high = static_cast<std::int16_t>(greater),
                 low = static_cast<std::int16_t>(high - kBoundDrops[lesser >> 1]);
      return lesser % 2 == 0 ? Rise{high, low} : Rise{low, high};
    };
    std::array<Rise, kFirstFar + (1u << kFarShift)> rises{};
    for (unsigned s = 0; s < kNearBounds; ++s) rises[s] = {INT16_MIN, INT16_MIN};  // no bounds
    for (unsigned s = kNearBounds; s < kFarBounds; ++s)
      rises[s] = rise((s - kNearBounds) / kLesserSymbols, (s - kNearBounds) % kLesserSymbols);
    for (unsigned l = 0; l < kLesserSymbols; ++l) rises[kFirstFar + l] = rise(0, l);
    return rises;
  }();
  const std::uint32_t both = (bytes.first - kFarBounds) << 8 | bytes.second,
                      isFar = 0u - static_cast<std::uint32_t>(bytes.isFar());
  const std::uint32_t place = (bytes.first & ~isFar) | ((kFirstFar + both % (1u << kFarShift)) & isFar),
                      from = (reference & ~isFar) | (both >> kFarShift & isFar);
  const Rise rise = kRises[place];
  const auto risen = [&](std::int16_t by) {
    return static_cast<std::uint32_t>(std::max(static_cast<std::int32_t>(from) + by, 0));
  };
  return {risen(rise.below), risen(rise.above)};
}

}  // namespace arete::packed
