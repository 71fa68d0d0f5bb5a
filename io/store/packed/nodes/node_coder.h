// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The walk over nodes that the writer and the reader of a packed .amt share. Both grow the same MT node by
// node and differ in `Io`: Io::code(stream, table, actual) returns the next symbol, which the reader decodes
// and the writer gets from actual() and records. So both know the same when a symbol is coded. What the walk
// does not read again (floors, spheres, errors and bounds) is kept by the reader alone: Io::kKeepsValues.
//
// A node is coded as follows.
//   Its seed, a triangle of its floor: the last one that the packet creates. When a triangle is created a
//   symbol says whether it is a seed, and how many bands below its creator the node lies. Nodes wait in the
//   queue of their band, so they come in the order of their seeds and need no number. Nodes whose floor is
//   created by other packets are listed at the beginning of their band. Its floor: the shape that a walk from
//   the seed across edges finds (shapes.h). The outer edges, in the order of the walk, are the link. Whether
//   the star is open, and at which edge of the border; which of its triangles have no remover, and which are
//   left to other packets. The position of its vertex, as the difference from the centroid of the link; its
//   height, as the difference from the plane of the triangle of the floor that contains it. Errors and bounds
//   of the star's triangles that have a remover.
// The last two follow for all nodes of a run once their stars exist (geometry.h). Nothing about a node's
// children is coded before the node, so the first bands alone are an MT with known errors.
//
// What lies across an edge: front.h.

#include <array>
#include <bit>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/front.h"
#include "io/store/packed/nodes/root.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// Memory of a coder, reused from packet to packet.
struct CoderSpace {
  FrontSpace front;
  std::array<std::vector<Front::Own>, MultiTriangulation::kBands> queues;
  std::vector<std::uint32_t> listed;   ///< indices of seeds in Arrays::border
  std::vector<const Shape*> shapesOf;  ///< of the run's nodes
  std::deque<Shape> otherShapes;       ///< shapes that are not listed, or turned
  std::vector<std::uint32_t>
      passing;                      ///< slots with a remover, counted from the run's first, and a spare entry
  std::vector<std::uint8_t> areas;  ///< of the run's slots, see shownArea()
};

/// @tparam Form  what vertices and triangles carry (io/store/packed/heightfield/form.h,
/// io/store/packed/surface/form.h): its
///               Geometry codes the vertices of a run, its Values their errors
/// @tparam Io    the reader's (packet_reader.cpp) or the writer's (writer_io.h)
template <class Form, class Io>
class NodeCoder {
 public:
  NodeCoder(Arrays& arrays, const Directory& directory, const Packet& packet, Io& io, CoderSpace& space)
      : a_(arrays),
        directory_(directory),
        packet_(packet),
        io_(io),
        shapes_(listedShapes()),
        geometry_(arrays, io),
        values_(arrays, io),
        front_(arrays, packet, space.front),
        space_(space) {
    for (auto& queue : space_.queues) queue.clear();
  }

  /// Codes all nodes of the packet.
  /// @return false if the symbols are invalid; problem() says why
  bool run() {
    if (!Front::canHold(packet_.nodes, a_.border.size()))
      return fail("has more nodes than a packet can have");
    if (&packet_ == directory_.packets.data())
      values_.ofRoot(MultiTriangulation::kBands - 1, directory_.bandClass[MultiTriangulation::kBands - 1]);
    std::size_t segment = 0;
    std::uint32_t runsLeft = packet_.segments[0].runs;
    for (const Run& run : packet_.runs) {
      for (; runsLeft == 0; runsLeft = packet_.segments[segment].runs)
        if (++segment == packet_.segments.size() || !io_.nextSegment())
          return fail("has a segment that does not end where it should");
      --runsLeft;
      band_ = run.band;
      class_ = directory_.bandClass[band_];
      node_ = run.firstNode;
      slot_ = firstSlot_ = run.firstSlot;
      slotEnd_ = run.firstSlot + run.slots;
      nodeEnd_ = run.firstNode + run.nodes;
      // One more entry is written than there are slots with a remover.
      space_.passing.resize(std::max<std::size_t>(space_.passing.size(), std::size_t{run.slots} + 1));
      space_.areas.resize(std::max<std::size_t>(space_.areas.size(), run.slots));
      nextPassing_ = space_.passing.data();
      space_.shapesOf.clear();
      space_.otherShapes.clear();
      std::vector<Own>& queue = space_.queues[band_];
      if (!io_.listed(run, space_.listed)) return fail("lists an invalid seed");
      for (std::size_t i = 0; i < space_.listed.size(); ++i) {
        const std::uint32_t seed = space_.listed[i];
        if (i + kAhead < space_.listed.size()) front_.prefetchBorder(space_.listed[i + kAhead]);
        if (i + kAhead / 2 < space_.listed.size()) front_.prefetchAround(space_.listed[i + kAhead / 2]);
        io_.begin(a_.border[seed].id, node_);
        if (!front_.takeBorder(seed, 0, node_, floor_, 0)) return fail("lists a seed that is gone");
        if (!node(true)) return false;
      }
      // The queue may grow by nodes of this band.
      for (std::size_t i = 0; i < queue.size(); ++i) {
        if (node_ == nodeEnd_) return fail("has more nodes than announced");
        const Own seed = queue[i];
        if (i + kAhead < queue.size()) front_.prefetch(queue[i + kAhead]);
        if (i + kAhead / 4 < queue.size()) front_.prefetchBeyond(queue[i + kAhead / 4]);
        if (i + kAhead / 2 < queue.size()) front_.prefetchAround(queue[i + kAhead / 2]);
        io_.begin(seed.id, node_);
        if (!front_.take(seed, node_, floor_, 0)) return fail("has a seed that is gone");
        if (!node(false)) return false;
      }
      if (node_ != nodeEnd_ || slot_ != slotEnd_)
        return fail("has another number of nodes or slots than announced");
      queue.clear();
      if (!geometry_.run(run, class_, space_.shapesOf, space_.areas.data()))
        return fail(Form::kInvalidVertex);
      values_.ofRun(run, class_, {space_.passing.data(), nextPassing_}, space_.areas.data());
      if constexpr (Io::kKeepsValues) floorErrors(run);
    }
    if (!front_.finish(!packet_.isCut)) return fail("leaves another number of triangles than announced");
    return true;
  }
  const std::string& problem() const { return problem_; }

