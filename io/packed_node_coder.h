// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The walk that the writer and the reader of a packed .amt share. Both grow the same MT node by node; `Io` is
// what tells them apart: Io::code(stream, table, actual) gives the next symbol, which the reader decodes and
// the writer gets from actual() and notes down. So the two cannot disagree on what is known when a symbol is
// coded.
//
// A node is told like this.
//   Its seed, one of the triangles of its floor. The last triangle of the floor that the chunk creates is the
//   seed, and when it is created a symbol says that it is one, and how many bands below its creator the node
//   lies. Nodes wait in the queue of their band, so they come in the order of their seeds and need no
//   number. Nodes whose floor is made by other chunks are listed, at the begin of their band.
//   Its floor, by a walk from the seed across edges: of every triangle, which of its other edges
//   are inner ones. The edges that are not, in the order of the walk, are the link.
//   Whether the star is open, and at which edge of the border.
//   The place of its vertex, against the centroid of the link; its height, against the plane of the triangle
//   of the floor that it stands on.
//   Error and bounds of the floor's triangles.
//
// What lies across an edge: packed_front.h.

#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/enclosing_ball.h"
#include "io/packed_arrays.h"
#include "io/packed_front.h"

namespace arete::packed {

/// Numbers of any size through a table.
template <class Io, class Actual>
std::uint64_t codeNumber(Io& io, Stream stream, unsigned table, const Actual& actual) {
  std::uint64_t value = 0;
  const unsigned symbol = io.code(stream, table, [&] {
    value = actual();
    return bucketOf(value).symbol;
  });
  if (symbol < 16) return symbol;
  const int bits = rawBitsOf(symbol);
  return bucketValue(symbol, io.raw(bits, value & ((std::uint64_t{1} << bits) - 1)));
}
template <class Io>
std::int64_t codeSigned(Io& io, Stream stream, unsigned table, std::int64_t actual) {
  return unzigzag(codeNumber(io, stream, table, [&] { return zigzag(actual); }));
}

/// The root, in front of the nodes of chunk 0: every number against the one before it. The writer's arrays
/// hold it already. False when it makes no sense.
template <class Io>
bool codeRoot(Arrays& a, Io& io) {
  const auto wrapped = [](std::uint64_t x, std::int64_t by) { return x + static_cast<std::uint64_t>(by); };
  std::uint64_t sample = 0, x = ordinal(0.0), y = ordinal(0.0);
  double z = 0;
  for (std::uint32_t v = 0; v < a.rootVertices; ++v) {
    if (a.isLattice) {
      sample = wrapped(sample, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                          std::int64_t{a.samples[v]} - static_cast<std::int64_t>(sample)));
      if (sample >= std::uint64_t{a.columns} * a.rows) return false;
      a.samples[v] = static_cast<std::uint32_t>(sample);
      a.place[v] = {static_cast<double>(sample % a.columns), static_cast<double>(sample / a.columns), 0};
    } else {
      x = wrapped(x, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                static_cast<std::int64_t>(ordinal(a.plan[v].x) - x)));
      y = wrapped(y, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                static_cast<std::int64_t>(ordinal(a.plan[v].y) - y)));
      a.plan[v] = {fromOrdinal(x), fromOrdinal(y)};
      a.place[v] = {a.plan[v].x, a.plan[v].y, 0};
      if (!std::isfinite(a.plan[v].x) || !std::isfinite(a.plan[v].y)) return false;
    }
    const std::int64_t residual =
        codeSigned(io, kHeightStream, kRootHeightTable, heightResidual(a.encoding.type, a.height(v), z));
    z = putHeight(a.encoding.type, a.rawHeights.get(), v, z, residual);
    if (!std::isfinite(z)) return false;
    a.place[v].z = z;
  }
  std::uint64_t corner = 0;
  for (std::uint32_t t = 0; t < a.roots; ++t)
    for (std::uint32_t& c : a.rootTriangles[t]) {
      corner = wrapped(corner, codeSigned(io, kFloorStream, kRootCornerTable,
                                          std::int64_t{c} - static_cast<std::int64_t>(corner)));
      if (corner >= a.rootVertices) return false;
      c = static_cast<std::uint32_t>(corner);
    }
  a.joinRoot();
  return true;
}

