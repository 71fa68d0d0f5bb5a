// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "surface/error/face_polygon.h"

namespace arete {

/// A convex part of a face of the original.
struct Piece {
  std::uint32_t face = 0;
  /// How often it was cut: each cut rounds a corner, by half a unit of the grid of FacePoint at most.
  std::uint32_t cuts = 0;
  std::span<const FacePoint> polygon;
  /// 0 of a piece that belongs to a triangle. Others lie across one of its sides, which is on a line, and
  /// belong to that: which one, acrossFrom() and oppositeCorner() know.
  std::uint8_t across = 0;

  bool isWhole() const { return polygon.data() == wholeFace().data(); }
};

/// Piece::across of the side that is opposite to a corner, by the order of the corners' numbers, so that it
/// does not depend on where a triangle begins.
inline std::uint8_t acrossFrom(std::size_t corner, const std::array<std::uint32_t, 3>& numbers) {
  std::uint8_t across = 1;
  for (const std::uint32_t other : numbers) across += other < numbers[corner] ? 1 : 0;
  return across;
}
inline std::size_t oppositeCorner(std::uint8_t across, const std::array<std::uint32_t, 3>& numbers) {
  std::size_t corner = 0;
  while (acrossFrom(corner, numbers) != across) ++corner;
  return corner;
}

/// The pieces that a triangle stands for, one after the other in one block of memory. Empty for the triangles
/// of the finest level, which stand for their own faces.
class PieceList {
 public:
  PieceList() = default;

  bool isEmpty() const { return words_ == nullptr; }
  /// 0 if the list is empty.
  std::uint32_t size() const { return isEmpty() ? 0 : words_[1]; }
  /// Calls visit(piece) for each.
  template <class Visit>
  void forEach(const Visit& visit) const {
    if (isEmpty()) return;
    const std::uint32_t* at = words_.get() + kHeader;
    for (const std::uint32_t* const end = words_.get() + words_[0]; at != end;) {
      const std::uint32_t face = at[0], corners = at[1] & kMostPoints, cuts = at[1] >> 16;
      const auto across = static_cast<std::uint8_t>(at[1] >> kAcrossAt & 3);
      at += 2;
      if (corners == 0) {
        visit(Piece{face, 0, wholeFace(), across});
        continue;
      }
      visit(Piece{face, cuts, {reinterpret_cast<const FacePoint*>(at), corners}, across});
      at += std::size_t{2} * corners;
    }
  }

  /// Collects pieces for a list.
  class Builder {
   public:
    void clear() { words_.assign(kHeader, 0); }
    void add(std::uint32_t face, std::uint32_t cuts, std::span<const FacePoint> polygon,
             std::uint8_t across = 0) {
      ++words_[1];
      words_.push_back(face);
      if (isWholeFace(polygon)) {
        words_.push_back(std::uint32_t{across} << kAcrossAt);
        return;
      }
      words_.push_back(std::min(cuts, kMostCuts) << 16 | std::uint32_t{across} << kAcrossAt |
                       static_cast<std::uint32_t>(polygon.size()));
      for (const FacePoint& p : polygon) {
        words_.push_back(p.u);
        words_.push_back(p.v);
      }
    }
    PieceList finish() {
      words_[0] = static_cast<std::uint32_t>(words_.size());
      PieceList list;
      list.words_ = std::make_unique_for_overwrite<std::uint32_t[]>(words_.size());
      std::ranges::copy(words_, list.words_.get());
      return list;
    }

   private:
    std::vector<std::uint32_t> words_ = {0, 0};
  };

  static constexpr std::uint32_t kMostCuts = 0xFFFF, kAcrossAt = 14, kMostPoints = 0x3FFF;

 private:
  static constexpr std::uint32_t kHeader = 2;
  std::unique_ptr<std::uint32_t[]> words_;  // their number, the number of pieces, then the pieces
};
static_assert(sizeof(FacePoint) == 2 * sizeof(std::uint32_t));

}  // namespace arete
