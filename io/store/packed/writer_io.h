// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "io/store/entropy/numbers.h"
#include "io/store/entropy/rans.h"
#include "io/store/packed/heightfield/bounds.h"
#include "io/store/packed/nodes/errors.h"
#include "io/store/packed/nodes/front.h"
#include "io/store/packed/nodes/heights.h"
#include "io/store/packed/nodes/plan.h"
#include "io/store/packed/nodes/shapes.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// What the walks of all packets share.
struct Walk {
  const MultiTriangulation& mt;
  const Plan& plan;
  Arrays& arrays;
  UninitializedVector<std::uint32_t> oldNode;      ///< per new node
  UninitializedVector<std::uint32_t> newNode;      ///< per node of the model
  UninitializedVector<std::uint32_t> oldTriangle;  ///< per new slot
  UninitializedVector<std::uint8_t> turn;  ///< per new node: the old slot, within the node, of its first one
  UninitializedVector<std::uint8_t> ownParentsLeft;
};

/// The streams of a segment, before they are encoded.
struct Streams {
  std::array<std::vector<RansSymbol>, kStreams> symbols;
  std::vector<std::byte> boundBytes, rawBits;

  /// Keeps the memory.
  void clear() {
    for (auto& s : symbols) s.clear();
    boundBytes.clear();
    rawBits.clear();
  }
};

class WriterIo {
 public:
  /// @param streams  memory for the streams of a segment
  /// @param segments  receives the streams of all segments, after finish()
  WriterIo(Walk& walk, std::uint32_t packet, Streams& streams, std::vector<Streams>& segments)
      : w_(walk),
        mt_(walk.mt),
        a_(mt_.arrays()),
        below_(mt_.column(kBelow)),
        above_(mt_.column(kAbove)),
        rms_(mt_.column(kRms)),
        roots_(mt_.rootTriangleCount()),
        packet_(packet),
        streams_(streams),
        segments_(segments) {
    streams_.clear();
    for (const std::uint32_t n : w_.plan.listed[packet]) listed_[w_.plan.band[n]].push_back(n);
  }

  bool nextSegment() {
    finish();
    return true;
  }
  /// Keeps the streams of the last segment.
  void finish() {
    streams_.rawBits = rawBits_.take();
    segments_.push_back(streams_);  // a copy without spare capacity; `streams_` keeps its memory
    streams_.clear();
  }

  static constexpr bool kKeepsValues = false;

  template <class Actual>
  unsigned code(Stream stream, unsigned table, const Actual& actual) {
    const unsigned symbol = actual();
    streams_.symbols[stream].push_back({static_cast<std::uint8_t>(table), static_cast<std::uint8_t>(symbol)});
    return symbol;
  }
  std::uint64_t raw(int bits, std::uint64_t actual) {
    rawBits_.write(actual, bits);
    return actual;
  }

  WriterIo& values() { return *this; }
  void putBack(const WriterIo&) {}

  bool listed(const Run& run, std::vector<std::uint32_t>& seeds) {
    std::vector<Entry> entries;
    // Of a floor the first triangle in the order of packets is the seed, however the model numbers them.
    const auto order = [](const Entry& e) { return std::tie(e.from, e.place); };
    for (const std::uint32_t n : listed_[run.band]) {
      const std::span<const std::uint32_t> floor = mt_.floor(NodeId(n));
      Entry first = entryOf(floor[0]);
      for (const std::uint32_t t : floor.subspan(1)) first = std::ranges::min(first, entryOf(t), {}, order);
      entries.push_back(first);
    }
    std::ranges::sort(entries, {}, order);
    seeds.clear();
    std::uint32_t from = 0, place = 0;
    for (const Entry& e : entries) {
      codeNumber(*this, kFloorStream, kListPacketTable, [&] { return e.from - from; });
      if (e.from != from) place = 0;
      codeNumber(*this, kFloorStream, kListBorderTable, [&] { return e.place - place; });
      from = e.from;
      place = e.place;
      seeds.push_back(e.border);
    }
    return seeds.size() == run.listed;
  }

  /// Selects the node with this number.
  void at(std::uint32_t number) { old_ = w_.oldNode[number]; }
  /// Selects the node that removes the seed, and gives it the number.
  void begin(std::uint32_t seed, std::uint32_t number) {
    number_ = number;
    old_ = a_.remover[oldIdOf(seed)];
    w_.oldNode[number] = old_;
    w_.newNode[old_] = number;
    const auto floor = mt_.floor(NodeId(old_));
    floorSize_ = static_cast<int>(floor.size());
    for (int i = 0; i < floorSize_; ++i) {
      const std::uint32_t t = floor[static_cast<std::size_t>(i)];
      const auto corners = mt_.corners(
          TriangleId(t), NodeId(t < roots_ ? MultiTriangulation::kNone : w_.plan.owners.of(t - roots_)));
      for (std::size_t c = 0; c < 3; ++c) corners_[i][c] = newVertex(corners[c]);
      isFound_[i] = t == oldIdOf(seed);
    }
  }