template <class Io>
class NodeCoder {
 public:
  NodeCoder(Arrays& arrays, const Directory& directory, const Chunk& chunk, Io& io)
      : a_(arrays), directory_(directory), chunk_(chunk), io_(io), front_(arrays, chunk.nodes) {}

  /// All nodes of the chunk. False when the symbols make no sense; problem() says which.
  bool run() {
    if (chunk_.nodes > kMostNodes) return fail("has more nodes than a chunk can have");
    for (const Run& run : chunk_.runs) {
      band_ = run.band;
      class_ = directory_.bandClass[band_];
      node_ = run.firstNode;
      slot_ = run.firstSlot;
      slotEnd_ = run.firstSlot + run.slots;
      nodeEnd_ = run.firstNode + run.nodes;
      areas_.resize(run.slots - 2 * std::size_t{run.nodes});
      nextArea_ = areas_.data();
      std::vector<Front::Own>& queue = queues_[band_];
      if (!io_.listed(run, listed_)) return fail("lists a seed that cannot be one");
      for (const Handle seed : listed_) {
        begin(a_.idOf(seed));
        if (!front_.take(seed, node_, floor_.triangles[0])) return fail("lists a seed that is gone");
        if (!node(true)) return false;
      }
      // Nodes of this band may join the queue on the way.
      for (std::size_t i = 0; i < queue.size(); ++i) {
        if (node_ == nodeEnd_) return fail("has more nodes than announced");
        const Front::Own seed = queue[i];
        if (i + kAhead < queue.size()) front_.prefetch(queue[i + kAhead]);
        if (i + kAhead / 2 < queue.size()) front_.prefetchAround(queue[i + kAhead / 2]);
        begin(seed.id);
        if (!front_.take(seed, node_, floor_.triangles[0])) return fail("has a seed that is gone");
        if (!node(false)) return false;
      }
      if (node_ != nodeEnd_ || slot_ != slotEnd_)
        return fail("has another number of nodes or slots than announced");
      queue = {};
      values(run);
    }
    front_.finish();
    return true;
  }
  const std::string& problem() const { return problem_; }

 private:
  /// An edge that the walk has come to: triangle of the floor << 3, edge << 1, whether it is an inner one.
  using Edge = std::uint32_t;
  static constexpr std::size_t kAhead = 12;
  static constexpr std::uint32_t kMostNodes = 1u << 29;  ///< so that the front's records can be numbered

  bool fail(const char* what) {
    problem_ = what;
    return false;
  }
  void begin(std::uint32_t seed) {
    floor_.size = 1;
    floor_.corners = 0;
    floor_.sumX = floor_.sumY = 0;
    floor_.isOpen = false;
    io_.begin(seed, node_);
  }

  bool node(bool isListed) {
    Floor& floor = floor_;
    if (!walk(isListed, floor)) return fail("has a floor that is none");
    if (!open(floor)) return fail("has an open star away from the border");
    const std::uint32_t size = static_cast<std::uint32_t>(floor.corners);
    // Every node that is still to come needs three.
    if (size + 3 * (nodeEnd_ - node_ - 1) > slotEnd_ - slot_) return fail("has more slots than announced");
    if (!io_.star(floor, slot_)) return fail("has a star that is not its floor's");
    if (!place(floor)) return fail("has a vertex outside of its grid or without a height");
    ball(floor);
    front_.addStar(node_, slot_, floor, records_.data());
    std::uint32_t* const ids = a_.floor.get() + (slot_ - 2 * node_);
    std::uint8_t* const areas = nextArea_;
    for (int i = 0; i < floor.size; ++i) {
      ids[i] = floor.triangles[i].id;
      areas[i] = shownArea(a_.isLattice, floor.triangles[i].doubledArea);
    }
    nextArea_ += floor.size;
    if (!seeds(floor)) return fail("has a node below the last band");
    ++node_;
    slot_ += size;
    return true;
  }

