// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes of blocks are floats, rounded outwards. Those of pages are parts of the box of their block, in steps
// of 1/65535 of it along each axis, outwards: a third of the bytes.
//
// A reader checks each count against the bytes that are left before it allocates.
#include "io/store/packed/pages/directory_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/mt/hole_limit.h"
#include "io/store/entropy/number_bytes.h"
#include "io/store/format/checksum.h"
#include "io/store/packed/nodes/dependencies.h"

namespace arete::packed {
namespace {

/// The packed forms have one count of versions.
constexpr std::uint8_t kPagedVersion = 19;
constexpr std::uint32_t kMaxIds = MultiTriangulation::kNone - 1;
constexpr std::uint32_t kBands = MultiTriangulation::kBands;
constexpr std::uint32_t kMostLevels = 5;  // 128^5 pages
constexpr double kSteps = 65535;
/// The bytes of an entry, and the least ones of a page: its box, a segment's checksum, and the numbers that
/// each page has.
constexpr std::uint64_t kEntryBytes = 8 + 4 + 8 + 1 + 6 * 4, kLeastPageBytes = 6 * 2 + 8 + 6;

float roundedDown(double x) {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) <= x ? near
                                        : std::nextafter(near, -std::numeric_limits<float>::infinity());
}
float roundedUp(double x) {
  return -roundedDown(-x);
}

Box3 boxOf(const Packet& page) {
  return {{page.xMin, page.yMin, page.zMin}, {page.xMax, page.yMax, page.zMax}};
}

/// The bytes that a number takes.
std::uint64_t numberBytes(std::uint64_t number) {
  return number < 128 ? 1 : 2;
}

/// A bound as a part of the extent of the block.
double placeOf(std::uint16_t code, double low, double high) {
  if (code == 0) return low;
  if (code == kSteps) return high;
  return low + (high - low) * (code / kSteps);
}
std::uint16_t lowCode(double x, double low, double high) {
  const double part = (x - low) / (high - low);
  if (!(part > 0) || !std::isfinite(high - low)) return 0;
  auto code = static_cast<std::uint16_t>(std::min(std::floor(part * kSteps), kSteps - 1));
  while (code > 0 && placeOf(code, low, high) > x) --code;
  return code;
}
std::uint16_t highCode(double x, double low, double high) {
  const double part = (x - low) / (high - low);
  if (!(part < 1) || !std::isfinite(high - low)) return static_cast<std::uint16_t>(kSteps);
  auto code = static_cast<std::uint16_t>(std::max(std::ceil(part * kSteps), 1.0));
  while (code < kSteps && placeOf(code, low, high) < x) ++code;
  return code;
}

/// All entries have the same size, so that where blocks lie can be said before they are written.
void write(const BlockEntry& entry, NumberWriter& out) {
  out.plain(entry.offset);
  out.plain(static_cast<std::uint32_t>(entry.bytes));
  out.plain(entry.checksum);
  out.plain(entry.highestBand);
  for (const Vec3& corner : {entry.box.low, entry.box.high})
    for (const double d : {corner.x, corner.y, corner.z}) out.plain(static_cast<float>(d));
}

std::vector<std::byte> bytesOf(std::span<const BlockEntry> entries) {
  NumberWriter out;
  out.number(entries.size());
  for (const BlockEntry& entry : entries) write(entry, out);
  return out.take();
}

bool readEntries(NumberReader& in, std::vector<BlockEntry>& entries) {
  const std::uint64_t count = in.number();
  if (in.isBad() || count == 0 || count > kPagesPerBlock || count > in.left() / kEntryBytes) return false;
  entries.resize(count);
  for (BlockEntry& entry : entries) {
    entry.offset = in.plain<std::uint64_t>();
    entry.bytes = in.plain<std::uint32_t>();
    entry.checksum = in.plain<std::uint64_t>();
    entry.highestBand = in.plain<std::uint8_t>();
    if (entry.highestBand >= kBands) return false;
    for (Vec3* corner : {&entry.box.low, &entry.box.high})
      for (double* d : {&corner->x, &corner->y, &corner->z}) *d = static_cast<double>(in.plain<float>());
    const Box3& b = entry.box;
    if (!(b.low.x <= b.high.x && b.low.y <= b.high.y && b.low.z <= b.high.z)) return false;
  }
  return !in.isBad();
}

std::vector<std::byte> leafBytes(std::span<const Packet> pages, const Box3& box) {
  NumberWriter out;
  out.number(pages.size());
  out.number(pages[0].segments[0].begin());
  for (const Packet& page : pages) {
    writeDependencies(page, out);
    for (const auto& [x, low, high] : {std::tuple(page.xMin, box.low.x, box.high.x),
                                       {page.yMin, box.low.y, box.high.y},
                                       {page.zMin, box.low.z, box.high.z}})
      out.plain(lowCode(x, low, high));
    for (const auto& [x, low, high] : {std::tuple(page.xMax, box.low.x, box.high.x),
                                       {page.yMax, box.low.y, box.high.y},
                                       {page.zMax, box.low.z, box.high.z}})
      out.plain(highCode(x, low, high));
    out.number(page.borders);
    out.number(page.segments.size());
    for (const Segment& segment : page.segments) {
      out.number(segment.bytes());
      out.plain(segment.checksum);
      out.number(segment.firstBand);
      out.number(segment.nodes);
    }
  }
  return out.take();
}

/// A block that is not placed yet.
struct Block {
  std::vector<std::byte> bytes;  // of a leaf
  BlockEntry entry;
};

/// The leaves of a directory, without offsets and checksums.
std::vector<Block> leavesOf(std::span<const Packet> pages) {
  std::vector<Block> leaves;
  for (std::size_t first = 0; first < pages.size(); first += kPagesPerBlock) {
    const auto of = pages.subspan(first, std::min<std::size_t>(kPagesPerBlock, pages.size() - first));
    Box3 around = Box3::empty();
    std::uint8_t band = 0;
    for (const Packet& page : of) {
      // A model of a root alone has a page without nodes.
      if (page.runs.empty()) continue;
      around.include(boxOf(page).low);
      around.include(boxOf(page).high);
      band = std::max(band, static_cast<std::uint8_t>(page.runs[0].band));
    }
    if (around.low.x > around.high.x) around = {{0, 0, 0}, {0, 0, 0}};
    const Box3 box{{double(roundedDown(around.low.x)), double(roundedDown(around.low.y)),
                    double(roundedDown(around.low.z))},
                   {double(roundedUp(around.high.x)), double(roundedUp(around.high.y)),
                    double(roundedUp(around.high.z))}};
    Block leaf{leafBytes(of, box), {}};
    leaf.entry.bytes = leaf.bytes.size();
    leaf.entry.highestBand = band;
    leaf.entry.box = box;
    leaves.push_back(std::move(leaf));
  }
  return leaves;
}

/// The blocks above a level.
std::vector<Block> levelAbove(std::span<const Block> level) {
  std::vector<Block> above;
  for (std::size_t first = 0; first < level.size(); first += kPagesPerBlock) {
    const auto of = level.subspan(first, std::min<std::size_t>(kPagesPerBlock, level.size() - first));
    Block block;
    block.entry.box = Box3::empty();
    for (const Block& below : of) {
      block.entry.box.include(below.entry.box.low);
      block.entry.box.include(below.entry.box.high);
      block.entry.highestBand = std::max(block.entry.highestBand, below.entry.highestBand);
    }
    block.entry.bytes = numberBytes(of.size()) + of.size() * kEntryBytes;
    above.push_back(std::move(block));
  }
  return above;
}

std::vector<BlockEntry> entriesOf(std::span<const Block> blocks) {
  std::vector<BlockEntry> entries;
  for (const Block& block : blocks) entries.push_back(block.entry);
  return entries;
}

}  // namespace

