// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "engine/mt/hole_limit.h"

namespace arete::packed {

inline constexpr int kMaxFloor = kMaxHoleCorners - 2;

/// How the triangles of a floor are connected, as a walk from its seed finds them. The edges of a triangle
/// are numbered from the one that the walk entered by, those of the seed in its own order; edge i begins at
/// corner i. 8 t + e is edge e of triangle t.
struct Shape {
  std::uint8_t triangles = 1, corners = 0;
  /// Edges of the link, in its order.
  std::array<std::uint8_t, kMaxHoleCorners> link{};
  struct Step {
    std::uint8_t from = 0;                ///< the edge that the walk crossed; unused for the seed
    std::array<std::uint8_t, 3> place{};  ///< the index of each corner in the link
  };
  std::array<Step, kMaxFloor> steps{};
};

/// Walks over a floor with a stack of edges, the seed's edge 0 on top. An edge is inner if another triangle
/// of the floor lies across it; crossing it enters that triangle, whose edges 1 and 2 go on the stack, 1 on
/// top.
/// @param bits  bits(shape, inner, count) returns which of `count` edges are inner: of the seed's three
///              (bit i: edge i), or of the last triangle's edges 1 and 2 (bits 0 and 1). `inner` is the
///              number of inner edges on the stack; shape.steps includes the triangle.
/// @return nothing if the floor has more triangles or corners than the limit
template <class Bits>
std::optional<Shape> walkedShape(const Bits& bits) {
  struct Side {
    std::uint8_t edge;
    bool isInner;
  };
  Shape shape;
  std::array<Side, 2 * kMaxFloor + 3> stack;
  std::array<std::array<std::uint8_t, 3>, kMaxFloor> across{};  // 0, or the triangle there
  int depth = 0, inner = 0;
  const auto push = [&](int edge, unsigned isInner) {
    stack[depth++] = {static_cast<std::uint8_t>(8 * (shape.triangles - 1) + edge), isInner != 0};
    inner += static_cast<int>(isInner);
  };
  const unsigned around = bits(shape, 0, 3);
  for (int edge = 3; edge-- > 0;) push(edge, around >> edge & 1);
  while (depth > 0) {
    const Side side = stack[--depth];
    if (!side.isInner) {
      if (shape.corners == kMaxHoleCorners) return std::nullopt;
      shape.link[shape.corners++] = side.edge;
      continue;
    }
    --inner;
    if (shape.triangles == kMaxFloor) return std::nullopt;
    across[side.edge >> 3][side.edge & 7] = shape.triangles;
    shape.steps[shape.triangles++].from = side.edge;
    const unsigned on = bits(shape, inner, 2);
    push(2, on >> 1 & 1);
    push(1, on & 1);
  }
  // A corner begins an edge. If that is an inner one, the triangle across has the corner as well, where its
  // edge 1 begins, and so on around the corner to the link.
  std::array<std::uint8_t, 8 * kMaxFloor> placeOf{};
  for (std::uint8_t i = 0; i < shape.corners; ++i) placeOf[shape.link[i]] = i;
  for (int t = 0; t < shape.triangles; ++t)
    for (int corner = 0; corner < 3; ++corner) {
      int at = t, edge = corner;
      for (;;) {
        if (edge == 0 && at > 0) {
          const std::uint8_t from = shape.steps[at].from;
          at = from >> 3;
          edge = ((from & 7) + 1) % 3;
        } else if (across[at][edge] != 0) {
          at = across[at][edge];
          edge = 1;
        } else {
          break;
        }
      }
      shape.steps[t].place[corner] = placeOf[8 * at + edge];
    }
  return shape;
}

/// The shapes that have a symbol of their own: those of at most five triangles (69 of 70 floors), sorted by
/// triangles, then by their bits as a number (the first bit is the lowest).
inline constexpr unsigned kListedTriangles = 5;
inline constexpr unsigned kListedShapes = 1 + 3 + 9 + 28 + 90;
/// The symbol of any other shape; its bits follow.
inline constexpr unsigned kWalkedShape = kListedShapes;

/// The shapes by symbol.
std::span<const Shape, kListedShapes> listedShapes();
/// The symbol of a shape with these bits, kWalkedShape if it is not listed.
unsigned shapeSymbol(std::uint64_t bits, unsigned triangles);

}  // namespace arete::packed
