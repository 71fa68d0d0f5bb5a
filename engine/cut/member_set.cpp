// SPDX-License-Identifier: GPL-3.0-or-later
//
// Different threads fill runs of groups; each records the words with members. A prefix sum over the runs
// determines where the words of each go, and they are copied there, in parallel again. So a small cut of a
// large MT takes an index per group and the words of its own groups alone: lookups stay in the caches nearest
// to a processor. If nearly all groups have members the few others get words too: then a node's half word is
// found without the index.
#include "engine/cut/member_set.h"

#include <array>
#include <cassert>
#include <cstring>
#include <numeric>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::uint32_t kMemberGroupsPerRun = 64;

/// A bit per byte, set where the byte is not 0. Precondition: count <= 64.
std::uint64_t bitsOf(const std::uint8_t* bytes, std::uint32_t count) {
  std::uint64_t bits = 0;
  for (std::uint32_t at = 0; at < count; at += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes + at, std::min(8u, count - at));
    // The lowest bit of each byte is set if any of its bits was; the product moves these bits side by side.
    constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F;
    const std::uint64_t any = (((eight & kLow) + kLow) | eight) >> 7 & 0x0101010101010101;
    bits |= any * 0x0102040810204080 >> 56 << at;
  }
  return bits;
}

}  // namespace

MemberSet::MemberSet(std::uint32_t certain, std::uint32_t end, std::uint32_t groupsPerRun, const Fill& fill) {
  const std::uint32_t words = (end + kNodesPerWord - 1) / kNodesPerWord,
                      groups = (words + kWordsPerGroup - 1) / kWordsPerGroup,
                      full = std::min(certain, end) / kNodesPerGroup;
  std::vector<Sink> runs((groups - full + groupsPerRun - 1) / groupsPerRun);
  parallelFor(std::size_t(0), runs.size(), [&](std::size_t run) {
    const std::uint32_t first = (full + static_cast<std::uint32_t>(run) * groupsPerRun) * kWordsPerGroup;
    fill(first, std::min(words, first + groupsPerRun * kWordsPerGroup), runs[run]);
  });

  struct Place {
    std::uint32_t group, used, members;
  };
  std::vector<Place> place(runs.size() + 1);
  place[0] = {1 + full, full * kWordsPerGroup, full * kNodesPerGroup};
  for (std::size_t run = 0; run < runs.size(); ++run)
    place[run + 1] = {place[run].group + runs[run].groups_,
                      place[run].used + static_cast<std::uint32_t>(runs[run].words_.size()),
                      place[run].members + runs[run].members_};
  size_ = place.back().members;
  begins_.assign(std::size_t(groups) + 1, 0);
  used_.resize(place.back().used);
  constexpr std::uint32_t kFewWithout = 8;  // dense if at most one group in so many is empty
  isDense_ = (1 + groups - place.back().group) * kFewWithout <= groups;
  if (isDense_) {
    std::iota(begins_.begin(), begins_.end(), 1u);
    for (std::uint32_t& begin : begins_) begin *= kHalvesPerGroup;
    for (std::size_t run = 0; run < runs.size(); ++run)
      place[run + 1].group =
          1 + std::min(groups, full + (static_cast<std::uint32_t>(run) + 1) * groupsPerRun);
  }
  const std::uint32_t groupsHere = place.back().group + (isDense_ ? 1 : 0);
  halves_ = std::make_unique_for_overwrite<Half[]>(std::size_t(groupsHere) * kHalvesPerGroup);
  std::fill_n(halves_.get(), kHalvesPerGroup, Half{});
  if (isDense_)
    std::fill_n(halves_.get() + std::size_t(1 + groups) * kHalvesPerGroup, kHalvesPerGroup, Half{});
  // Whole groups of certain members need no Sink: all bits are set, and a rank is the number of the node.
  parallelFor(std::uint32_t(0), full, [&](std::uint32_t group) {
    begins_[group] = (1 + group) * kHalvesPerGroup;
    for (std::uint32_t h = group * kHalvesPerGroup; h < (group + 1) * kHalvesPerGroup; ++h)
      halves_[kHalvesPerGroup + h] = {~std::uint32_t(0), h * kNodesPerHalf};
    std::iota(&used_[group * kWordsPerGroup], &used_[group * kWordsPerGroup] + kWordsPerGroup,
              group * kWordsPerGroup);
  });
  // A group gets its words at its first word with members. In a dense set it has them already, and groups
  // without members keep empty halves.
  parallelFor(std::size_t(0), runs.size(), [&](std::size_t run) {
    Place at = place[run];
    std::fill_n(halves_.get() + std::size_t(at.group) * kHalvesPerGroup,
                std::size_t(place[run + 1].group - at.group) * kHalvesPerGroup, Half{});
    for (std::size_t i = 0; i < runs[run].words_.size(); ++i) {
      const std::uint32_t w = runs[run].words_[i];
      if (begins_[w / kWordsPerGroup] == 0) begins_[w / kWordsPerGroup] = at.group++ * kHalvesPerGroup;
      for (std::uint32_t k = 0; k < 2; ++k) {
        const auto bits = static_cast<std::uint32_t>(runs[run].bits_[i] >> (k * kNodesPerHalf));
        halves_[begins_[w / kWordsPerGroup] + w % kWordsPerGroup * 2 + k] = {bits, at.members};
        at.members += static_cast<std::uint32_t>(std::popcount(bits));
      }
      used_[at.used++] = w;
    }
  });
}

