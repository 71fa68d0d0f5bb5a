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
// What lies across an edge. A star remembers, for every edge of its link, the triangle that was on the other
// side when the star was made, and this is never changed. That triangle may have been removed since: then the
// star that removed it has the edge in its link (the edge is still there), and the triangle at that slot is
// the next one to look at. All nodes on this way are ancestors of whoever asks, so chunks that do not lean on
// each other never look at what the other one writes; in a damaged file they may, and then read some value,
// in range.

#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "io/packed_arrays.h"
#include "terrain/hole.h"

namespace arete::packed {

inline constexpr int kMaxFloor = kMaxHoleCorners - 2;

/// A triangle of a floor.
struct FloorTriangle {
  Handle handle;
  std::array<std::uint32_t, 3> corners;
  double doubledArea;
};

struct Floor {
  std::array<FloorTriangle, kMaxFloor> triangles;
  int size = 0;
  std::array<std::uint32_t, kMaxHoleCorners> link;
  std::array<Handle, kMaxHoleCorners> outer;
  int corners = 0;
  bool isOpen = false;
  double doubledArea = 0;
};

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
      a.place[v] = {static_cast<double>(sample % a.columns), static_cast<double>(sample / a.columns)};
    } else {
      x = wrapped(x, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                static_cast<std::int64_t>(ordinal(a.plan[v].x) - x)));
      y = wrapped(y, codeSigned(io, kPlaceStream, kRootPlaceTable,
                                static_cast<std::int64_t>(ordinal(a.plan[v].y) - y)));
      a.plan[v] = {fromOrdinal(x), fromOrdinal(y)};
      a.place[v] = {a.plan[v].x, a.plan[v].y};
      if (!std::isfinite(a.plan[v].x) || !std::isfinite(a.plan[v].y)) return false;
    }
    const std::int64_t residual =
        codeSigned(io, kHeightStream, kRootHeightTable, heightResidual(a.encoding.type, a.height(v), z));
    z = putHeight(a.encoding.type, a.rawHeights.get(), v, z, residual);
    if (!std::isfinite(z)) return false;
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
      : a_(arrays), directory_(directory), chunk_(chunk), io_(io) {}

  /// All nodes of the chunk. False when the symbols make no sense; problem() says which.
  bool run() {
    for (const Run& run : chunk_.runs) {
      band_ = run.band;
      class_ = directory_.bandClass[band_];
      node_ = run.firstNode;
      slot_ = run.firstSlot;
      slotEnd_ = run.firstSlot + run.slots;
      nodeEnd_ = run.firstNode + run.nodes;
      std::vector<Handle>& queue = queues_[band_];
      if (!io_.listed(run, listed_)) return fail("lists a seed that cannot be one");
      for (const Handle seed : listed_)
        if (!node(seed, true)) return false;
      // Nodes of this band may join the queue on the way.
      for (std::size_t i = 0; i < queue.size(); ++i) {
        if (node_ == nodeEnd_) return fail("has more nodes than announced");
        const Handle seed = queue[i];
        if (i + kAhead < queue.size()) prefetch(queue[i + kAhead]);
        if (!node(seed, false)) return false;
      }
      if (node_ != nodeEnd_ || slot_ != slotEnd_)
        return fail("has another number of nodes or slots than announced");
      queue = {};
    }
    return true;
  }
  const std::string& problem() const { return problem_; }

 private:
  static constexpr std::size_t kAhead = 6;
  static constexpr std::uint32_t kNone = MultiTriangulation::kNone;

  bool fail(const char* what) {
    problem_ = what;
    return false;
  }
  void prefetch(Handle h) const {
    if (h.isRoot()) return;
    __builtin_prefetch(&a_.link[h.slot]);
    __builtin_prefetch(&a_.outer[h.slot]);
    __builtin_prefetch(&a_.remover[a_.roots + h.slot]);
    __builtin_prefetch(&a_.slotBegin[h.node]);
    __builtin_prefetch(&a_.star[h.node]);
  }

  std::uint32_t removerOf(Handle h) const {
    return std::atomic_ref(a_.remover[a_.idOf(h)]).load(std::memory_order_relaxed);
  }

  std::array<std::uint32_t, 3> cornersOf(Handle h) const {
    if (h.isRoot()) return a_.rootTriangles[h.slot];
    const std::uint32_t begin = a_.slotBegin[h.node], end = begin + a_.starSize(h.node);
    return {a_.rootVertices + h.node, a_.link[h.slot], a_.link[h.slot + 1 < end ? h.slot + 1 : begin]};
  }

  /// What was across an edge of a triangle when its star was made.
  Handle across(Handle h, int edge) const {
    if (h.isRoot()) return a_.rootOuter[3 * std::size_t{h.slot} + static_cast<unsigned>(edge)];
    if (edge == 1) return a_.outer[h.slot];
    const std::uint32_t begin = a_.slotBegin[h.node], end = begin + a_.starSize(h.node);
    const bool isOpen = a_.isOpen(h.node);
    if (edge == 0) {
      if (h.slot > begin) return {h.node, h.slot - 1};
      return isOpen ? Handle{} : Handle{h.node, end - 1};
    }
    if (h.slot + 1 < end - (isOpen ? 1 : 0)) return {h.node, h.slot + 1};
    return isOpen ? Handle{} : Handle{h.node, begin};
  }

  /// The triangle there now that has the directed edge (from, to), and which of its edges that is.
  bool resolve(Handle& h, std::uint32_t from, std::uint32_t to, int& edge) const {
    if (h.isNothing()) return false;
    std::uint32_t remover = removerOf(h);
    if (remover == kNone) {
      const auto corners = cornersOf(h);
      for (edge = 0; edge < 3; ++edge)
        if (corners[edge] == from && corners[edge == 2 ? 0 : edge + 1] == to) return true;
      return false;
    }
    edge = 1;
    for (std::uint32_t youngest = 0;;) {
      if (remover >= a_.nodes || remover < youngest) return false;
      youngest = remover;
      const std::uint32_t begin = a_.slotBegin[remover], size = a_.starSize(remover);
      const std::uint32_t* link = a_.link.get() + begin;
      std::uint32_t i = 0;
      while (i < size && (link[i] != from || link[i + 1 < size ? i + 1 : 0] != to)) ++i;
      if (i == size) return false;
      h = {remover, begin + i};
      const std::uint32_t next = removerOf(h);
      if (next == kNone) return true;
      if (next == remover) return false;
      remover = next;
    }
  }

  bool node(Handle seed, bool isListed) {
    Floor floor;
    io_.begin(seed, node_);
    if (!walk(seed, isListed, floor)) return fail("has a floor that is none");
    if (!open(floor)) return fail("has an open star away from the border");
    const std::uint32_t size = static_cast<std::uint32_t>(floor.corners);
    // Every node that is still to come needs three.
    if (size + 3 * (nodeEnd_ - node_ - 1) > slotEnd_ - slot_) return fail("has more slots than announced");
    if (!io_.star(floor, slot_)) return fail("has a star that is not its floor's");
    if (!place(floor)) return fail("has a vertex outside of its grid or without a height");
    errors(floor);
    store(floor);
    if (!seeds(floor)) return fail("has a node below the last band");
    ++node_;
    slot_ += size;
    return true;
  }

  bool take(Handle h, Floor& floor) {
    if (floor.size == kMaxFloor) return false;
    std::uint32_t& remover = a_.remover[a_.idOf(h)];
    const std::atomic_ref atomic(remover);
    if (atomic.load(std::memory_order_relaxed) != kNone) return false;
    atomic.store(node_, std::memory_order_relaxed);
    FloorTriangle& t = floor.triangles[floor.size++];
    t.handle = h;
    t.corners = cornersOf(h);
    const auto &p = a_.place[t.corners[0]], &q = a_.place[t.corners[1]], &r = a_.place[t.corners[2]];
    t.doubledArea = std::fabs((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y));
    floor.doubledArea += t.doubledArea;
    return true;
  }

  bool walk(Handle seed, bool isListed, Floor& floor) {
    struct Side {
      Handle of;
      std::uint32_t from, to;
      int edge;
      bool isInner;
    };
    std::array<Side, 2 * kMaxFloor + 3> stack;
    int depth = 0, inner = 0;
    const auto push = [&](int firstEdge, int count, unsigned symbol) {
      const FloorTriangle& t = floor.triangles[floor.size - 1];
      for (int i = count; i-- > 0;) {
        const int edge = (firstEdge + i) % 3;
        const bool isInner = (symbol >> i & 1) != 0;
        stack[depth++] = {t.handle, t.corners[edge], t.corners[edge == 2 ? 0 : edge + 1], edge, isInner};
        inner += isInner ? 1 : 0;
      }
    };
    if (!take(seed, floor)) return false;
    push(0, 3, io_.code(kFloorStream, kSeedTable + (isListed ? 1 : 0), [&] {
      return io_.innerEdges(floor, 0, 3);
    }));
    while (depth > 0) {
      const Side side = stack[--depth];
      Handle there = across(side.of, side.edge);
      if (!side.isInner) {
        if (floor.corners == kMaxHoleCorners) return false;
        floor.link[floor.corners] = side.from;
        floor.outer[floor.corners++] = there;
        continue;
      }
      --inner;
      int edge = 0;
      if (!resolve(there, side.to, side.from, edge) || !take(there, floor)) return false;
      const int first = edge == 2 ? 0 : edge + 1;
      const unsigned table =
          kFloodTable + static_cast<unsigned>(std::min(floor.size - 2, 5) * 4 + std::min(inner, 3));
      push(first, 2, io_.code(kFloorStream, table, [&] { return io_.innerEdges(floor, first, 2); }));
    }
    return floor.corners == floor.size + 2;
  }

  /// Turns the link of an open star so that its last edge is the border's that the vertex divides. Where rims
  /// reach over NODATA a border can have been closed altogether, and any edge may open.
  bool open(Floor& floor) {
    std::array<int, kMaxHoleCorners> borders;
    unsigned count = 0;
    for (int i = 0; i < floor.corners; ++i)
      if (floor.outer[i].isNothing() || a_.hasFills) borders[count++] = i;
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
    double x = 0, y = 0;
    for (int i = 0; i < floor.corners; ++i) {
      const auto& p = a_.place[floor.link[i]];
      x += p.x;
      y += p.y;
    }
    const Arrays::Place actual = io_.actualPlace();
    if (a_.isLattice) {
      x = std::floor(x / floor.corners + 0.5);
      y = std::floor(y / floor.corners + 0.5);
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
    a_.place[v] = {x, y};

    const double predicted = predictedHeight(floor, x, y);
    const std::int64_t residual =
        signedNumber(kHeightStream, kHeightTable + class_, io_.actualHeightResidual(predicted));
    return std::isfinite(putHeight(a_.encoding.type, a_.rawHeights.get(), v, predicted, residual));
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
    const double z0 = a_.height(t->corners[0]), z1 = a_.height(t->corners[1]), z2 = a_.height(t->corners[2]);
    const double z = (w[0] * z0 + w[1] * z1 + w[2] * z2) / sum;
    const double low = std::fmin(std::fmin(z0, z1), z2), high = std::fmax(std::fmax(z0, z1), z2);
    return std::isfinite(z) ? std::fmin(std::fmax(z, low), high) : low;
  }

  void errors(const Floor& floor) {
    const bool isWhole = a_.isLattice && a_.encoding.type == HeightEncoding::Type::int16;
    const std::uint32_t top = (band_ + 1) << MultiTriangulation::kBandShift;
    for (int i = 0; i < floor.size; ++i) {
      const FloorTriangle& t = floor.triangles[i];
      const std::uint32_t id = a_.idOf(t.handle);
      const unsigned area = areaClass(a_.isLattice, t.doubledArea);
      const unsigned table = kErrorTable + area * kClasses + class_;
      const std::uint16_t actual = io_.actualError(i);
      std::uint32_t code = 0;
      if (isWhole && t.doubledArea <= kLatticeErrorArea && t.doubledArea > 0) {
        std::uint64_t whole = 0;
        const unsigned symbol = io_.code(kErrorStream, table, [&] {
          const auto found = io_.wholeError(t.doubledArea, actual);
          whole = found.value_or(0);
          return found ? bucketOf(whole).symbol : kPlainError;
        });
        if (symbol == kPlainError) {
          code = static_cast<std::uint32_t>(io_.raw(16, actual));
        } else {
          const int bits = rawBitsOf(symbol);
          whole = bits == 0 ? symbol
                            : bucketValue(symbol, io_.raw(bits, whole & ((std::uint64_t{1} << bits) - 1)));
          code = wholeErrorCode(a_, whole, t.doubledArea);
        }
      } else {
        const std::uint64_t below = codeNumber(io_, kErrorStream, table, [&] {
          return actual == 0 ? std::uint64_t{0} : std::uint64_t{top} - actual;
        });
        code = below == 0 || below >= top ? 0 : top - static_cast<std::uint32_t>(below);
      }
      a_.error[id] = static_cast<std::uint16_t>(code);

      const std::uint32_t reference = boundReference(code, band_);
      BoundSteps bounds = io_.actualBounds(i);
      const unsigned symbol = io_.code(kBoundStream, kBoundTable + area * 2 + (code == 0 ? 1 : 0),
                                       [&] { return boundSymbol(bounds, reference); });
      if (symbol == kPlainBounds) {
        bounds.below = static_cast<std::uint32_t>(io_.raw(8, bounds.below));
        bounds.above = static_cast<std::uint32_t>(io_.raw(8, bounds.above));
      } else {
        bounds = symbol == kNoBounds ? BoundSteps{0, 0} : boundsOf(symbol, reference);
      }
      a_.below[id] = boundCode(bounds.below);
      a_.above[id] = boundCode(bounds.above);
    }
  }

 public:
  static std::uint32_t wholeErrorCode(const Arrays& a, std::uint64_t whole, double doubledArea) {
    const double magnitude = static_cast<double>(whole) * std::fabs(a.encoding.scale) / doubledArea;
    const double largest = static_cast<double>(a.scale.decode(OutwardScale::kMaxCode));
    return a.scale.encode(std::fmin(magnitude, largest));
  }

 private:
  void store(const Floor& floor) {
    const std::uint32_t size = static_cast<std::uint32_t>(floor.corners);
    a_.slotBegin[node_] = slot_;
    a_.star[node_] = static_cast<std::uint8_t>(size | (floor.isOpen ? Arrays::kOpen : 0));
    std::copy_n(floor.link.begin(), size, a_.link.get() + slot_);
    std::copy_n(floor.outer.begin(), size, a_.outer.get() + slot_);
    if (floor.isOpen) a_.remover[a_.roots + slot_ + size - 1] = node_;
    const std::uint32_t firstFloor = slot_ - 2 * node_;
    for (int i = 0; i < floor.size; ++i)
      a_.floor[firstFloor + static_cast<std::uint32_t>(i)] = a_.idOf(floor.triangles[i].handle);
  }

  bool seeds(const Floor& floor) {
    const std::uint32_t triangles = static_cast<std::uint32_t>(floor.corners) - (floor.isOpen ? 1 : 0);
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const unsigned symbol =
          io_.code(kSlotStream, kSlotTable + class_, [&] { return io_.seedSymbol(slot_ + i, band_); });
      if (symbol == 0) continue;
      if (symbol - 1 > band_) return false;
      queues_[band_ - (symbol - 1)].push_back({node_, slot_ + i});
    }
    return true;
  }

  Arrays& a_;
  const Directory& directory_;
  const Chunk& chunk_;
  Io& io_;
  std::uint32_t band_ = 0, class_ = 0, node_ = 0, slot_ = 0, nodeEnd_ = 0, slotEnd_ = 0;
  std::array<std::vector<Handle>, MultiTriangulation::kBands> queues_;
  std::vector<Handle> listed_;
  std::string problem_;
};

}  // namespace arete::packed