  /// Walks over the floor as the reader will. `words` begin with the seed's corners.
  unsigned shapeSymbol(const std::uint32_t* words) {
    std::array<std::array<std::uint32_t, 3>, kMaxFloor> found;
    shapeBits_ = 0;
    int bit = 0;
    const auto shape = walkedShape([&](const Shape& s, int, int count) {
      const unsigned t = s.triangles - 1u;
      if (t == 0)
        found[0] = {words[0], words[1], words[2]};
      else
        found[t] = acrossOf(found[s.steps[t].from >> 3], s.steps[t].from & 7);
      unsigned inner = 0;
      for (int i = 0; i < count; ++i)
        if (find(found[t], 3 - count + i)) inner |= 1u << i;
      shapeBits_ |= std::uint64_t{inner} << bit;
      bit += count;
      return inner;
    });
    return shape ? packed::shapeSymbol(shapeBits_, shape->triangles) : 0;
  }
  unsigned shapeBits(int count) {
    const auto bits = static_cast<unsigned>(shapeBits_ & ((1u << count) - 1));
    shapeBits_ >>= count;
    return bits;
  }

  unsigned openEdge(const Floor& floor, std::span<const int> borders) const {
    if (!mt_.isOpen(NodeId(old_))) return 0;
    const auto link = mt_.link(NodeId(old_));
    const std::uint32_t from = newVertex(link.back()), to = newVertex(link.front());
    for (unsigned i = 0; i < borders.size(); ++i)
      if (floor.link[borders[i]] == from && floor.link[(borders[i] + 1) % floor.corners] == to) return i + 1;
    return 0;
  }