std::uint64_t PageRoot::nodes() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t n : nodesOfBand) sum += n;
  return sum;
}

// The topmost blocks come first, so that they lie at the beginning of the file. A block refers to others by
// their checksums, so blocks are written from the last level to the first.
PageDirectoryBytes pageDirectoryBytes(const Directory& directory) {
  const std::span<const Packet> pages = directory.packets;
  std::vector<std::vector<Block>> levels = {leavesOf(pages)};
  while (levels.back().size() > kPagesPerBlock) levels.push_back(levelAbove(levels.back()));
  std::uint64_t end = 0;
  for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    for (Block& block : *level) {
      block.entry.offset = end;
      end += block.entry.bytes;
    }
  PageDirectoryBytes bytes;
  bytes.blocks.resize(end);
  for (std::size_t height = 0; height < levels.size(); ++height)
    for (std::size_t i = 0; i < levels[height].size(); ++i) {
      Block& block = levels[height][i];
      if (height > 0) {
        const std::span<const Block> below = levels[height - 1];
        const std::size_t first = i * kPagesPerBlock;
        block.bytes = bytesOf(
            entriesOf(below.subspan(first, std::min<std::size_t>(kPagesPerBlock, below.size() - first))));
      }
      block.entry.checksum = amtChecksum(block.bytes);
      std::ranges::copy(block.bytes, bytes.blocks.begin() + static_cast<std::ptrdiff_t>(block.entry.offset));
    }
  NumberWriter out;
  out.plain(kPagedVersion);
  for (const std::uint8_t c : directory.bandClass) out.plain(c);
  std::array<std::uint64_t, kBands> nodesOfBand{};
  for (const Packet& page : pages)
    for (const Run& run : page.runs) nodesOfBand[run.band] += run.nodes;
  for (const std::uint64_t n : nodesOfBand) out.number(n);
  out.number(pages.size());
  out.number(directory.slots());
  out.number(levels.size());
  bytes.root = out.take();
  const std::vector<std::byte> entries = bytesOf(entriesOf(levels.back()));
  bytes.root.insert(bytes.root.end(), entries.begin(), entries.end());
  return bytes;
}

