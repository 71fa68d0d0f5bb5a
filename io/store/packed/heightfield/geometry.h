// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Positions and heights of the vertices of a run's nodes and the spheres of their stars. This is a pass of
// its own after all stars of the run, so that a processor overlaps the arithmetic of several nodes instead of
// waiting for the topology of one: a vertex rarely depends on the one just before it.

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/store/entropy/numbers.h"
#include "io/store/entropy/ordinals.h"
#include "io/store/packed/heightfield/areas.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/heights.h"
#include "io/store/packed/nodes/shapes.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// The offsets from the predicted position that the symbols 0 to 48 stand for.
inline constexpr auto kNearMoves = [] {
  std::array<std::array<float, 2>, 49> moves{};
  for (int s = 0; s < 49; ++s) moves[s] = {static_cast<float>(s / 7 - 3), static_cast<float>(s % 7 - 3)};
  return moves;
}();

/// @tparam Real  number type of the positions (Arrays::places())
/// @tparam Io    the reader's or the writer's, see node_coder.h
template <class Real, class Io>
class Geometry {
 public:
  Geometry(Arrays& arrays, Io& io) : a_(arrays), io_(io), place_(arrays.places<Real>()) {
    const MetricFrame& m = a_.metric;
    metricStep_ = Four{static_cast<Real>(m.scale.x), static_cast<Real>(m.scale.y),
                       static_cast<Real>(m.scale.z * a_.encoding.scale), 0};
  }

  /// Codes positions and heights of all nodes of a run.
  /// @param shapes  of the nodes' floors
  /// @param areas   receives the shownArea() of each slot
  /// @return false if a vertex is outside its grid or has no valid height, or the metric is not finite
  bool run(const Run& run, unsigned bandClass, std::span<const Shape* const> shapes, std::uint8_t* areas) {
    if (!std::isfinite(metricStep_[0] + metricStep_[1] + metricStep_[2])) return false;
    class_ = bandClass;
    slot_ = run.firstSlot;
    nextAreas_ = areas;
    const std::uint32_t lastSlot = run.firstSlot + run.slots - 1;
    for (std::uint32_t i = 0; i < run.nodes; ++i) {
      node_ = run.firstNode + i;
      shape_ = shapes[i];
      const std::uint8_t star = a_.star[node_];
      corners_ = star & (Arrays::kOpen - 1);
      isOpen_ = (star & Arrays::kOpen) != 0;
      for (std::uint32_t k = 0; k < 6; ++k)
        __builtin_prefetch(&place_[a_.link[std::min(slot_ + kLinksAhead + k, lastSlot)]]);
      io_.at(node_);
      // The mark of an open star makes it take the general case.
      if (!withCorners(star, [&](auto known) { return nodeOf<known>(); })) return false;
      slot_ += static_cast<std::uint32_t>(corners_);
      nextAreas_ += corners_;
    }
    return true;
  }

 private:
  /// A SIMD vector of four numbers.
  typedef Real Four __attribute__((vector_size(4 * sizeof(Real))));
  static constexpr std::uint32_t kLinksAhead = 24;

  template <int kCorners>
  int corners() const {
    return kCorners > 0 ? kCorners : corners_;
  }
  std::int64_t signedNumber(Stream stream, unsigned table, std::int64_t actual) {
    return codeSigned(io_, stream, table, actual);
  }

  template <int kCorners>
  bool nodeOf() {
    const int corners = this->corners<kCorners>();
    Four at[kCorners > 0 ? kCorners : kMaxHoleCorners];
    if constexpr (kCorners == 0) std::memset(at, 0, sizeof at);
    const std::uint32_t* const link = a_.link.get() + slot_;
    for (int i = 0; i < corners; ++i) std::memcpy(&at[i], &place_[link[i]], sizeof at[i]);
    if (!place<kCorners>(at)) return false;
    if constexpr (Io::kKeepsValues) ball<kCorners>(at);
    return true;
  }

  template <int kCorners>
  [[gnu::always_inline]] bool place(const Four* at) {
    const std::uint32_t v = a_.rootVertices + node_;
    const int corners = this->corners<kCorners>();
    Four sum = at[0];
    for (int i = 1; i < corners; ++i) sum += at[i];
    Real x = sum[0] / static_cast<Real>(corners), y = sum[1] / static_cast<Real>(corners);
    const Vec2 actual = io_.actualPlace();
    if (std::is_same_v<Real, float> || a_.isLattice) {
      x = static_cast<Real>(static_cast<std::int64_t>(x + Real{0.5}));
      y = static_cast<Real>(static_cast<std::int64_t>(y + Real{0.5}));
      float doubledArea = 0;
      for (int i = 1; i + 1 < corners; ++i)
        doubledArea += static_cast<float>((at[i][0] - at[0][0]) * (at[i + 1][1] - at[0][1]) -
                                          (at[i + 1][0] - at[0][0]) * (at[i][1] - at[0][1]));
      doubledArea = std::fabs(doubledArea);
      const unsigned symbol = io_.code(kPlaceStream, kPlaceTable + placeClass(doubledArea, isOpen_), [&] {
        const double dx = actual.x - static_cast<double>(x), dy = actual.y - static_cast<double>(y);
        return std::fabs(dx) <= 3 && std::fabs(dy) <= 3 ? static_cast<unsigned>((dx + 3) * 7 + dy + 3) : 49u;
      });
      if (symbol < 49) {
        x += kNearMoves[symbol][0];
        y += kNearMoves[symbol][1];
      } else {
        x += static_cast<Real>(
            signedNumber(kPlaceStream, kPlaceFarTable, std::llround(actual.x - static_cast<double>(x))));
        y += static_cast<Real>(
            signedNumber(kPlaceStream, kPlaceFarTable + 1, std::llround(actual.y - static_cast<double>(y))));
      }
      if (!(x >= 0 && x < static_cast<Real>(a_.columns) && y >= 0 && y < static_cast<Real>(a_.rows)))
        return false;
      a_.samples[v] = static_cast<std::uint32_t>(static_cast<std::int64_t>(y)) * a_.columns +
                      static_cast<std::uint32_t>(static_cast<std::int64_t>(x));
    } else {
      const double farX = far(kPlaceFarTable, static_cast<double>(x), actual.x);
      const double farY = far(kPlaceFarTable + 1, static_cast<double>(y), actual.y);
      if (!std::isfinite(farX) || !std::isfinite(farY)) return false;
      a_.plan[v] = {farX, farY};
      x = static_cast<Real>(farX);
      y = static_cast<Real>(farY);
    }
    const auto predicted = static_cast<double>(predictedHeight<kCorners>(at, x, y));
    const std::int64_t residual =
        signedNumber(kHeightStream, kHeightTable + class_, io_.actualHeightResidual(predicted));
    const double z = putHeight(a_.encoding.type, a_.rawHeights.get(), v, predicted, residual);
    apex_ = Four{x, y, static_cast<Real>(z), 0};
    std::memcpy(&place_[v], &apex_, sizeof apex_);
    return std::isfinite(z);
  }

