// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "engine/mt/multitriangulation.h"
#include "engine/mt/vertex_arrays.h"

namespace arete::packed {

/// How the numbers of a packed .amt become symbols of at most 256 kinds and raw bits, and which table each
/// symbol is coded with (docs/topics/amt-format.md, "Packed").

// Streams of a chunk: symbols of one stream follow each other, those of different streams are independent, so
// that a processor works on several at once. Behind the coded ones two plain ones: bounds are a byte each, as
// they are, for there are many, each takes 5 or 6 bits however it is coded, and a byte is read at once.
enum Stream : unsigned { kSlotStream, kFloorStream, kPlaceStream, kHeightStream, kErrorStream };
inline constexpr unsigned kStreams = 5;
inline constexpr unsigned kBoundBytes = kStreams, kRawBits = kStreams + 1, kParts = kStreams + 2;

// Tables, by what a symbol says and what is known when it is read.
inline constexpr unsigned kClasses = 9;       ///< of bands: see Directory::bandClass
inline constexpr unsigned kAreaClasses = 14;  ///< see areaClass()
inline constexpr unsigned kPlaceClasses = 36;
inline constexpr unsigned kErrorClasses = 3;  ///< bandClass / 3: errors have many tables, which want a cache
inline constexpr unsigned kStarClasses = 9;
enum Table : unsigned {
  kSeedsTable = 0,                                  // by star class and whether the band is the last
  kSeedBandTable = kSeedsTable + 2 * kStarClasses,  // by class
  kLeftTable = kSeedBandTable + kClasses,           // by star class
  kSeedTable = kLeftTable + kStarClasses,           //
  kShapeTable = kSeedTable + 1,                     // by whether the seed is listed
  kFloodTable = kShapeTable + 2,                    // by triangles found (6) and inner edges left (4)
  kOpenTable = kFloodTable + 24,                    //
  kPlaceTable = kOpenTable + 1,                     // by place class
  kPlaceFarTable = kPlaceTable + kPlaceClasses,     // by axis
  kHeightTable = kPlaceFarTable + 2,                // by class
  kErrorTable = kHeightTable + kClasses,            // by area class and error class
  kListChunkTable = kErrorTable + kAreaClasses * kErrorClasses,
  kListBorderTable,
  kRootCornerTable,
  kRootPlaceTable,
  kRootHeightTable,
  kTables
};
static_assert(kTables <= 256);  // RansSymbol

/// What becomes of a star's triangles is told of eight at a time; of `more` it is still to be told.
inline unsigned starClass(std::uint32_t more) {
  return std::min<std::uint32_t>(more, kStarClasses) - 1;
}
inline unsigned seedsTable(std::uint32_t more, std::uint32_t band) {
  return kSeedsTable + starClass(more) + (band == 0 ? kStarClasses : 0);
}

// ---- numbers of any size: 256 kinds and raw bits --------------------------------------------------------

/// Numbers below 16 are their own symbol; others are told by their length and their two bits behind the
/// first.
struct Bucket {
  unsigned symbol;
  int rawBits;
};
inline Bucket bucketOf(std::uint64_t value) {
  if (value < 16) return {static_cast<unsigned>(value), 0};
  const int width = std::bit_width(value);
  return {static_cast<unsigned>(16 + (width - 5) * 4 + static_cast<int>((value >> (width - 3)) & 3)),
          width - 3};
}
/// Bits that follow the symbol.
inline int rawBitsOf(unsigned symbol) {
  return symbol < 16 ? 0 : static_cast<int>(symbol - 16) / 4 + 2;
}
inline std::uint64_t bucketValue(unsigned symbol, std::uint64_t raw) {
  if (symbol < 16) return symbol;
  return (std::uint64_t{4 | ((symbol - 16) & 3)} << rawBitsOf(symbol)) | raw;
}

/// The nearest whole number, halves upwards. Precondition: below 2^62 in magnitude.
inline std::int64_t nearest(double x) {
  const double shifted = x + 0.5;
  const auto whole = static_cast<std::int64_t>(shifted);
  return whole - (static_cast<double>(whole) > shifted ? 1 : 0);
}

inline std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
inline std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
}

// ---- heights and coordinates: integers that are ordered as the numbers are
// ------------------------------------