/// The bytes of a set become bits, a word at a time.
MemberSet::MemberSet(const NodeSet& set)
    : MemberSet(0, static_cast<std::uint32_t>(set.size()), kMemberGroupsPerRun,
                [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
                  for (std::uint32_t word = first; word < last; ++word) {
                    const std::size_t begin = std::size_t(word) * kNodesPerWord;
                    const std::size_t count = std::min<std::size_t>(kNodesPerWord, set.size() - begin);
                    sink.put(word, bitsOf(set.data() + begin, static_cast<std::uint32_t>(count)));
                  }
                }) {}

/// A run finds its first node by halving, so that runs can be filled in any order.
MemberSet::MemberSet(const std::vector<std::uint32_t>& nodes, std::uint32_t end)
    : MemberSet(0, end, kMemberGroupsPerRun, [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
        auto at = std::ranges::lower_bound(nodes, first * kNodesPerWord);
        while (at != nodes.end() && *at / kNodesPerWord < last) {
          const std::uint32_t word = *at / kNodesPerWord;
          std::uint64_t bits = 0;
          for (; at != nodes.end() && *at / kNodesPerWord == word; ++at)
            bits |= std::uint64_t(1) << *at % kNodesPerWord;
          sink.put(word, bits);
        }
      }) {}

/// The first nodes are all members; the last word may be in part.
MemberSet MemberSet::prefix(std::uint32_t nodes) {
  return MemberSet(nodes, nodes, 1, [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
    for (std::uint32_t word = first; word < last; ++word) {
      const std::uint32_t count = std::min(kNodesPerWord, nodes - word * kNodesPerWord);
      sink.put(word, ~std::uint64_t(0) >> (kNodesPerWord - count));
    }
  });
}

// The group behind the last one has no members: a lookup of a node beyond the end, such as kNone, is clamped
// to it.
MemberSet::Lookup MemberSet::lookup() const {
  Lookup lookup;
  lookup.begins_ = begins_.data();
  lookup.halves_ = halves_.get();
  lookup.groups_ = static_cast<std::uint32_t>(begins_.size() - 1);
  return lookup;
}

MemberSet::DenseLookup MemberSet::denseLookup() const {
  assert(isDense_);
  DenseLookup lookup;
  lookup.halves_ = halves_.get() + kHalvesPerGroup;
  lookup.end_ = static_cast<std::uint32_t>(begins_.size() - 1) * kHalvesPerGroup;
  return lookup;
}

std::uint32_t MemberSet::spans() const {
  return static_cast<std::uint32_t>((used_.size() + kWordsPerSpan - 1) / kWordsPerSpan);
}

// The two halves of a word are joined, so that one loop visits the set bits from the lowest to the highest.
std::uint32_t MemberSet::list(std::uint32_t span, std::uint32_t* members) const {
  const std::size_t begin = std::size_t(span) * kWordsPerSpan;
  std::uint32_t count = 0;
  for (std::size_t i = begin; i < std::min(used_.size(), begin + kWordsPerSpan); ++i) {
    const Half* const half = halves(used_[i]);
    for (std::uint64_t bits = half[0].bits | std::uint64_t(half[1].bits) << kNodesPerHalf; bits != 0;
         bits &= bits - 1)
      members[count++] = used_[i] * kNodesPerWord + static_cast<std::uint32_t>(std::countr_zero(bits));
  }
  return count;
}

NodeSet MemberSet::toNodeSet(std::uint32_t nodeCount) const {
  NodeSet set(nodeCount, 0);
  parallelFor(std::uint32_t(0), spans(), [&](std::uint32_t span) {
    std::array<std::uint32_t, kMostInSpan> members;
    const std::uint32_t count = list(span, members.data());
    for (std::uint32_t i = 0; i < count; ++i) set[members[i]] = 1;
  });
  return set;
}

}  // namespace arete