  bool walk(bool isListed, Floor& floor) {
    int depth = 0, inner = 0;
    floor.doubledArea = floor.triangles[0].doubledArea;
    const auto push = [&](int edge, unsigned isInner) {
      stack_[depth++] =
          static_cast<unsigned>(floor.size - 1) << 3 | static_cast<unsigned>(edge) << 1 | isInner;
      inner += static_cast<int>(isInner);
    };
    const unsigned around =
        io_.code(kFloorStream, kSeedTable + (isListed ? 1 : 0), [&] { return io_.innerEdges(floor, 0, 3); });
    push(2, around >> 2 & 1);
    push(1, around >> 1 & 1);
    push(0, around & 1);
    while (depth > 0) {
      const Edge side = stack_[--depth];
      const FloorTriangle& t = floor.triangles[side >> 3];
      const int at = static_cast<int>(side >> 1 & 3);
      if ((side & 1) == 0) {
        if (floor.corners == kMaxHoleCorners) return false;
        floor.link[floor.corners] = t.corners[at];
        floor.outer[floor.corners++] = t.across[at];
        const Arrays::Place& p = a_.place[t.corners[at]];
        floor.sumX += p.x;
        floor.sumY += p.y;
        continue;
      }
      --inner;
      if (floor.size == kMaxFloor) return false;
      FloorTriangle& next = floor.triangles[floor.size];
      int edge = 0;
      if (!front_.takeAcross(t, at, node_, next, edge)) return false;
      ++floor.size;
      floor.doubledArea += next.doubledArea;
      const int first = kNextEdge[edge];
      const unsigned table =
          kFloodTable + static_cast<unsigned>(std::min(floor.size - 2, 5) * 4 + std::min(inner, 3));
      const unsigned on = io_.code(kFloorStream, table, [&] { return io_.innerEdges(floor, first, 2); });
      push(kNextEdge[first], on >> 1 & 1);
      push(first, on & 1);
    }
    return floor.corners == floor.size + 2;
  }

  /// Turns the link of an open star so that its last edge is the border's that the vertex divides. Where rims
  /// reach over NODATA a border can have been closed altogether, and any edge may open.
  bool open(Floor& floor) {
    std::array<int, kMaxHoleCorners> borders;
    unsigned count = 0;
    for (int i = 0; i < floor.corners; ++i)
      if (floor.outer[i] == kNoSide || a_.hasFills) borders[count++] = i;
    if (count == 0) return true;
    const unsigned which = io_.code(kFloorStream, kOpenTable,
                                    [&] { return io_.openEdge(floor, std::span(borders.data(), count)); });
    if (which == 0) return true;
    if (which > count) return false;
    floor.isOpen = true;
    const int first = borders[which - 1] + 1;
    std::rotate(floor.link.begin(), floor.link.begin() + first, floor.link.begin() + floor.corners);
    std::rotate(floor.outer.begin(), floor.outer.begin() + first, floor.outer.begin() + floor.corners);
    return true;
  }

  std::int64_t signedNumber(Stream stream, unsigned table, std::int64_t actual) {
    return codeSigned(io_, stream, table, actual);
  }

  bool place(const Floor& floor) {
    const std::uint32_t v = a_.rootVertices + node_;
    double x = floor.sumX, y = floor.sumY;
    const Arrays::Place actual = io_.actualPlace();
    if (a_.isLattice) {
      x = static_cast<double>(nearest(x / floor.corners));
      y = static_cast<double>(nearest(y / floor.corners));
      const unsigned symbol =
          io_.code(kPlaceStream, kPlaceTable + placeClass(floor.doubledArea, floor.isOpen), [&] {
            const double dx = actual.x - x, dy = actual.y - y;
            return std::fabs(dx) <= 3 && std::fabs(dy) <= 3 ? static_cast<unsigned>((dx + 3) * 7 + dy + 3)
                                                            : 49u;
          });
      if (symbol < 49) {
        x += static_cast<double>(symbol / 7) - 3;
        y += static_cast<double>(symbol % 7) - 3;
      } else {
        x += static_cast<double>(signedNumber(kPlaceStream, kPlaceFarTable, std::llround(actual.x - x)));
        y += static_cast<double>(signedNumber(kPlaceStream, kPlaceFarTable + 1, std::llround(actual.y - y)));
      }
      if (!(x >= 0 && x < a_.columns && y >= 0 && y < a_.rows)) return false;
      a_.samples[v] = static_cast<std::uint32_t>(static_cast<std::uint64_t>(y) * a_.columns +
                                                 static_cast<std::uint64_t>(x));
    } else {
      x = far(kPlaceFarTable, x / floor.corners, actual.x);
      y = far(kPlaceFarTable + 1, y / floor.corners, actual.y);
      if (!std::isfinite(x) || !std::isfinite(y)) return false;
      a_.plan[v] = {x, y};
    }
    const double predicted = predictedHeight(floor, x, y);
    const std::int64_t residual =
        signedNumber(kHeightStream, kHeightTable + class_, io_.actualHeightResidual(predicted));
    const double z = putHeight(a_.encoding.type, a_.rawHeights.get(), v, predicted, residual);
    a_.place[v] = {x, y, z};
    return std::isfinite(z);
  }