inline std::uint64_t ordinal(double x) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  return bits >> 63 != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}
inline double fromOrdinal(std::uint64_t o) {
  return std::bit_cast<double>(o >> 63 != 0 ? o & ~(std::uint64_t{1} << 63) : ~o);
}
inline std::uint32_t ordinal(float x) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  return bits >> 31 != 0 ? ~bits : bits | 1u << 31;
}
inline float fromOrdinal(std::uint32_t o) {
  return std::bit_cast<float>(o >> 31 != 0 ? o & ~(1u << 31) : ~o);
}

inline double rawHeight(HeightEncoding::Type type, const std::byte* heights, std::size_t i) {
  if (type == HeightEncoding::Type::int16) {
    std::int16_t value;
    std::memcpy(&value, heights + 2 * i, sizeof value);
    return value;
  }
  if (type == HeightEncoding::Type::float32) {
    float value;
    std::memcpy(&value, heights + 4 * i, sizeof value);
    return static_cast<double>(value);
  }
  double value;
  std::memcpy(&value, heights + 8 * i, sizeof value);
  return value;
}

/// How far a raw height is from what was predicted, in steps of its type.
inline std::int64_t heightResidual(HeightEncoding::Type type, double raw, double predicted) {
  if (type == HeightEncoding::Type::int16) return static_cast<std::int64_t>(raw) - nearest(predicted);
  if (type == HeightEncoding::Type::float32)
    return static_cast<std::int32_t>(ordinal(static_cast<float>(raw)) -
                                     ordinal(static_cast<float>(predicted)));
  return static_cast<std::int64_t>(ordinal(raw) - ordinal(predicted));
}
/// Writes the height into its array and returns it; a number that is not finite when there is no such height.
inline double putHeight(HeightEncoding::Type type, std::byte* heights, std::size_t i, double predicted,
                        std::int64_t residual) {
  if (type == HeightEncoding::Type::int16) {
    const std::int64_t wide = static_cast<std::int64_t>(static_cast<std::uint64_t>(nearest(predicted)) +
                                                        static_cast<std::uint64_t>(residual));
    const std::int16_t value = static_cast<std::int16_t>(wide);
    std::memcpy(heights + 2 * i, &value, sizeof value);
    return value == wide ? value : HUGE_VAL;
  }
  if (type == HeightEncoding::Type::float32) {
    const float value = fromOrdinal(static_cast<std::uint32_t>(ordinal(static_cast<float>(predicted)) +
                                                               static_cast<std::uint32_t>(residual)));
    std::memcpy(heights + 4 * i, &value, sizeof value);
    return static_cast<double>(value);
  }
  const double value = fromOrdinal(ordinal(predicted) + static_cast<std::uint64_t>(residual));
  std::memcpy(heights + 8 * i, &value, sizeof value);
  return value;
}

// ---- areas
// --------------------------------------------------------------------------------------------------

/// Twice the area of a triangle of a lattice is a whole number; few areas of it hold few possible errors. As
/// one byte: 65 for more than 64, 66 for scattered points.
inline std::uint8_t shownArea(bool isLattice, float doubledArea) {
  if (!isLattice) return 66;
  return static_cast<std::uint8_t>(std::min(doubledArea, 65.0f));
}
inline constexpr auto kAreaClass = [] {
  std::array<std::uint8_t, 67> classes{};
  for (unsigned area = 0; area < 67; ++area)
    classes[area] = static_cast<std::uint8_t>(area <= 8    ? area
                                              : area <= 16 ? 9
                                              : area <= 32 ? 10
                                              : area <= 64 ? 11
                                              : area == 65 ? 12
                                                           : 13);
  return classes;
}();
/// Of a floor.
inline unsigned placeClass(float doubledArea, bool isOpen) {
  if (isOpen) return kPlaceClasses - 1;
  if (doubledArea <= 12) return static_cast<unsigned>(doubledArea);
  if (doubledArea <= 32) return 12 + static_cast<unsigned>((doubledArea - 12) / 4);
  return std::min(
      12 + static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(std::min(doubledArea, 1e6f)))),
      kPlaceClasses - 2);
}

// ---- errors
// ---------------------------------------------------------------------------------------------------

/// Up to this doubled area, an error of whole-numbered heights is told as the whole number
/// error * doubled area / height step.
inline constexpr unsigned kLatticeErrorArea = 64;
/// A symbol that no such number below 2^24 has: the code follows as 16 raw bits.
inline constexpr unsigned kPlainError = 255;

