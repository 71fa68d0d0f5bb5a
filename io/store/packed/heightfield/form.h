// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "io/store/entropy/numbers.h"
#include "io/store/entropy/ordinals.h"
#include "io/store/packed/heightfield/bounded_errors.h"
#include "io/store/packed/heightfield/geometry.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/heights.h"
#include "io/store/packed/nodes/tables.h"
#include "terrain/model/terrain_model.h"

namespace arete::packed {

inline MtKind kindOf(const TerrainModel& model) {
  MtKind kind;
  kind.isLattice = model.isRaster;
  kind.hasFills = model.options.rimTolerance > 0;
  kind.columns = model.columns;
  kind.rows = model.rows;
  kind.encoding = model.mt.vertices().encoding;
  kind.scale = model.mt.scale();
  kind.metric = model.mt.metric();
  return kind;
}

/// What the vertices and triangles of a heightfield carry: plan position and height; error and two bounds.
/// @tparam Real  number type of the positions (Arrays::places())
template <class Real>
struct HeightfieldForm {
  template <class Io>
  using Geometry = packed::Geometry<Real, Io>;
  template <class Io>
  using Values = BoundedErrors<Real, Io>;
  static constexpr const char* kInvalidVertex = "has a vertex outside of its grid or without a height";

  /// Gives the writer's arrays the root's vertices.
  static void prepare(Arrays& a, const MultiTriangulation& from) {
    const VertexArrays& vertices = from.vertices();
    const std::size_t count = from.rootVertexCount();
    if (a.isLattice)
      std::copy_n(vertices.samples.begin(), count, a.samples.get());
    else
      std::copy_n(vertices.plan.begin(), count, a.plan.get());
    std::copy_n(vertices.rawHeights.begin(), count * vertices.encoding.bytesPerHeight(), a.rawHeights.get());
  }

  /// Codes the root's vertices: every number as the difference from the one before it. The writer's arrays
  /// hold them already; the reader's are filled.
  /// @return false if the numbers are invalid
  template <class Io>
  static bool codeRootVertices(Arrays& a, Io& io) {
    Place<Real>* const place = a.places<Real>();
    const auto wrapped = [](std::uint64_t x, std::int64_t by) { return x + static_cast<std::uint64_t>(by); };
    std::uint64_t sample = 0, x = ordinal(0.0), y = ordinal(0.0);
    double z = 0;
    for (std::uint32_t v = 0; v < a.rootVertices; ++v) {
      if (a.isLattice) {
        sample = wrapped(sample, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                            std::int64_t{a.samples[v]} - static_cast<std::int64_t>(sample)));
        if (sample >= std::uint64_t{a.columns} * a.rows) return false;
        a.samples[v] = static_cast<std::uint32_t>(sample);
        place[v] = {static_cast<Real>(sample % a.columns), static_cast<Real>(sample / a.columns), 0, 0};
      } else {
        x = wrapped(x, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                  static_cast<std::int64_t>(ordinal(a.plan[v].x) - x)));
        y = wrapped(y, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                  static_cast<std::int64_t>(ordinal(a.plan[v].y) - y)));
        a.plan[v] = {fromOrdinal(x), fromOrdinal(y)};
        place[v] = {static_cast<Real>(a.plan[v].x), static_cast<Real>(a.plan[v].y), 0, 0};
        if (!std::isfinite(a.plan[v].x) || !std::isfinite(a.plan[v].y)) return false;
      }
      const std::int64_t residual =
          codeSigned(io, kHeightStream, kRootHeightTable, heightResidual(a.encoding.type, a.height(v), z));
      z = putHeight(a.encoding.type, a.rawHeights.get(), v, z, residual);
      if (!std::isfinite(z)) return false;
      place[v].z = static_cast<Real>(z);
    }
    return true;
  }
};

}  // namespace arete::packed