 private:
  using Own = Front::Own;
  static constexpr std::size_t kAhead = 12;

  bool fail(const char* what) {
    problem_ = what;
    return false;
  }

  bool node(bool isListed) {
    floor_.isOpen = false;
    const unsigned symbol = io_.code(kFloorStream, kShapeTable + (isListed ? 1 : 0),
                                     [&] { return io_.shapeSymbol(floor_.words.data()); });
    if (symbol < kListedShapes) [[likely]]
      shape_ = &shapes_[symbol];
    else if (symbol > kWalkedShape || !walked())
      return fail("has an invalid floor");
    return withCorners(shape_->corners, [&](auto known) { return nodeOf<known>(); });
  }

  /// kCorners: of the floor, 0 for any number.
  template <int kCorners>
  bool nodeOf() {
    if (!walk<kCorners>()) return fail("has an invalid floor");
    if (!floor_.isAtBorder && !a_.hasFills) [[likely]]
      return finishNode<kCorners>();
    if (!open()) return fail("has an open star away from the border");
    return finishNode<0>();
  }
  template <int kCorners>
  [[gnu::always_inline]] bool finishNode() {
    const std::uint32_t size = static_cast<std::uint32_t>(corners<kCorners>());
    // Each later node needs at least three slots.
    if (size + 3 * (nodeEnd_ - node_ - 1) > slotEnd_ - slot_) return fail("has more slots than announced");
    if (!io_.star(floor_, slot_)) return fail("has a star that is not its floor's");
    const int made = static_cast<int>(starTriangles<kCorners>());
    const std::uint64_t staying = io_.raw(made, io_.staying(slot_, made));
    const std::uint64_t left = this->left<kCorners>();
    if ((left & staying) != 0 || left >> made != 0) return fail("leaves triangles that it cannot leave");
    const std::uint32_t* const records =
        front_.template addStar<kCorners>(node_, slot_, floor_, staying, left);
    if constexpr (Io::kKeepsValues) {
      std::uint32_t* const ids = a_.floor.get() + (slot_ - 2 * node_);
      const int triangles = corners<kCorners>() - 2;
      for (int i = 0; i < triangles; ++i) ids[i] = floor_.id(i);
    }
    for (int i = 0; i < made; ++i) {
      *nextPassing_ = slot_ - firstSlot_ + static_cast<std::uint32_t>(i);
      nextPassing_ += ~staying >> i & 1;
    }
    space_.shapesOf.push_back(shape_);
    if (!seeds<kCorners>(records)) return fail("has a node below the last band");
    ++node_;
    slot_ += size;
    return true;
  }
  template <int kCorners>
  int corners() const {
    return kCorners > 0 ? kCorners : floor_.corners;
  }

  /// Removes the floor's triangles; finds the link and what lies across its edges.
  template <int kCorners>
  [[gnu::always_inline]] bool walk() {
    Floor& floor = floor_;
    const Shape& shape = *shape_;
    if (shape.corners != shape.triangles + 2) return false;
    floor.corners = shape.corners;
    floor.size = shape.triangles;
    const int corners = this->corners<kCorners>(), triangles = corners - 2;
    for (int i = 1; i < triangles; ++i)
      if (!front_.takeAcross(shape.steps[static_cast<unsigned>(i)].from, node_, floor, i)) return false;
    bool isAtBorder = false;
    for (int i = 0; i < corners; ++i) {
      const unsigned edge = shape.link[static_cast<unsigned>(i)];
      const std::uint32_t vertex = floor.words[edge];
      floor.link[i] = vertex;
      const Side across = floor.words[edge + Floor::kAcross];
      floor.outer[i] = across;
      isAtBorder |= across == kNoSide;
    }
    floor.isAtBorder = isAtBorder;
    return true;
  }
  bool walked() {
    const auto shape = walkedShape([&](const Shape& s, int inner, int count) {
      const unsigned table =
          s.triangles == 1
              ? kSeedTable
              : kFloodTable + static_cast<unsigned>(std::min(s.triangles - 2, 5) * 4 + std::min(inner, 3));
      return io_.code(kFloorStream, table, [&] { return io_.shapeBits(count); });
    });
    if (shape) shape_ = &space_.otherShapes.emplace_back(*shape);
    return shape.has_value();
  }

