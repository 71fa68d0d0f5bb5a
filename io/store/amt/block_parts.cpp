// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/block_parts.h"

#include <algorithm>

namespace arete {
namespace {

using Bytes = std::span<const std::byte>;

/// A directory that is fetched at once: of about 20 million samples at the most.
constexpr std::size_t kSmallDirectory = std::size_t{3} << 19;
/// Fewer blocks are fetched alone: a coarse question has no use for the others.
constexpr std::size_t kManyBlocks = 8;
/// Of the pages a part of the first ones, which hold the largest nodes, goes with it.
constexpr std::size_t kFirstPart = 192, kMostOfFirst = std::size_t{9} << 17;
/// Between two blocks that are fetched together.
constexpr std::size_t kGap = std::size_t{1} << 18;

}  // namespace

std::vector<Bytes> withBlocksJoined(std::span<const Bytes> parts, Bytes blocks, Bytes nodes) {
  std::vector<Bytes> wanted, of;
  for (const Bytes part : parts)
    (part.data() >= blocks.data() && part.data() < blocks.data() + blocks.size() ? of : wanted)
        .push_back(part);
  if (of.empty()) return wanted;
  if (of.size() >= kManyBlocks && blocks.size() <= kSmallDirectory) {
    wanted.push_back(blocks);
    wanted.push_back(nodes.first(std::min(kMostOfFirst, nodes.size() / kFirstPart)));
    return wanted;
  }
  std::ranges::sort(of, {}, [](Bytes part) { return part.data(); });
  Bytes joined = of.front();
  for (const Bytes part : std::span(of).subspan(1)) {
    const std::byte* const end = std::max(joined.data() + joined.size(), part.data() + part.size());
    if (part.data() <= joined.data() + joined.size() + kGap) {
      joined = {joined.data(), static_cast<std::size_t>(end - joined.data())};
      continue;
    }
    wanted.push_back(joined);
    joined = part;
  }
  wanted.push_back(joined);
  return wanted;
}

}  // namespace arete
