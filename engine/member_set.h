// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/cut.h"

namespace arete {

/// The nodes of a cut: all before certain(), none from end() on, and between those whose bit is set, 64 to a
/// word. Made in parallel, the same for any number of threads; it knows how many members come before each, so
/// that a front can number its vertices.
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

  std::uint32_t certain() const { return certain_; }
  std::uint32_t end() const { return end_; }
  std::uint32_t size() const { return size_; }

  bool contains(std::uint32_t n) const {
    if (n < certain_) return true;
    return n < end_ && (words_[(n - certain_) / kNodesPerWord].bits >> (n % kNodesPerWord) & 1) != 0;
  }
  /// Members before n. Precondition: n < end().
  std::uint32_t rank(std::uint32_t n) const {
    if (n < certain_) return n;
    const Word& word = words_[(n - certain_) / kNodesPerWord];
    return word.before + countBits(word.bits & ((std::uint64_t(1) << (n % kNodesPerWord)) - 1));
  }

  /// Members fall into pieces, in rising order; those of different pieces can be visited by different
  /// threads.
  std::uint32_t pieces() const;
  /// visit(node, rank) for the members of a piece, rising.
  template <class Visit>
  void visitPiece(std::uint32_t piece, const Visit& visit) const;

  NodeSet toNodeSet(std::uint32_t nodeCount) const;

 private:
  struct Word {
    std::uint64_t bits = 0;
    std::uint32_t before = 0;  // members before it
  };
  static constexpr std::uint32_t kNodesPerPiece = 2048, kWordsPerPiece = 64;

  /// std::popcount is a call where the machine may lack the instruction.
  static std::uint32_t countBits(std::uint64_t x) {
    x -= x >> 1 & 0x5555555555555555u;
    x = (x & 0x3333333333333333u) + (x >> 2 & 0x3333333333333333u);
    x = (x + (x >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
    return static_cast<std::uint32_t>(x * 0x0101010101010101u >> 56);
  }
  std::uint32_t certainPieces() const { return (certain_ + kNodesPerPiece - 1) / kNodesPerPiece; }

  std::uint32_t certain_, end_, size_ = 0;
  std::vector<Word> words_;          // from node certain_ on
  std::vector<std::uint32_t> used_;  // of words_, those with members
};

class MemberSet::Sink {
 public:
  /// The members among nodes 64 word .. 64 word + 63; rising words, no word twice.
  void put(std::uint32_t word, std::uint64_t bits) {
    if (bits == 0) return;
    words_[word - first_].bits = bits;
    used_.push_back(word - first_);
  }

 private:
  friend class MemberSet;
  Sink(Word* words, std::uint32_t first, std::vector<std::uint32_t>& used)
      : words_(words), first_(first), used_(used) {}
  Word* words_;
  std::uint32_t first_;
  std::vector<std::uint32_t>& used_;
};

template <class Visit>
void MemberSet::visitPiece(std::uint32_t piece, const Visit& visit) const {
  if (piece < certainPieces()) {
    const std::uint32_t begin = piece * kNodesPerPiece;
    for (std::uint32_t n = begin; n < std::min(certain_, begin + kNodesPerPiece); ++n) visit(n, n);
    return;
  }
  const std::size_t begin = std::size_t(piece - certainPieces()) * kWordsPerPiece;
  for (std::size_t i = begin; i < std::min(used_.size(), begin + kWordsPerPiece); ++i) {
    std::uint32_t rank = words_[used_[i]].before;
    const std::uint32_t first = certain_ + used_[i] * kNodesPerWord;
    for (std::uint64_t bits = words_[used_[i]].bits; bits != 0; bits &= bits - 1)
      visit(first + static_cast<std::uint32_t>(std::countr_zero(bits)), rank++);
  }
}

}  // namespace arete
