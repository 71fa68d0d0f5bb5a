// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/ids.h"
#include "engine/base/vec.h"

namespace arete {

/// How heights are stored: height = raw * scale + offset, exactly, where raw has the given type.
struct HeightEncoding {
  enum class Type : std::uint32_t { int16 = 1, float32 = 2, float64 = 3 };
  Type type = Type::float64;
  double scale = 1;
  double offset = 0;

  std::size_t bytesPerHeight() const { return type == Type::int16 ? 2 : type == Type::float32 ? 4 : 8; }
};

/// Vertex positions in plan coordinates and height, in the smallest form that is exact: sample indices (4
/// bytes) and raw heights (2 to 8 bytes) for vertices of a raster, plan coordinates as doubles for other
/// heightfields; three floats or doubles for surfaces.
struct VertexArrays {
  /// Raster: the sample index, row * columns + column. Plan coordinates are (column, row).
  std::span<const std::uint32_t> samples;
  std::uint32_t columns = 0;
  /// Otherwise: plan coordinates. Exactly one of `samples` and `plan` is in use.
  std::span<const Vec2> plan;

  /// A surface: places, in one of these; the arrays of heightfields are empty.
  std::span<const std::array<float, 3>> places32;
  std::span<const Vec3> places64;

  HeightEncoding encoding;
  std::span<const std::byte> rawHeights;  ///< size() * encoding.bytesPerHeight(), aligned to its type

  std::uint32_t size() const {
    return static_cast<std::uint32_t>(columns != 0       ? samples.size()
                                      : places32.empty() ? plan.size() + places64.size()
                                                         : places32.size());
  }
  bool isLattice() const { return columns != 0; }
  /// Whether a vertex is a position in the plan and a height, so that errors are vertical. Otherwise it is a
  /// place in space, and errors are distances.
  bool hasPlan() const { return places32.empty() && places64.empty(); }

  Vec2 planPosition(VertexId v) const {
    if (!isLattice()) return plan[v.index()];
    const std::uint32_t s = samples[v.index()];
    return {static_cast<double>(s % columns), static_cast<double>(s / columns)};
  }

  double height(VertexId v) const {
    const std::size_t i = v.index();
    switch (encoding.type) {
      case HeightEncoding::Type::int16:
        return reinterpret_cast<const std::int16_t*>(rawHeights.data())[i] * encoding.scale + encoding.offset;
      case HeightEncoding::Type::float32:
        return reinterpret_cast<const float*>(rawHeights.data())[i] * encoding.scale + encoding.offset;
      default:
        return reinterpret_cast<const double*>(rawHeights.data())[i] * encoding.scale + encoding.offset;
    }
  }

  /// Of a vertex of a surface.
  Vec3 place(VertexId v) const {
    if (places32.empty()) return places64[v.index()];
    const auto& [x, y, z] = places32[v.index()];
    return {x, y, z};
  }

  Vec3 position(VertexId v) const {
    if (!hasPlan()) return place(v);
    const Vec2 p = planPosition(v);
    return {p.x, p.y, height(v)};
  }
};

}  // namespace arete