inline std::uint16_t wholeErrorCode(const OutwardScale& scale, const HeightEncoding& heights,
                                    std::uint64_t whole, double doubledArea) {
  const double magnitude = static_cast<double>(whole) * std::fabs(heights.scale) / doubledArea;
  return scale.encode(std::min(magnitude, static_cast<double>(scale.decode(OutwardScale::kMaxCode))));
}

// ---- bounds
// ---------------------------------------------------------------------------------------------------

/// Bounds are rounded outwards to quarters of an octave.
inline constexpr int kBoundShift = 9;
inline std::uint32_t boundStep(std::uint32_t code) {
  constexpr std::uint32_t step = 1u << kBoundShift;
  return (code + step - 1) / step;
}
inline std::uint16_t boundCode(std::uint32_t step) {
  return static_cast<std::uint16_t>(std::min<std::uint32_t>(step << kBoundShift, OutwardScale::kMaxCode));
}
inline constexpr std::uint32_t kBoundSteps = 129;

/// How far the lesser bound may lie below the greater one; what lies between is rounded outwards, and
/// the last stands for a bound of 0.
inline constexpr std::array<std::uint8_t, 13> kBoundDrops = {0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 255};
/// What the greater bound is told against; it has 9 steps, from the one returned. Without an error the band
/// is what is known.
inline std::uint32_t boundReference(std::uint32_t errorCode, std::uint32_t band) {
  if (errorCode != 0) return boundStep(errorCode);
  return band > 0 ? (band << (MultiTriangulation::kBandShift - kBoundShift)) - 3 : 0;
}

struct BoundSteps {
  std::uint32_t below, above;
};
/// The bounds as they can be told, outwards.
inline BoundSteps roundedBounds(std::uint32_t below, std::uint32_t above) {
  const std::uint32_t greater = std::max(below, above), lesser = std::min(below, above);
  if (lesser == 0) return {below, above};
  const auto drop = std::upper_bound(kBoundDrops.begin(), kBoundDrops.end() - 1, greater - lesser) - 1;
  const std::uint32_t rounded = greater - *drop;
  return below >= above ? BoundSteps{greater, rounded} : BoundSteps{rounded, greater};
}
/// How the lesser bound lies to the greater one, and which one that is. Precondition: rounded.
inline unsigned lesserSymbol(BoundSteps b) {
  const std::uint32_t greater = std::max(b.below, b.above), lesser = std::min(b.below, b.above);
  const auto drop = lesser == 0 ? kBoundDrops.end() - 1
                                : std::lower_bound(kBoundDrops.begin(), kBoundDrops.end(), greater - lesser);
  return static_cast<unsigned>(drop - kBoundDrops.begin()) * 2 + (b.below >= b.above ? 0 : 1);
}
inline constexpr unsigned kLesserSymbols = 2 * static_cast<unsigned>(kBoundDrops.size());
/// Bounds are told by one byte: none at all; or how far the greater one lies above the reference, and how the
/// lesser one lies to it. Or by two: how great the greater one is, and how the lesser one lies.
inline constexpr unsigned kNoBounds = 1, kNearBounds = 2, kNearRises = 9;
inline constexpr unsigned kFarBounds = kNearBounds + kNearRises * kLesserSymbols, kFarShift = 5;
static_assert(kLesserSymbols <= 1u << kFarShift &&
              kFarBounds + ((kBoundSteps << kFarShift) >> 8) < 256);  // bytes suffice
struct BoundBytes {
  std::uint8_t first, second;
  bool isFar() const { return first >= kFarBounds; }
};
/// Precondition: rounded.
inline BoundBytes bytesOf(BoundSteps b, std::uint32_t reference) {
  const std::uint32_t greater = std::max(b.below, b.above);
  if (greater == 0) return {kNoBounds, 0};
  const unsigned lesser = lesserSymbol(b);
  if (greater >= reference && greater < reference + kNearRises)
    return {static_cast<std::uint8_t>(kNearBounds + (greater - reference) * kLesserSymbols + lesser), 0};
  const unsigned both = greater << kFarShift | lesser;
  return {static_cast<std::uint8_t>(kFarBounds + (both >> 8)), static_cast<std::uint8_t>(both)};
}
/// What the bytes mean; of those that only a damaged file has, something, which may be beyond the last step.
/// Without a branch: which of the two forms comes cannot be foreseen.
inline BoundSteps boundsOf(BoundBytes bytes, std::uint32_t reference) {
  /// How far the two lie above the reference, or above the greater one where a second byte tells it.
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
