// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "engine/base/vec.h"
#include "engine/simplify/hole_triangles.h"
#include "surface/error/piece_division.h"
#include "surface/error/pieces.h"
#include "surface/model/parts.h"

namespace arete {

/// A star and the floor that replaces it.
struct ReplacedStar {
  int triangles;       ///< triangle i is of the apex and the corners i and i + 1
  std::uint32_t apex;  ///< a number, as link has them by corner
  std::span<const std::uint32_t> link;
  std::span<const Vec3> corners;
  const HoleTriangulation& floor;
  const StarLine& line;
  /// By triangle of the floor, where attributes count (PieceDivision::divide()).
  std::span<const std::array<std::uint32_t, 3>> drawn = {};
};

/// Divides the pieces of a star among the floor (PieceDivision), each side of a line by itself. Where a side
/// is a single triangle, which leaves no floor there, its pieces go across: to the new edge of the line, and
/// that is one of a triangle of the floor on the other side. While such a triangle is in a front, so is its
/// edge, and beyond it is one of the pieces' chart.
/// @param piecesOf called with i and a function that takes each piece of triangle i
template <class PiecesOf>
void divideStar(PieceDivision& division, const ReplacedStar& star, const PiecesOf& piecesOf) {
  const auto next = [&](int i) { return i + 1 < static_cast<int>(star.link.size()) ? i + 1 : 0; };
  const auto isAtRim = [&](int i, const Piece& piece) {
    const std::array<std::uint32_t, 3> corners{star.apex, star.link[static_cast<std::size_t>(i)],
                                               star.link[static_cast<std::size_t>(next(i))]};
    return oppositeCorner(piece.across, corners) == 0;
  };
  bool hasAtRim = false;
  const auto gather = [&](int side) {
    division.clear();
    for (int i = 0; i < star.triangles; ++i)
      piecesOf(i, [&](const Piece& piece) {
        int of = star.line.sideOfStar(i);
        if (piece.across != 0) {
          if (isAtRim(i, piece)) {
            hasAtRim = true;
            return;
          }
          of = 1 - of;  // across an edge of the line
        }
        if (of == side) division.add(piece.face, piece.cuts, piece.polygon);
      });
  };
  // The triangle of the floor with two corners takes the pieces across the edge between them.
  const auto giveAcross = [&](int i, int j) {
    for (int f = 0; f < star.floor.size; ++f) {
      const auto& corners = star.floor.triangles[static_cast<std::size_t>(f)];
      if (std::ranges::find(corners, i) == corners.end() || std::ranges::find(corners, j) == corners.end())
        continue;
      std::array<std::uint32_t, 3> numbers{};
      std::size_t opposite = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        numbers[c] = star.link[corners[c]];
        if (corners[c] != i && corners[c] != j) opposite = c;
      }
      division.giveAcross(f, acrossFrom(opposite, numbers), star.corners[static_cast<std::size_t>(i)],
                          star.corners[static_cast<std::size_t>(j)]);
      return;
    }
  };
  std::array<std::uint32_t, 2> members{};
  for (int f = 0; f < star.floor.size; ++f)
    members[static_cast<std::size_t>(star.line.sideOf(star.floor.triangles[static_cast<std::size_t>(f)]))] |=
        std::uint32_t{1} << f;
  for (const int side : {0, 1}) {
    const std::uint32_t own = members[static_cast<std::size_t>(side)];
    if (own == 0) continue;
    gather(side);
    division.divide(star.corners, star.floor, own, star.drawn);
  }
  if (star.line.isThere())
    for (const int side : {0, 1})
      if (members[static_cast<std::size_t>(side)] == 0) {
        gather(side);
        giveAcross(star.line.ends[0], star.line.ends[1]);
      }
  if (!hasAtRim) return;
  for (int i = 0; i < star.triangles; ++i) {
    division.clear();
    piecesOf(i, [&](const Piece& piece) {
      if (piece.across != 0 && isAtRim(i, piece)) division.add(piece.face, piece.cuts, piece.polygon);
    });
    if (!division.isEmpty()) giveAcross(i, next(i));
  }
}

}  // namespace arete
