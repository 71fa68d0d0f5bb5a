// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two sides of the coder for the tiny model (tests/io/amt_fixture.h): one that knows the model and records
// every symbol, and one that replays the record and holds what is asked for against it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "io/amt_fixture.h"
#include "io/store/packed/heightfield/bounds.h"
#include "io/store/packed/nodes/front.h"
#include "io/store/packed/nodes/shapes.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed::test {

/// What was coded: symbols with their stream and table, raw bits with their count, bytes of bounds.
struct Recording {
  std::deque<std::tuple<Stream, unsigned, unsigned>> symbols;
  std::deque<std::pair<int, std::uint64_t>> raw;
  std::deque<BoundBytes> bounds;
  bool isEmpty() const { return symbols.empty() && raw.empty() && bounds.empty(); }
};

/// Node 0 is listed and lies a band above node 1, whose seed is slot 0.
inline bool listTiny(const Run& run, std::vector<std::uint32_t>& seeds) {
  seeds.clear();
  if (run.firstNode == 0) seeds.push_back(0);
  return true;
}

/// Knows the model.
class KnowingIo {
 public:
  bool nextSegment() { return true; }
  static constexpr bool kKeepsValues = true;

  explicit KnowingIo(const TerrainModel& model) : a_(model.mt.arrays()) {}

  Recording recording;
  Vec2 offset = {};  ///< moves the vertices

  template <class Actual>
  unsigned code(Stream stream, unsigned table, const Actual& actual) {
    const auto symbol = static_cast<unsigned>(actual());
    recording.symbols.emplace_back(stream, table, symbol);
    return symbol;
  }
  std::uint64_t raw(int bits, std::uint64_t actual) {
    recording.raw.emplace_back(bits, actual);
    return actual;
  }
  KnowingIo& values() { return *this; }
  void putBack(const KnowingIo&) {}
  bool listed(const Run& run, std::vector<std::uint32_t>& seeds) { return listTiny(run, seeds); }
  void at(std::uint32_t node) { node_ = node; }
  void begin(std::uint32_t, std::uint32_t node) { node_ = node; }
  /// Node 0: inner edge 2 of the seed; node 1: one triangle.
  unsigned shapeSymbol(const std::uint32_t*) {
    return node_ == 0 ? packed::shapeSymbol(0b100, 2) : packed::shapeSymbol(0, 1);
  }
  unsigned shapeBits(int) { return 0; }
  unsigned openEdge(const Floor&, std::span<const int>) const { return node_; }
  bool star(const Floor&, std::uint32_t) { return true; }
  std::uint64_t staying(std::uint32_t slot, int) const { return slot == 0 ? 0b1110 : 0b11; }
  bool isLeft(std::uint32_t) const { return false; }
  std::optional<unsigned> seedAt(std::uint32_t slot, std::uint32_t) {
    return slot == 0 ? std::optional(1u) : std::nullopt;
  }
  Vec2 actualPlace() const {
    const Vec2 p = a_.vertices.planPosition(VertexId(4 + node_));
    return {p.x + offset.x, p.y + offset.y};
  }
  std::int64_t actualHeightResidual(double predicted) const {
    const HeightEncoding::Type type = a_.vertices.encoding.type;
    return heightResidual(type, rawHeight(type, a_.vertices.rawHeights.data(), 4 + node_), predicted);
  }
  std::uint16_t actualError(std::uint32_t id) const { return a_.error[id]; }
  std::optional<std::uint64_t> wholeError(double, std::uint16_t code) const {
    return code == 0 ? std::optional<std::uint64_t>(0) : std::nullopt;
  }
  BoundBytes bounds(std::uint32_t id, std::uint32_t reference) {
    const BoundBytes bytes = bytesOf(
        roundedBounds(boundStep(a_.columns.of(kBelow)[id]), boundStep(a_.columns.of(kAbove)[id])), reference);
    recording.bounds.push_back(bytes);
    return bytes;
  }

 private:
  const MtArrays& a_;
  std::uint32_t node_ = 0;
};