  /// Turns the link of an open star so that its last edge is the border edge that the vertex divides. Where
  /// rims reach over NODATA a border may have been closed, and the star may open at any edge.
  bool open() {
    Floor& floor = floor_;
    std::array<int, kMaxHoleCorners> borders;
    unsigned count = 0;
    for (int i = 0; i < floor.corners; ++i)
      if (floor.outer[i] == kNoSide || a_.hasFills) borders[count++] = i;
    const unsigned which = io_.code(kFloorStream, kOpenTable,
                                    [&] { return io_.openEdge(floor, std::span(borders.data(), count)); });
    if (which == 0) return true;
    if (which > count) return false;
    floor.isOpen = true;
    const int first = (borders[which - 1] + 1) % floor.corners;
    std::rotate(floor.link.begin(), floor.link.begin() + first, floor.link.begin() + floor.corners);
    std::rotate(floor.outer.begin(), floor.outer.begin() + first, floor.outer.begin() + floor.corners);
    Shape turned = *shape_;
    for (int i = 0; i < floor.size; ++i)
      for (std::uint8_t& place : turned.steps[static_cast<unsigned>(i)].place)
        place = static_cast<std::uint8_t>((place + floor.corners - first) % floor.corners);
    shape_ = &space_.otherShapes.emplace_back(turned);
    return true;
  }

  /// The largest error of each node's floor; saturate() adds those of the children (arrays.h).
  void floorErrors(const Run& run) {
    constexpr std::ptrdiff_t kIdsAhead = 24;
    const std::uint32_t* id = a_.floor.get() + (run.firstSlot - 2 * run.firstNode);
    const std::uint32_t* const last = id + (run.slots - 2 * std::size_t{run.nodes}) - 1;
    const std::uint16_t* const error = a_.error.get();
    for (std::uint32_t n = run.firstNode; n != run.firstNode + run.nodes; ++n) {
      const std::uint32_t triangles = a_.starSize(n) - 2;
      std::uint16_t largest = 0;
      for (std::uint32_t i = 0; i < triangles; ++i, ++id) {
        __builtin_prefetch(&error[id[std::min(kIdsAhead, last - id)]]);
        largest = std::max(largest, error[*id]);
      }
      a_.saturatedError[n] = largest;
    }
  }

  template <int kCorners>
  std::uint32_t starTriangles() const {
    return static_cast<std::uint32_t>(corners<kCorners>() - (kCorners == 0 && floor_.isOpen ? 1 : 0));
  }
  /// Bit i: triangle i of the star is left to another packet.
  template <int kCorners>
  [[gnu::always_inline]] std::uint64_t left() {
    const std::uint32_t triangles = starTriangles<kCorners>();
    std::uint64_t all = 0;
    for (std::uint32_t first = 0; first < triangles; first += 8) {
      const std::uint32_t more = triangles - first;
      const std::uint64_t mask = io_.code(kSlotStream, kLeftTable + starClass(more), [&] {
        unsigned actual = 0;
        for (std::uint32_t i = 0; i < std::min(more, 8u); ++i)
          actual |= static_cast<unsigned>(io_.isLeft(slot_ + first + i)) << i;
        return actual;
      });
      all |= mask << first;
    }
    return all;
  }
  template <int kCorners>
  [[gnu::always_inline]] bool seeds(const std::uint32_t* records) {
    const std::uint32_t triangles = starTriangles<kCorners>();
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
        space_.queues[band_ - below].push_back({records[first + i], a_.roots + slot_ + first + i});
      }
    }
    return true;
  }

  Arrays& a_;
  const Directory& directory_;
  const Packet& packet_;
  Io& io_;
  std::uint32_t band_ = 0, class_ = 0, node_ = 0, slot_ = 0, nodeEnd_ = 0, firstSlot_ = 0, slotEnd_ = 0;
  std::span<const Shape, kListedShapes> shapes_;
  const Shape* shape_ = nullptr;
  typename Form::template Geometry<Io> geometry_;
  typename Form::template Values<Io> values_;
  Front front_;
  CoderSpace& space_;
  Floor floor_;
  std::uint32_t* nextPassing_ = nullptr;
  std::string problem_;
};

}  // namespace arete::packed
