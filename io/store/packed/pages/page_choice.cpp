// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tree of blocks is walked level by level. Then the pages that the chosen ones depend on are followed:
// they come before, often in blocks that were read. The blocks that are still missing are read together, and
// again, until no page is missing. A block's number says on which way from the root it lies.
#include "io/store/packed/pages/page_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "engine/memory/required_memory.h"
#include "io/store/format/checksum.h"

namespace arete::packed {
namespace {

constexpr std::uint32_t kNotRequired = MultiTriangulation::kBands;

/// What the pages of a leaf take while they are chosen.
constexpr std::uint64_t kBytesOfLeaf = std::uint64_t{1} << 16;

class Chooser {
 public:
  Chooser(const PageRoot& root, std::span<const std::byte> blocks, const RequiredError& wanted,
          const OutwardScale& scale, const LoadParts& load)
      : root_(root), blocks_(blocks), wanted_(wanted), scale_(scale), load_(load) {}

  Result<PageChoice> run() {
    ARETE_CHECK(readRequiredLeaves());
    if (!leaves_.contains(0)) ARETE_CHECK(readLeaves({0}));
    for (;;) {
      const std::set<std::uint32_t> missing = spreadToParents();
      if (missing.empty()) return chosen();
      ARETE_CHECK(readLeaves(missing));
    }
  }

 private:
  struct Page {
    Packet packet;
    std::uint32_t lowest = kNotRequired;
  };
  /// A block of a level, by its number within the level; leaves are of level 0.
  struct Block {
    std::uint32_t number = 0;
    BlockEntry entry;
  };

  /// The lowest band that is required of a box.
  std::uint32_t lowestIn(const Box3& box) {
    const double error = wanted_ ? wanted_(box) : 0;
    const std::uint32_t lowest = error == std::numeric_limits<double>::infinity() ? kNotRequired
                                 : error > 0 ? MultiTriangulation::bandOf(scale_.floorCode(error))
                                             : 0;
    isEvenly_ = isEvenly_ && lowest == anyLowest_.value_or(lowest);
    anyLowest_ = lowest;
    return lowest;
  }

  Status readRequiredLeaves() {
    std::vector<Block> level;
    for (std::uint32_t i = 0; i < root_.entries.size(); ++i) level.push_back({i, root_.entries[i]});
    for (std::uint32_t height = root_.levels; height-- > 0;) {
      std::erase_if(level, [&](const Block& b) { return lowestIn(b.entry.box) > b.entry.highestBand; });
      ARETE_TRY(level, readLevel(std::move(level), height));
    }
    return {};
  }

  /// Reads blocks of one level: the blocks that they refer to; of leaves none, but their pages are kept.
  Result<std::vector<Block>> readLevel(std::vector<Block> level, std::uint32_t height) {
    if (height == 0)
      ARETE_CHECK(checkBudget(level.size() * kBytesOfLeaf, "ask for a smaller part or a larger tolerance"));
    std::vector<std::span<const std::byte>> parts;
    for (const Block& block : level) {
      const BlockEntry& e = block.entry;
      if (e.offset > blocks_.size() || e.bytes > blocks_.size() - e.offset) return damaged(block, height);
      parts.push_back(blocks_.subspan(e.offset, e.bytes));
    }
    if (load_) ARETE_CHECK(load_(parts));
    std::vector<Block> below;
    for (std::size_t i = 0; i < level.size(); ++i) {
      const Block& block = level[i];
      if (amtChecksum(parts[i]) != block.entry.checksum) return damaged(block, height);
      if (height == 0) {
        auto pages = pagesOf(parts[i], block.entry, block.number * kPagesPerBlock);
        if (!pages || pages->size() != pagesIn(block.number)) return damaged(block, height);
        keep(block.number, std::move(*pages));
        continue;
      }
      const auto entries = blockEntriesOf(parts[i]);
      if (!entries) return damaged(block, height);
      for (std::uint32_t k = 0; k < entries->size(); ++k)
        below.push_back({block.number * kPagesPerBlock + k, (*entries)[k]});
    }
    return below;
  }