/// Knows nothing but the record.
class ReplayingIo {
 public:
  bool nextSegment() { return true; }
  static constexpr bool kKeepsValues = true;

  explicit ReplayingIo(Recording recording) : recording_(std::move(recording)) {}

  bool isAtEnd() const { return recording_.isEmpty(); }

  template <class Actual>
  unsigned code(Stream stream, unsigned table, const Actual&) {
    if (recording_.symbols.empty()) {
      ADD_FAILURE() << "a symbol too many";
      return 0;
    }
    const auto [itsStream, itsTable, symbol] = recording_.symbols.front();
    recording_.symbols.pop_front();
    EXPECT_EQ(stream, itsStream);
    EXPECT_EQ(table, itsTable);
    return symbol;
  }
  std::uint64_t raw(int bits, std::uint64_t) {
    if (recording_.raw.empty()) {
      ADD_FAILURE() << "raw bits too many";
      return 0;
    }
    const auto [itsBits, value] = recording_.raw.front();
    recording_.raw.pop_front();
    EXPECT_EQ(bits, itsBits);
    return value;
  }
  ReplayingIo& values() { return *this; }
  void putBack(const ReplayingIo&) {}
  bool listed(const Run& run, std::vector<std::uint32_t>& seeds) { return listTiny(run, seeds); }
  BoundBytes bounds(std::uint32_t, std::uint32_t) {
    const BoundBytes bytes = recording_.bounds.front();
    recording_.bounds.pop_front();
    return bytes;
  }
  void at(std::uint32_t) {}
  void begin(std::uint32_t, std::uint32_t) {}
  unsigned shapeSymbol(const std::uint32_t*) { return 0; }
  unsigned shapeBits(int) { return 0; }
  unsigned openEdge(const Floor&, std::span<const int>) const { return 0; }
  bool star(const Floor&, std::uint32_t) { return true; }
  std::uint64_t staying(std::uint32_t, int) const { return 0; }
  bool isLeft(std::uint32_t) const { return false; }
  std::optional<unsigned> seedAt(std::uint32_t, std::uint32_t) { return std::nullopt; }
  Vec2 actualPlace() const { return {}; }
  std::int64_t actualHeightResidual(double) const { return 0; }
  std::uint16_t actualError(std::uint32_t) const { return 0; }
  std::optional<std::uint64_t> wholeError(double, std::uint16_t) const { return 0; }

 private:
  Recording recording_;
};

/// The arrays of the tiny model, empty.
inline void allocateTiny(Arrays& arrays, const TerrainModel& model) {
  const MtArrays& a = model.mt.arrays();
  arrays.isLattice = true;
  arrays.columns = arrays.rows = 3;
  arrays.encoding = a.vertices.encoding;
  arrays.scale = a.scale;
  arrays.metric = a.metric;
  if (!arrays.allocate({4, 2, 2, 7, 0, 0}, 0)) throw std::runtime_error("no memory");
}

/// Its root, as a writer's arrays hold it.
inline void fillRoot(Arrays& arrays, const TerrainModel& model) {
  const MtArrays& a = model.mt.arrays();
  std::ranges::copy(a.rootTriangles, arrays.rootTriangles.get());
  std::copy_n(a.vertices.samples.begin(), 4, arrays.samples.get());
  std::copy_n(a.vertices.rawHeights.begin(), 8, arrays.rawHeights.get());
}

/// One packet with a node in each of two bands.
inline Directory tinyDirectory(const TerrainModel& model) {
  const auto& saturated = model.mt.arrays().saturatedError;
  Directory directory;
  directory.packets.resize(1);
  for (const std::uint32_t n : {0u, 1u}) {
    Run run;
    run.band = MultiTriangulation::bandOf(saturated[n]);
    run.nodes = 1;
    run.slots = n == 0 ? 4 : 3;
    run.listed = n == 0 ? 1 : 0;
    directory.packets[0].runs.push_back(run);
  }
  directory.packets[0].segments.resize(1);
  directory.packets[0].segments[0].runs = 2;
  directory.number();
  return directory;
}

}  // namespace arete::packed::test
