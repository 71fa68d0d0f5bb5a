// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace arete::packed {

/// The streams of a packed packet of nodes, and the tables that their symbols are coded with
/// (docs/topics/amt-format.md, "Packed").

/// Streams of a packet. The symbols of different streams are independent, so that a processor decodes several
/// at once. Two plain streams follow the coded ones: bounds, which are bytes because each takes 5 or 6 bits
/// however it is coded and a byte is read at once, and raw bits.
enum Stream : unsigned { kSlotStream, kFloorStream, kPlaceStream, kHeightStream, kErrorStream };
inline constexpr unsigned kStreams = 5;
inline constexpr unsigned kBoundBytes = kStreams, kRawBits = kStreams + 1, kParts = kStreams + 2;

inline constexpr unsigned kClasses = 9;        ///< of bands: see Directory::bandClass (layout.h)
inline constexpr unsigned kAreaClasses = 14;   ///< see kAreaClass (areas.h)
inline constexpr unsigned kPlaceClasses = 36;  ///< see placeClass() (areas.h)
inline constexpr unsigned kErrorClasses =
    3;  ///< bandClass / 3: error tables are many and should stay in a cache
inline constexpr unsigned kStarClasses = 9;  ///< see starClass()
/// First tables, by what a symbol says; the comments name what else selects the table.
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
  kListPacketTable = kErrorTable + kAreaClasses * kErrorClasses,
  kListBorderTable,
  kRootCornerTable,
  kRootPlaceTable,
  kRootHeightTable,
  kTables
};
static_assert(kTables <= 256);  // RansSymbol

/// The class of a symbol that says something of up to eight triangles of a star, by how many triangles it and
/// the symbols after it are about. Precondition: more > 0.
inline unsigned starClass(std::uint32_t more) {
  return std::min<std::uint32_t>(more, kStarClasses) - 1;
}
/// The table of a symbol that says which triangles are seeds.
inline unsigned seedsTable(std::uint32_t more, std::uint32_t band) {
  return kSeedsTable + starClass(more) + (band == 0 ? kStarClasses : 0);
}

}  // namespace arete::packed
