// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of words are filled by different threads; each notes which words it used, and the notes are joined in
// the order of the runs. Only used words are looked at again, so a small cut of a large MT pays for the
// memory of its words, a bit a node, and not for a walk over all nodes.
#include "engine/member_set.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cstring>
#include <numeric>

namespace arete {
namespace {

constexpr std::uint32_t kWordsPerRun = 1024;

/// A bit per byte, set where the byte is not 0. Precondition: count <= 64.
std::uint64_t bitsOf(const std::uint8_t* bytes, std::uint32_t count) {
  std::uint64_t bits = 0;
  for (std::uint32_t at = 0; at < count; at += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes + at, std::min(8u, count - at));
    if (eight == 0) continue;
    for (std::uint32_t i = 0; i < 8; ++i)
      bits |= std::uint64_t((eight >> (8 * i) & 0xFF) != 0 ? 1 : 0) << (at + i);
  }
  return bits;
}

}  // namespace

MemberSet::MemberSet(std::uint32_t certain, std::uint32_t end, std::uint32_t wordsPerRun, const Fill& fill)
    : bits_((end + kNodesPerWord - 1) / kNodesPerWord + 1, 0), before_(bits_.size()) {
  const auto last = static_cast<std::uint32_t>(bits_.size() - 1),
             first = std::min(certain / kNodesPerWord, last);
  std::fill(bits_.begin(), bits_.begin() + first, ~std::uint64_t(0));
  used_.resize(first);
  std::iota(used_.begin(), used_.end(), 0u);
  std::vector<std::vector<std::uint32_t>> used((last - first + wordsPerRun - 1) / wordsPerRun);
  tbb::parallel_for(std::size_t(0), used.size(), [&](std::size_t run) {
    const std::uint32_t begin = first + static_cast<std::uint32_t>(run) * wordsPerRun;
    Sink sink(bits_.data(), used[run]);
    fill(begin, std::min(last, begin + wordsPerRun), sink);
  });
  for (const auto& run : used) used_.insert(used_.end(), run.begin(), run.end());
  for (const std::uint32_t word : used_) {
    before_[word] = size_;
    size_ += static_cast<std::uint32_t>(std::popcount(bits_[word]));
  }
}

MemberSet::MemberSet(const NodeSet& set)
    : MemberSet(0, static_cast<std::uint32_t>(set.size()), kWordsPerRun,
                [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
                  for (std::uint32_t word = first; word < last; ++word) {
                    const std::size_t begin = std::size_t(word) * kNodesPerWord;
                    const std::size_t count = std::min<std::size_t>(kNodesPerWord, set.size() - begin);
                    sink.put(word, bitsOf(set.data() + begin, static_cast<std::uint32_t>(count)));
                  }
                }) {}

MemberSet::MemberSet(const std::vector<std::uint32_t>& nodes, std::uint32_t end)
    : MemberSet(0, end, kWordsPerRun, [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
        auto at = std::ranges::lower_bound(nodes, first * kNodesPerWord);
        while (at != nodes.end() && *at / kNodesPerWord < last) {
          const std::uint32_t word = *at / kNodesPerWord;
          std::uint64_t bits = 0;
          for (; at != nodes.end() && *at / kNodesPerWord == word; ++at)
            bits |= std::uint64_t(1) << *at % kNodesPerWord;
          sink.put(word, bits);
        }
      }) {}

MemberSet MemberSet::prefix(std::uint32_t nodes) {
  return MemberSet(nodes, nodes, 1, [&](std::uint32_t word, std::uint32_t, Sink& sink) {
    sink.put(word, (std::uint64_t(1) << nodes % kNodesPerWord) - 1);
  });
}

MemberSet::Lookup MemberSet::lookup() const {
  Lookup lookup;
  lookup.bits_ = bits_.data();
  lookup.before_ = before_.data();
  lookup.words_ = static_cast<std::uint32_t>(bits_.size() - 1);
  return lookup;
}

std::uint32_t MemberSet::pieces() const {
  return static_cast<std::uint32_t>((used_.size() + kWordsPerPiece - 1) / kWordsPerPiece);
}

std::uint32_t MemberSet::list(std::uint32_t piece, std::uint32_t* members) const {
  const std::size_t begin = std::size_t(piece) * kWordsPerPiece;
  std::uint32_t count = 0;
  for (std::size_t i = begin; i < std::min(used_.size(), begin + kWordsPerPiece); ++i)
    for (std::uint64_t bits = bits_[used_[i]]; bits != 0; bits &= bits - 1)
      members[count++] = used_[i] * kNodesPerWord + static_cast<std::uint32_t>(std::countr_zero(bits));
  return count;
}

NodeSet MemberSet::toNodeSet(std::uint32_t nodeCount) const {
  NodeSet set(nodeCount, 0);
  tbb::parallel_for(std::uint32_t(0), pieces(), [&](std::uint32_t piece) {
    std::array<std::uint32_t, kMostInPiece> members;
    const std::uint32_t count = list(piece, members.data());
    for (std::uint32_t i = 0; i < count; ++i) set[members[i]] = 1;
  });
  return set;
}

}  // namespace arete
