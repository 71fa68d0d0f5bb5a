// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace arete {

/// A set of nodes of an MT, one bit each, with ranks: the number of members before a node, which is the
/// node's number in a copy of the set.
class RankedNodes {
 public:
  static constexpr std::uint32_t kNodesPerWord = 64;

  explicit RankedNodes(std::uint32_t nodes) : words_((nodes + kNodesPerWord - 1) / kNodesPerWord, 0) {}

  bool contains(std::uint32_t n) const { return (words_[n / kNodesPerWord] >> n % kNodesPerWord & 1) != 0; }
  void add(std::uint32_t n) { words_[n / kNodesPerWord] |= std::uint64_t{1} << n % kNodesPerWord; }

  /// Word i holds the nodes 64 i to 64 i + 63.
  std::size_t wordCount() const { return words_.size(); }
  std::uint64_t word(std::size_t i) const { return words_[i]; }
  /// Thread-safe for different words.
  void setWord(std::size_t i, std::uint64_t members) { words_[i] = members; }

  /// Computes the ranks, once all members are set. O(words).
  void rank() {
    before_.resize(words_.size());
    size_ = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      before_[i] = size_;
      size_ += static_cast<std::uint32_t>(std::popcount(words_[i]));
    }
  }
  /// Valid after rank(): the number of members, of members before n, of members before the word's first node.
  std::uint32_t size() const { return size_; }
  std::uint32_t rankOf(std::uint32_t n) const {
    const std::uint64_t below = (std::uint64_t{1} << n % kNodesPerWord) - 1;
    return before_[n / kNodesPerWord] +
           static_cast<std::uint32_t>(std::popcount(words_[n / kNodesPerWord] & below));
  }
  std::uint32_t rankOfWord(std::size_t i) const { return before_[i]; }

  /// Calls visit(n) for the members of a word, in rising order.
  template <class Visit>
  void visitWord(std::size_t i, const Visit& visit) const {
    for (std::uint64_t rest = words_[i]; rest != 0; rest &= rest - 1)
      visit(static_cast<std::uint32_t>(i * kNodesPerWord + std::countr_zero(rest)));
  }

 private:
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> before_;
  std::uint32_t size_ = 0;
};

}  // namespace arete
