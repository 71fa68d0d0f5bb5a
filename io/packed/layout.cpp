// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers are written as LEB128: seven bits per byte, the lowest first; the eighth bit is set if more bytes
// follow. A reader checks each count against the bytes that are left before it allocates.
#include "io/packed/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace arete::packed {
namespace {

class ByteSink {
 public:
  void number(std::uint64_t value) {
    for (; value >= 128; value >>= 7) bytes_.push_back(static_cast<std::byte>(value | 128));
    bytes_.push_back(static_cast<std::byte>(value));
  }
  template <class T>
  void plain(const T& value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads zeros beyond the end, and isDone() is false then.
class ByteSource {
 public:
  explicit ByteSource(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = plain<std::uint8_t>();
      value |= std::uint64_t{byte & 127u} << shift;
      if (byte < 128) return value;
    }
    isBad_ = true;
    return 0;
  }
  /// A number of at most `limit`; a larger one makes the source bad.
  std::uint32_t number(std::uint64_t limit) {
    const std::uint64_t value = number();
    if (value <= limit) return static_cast<std::uint32_t>(value);
    isBad_ = true;
    return 0;
  }
  template <class T>
  T plain() {
    T value{};
    if (bytes_.size() - at_ < sizeof value) {
      isBad_ = true;
      at_ = bytes_.size();
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  bool isBad() const { return isBad_; }
  bool isDone() const { return !isBad_ && at_ == bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool isBad_ = false;
};

/// The first packed form had no version; its first byte was a band's class, which is below kClasses. The
/// second was version 16.
constexpr std::uint8_t kPackedVersion = 18;
static_assert(kPackedVersion >= kClasses);

constexpr std::uint32_t kMaxIds = MultiTriangulation::kNone - 1;
/// The least bytes of a packet in the directory: four doubles, a checksum, and the numbers that each packet
/// has.
constexpr std::uint64_t kLeastPacketBytes = 4 * 8 + 8 + kParts + 3;

}  // namespace

void Directory::number() {
  std::uint64_t offset = 0, borders = 0;
  std::vector<Run*> runs;
  for (Packet& packet : packets) {
    packet.offset = offset;
    offset += packet.bytes();
    packet.firstBorder = borders;
    borders += packet.borders;
    packet.nodes = 0;
    for (Run& run : packet.runs) {
      packet.nodes += run.nodes;
      runs.push_back(&run);
    }
  }
  std::ranges::stable_sort(runs, [](const Run* a, const Run* b) { return a->band > b->band; });
  std::uint32_t node = 0, slot = 0;
  for (Run* run : runs) {
    run->firstNode = node;
    run->firstSlot = slot;
    node += run->nodes;
    slot += run->slots;
  }
}

std::uint64_t Directory::nodes() const {
  std::uint64_t sum = 0;
  for (const Packet& packet : packets)
    for (const Run& run : packet.runs) sum += run.nodes;
  return sum;
}

std::uint64_t Directory::slots() const {
  std::uint64_t sum = 0;
  for (const Packet& packet : packets)
    for (const Run& run : packet.runs) sum += run.slots;
  return sum;
}

std::uint64_t Directory::borders() const {
  std::uint64_t sum = 0;
  for (const Packet& packet : packets) sum += packet.borders;
  return sum;
}

std::vector<std::byte> toBytes(const Directory& directory) {
  ByteSink out;
  out.plain(kPackedVersion);
  for (const std::uint8_t c : directory.bandClass) out.plain(c);
  out.number(directory.packets.size());
  for (const Packet& packet : directory.packets) {
    const std::span dependsOn = std::span(packet.dependsOn).subspan(packet.dependsOn.empty() ? 0 : 1);
    out.number(dependsOn.size());
    std::uint32_t next = 1;
    for (const std::uint32_t other : dependsOn) {
      out.number(other - next);
      next = other + 1;
    }
    for (const double d : {packet.xMin, packet.yMin, packet.xMax, packet.yMax}) out.plain(d);
    for (const std::uint32_t n : packet.streamBytes) out.number(n);
    out.number(packet.borders);
    out.plain(packet.checksum);
    out.number(packet.runs.size());
    for (const Run& run : packet.runs) {
      out.number(run.band);
      out.number(run.nodes);
      out.number(run.slots - 3 * run.nodes);
      out.number(run.listed);
    }
  }
  return out.take();
}

std::optional<Directory> directoryOf(std::span<const std::byte> bytes, std::string& problem) {
  problem = "is cut short or damaged";
  ByteSource in(bytes);
  Directory directory;
  if (const auto version = in.plain<std::uint8_t>(); version != kPackedVersion) {
    if (!bytes.empty() && version < kPackedVersion)
      problem = "was packed by an older Arete; pack the terrain again";
    else if (version > kPackedVersion)
      problem = fmt::format("has packed format version {}, and this Arete reads {}", version, kPackedVersion);
    return std::nullopt;
  }
  for (std::uint8_t& c : directory.bandClass) {
    c = in.plain<std::uint8_t>();
    if (c >= kClasses) return std::nullopt;
  }
  const std::uint64_t count = in.number();
  // A count that the bytes cannot hold is refused before memory is allocated.
  if (in.isBad() || count == 0 || count > bytes.size() / kLeastPacketBytes) return std::nullopt;
  std::uint64_t nodes = 0, slots = 0;
  directory.packets.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Packet& packet = directory.packets[i];
    if (i > 0) packet.dependsOn.push_back(0);
    std::uint64_t next = 1;
    for (std::uint32_t left = in.number(kMaxIds); left > 0; --left) {
      next += in.number(kMaxIds);
      if (in.isBad() || next >= i) {
        problem = fmt::format("packet {} of the packed nodes depends on one that does not come before it", i);
        return std::nullopt;
      }
      packet.dependsOn.push_back(static_cast<std::uint32_t>(next++));
    }
    for (double* d : {&packet.xMin, &packet.yMin, &packet.xMax, &packet.yMax}) *d = in.plain<double>();
    for (std::uint32_t& n : packet.streamBytes) n = in.number(kMaxIds);
    packet.borders = in.number(kMaxIds);
    packet.checksum = in.plain<std::uint64_t>();
    const std::uint32_t runs = in.number(MultiTriangulation::kBands);
    if (in.isBad()) return std::nullopt;
    packet.runs.resize(runs);
    const std::uint64_t slotsBefore = slots;
    for (std::uint32_t r = 0; r < runs; ++r) {
      Run& run = packet.runs[r];
      run.band = in.number(r == 0 ? MultiTriangulation::kBands - 1 : packet.runs[r - 1].band - 1);
      run.nodes = in.number(kMaxIds);
      const std::uint64_t more = in.number();
      run.listed = in.number(run.nodes);
      if (in.isBad() || run.nodes == 0 || more > 30 * std::uint64_t{run.nodes} ||
          (r + 1 < runs && run.band == 0))
        return std::nullopt;
      nodes += run.nodes;
      slots += 3 * std::uint64_t{run.nodes} + more;
      if (slots > kMaxIds) {
        problem = "has more nodes than can be numbered";
        return std::nullopt;
      }
      run.slots = static_cast<std::uint32_t>(3 * std::uint64_t{run.nodes} + more);
    }
    if (packet.borders > slots - slotsBefore) {
      problem = fmt::format("packet {} of the packed nodes leaves more triangles than it creates", i);
      return std::nullopt;
    }
  }
  if (!in.isDone()) return std::nullopt;
  (void)nodes;
  directory.number();
  return directory;
}

std::vector<std::byte> toBytes(std::span<const RansTable> tables) {
  ByteSink out;
  for (const RansTable& table : tables) {
    unsigned symbols = 0;
    for (unsigned s = 0; s < RansTable::kAlphabet; ++s) symbols += table.share(s) > 0 ? 1 : 0;
    out.number(symbols);
    if (symbols == 0) continue;
    unsigned next = 0;
    for (unsigned s = 0; s < RansTable::kAlphabet; ++s) {
      if (table.share(s) == 0) continue;
      out.number(s - next);
      out.number(table.share(s) - 1);
      next = s + 1;
    }
  }
  return out.take();
}

std::optional<std::vector<RansTable>> tablesOf(std::span<const std::byte> bytes) {
  ByteSource in(bytes);
  std::vector<RansTable> tables(kTables);
  for (RansTable& table : tables) {
    const std::uint32_t symbols = in.number(RansTable::kAlphabet);
    if (symbols == 0) continue;
    std::array<std::uint16_t, RansTable::kAlphabet> shares{};
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < symbols; ++i) {
      const std::uint32_t s = next + in.number(RansTable::kAlphabet);
      const std::uint32_t share = in.number((1u << RansTable::kBits) - 1) + 1;
      if (in.isBad() || s >= RansTable::kAlphabet) return std::nullopt;
      shares[s] = static_cast<std::uint16_t>(share);
      next = s + 1;
    }
    const auto read = RansTable::ofShares(shares);
    if (!read) return std::nullopt;
    table = *read;
  }
  if (!in.isDone()) return std::nullopt;
  return tables;
}

}  // namespace arete::packed