  void keep(std::uint32_t leaf, std::vector<Packet> packets) {
    std::vector<Page>& pages = leaves_[leaf];
    for (Packet& packet : packets) {
      const std::uint32_t lowest =
          lowestIn({{packet.xMin, packet.yMin, packet.zMin}, {packet.xMax, packet.yMax, packet.zMax}});
      const bool isRequired = packet.number == 0 || lowest <= packet.segments[0].firstBand;
      pages.push_back({std::move(packet), isRequired ? lowest : kNotRequired});
    }
  }
  std::uint64_t pagesIn(std::uint32_t leaf) const {
    return std::min<std::uint64_t>(kPagesPerBlock, root_.pages - std::uint64_t{leaf} * kPagesPerBlock);
  }

  /// Reads leaves by their numbers, down from the root.
  Status readLeaves(const std::set<std::uint32_t>& numbers) {
    std::uint64_t span = 1;  // leaves below a block of the level
    for (std::uint32_t height = 1; height < root_.levels; ++height) span *= kPagesPerBlock;
    std::vector<Block> level;
    for (std::uint32_t i = 0; i < root_.entries.size(); ++i) level.push_back({i, root_.entries[i]});
    for (std::uint32_t height = root_.levels; height-- > 0; span /= kPagesPerBlock) {
      std::erase_if(level, [&](const Block& b) {
        const auto first = numbers.lower_bound(static_cast<std::uint32_t>(b.number * span));
        return first == numbers.end() || *first >= (b.number + 1) * span;
      });
      ARETE_TRY(level, readLevel(std::move(level), height));
    }
    for (const std::uint32_t leaf : numbers)
      if (!leaves_.contains(leaf))
        return failure(ErrorCode::corrupt, fmt::format("the directory of its pages has no block {}", leaf));
    return {};
  }

  /// Requires of the pages that others depend on what is required of those. @return the leaves that hold some
  /// and were not read
  std::set<std::uint32_t> spreadToParents() {
    std::set<std::uint32_t> missing;
    for (auto leaf = leaves_.rbegin(); leaf != leaves_.rend(); ++leaf)
      for (auto page = leaf->second.rbegin(); page != leaf->second.rend(); ++page) {
        if (page->lowest == kNotRequired) continue;
        for (const std::uint32_t other : page->packet.dependsOn) {
          const auto of = leaves_.find(other / kPagesPerBlock);
          if (of == leaves_.end()) {
            missing.insert(other / kPagesPerBlock);
            continue;
          }
          std::uint32_t& lowest = of->second[other % kPagesPerBlock].lowest;
          lowest = std::min(lowest, page->lowest);
        }
      }
    return missing;
  }

  PageChoice chosen() {
    PageChoice choice;
    choice.directory.bandClass = root_.bandClass;
    std::map<std::uint32_t, std::uint32_t> newNumber;
    for (auto& [leaf, pages] : leaves_)
      for (Page& page : pages) {
        Packet& packet = page.packet;
        if (page.lowest == kNotRequired && packet.number != 0) continue;
        // Of a page that others depend on perhaps no band is required; of the first one the root is.
        std::size_t kept = packet.number == 0 ? 1 : 0;
        while (kept < packet.segments.size() && packet.segments[kept].firstBand >= page.lowest) ++kept;
        packet.isCut = kept < packet.segments.size();
        packet.segments.resize(kept);
        for (std::uint32_t& other : packet.dependsOn) other = newNumber.at(other);
        newNumber[packet.number] = static_cast<std::uint32_t>(choice.directory.packets.size());
        choice.directory.packets.push_back(std::move(packet));
        choice.lowest.push_back(page.lowest);
      }
    choice.isEvenly = isEvenly_;
    leaves_.clear();
    return choice;
  }

  static tl::unexpected<Error> damaged(const Block& block, std::uint32_t height) {
    return failure(ErrorCode::corrupt,
                   height == 0
                       ? fmt::format("block {} of the directory of its pages is damaged", block.number)
                       : fmt::format("block {} of level {} of the directory of its pages is damaged",
                                     block.number, height));
  }

  const PageRoot& root_;
  std::span<const std::byte> blocks_;
  const RequiredError& wanted_;
  const OutwardScale& scale_;
  const LoadParts& load_;
  std::map<std::uint32_t, std::vector<Page>> leaves_;
  std::optional<std::uint32_t> anyLowest_;
  bool isEvenly_ = true;  // the same is required of every box
};

}  // namespace

Result<PageChoice> choosePages(const PageRoot& root, std::span<const std::byte> blocks,
                               const RequiredError& wanted, const OutwardScale& scale,
                               const LoadParts& load) {
  return Chooser(root, blocks, wanted, scale, load).run();
}

}  // namespace arete::packed