std::optional<PageRoot> pageRootOf(std::span<const std::byte> bytes, std::string& problem) {
  problem = "is cut short or damaged";
  NumberReader in(bytes);
  if (const auto version = in.plain<std::uint8_t>(); version != kPagedVersion) {
    if (version > kPagedVersion)
      problem = fmt::format("has packed format version {}, and this Arete reads {}", version, kPagedVersion);
    return std::nullopt;
  }
  PageRoot root;
  for (std::uint8_t& c : root.bandClass) {
    c = in.plain<std::uint8_t>();
    if (c >= kClasses) return std::nullopt;
  }
  for (std::uint64_t& n : root.nodesOfBand) {
    n = in.number();
    if (n > std::uint64_t{1} << 56) return std::nullopt;
  }
  root.pages = in.number(kMaxIds);
  root.slots = in.number();
  root.levels = in.number(kMostLevels);
  if (in.isBad() || root.pages == 0 || root.levels == 0 || !readEntries(in, root.entries) || !in.isDone())
    return std::nullopt;
  // The shape of the tree follows from the number of pages.
  std::uint64_t blocks = root.pages;
  for (std::uint32_t level = 0; level < root.levels; ++level)
    blocks = (blocks + kPagesPerBlock - 1) / kPagesPerBlock;
  if (blocks != root.entries.size()) return std::nullopt;
  return root;
}

std::optional<std::vector<BlockEntry>> blockEntriesOf(std::span<const std::byte> bytes) {
  NumberReader in(bytes);
  std::vector<BlockEntry> entries;
  if (!readEntries(in, entries) || !in.isDone()) return std::nullopt;
  return entries;
}

std::optional<std::vector<Packet>> pagesOf(std::span<const std::byte> bytes, const BlockEntry& entry,
                                           std::uint32_t first) {
  NumberReader in(bytes);
  const std::uint64_t count = in.number();
  if (in.isBad() || count == 0 || count > kPagesPerBlock || count > in.left() / kLeastPageBytes)
    return std::nullopt;
  std::uint64_t offset = in.number();
  std::vector<Packet> pages(count);
  const Box3& box = entry.box;
  for (std::uint32_t i = 0; i < count; ++i) {
    Packet& page = pages[i];
    page.number = first + i;
    if (!readDependencies(page.number, in, page)) return std::nullopt;
    page.xMin = placeOf(in.plain<std::uint16_t>(), box.low.x, box.high.x);
    page.yMin = placeOf(in.plain<std::uint16_t>(), box.low.y, box.high.y);
    page.zMin = placeOf(in.plain<std::uint16_t>(), box.low.z, box.high.z);
    page.xMax = placeOf(in.plain<std::uint16_t>(), box.low.x, box.high.x);
    page.yMax = placeOf(in.plain<std::uint16_t>(), box.low.y, box.high.y);
    page.zMax = placeOf(in.plain<std::uint16_t>(), box.low.z, box.high.z);
    page.borders = in.number(kMaxIds);
    const std::uint32_t segments = in.number(kBands);
    if (in.isBad() || segments == 0) return std::nullopt;
    page.segments.resize(segments);
    std::uint32_t band = kBands;
    std::uint64_t nodes = 0;
    for (Segment& segment : page.segments) {
      segment.headerBytes = in.number(kMaxIds);
      segment.checksum = in.plain<std::uint64_t>();
      segment.firstBand = in.number(kBands - 1);
      segment.nodes = in.number(kMaxIds);
      if (in.isBad() || segment.firstBand >= band || segment.headerBytes < leastBytes(segment.nodes))
        return std::nullopt;
      nodes += segment.nodes;
      band = segment.firstBand;
      offset += segment.headerBytes;
      segment.offset = offset;
    }
    if (page.borders > kMaxHoleCorners * nodes) return std::nullopt;
  }
  if (!in.isDone()) return std::nullopt;
  return pages;
}

}  // namespace arete::packed