  /// Maps the star's slots to those of the model, whose link may begin elsewhere. Returns false if the walk
  /// did not find the floor or its link.
  bool star(const Floor& floor, std::uint32_t slot) {
    if (floor.size != floorSize_ || floor.isOpen != mt_.isOpen(NodeId(old_))) return false;
    for (int i = 0; i < floor.size; ++i)
      if (a_.remover[oldIdOf(floor.id(i))] != old_) return false;
    const auto link = mt_.link(NodeId(old_));
    const std::uint32_t size = static_cast<std::uint32_t>(link.size());
    std::uint32_t turn = 0;
    while (turn < size && newVertex(link[turn]) != floor.link[0]) ++turn;
    if (turn == size || (floor.isOpen && turn != 0) || size != static_cast<std::uint32_t>(floor.corners))
      return false;
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t j = (i + turn) % size;
      if (newVertex(link[j]) != floor.link[i]) return false;
      w_.oldTriangle[slot + i] = roots_ + a_.slotBegin[old_] + j;
    }
    w_.turn[number_] = static_cast<std::uint8_t>(turn);
    return true;
  }

  /// Bit i: triangle i of the star has no remover.
  std::uint64_t staying(std::uint32_t slot, int triangles) const {
    std::uint64_t bits = 0;
    for (int i = 0; i < triangles; ++i)
      if (a_.remover[w_.oldTriangle[slot + static_cast<std::uint32_t>(i)]] == MultiTriangulation::kNone)
        bits |= std::uint64_t{1} << i;
    return bits;
  }

  Vec2 actualPlace() const {
    const Vec2 p = a_.vertices.planPosition(mt_.apex(NodeId(old_)));
    return {p.x, p.y};
  }
  std::int64_t actualHeightResidual(double predicted) const {
    const HeightEncoding::Type type = a_.vertices.encoding.type;
    return heightResidual(
        type, rawHeight(type, a_.vertices.rawHeights.data(), mt_.apex(NodeId(old_)).index()), predicted);
  }

  Vec3 actualPosition() const { return a_.vertices.place(mt_.apex(NodeId(old_))); }

  std::uint16_t actualError(std::uint32_t id) const { return a_.error[oldIdOf(id)]; }
  std::uint16_t actualRms(std::uint32_t id) const { return rms_[oldIdOf(id)]; }
  /// Error and RMS of the triangles that stay.
  std::array<std::uint16_t, 2> actualFinest() const { return {w_.arrays.finestError, w_.arrays.finestRms}; }
  std::optional<std::uint64_t> wholeError(double doubledArea, std::uint16_t code) const {
    if (code == 0) return 0;
    const double largest =
        static_cast<double>(a_.scale.decode(code)) * doubledArea / std::fabs(w_.arrays.encoding.scale);
    if (!(largest < 1 << 24)) return std::nullopt;
    // Codes are rounded upwards by up to one part in 2048, so several whole numbers may have the code: take
    // the least one.
    const auto most = static_cast<std::uint64_t>(largest + 1e-6);
    for (std::uint64_t whole = most - std::min<std::uint64_t>(most, most / 2048 + 1); whole <= most; ++whole)
      if (wholeErrorCode(w_.arrays.scale, w_.arrays.encoding, whole, doubledArea) == code) return whole;
    return std::nullopt;
  }
  BoundBytes bounds(std::uint32_t id, std::uint32_t reference) {
    const std::uint32_t t = oldIdOf(id);
    const BoundBytes bytes = bytesOf(roundedBounds(boundStep(below_[t]), boundStep(above_[t])), reference);
    streams_.boundBytes.push_back(static_cast<std::byte>(bytes.first));
    if (bytes.isFar()) streams_.boundBytes.push_back(static_cast<std::byte>(bytes.second));
    return bytes;
  }

  /// How many bands below this one the node lies whose seed is here; nothing if no node has it.
  std::optional<unsigned> seedAt(std::uint32_t slot, std::uint32_t band) {
    const std::uint32_t remover = a_.remover[w_.oldTriangle[slot]];
    if (remover == MultiTriangulation::kNone || w_.plan.packetOf[remover] != packet_ ||
        --w_.ownParentsLeft[remover] != 0)
      return std::nullopt;
    return band - w_.plan.band[remover];
  }
  /// Whether the remover of the triangle is in another packet.
  bool isLeft(std::uint32_t slot) const {
    const std::uint32_t remover = a_.remover[w_.oldTriangle[slot]];
    return remover != MultiTriangulation::kNone && w_.plan.packetOf[remover] != packet_;
  }

 private:
  std::uint32_t newVertex(std::uint32_t old) const {
    return old < a_.rootVertices ? old : a_.rootVertices + w_.newNode[old - a_.rootVertices];
  }
  std::uint32_t oldIdOf(std::uint32_t id) const { return id < roots_ ? id : w_.oldTriangle[id - roots_]; }

  /// A triangle of another packet: 1 + the index of that packet among those that this one depends on (0: the
  /// root), the triangle's index among those that the packet leaves, and among all borders.
  struct Entry {
    std::uint32_t from, place, border;
  };
  Entry entryOf(std::uint32_t triangle) const {
    if (triangle < roots_) return {0, triangle, triangle};
    const std::uint32_t owner = w_.plan.owners.of(triangle - roots_), c = w_.plan.packetOf[owner];
    const Packet& packet = w_.plan.directory.packets[c];
    const auto& dependsOn = w_.plan.directory.packets[packet_].dependsOn;
    const auto from = std::lower_bound(dependsOn.begin(), dependsOn.end(), c) - dependsOn.begin();
    // The remover is in this packet and not coded yet, so the triangle still has its mark.
    const std::uint32_t border =
        w_.arrays.remover[roots_ + newSlot(triangle - roots_, owner)] & ~Arrays::kMarks;
    return {static_cast<std::uint32_t>(from) + 1,
            static_cast<std::uint32_t>(border - roots_ - packet.firstBorder), border};
  }

  /// The new slot of a slot of the model. Precondition: its owner has been coded.
  std::uint32_t newSlot(std::uint32_t slot, std::uint32_t owner) const {
    const std::uint32_t number = w_.newNode[owner], size = mt_.slotCount(NodeId(owner));
    const std::uint32_t at = slot - a_.slotBegin[owner] + size - w_.turn[number];
    return w_.arrays.slotBegin[number] + (at < size ? at : at - size);
  }

  /// Whether a triangle of the floor lies across an edge that was not found yet; marks it as found.
  bool find(const std::array<std::uint32_t, 3>& corners, int edge) {
    const std::uint32_t from = corners[(edge + 1) % 3], to = corners[edge];
    for (int j = 0; j < floorSize_; ++j)
      for (int e = 0; e < 3 && !isFound_[j]; ++e)
        if (corners_[j][e] == from && corners_[j][(e + 1) % 3] == to) return isFound_[j] = true;
    return false;
  }
  /// The corners of the triangle across an edge, from that edge.
  std::array<std::uint32_t, 3> acrossOf(const std::array<std::uint32_t, 3>& corners, int edge) const {
    const std::uint32_t from = corners[(edge + 1) % 3], to = corners[edge];
    for (int j = 0; j < floorSize_; ++j)
      for (int e = 0; e < 3; ++e)
        if (corners_[j][e] == from && corners_[j][(e + 1) % 3] == to)
          return {from, to, corners_[j][(e + 2) % 3]};
    return {};
  }

  Walk& w_;
  const MultiTriangulation& mt_;
  const MtArrays& a_;
  std::span<const std::uint16_t> below_, above_, rms_;
  std::uint32_t roots_, packet_;
  Streams& streams_;
  std::vector<Streams>& segments_;
  BitWriter rawBits_;
  std::array<std::vector<std::uint32_t>, MultiTriangulation::kBands> listed_;

  // Of the selected node.
  std::uint32_t number_ = 0, old_ = 0;
  int floorSize_ = 0;
  std::array<std::array<std::uint32_t, 3>, kMaxFloor> corners_;
  std::array<bool, kMaxFloor> isFound_;
  std::uint64_t shapeBits_ = 0;
};

}  // namespace arete::packed
