// SPDX-License-Identifier: GPL-3.0-or-later
//
// A reader checks each count against the bytes that are left before it allocates.
#include "io/store/packed/nodes/layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/store/entropy/number_bytes.h"
#include "io/store/packed/nodes/dependencies.h"

namespace arete::packed {
namespace {

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
  std::uint64_t offset = 0;
  for (Packet& packet : packets)
    for (Segment& segment : packet.segments) {
      segment.offset = offset + segment.headerBytes;
      offset += segment.bytes();
    }
  numberNodes();
}

void Directory::numberNodes() {
  std::uint64_t borders = 0;
  std::vector<Run*> runs;
  for (Packet& packet : packets) {
    packet.firstBorder = borders;
    borders += packet.borders;
    packet.nodes = 0;
    for (Run& run : packet.runs) {
      packet.nodes += run.nodes;
      runs.push_back(&run);
    }
  }
  // Nodes are numbered by bands, the largest errors first, and within a band by packets.
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
  NumberWriter out;
  out.plain(kPackedVersion);
  for (const std::uint8_t c : directory.bandClass) out.plain(c);
  out.number(directory.packets.size());
  for (const Packet& packet : directory.packets) {
    writeDependencies(packet, out);
    for (const double d : {packet.xMin, packet.yMin, packet.xMax, packet.yMax}) out.plain(d);
    if (directory.isOfSurface)
      for (const double d : {packet.zMin, packet.zMax}) out.plain(d);
    for (const std::uint32_t n : packet.segments[0].streamBytes) out.number(n);
    out.number(packet.borders);
    out.plain(packet.segments[0].checksum);
    out.number(packet.runs.size());
    for (const Run& run : packet.runs) {
      out.number(run.band);
      out.number(run.nodes);
      // A star has at least three slots.
      out.number(run.slots - 3 * run.nodes);
      out.number(run.listed);
    }
  }
  return out.take();
}

std::optional<Directory> directoryOf(std::span<const std::byte> bytes, std::string& problem,
                                     bool isOfSurface) {
  problem = "is cut short or damaged";
  NumberReader in(bytes);
  Directory directory;
  directory.isOfSurface = isOfSurface;
  // The version is read first, so that a file of another version is refused as such and not as damaged.
  if (const auto version = in.plain<std::uint8_t>(); version != kPackedVersion) {
    if (!bytes.empty() && version < kPackedVersion)
      problem = "was packed by an older Arete; pack the model again";
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
    if (!readDependencies(i, in, packet)) {
      problem = fmt::format("packet {} of the packed nodes depends on one that does not come before it", i);
      return std::nullopt;
    }
    for (double* d : {&packet.xMin, &packet.yMin, &packet.xMax, &packet.yMax}) *d = in.plain<double>();
    if (isOfSurface)
      for (double* d : {&packet.zMin, &packet.zMax}) *d = in.plain<double>();
    Segment& all = packet.segments.emplace_back();
    for (std::uint32_t& n : all.streamBytes) n = in.number(kMaxIds);
    packet.borders = in.number(kMaxIds);
    all.checksum = in.plain<std::uint64_t>();
    const std::uint32_t runs = in.number(MultiTriangulation::kBands);
    if (in.isBad()) return std::nullopt;
    all.runs = runs;
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

}  // namespace arete::packed
