// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/store/entropy/numbers.h"
#include "io/store/entropy/rans.h"
#include "io/store/packed/heightfield/bounds.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/front.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/nodes/tables.h"

namespace arete::packed {

/// Reads the bytes of bounds. Reading beyond the end gives some bytes; isAtEnd() detects it.
class BoundReader {
 public:
  /// The bytes behind the end that must be readable.
  static constexpr std::size_t kReadable = 3;

  BoundReader() = default;
  BoundReader(const std::byte* bytes, std::size_t size) : at_(bytes), end_(bytes + size) {}

  BoundBytes next() {
    const BoundBytes bytes{static_cast<std::uint8_t>(at_[0]), static_cast<std::uint8_t>(at_[1])};
    at_ += bytes.isFar() ? 2 : 1;
    if (at_ > end_) [[unlikely]]
      at_ = end_ + 1;
    return bytes;
  }
  bool isAtEnd() const { return at_ == end_; }

 private:
  const std::byte *at_ = nullptr, *end_ = nullptr;  // at_ is one beyond end_ if too much was read
};

class ReaderIo {
 public:
  /// @param nodes of all packets; the packet's segments lie there (Segment::offset)
  ReaderIo(const Arrays& arrays, const Directory& directory, std::size_t packet, const std::uint32_t* tables,
           std::span<const std::byte> nodes)
      : a_(arrays),
        directory_(directory),
        packet_(directory.packets[packet]),
        tables_(tables),
        nodes_(nodes) {
    open(packet_.segments[0]);
  }

  /// Goes on with the streams of the next segment. Precondition: there is one.
  /// @return false if a stream of the last one does not end here
  bool nextSegment() {
    if (!isAtEnd()) return false;
    open(packet_.segments[++segment_]);
    return true;
  }

  static constexpr bool kKeepsValues = true;

  template <class Actual>
  unsigned code(Stream stream, unsigned table, const Actual&) {
    return streams_[stream].decode(tables_ + table * RansTable::kEntries);
  }
  std::uint64_t raw(int bits, std::uint64_t) { return raw_.read(bits); }

  /// Reads long runs of errors and bounds: a copy of the streams that stays in registers.
  struct Values {
    RansDecoder error;
    BoundReader boundBytes;
    BitReader rawBits;
    const std::uint32_t* tables;

    template <class Actual>
    unsigned code(Stream, unsigned table, const Actual&) {
      return error.decode(tables + table * RansTable::kEntries);
    }
    std::uint64_t raw(int bits, std::uint64_t) { return rawBits.read(bits); }
    std::uint16_t actualError(std::uint32_t) const { return 0; }
    std::uint16_t actualRms(std::uint32_t) const { return 0; }
    std::optional<std::uint64_t> wholeError(double, std::uint16_t) const { return 0; }
    BoundBytes bounds(std::uint32_t, std::uint32_t) { return boundBytes.next(); }
  };
  Values values() const { return {streams_[kErrorStream], bounds_, raw_, tables_}; }
  void putBack(const Values& values) {
    streams_[kErrorStream] = values.error;
    bounds_ = values.boundBytes;
    raw_ = values.rawBits;
  }

  bool listed(const Run& run, std::vector<std::uint32_t>& seeds) {
    const auto& dependsOn = packet_.dependsOn;
    seeds.clear();
    std::uint64_t from = 0, place = 0;
    for (std::uint32_t i = 0; i < run.listed; ++i) {
      const std::uint64_t later = codeNumber(*this, kFloorStream, kListPacketTable, [] { return 0; });
      if (later > 0) place = 0;
      from += later;
      place += codeNumber(*this, kFloorStream, kListBorderTable, [] { return 0; });
      if (from > dependsOn.size()) return false;
      const Packet* const other = from > 0 ? &directory_.packets[dependsOn[from - 1]] : nullptr;
      if (place >= (other != nullptr ? other->borders : a_.roots)) return false;
      const std::uint64_t first = other != nullptr ? a_.roots + other->firstBorder : 0;
      seeds.push_back(static_cast<std::uint32_t>(first + place));
    }
    return true;
  }

  bool isAtEnd() const {
    return !raw_.isOver() && bounds_.isAtEnd() &&
           std::ranges::all_of(streams_, [](const RansDecoder& s) { return s.isAtEnd(); });
  }

  // Values that only the writer has.
  void begin(std::uint32_t, std::uint32_t) {}
  void at(std::uint32_t) {}
  unsigned shapeSymbol(const std::uint32_t*) { return 0; }
  unsigned shapeBits(int) { return 0; }
  unsigned openEdge(const Floor&, std::span<const int>) { return 0; }
  bool star(const Floor&, std::uint32_t) { return true; }
  std::uint64_t staying(std::uint32_t, int) const { return 0; }
  Vec2 actualPlace() const { return {0, 0}; }
  Vec3 actualPosition() const { return {0, 0, 0}; }
  std::array<std::uint16_t, 2> actualFinest() const { return {0, 0}; }
  std::int64_t actualHeightResidual(double) const { return 0; }
  std::optional<unsigned> seedAt(std::uint32_t, std::uint32_t) { return std::nullopt; }
  bool isLeft(std::uint32_t) const { return false; }

 private:
  void open(const Segment& segment) {
    const auto streams =
        nodes_.subspan(segment.offset, segment.bytes() - segment.headerBytes - segment.carriedBytes);
    bytes_.assign(streams.begin(), streams.end());
    bytes_.resize(bytes_.size() + std::max(RansDecoder::kReadable, BoundReader::kReadable));
    std::size_t at = 0;
    for (unsigned s = 0; s < kParts; ++s) {
      const std::size_t size = segment.streamBytes[s];
      if (s < kStreams)
        streams_[s] = RansDecoder(bytes_.data() + at, size);
      else if (s == kBoundBytes)
        bounds_ = BoundReader(bytes_.data() + at, size);
      else
        raw_ = BitReader({bytes_.data() + at, size});
      at += size;
    }
  }

  const Arrays& a_;
  const Directory& directory_;
  const Packet& packet_;
  const std::uint32_t* tables_;
  std::span<const std::byte> nodes_;
  std::size_t segment_ = 0;
  std::vector<std::byte> bytes_;
  std::array<RansDecoder, kStreams> streams_;
  BoundReader bounds_;
  BitReader raw_;
};

}  // namespace arete::packed