  /// Around the star; saturate() adds the children's.
  void ball(const Floor& floor) {
    std::array<Vec3, kMaxHoleCorners + 1> positions;
    const auto metric = [this](const Arrays::Place& p) {
      return a_.metric.toMetric({p.x, p.y, p.z * a_.encoding.scale + a_.encoding.offset});
    };
    const auto size = static_cast<std::size_t>(floor.corners);
    for (std::size_t i = 0; i < size; ++i) positions[i] = metric(a_.place[floor.link[i]]);
    positions[size] = metric(a_.place[a_.rootVertices + node_]);
    a_.sphere[node_] = EnclosingBall::around({positions.data(), size + 1}).rounded();
  }

  double far(unsigned table, double predicted, double actual) {
    const std::int64_t residual =
        signedNumber(kPlaceStream, table, static_cast<std::int64_t>(ordinal(actual) - ordinal(predicted)));
    return fromOrdinal(ordinal(predicted) + static_cast<std::uint64_t>(residual));
  }

  /// The plane of the triangle of the floor that holds (x, y), there; of the last one when none does.
  double predictedHeight(const Floor& floor, double x, double y) const {
    double w[3] = {1, 0, 0};
    const FloorTriangle* t = nullptr;
    for (int i = 0; i < floor.size; ++i) {
      t = &floor.triangles[i];
      const auto &p = a_.place[t->corners[0]], &q = a_.place[t->corners[1]], &r = a_.place[t->corners[2]];
      w[0] = (q.x - x) * (r.y - y) - (r.x - x) * (q.y - y);
      w[1] = (r.x - x) * (p.y - y) - (p.x - x) * (r.y - y);
      w[2] = (p.x - x) * (q.y - y) - (q.x - x) * (p.y - y);
      if ((w[0] >= 0 && w[1] >= 0 && w[2] >= 0) || (w[0] <= 0 && w[1] <= 0 && w[2] <= 0)) break;
    }
    const double sum = w[0] + w[1] + w[2];
    const double z0 = a_.place[t->corners[0]].z, z1 = a_.place[t->corners[1]].z,
                 z2 = a_.place[t->corners[2]].z;
    const double z = (w[0] * z0 + w[1] * z1 + w[2] * z2) / sum;
    const double low = std::min(std::min(z0, z1), z2), high = std::max(std::max(z0, z1), z2);
    return std::isfinite(z) ? std::min(std::max(z, low), high) : low;
  }