  double far(unsigned table, double predicted, double actual) {
    const std::int64_t residual =
        signedNumber(kPlaceStream, table, static_cast<std::int64_t>(ordinal(actual) - ordinal(predicted)));
    return fromOrdinal(ordinal(predicted) + static_cast<std::uint64_t>(residual));
  }

  /// The height at (x, y) of the plane of the floor's triangle that contains (x, y), or of the last triangle
  /// if none does. Writes the shown areas of the star's triangles.
  template <int kCorners>
  [[gnu::always_inline]] Real predictedHeight(const Four* at, Real x, Real y) {
    const int corners = this->corners<kCorners>();
    std::array<std::array<Real, 2>, (kCorners > 0 ? kCorners : kMaxHoleCorners) + 1> away;
    if constexpr (kCorners == 0) away = {};
    for (int i = 0; i < corners; ++i) away[static_cast<unsigned>(i)] = {at[i][0] - x, at[i][1] - y};
    away[static_cast<unsigned>(corners)] = away[0];
    const auto cross = [](const std::array<Real, 2>& p, const std::array<Real, 2>& q) {
      return p[0] * q[1] - q[0] * p[1];
    };
    for (unsigned i = 0; i < static_cast<unsigned>(corners); ++i)
      nextAreas_[i] = shownArea(a_.isLattice, static_cast<float>(std::fabs(cross(away[i], away[i + 1]))));
    Real w0 = 1, w1 = 0, w2 = 0;
    std::array<std::uint8_t, 3> in{};
    for (int i = 0; i < corners - 2; ++i) {
      in = shape_->steps[static_cast<unsigned>(i)].place;
      w0 = cross(away[in[1]], away[in[2]]);
      w1 = cross(away[in[2]], away[in[0]]);
      w2 = cross(away[in[0]], away[in[1]]);
      if (std::min(std::min(w0, w1), w2) >= 0 || std::max(std::max(w0, w1), w2) <= 0) break;
    }
    const Real z0 = at[in[0]][2], z1 = at[in[1]][2], z2 = at[in[2]][2];
    const Real z = (w0 * z0 + w1 * z1 + w2 * z2) / (w0 + w1 + w2);
    const Real low = std::min(std::min(z0, z1), z2), high = std::max(std::max(z0, z1), z2);
    return std::isfinite(z) ? std::min(std::max(z, low), high) : low;
  }

  /// The sphere of the star; saturate() adds those of the children. Its radius is negative until then.
  template <int kCorners>
  [[gnu::always_inline]] void ball(const Four* at) {
    const int corners = this->corners<kCorners>();
    Four low = apex_, high = apex_;
    for (int i = 0; i < corners; ++i) {
      low = at[i] < low ? at[i] : low;
      high = at[i] > high ? at[i] : high;
    }
    const Four centre = (low + high) * Real{0.5};
    Real most = 0;
    const auto reach = [&](const Four& p) {
      Four d = (p - centre) * metricStep_;
      d *= d;
      most = std::max(most, d[0] + d[1] + d[2]);
    };
    reach(apex_);
    for (int i = 0; i < corners; ++i) reach(at[i]);
    const Vec3 middle =
        a_.metric.toMetric({static_cast<double>(centre[0]), static_cast<double>(centre[1]),
                            static_cast<double>(centre[2]) * a_.encoding.scale + a_.encoding.offset});
    // Outwards by what the arithmetic of a Real and the rounding of the centre lose.
    const double moved = (std::fabs(middle.x) + std::fabs(middle.y) + std::fabs(middle.z)) * 0x1p-24;
    const auto radius = static_cast<float>((static_cast<double>(std::sqrt(most)) + moved) * (1 + 4e-6));
    a_.sphere[node_] = {static_cast<float>(middle.x), static_cast<float>(middle.y),
                        static_cast<float>(middle.z),
                        -std::bit_cast<float>(std::bit_cast<std::uint32_t>(radius) + 1)};
  }

  Arrays& a_;
  Io& io_;
  Place<Real>* place_;
  Four metricStep_;  ///< a step along each axis of the places, in metric space
  std::uint32_t node_ = 0, slot_ = 0;
  unsigned class_ = 0;
  int corners_ = 0;
  bool isOpen_ = false;
  std::uint8_t* nextAreas_ = nullptr;
  const Shape* shape_ = nullptr;
  Four apex_;
};

}  // namespace arete::packed
