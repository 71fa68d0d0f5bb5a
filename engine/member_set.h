// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/cut.h"

namespace arete {

/// The nodes of a cut, a bit each, 64 to a word. Made in parallel, the same for any number of threads; it
/// knows how many members come before each, so that a front can number its vertices.
class MemberSet {
 public:
  static constexpr std::uint32_t kNodesPerWord = 64;

  /// Takes the members of a run of words.
  class Sink;
  /// fill(first word, end of words, sink): puts what members there are.
  using Fill = std::function<void(std::uint32_t, std::uint32_t, Sink&)>;

  /// Nodes before `certain` are members, nodes from `end` on are not; fill() says which of the rest are,
  /// called for runs of at most so many words, by any thread. `certain` is rounded down to a whole word.
  MemberSet(std::uint32_t certain, std::uint32_t end, std::uint32_t wordsPerRun, const Fill& fill);
  /// The nodes that are in, of all of them.
  explicit MemberSet(const NodeSet& set);
  /// The nodes of a rising list, below `end`.
  MemberSet(const std::vector<std::uint32_t>& nodes, std::uint32_t end);
  static MemberSet prefix(std::uint32_t nodes);

  std::uint32_t size() const { return size_; }

  /// What a front asks: whether n is a member, be it a node or none; how many come before it (precondition: n
  /// is below `end`). Pointers by value, so that nothing a loop writes can change them.
  class Lookup {
   public:
    bool contains(std::uint32_t n) const {
      return (bits_[std::min(n / kNodesPerWord, words_)] >> (n % kNodesPerWord) & 1) != 0;
    }
    std::uint32_t rank(std::uint32_t n) const {
      const std::uint32_t word = n / kNodesPerWord;
      const std::uint64_t before = bits_[word] & ((std::uint64_t(1) << (n % kNodesPerWord)) - 1);
      return before_[word] + static_cast<std::uint32_t>(std::popcount(before));
    }

   private:
    friend class MemberSet;
    const std::uint64_t* bits_;
    const std::uint32_t* before_;
    std::uint32_t words_;
  };
  Lookup lookup() const;

  /// Members fall into pieces, in rising order; those of different pieces can be visited by different
  /// threads.
  static constexpr std::uint32_t kMostInPiece = 4096;
  std::uint32_t pieces() const;
  /// Writes the members of a piece, rising; returns how many. Precondition: room for kMostInPiece.
  std::uint32_t list(std::uint32_t piece, std::uint32_t* members) const;
  /// Members before those of the piece.
  std::uint32_t before(std::uint32_t piece) const { return before_[used_[piece * kWordsPerPiece]]; }

  NodeSet toNodeSet(std::uint32_t nodeCount) const;

 private:
  static constexpr std::uint32_t kWordsPerPiece = kMostInPiece / kNodesPerWord;

  std::uint32_t size_ = 0;
  std::vector<std::uint64_t> bits_;    // and one word of none
  std::vector<std::uint32_t> before_;  // of used words: members before them
  std::vector<std::uint32_t> used_;    // words with members
};

class MemberSet::Sink {
 public:
  /// The members among nodes 64 word .. 64 word + 63; rising words, no word twice.
  void put(std::uint32_t word, std::uint64_t bits) {
    if (bits == 0) return;
    bits_[word] = bits;
    used_.push_back(word);
  }

 private:
  friend class MemberSet;
  Sink(std::uint64_t* bits, std::vector<std::uint32_t>& used) : bits_(bits), used_(used) {}
  std::uint64_t* bits_;
  std::vector<std::uint32_t>& used_;
};

}  // namespace arete