  /// Errors and bounds of all triangles that the nodes of a run remove.
  void values(const Run& run) {
    const bool isWhole = a_.isLattice && a_.encoding.type == HeightEncoding::Type::int16;
    const std::uint32_t top = (band_ + 1) << MultiTriangulation::kBandShift;
    const std::uint32_t firstFloor = run.firstSlot - 2 * run.firstNode;
    const std::uint32_t* const ids = a_.floor.get() + firstFloor;
    const std::uint32_t withoutError = boundReference(0, band_);
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      if (i + kAhead < areas_.size()) {
        __builtin_prefetch(&a_.error[ids[i + kAhead]], 1);
        __builtin_prefetch(&a_.below[ids[i + kAhead]], 1);
        __builtin_prefetch(&a_.above[ids[i + kAhead]], 1);
      }
      const std::uint32_t id = ids[i];
      const unsigned shown = areas_[i], area = kAreaClass[shown];
      const unsigned table = kErrorTable + area * kErrorClasses + class_ / 3;
      std::uint32_t code = 0;
      if (isWhole && shown <= kLatticeErrorArea && shown > 0) {
        std::uint64_t whole = 0;
        const unsigned symbol = io_.code(kErrorStream, table, [&] {
          const auto found = io_.wholeError(shown, io_.actualError(id));
          whole = found.value_or(0);
          return found ? bucketOf(whole).symbol : kPlainError;
        });
        if (symbol < 16) {
          code = a_.wholeErrors[shown * 16 + symbol];
        } else if (symbol == kPlainError) {
          code = static_cast<std::uint32_t>(io_.raw(16, io_.actualError(id)));
        } else {
          const int bits = rawBitsOf(symbol);
          whole = bucketValue(symbol, io_.raw(bits, whole & ((std::uint64_t{1} << bits) - 1)));
          code = wholeErrorCode(a_.scale, a_.encoding, whole, shown);
        }
      } else {
        const std::uint64_t below = codeNumber(io_, kErrorStream, table, [&] {
          const std::uint16_t actual = io_.actualError(id);
          return actual == 0 ? std::uint64_t{0} : std::uint64_t{top} - actual;
        });
        code = below == 0 || below >= top ? 0 : top - static_cast<std::uint32_t>(below);
      }
      a_.error[id] = a_.floorError[firstFloor + i] = static_cast<std::uint16_t>(code);

      const std::uint32_t reference = code != 0 ? boundStep(code) : withoutError;
      BoundSteps bounds = io_.actualBounds(id);
      const unsigned symbol = io_.code(kBoundStream, kBoundTable + area * 2 + (code == 0 ? 1 : 0),
                                       [&] { return boundSymbol(bounds, reference); });
      if (symbol > kNoBounds) {
        bounds = nearBoundsOf(symbol, reference);
      } else if (symbol == kNoBounds) {
        bounds = {0, 0};
      } else {
        const unsigned isZero = code == 0 ? 1 : 0;
        const unsigned greater = io_.code(kBoundStream, kFarBoundTable + class_ * 2 + isZero,
                                          [&] { return std::max(bounds.below, bounds.above); });
        bounds = boundsOf(greater, io_.code(kBoundStream, kLesserBoundTable + isZero,
                                            [&] { return lesserSymbol(bounds); }));
      }
      a_.below[id] = boundCode(bounds.below);
      a_.above[id] = boundCode(bounds.above);
    }
  }

  bool seeds(const Floor& floor) {
    const std::uint32_t triangles = static_cast<std::uint32_t>(floor.corners) - (floor.isOpen ? 1 : 0);
    for (std::uint32_t first = 0; first < triangles; first += 8) {
      const std::uint32_t left = triangles - first;
      std::array<unsigned, 8> bandsBelow;
      unsigned mask = io_.code(kSlotStream, seedsTable(left, band_), [&] {
        unsigned actual = 0;
        for (std::uint32_t i = 0; i < std::min(left, 8u); ++i)
          if (const auto below = io_.seedAt(slot_ + first + i, band_)) {
            bandsBelow[i] = *below;
            actual |= 1u << i;
          }
        return actual;
      });
      if (left < 8 && mask >> left != 0) return false;
      for (; mask != 0; mask &= mask - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(mask));
        const unsigned below =
            band_ == 0 ? 0 : io_.code(kSlotStream, kSeedBandTable + class_, [&] { return bandsBelow[i]; });
        if (below > band_) return false;
        queues_[band_ - below].push_back({records_[first + i], a_.roots + slot_ + first + i});
      }
    }
    return true;
  }

  Arrays& a_;
  const Directory& directory_;
  const Chunk& chunk_;
  Io& io_;
  std::uint32_t band_ = 0, class_ = 0, node_ = 0, slot_ = 0, nodeEnd_ = 0, slotEnd_ = 0;
  Front front_;
  Floor floor_;
  std::array<Edge, 2 * kMaxFloor + 3> stack_;
  std::array<std::uint32_t, kMaxHoleCorners + 1> records_;
  std::array<std::vector<Front::Own>, MultiTriangulation::kBands> queues_;
  std::vector<std::uint8_t> areas_;  ///< of the run's floors
  std::uint8_t* nextArea_ = nullptr;
  std::vector<Handle> listed_;
  std::string problem_;
};

}  // namespace arete::packed
