// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "engine/cut/cut.h"

namespace arete {

/// The nodes of a cut, a bit each, 64 to a word, 16 words to a page; a page without members takes an index
/// and no words, unless there are hardly any such pages. Made in parallel, the same for any number of
/// threads; it knows how many members come before each, so that a front can number its vertices.
class MemberSet {
 public:
  static constexpr std::uint32_t kNodesPerWord = 64, kWordsPerPage = 16;

  /// Takes the members of a run of words.
  class Sink;
  /// fill(first word, end of words, sink): puts what members there are.
  using Fill = std::function<void(std::uint32_t, std::uint32_t, Sink&)>;

  /// Nodes before `certain` are members, nodes from `end` on are not; fill() says which of the rest are,
  /// called for runs of at most so many pages, by any thread. `certain` is rounded down to a whole page: a
  /// fill() may have to say again what is certain.
  MemberSet(std::uint32_t certain, std::uint32_t end, std::uint32_t pagesPerRun, const Fill& fill);
  /// The nodes that are in, of all of them.
  explicit MemberSet(const NodeSet& set);
  /// The nodes of a rising list, below `end`.
  MemberSet(const std::vector<std::uint32_t>& nodes, std::uint32_t end);
  static MemberSet prefix(std::uint32_t nodes);

  std::uint32_t size() const { return size_; }

 private:
  /// Half of a word's nodes: what is asked of a node is in eight bytes.
  struct Half {
    std::uint32_t bits;
    std::uint32_t before;  // members before those of the half
  };
  static constexpr std::uint32_t kNodesPerHalf = 32, kHalvesPerPage = 2 * kWordsPerPage;

  static bool isSet(Half half, std::uint32_t n) { return (half.bits >> (n % kNodesPerHalf) & 1) != 0; }
  static std::uint32_t rankIn(Half half, std::uint32_t n) {
    // What is left are the members up to n, itself among them.
    return half.before + static_cast<std::uint32_t>(std::popcount(half.bits << (~n % kNodesPerHalf))) - 1;
  }

 public:
  /// What a front asks: whether n is a member, be it a node or none; how many come before it (precondition: n
  /// is a member). Pointers by value, so that nothing a loop writes can change them.
  class Lookup {
   public:
    bool contains(std::uint32_t n) const { return isSet(half(std::min(n / kNodesPerPage, pages_), n), n); }
    std::uint32_t rank(std::uint32_t n) const { return rankIn(half(n / kNodesPerPage, n), n); }

   private:
    friend class MemberSet;
    Half half(std::uint32_t page, std::uint32_t n) const {
      return halves_[begins_[page] + n / kNodesPerHalf % kHalvesPerPage];
    }
    const std::uint32_t* begins_;
    const Half* halves_;
    std::uint32_t pages_;
  };
  /// The same of a set with members nearly everywhere (isDense()), whose pages are all there, without a look
  /// at an index.
  class DenseLookup {
   public:
    bool contains(std::uint32_t n) const { return isSet(halves_[std::min(n / kNodesPerHalf, end_)], n); }
    std::uint32_t rank(std::uint32_t n) const { return rankIn(halves_[n / kNodesPerHalf], n); }

   private:
    friend class MemberSet;
    const Half* halves_;
    std::uint32_t end_;
  };
  Lookup lookup() const;
  bool isDense() const { return isDense_; }
  /// Precondition: isDense().
  DenseLookup denseLookup() const;

  /// Members fall into pieces, in rising order; those of different pieces can be visited by different
  /// threads.
  static constexpr std::uint32_t kMostInPiece = 4096;
  std::uint32_t pieces() const;
  /// Writes the members of a piece, rising; returns how many. Precondition: room for kMostInPiece.
  std::uint32_t list(std::uint32_t piece, std::uint32_t* members) const;
  /// visit(n) for every member, rising, in one thread.
  template <class Visit>
  void visit(const Visit& visit) const {
    std::array<std::uint32_t, kMostInPiece> members;
    for (std::uint32_t piece = 0; piece < pieces(); ++piece) {
      const std::uint32_t count = list(piece, members.data());
      for (std::uint32_t i = 0; i < count; ++i) visit(members[i]);
    }
  }
  /// Members before those of the piece.
  std::uint32_t before(std::uint32_t piece) const { return halves(used_[piece * kWordsPerPiece])[0].before; }

  NodeSet toNodeSet(std::uint32_t nodeCount) const;

 private:
  static constexpr std::uint32_t kNodesPerPage = kNodesPerWord * kWordsPerPage;
  static constexpr std::uint32_t kWordsPerPiece = kMostInPiece / kNodesPerWord;

  /// The two of a word.
  const Half* halves(std::uint32_t w) const {
    return halves_.get() + begins_[w / kWordsPerPage] + w % kWordsPerPage * 2;
  }

  std::uint32_t size_ = 0;
  bool isDense_ = false;
  std::vector<std::uint32_t> begins_;  // of pages, and of one beyond them: where their halves begin
  std::unique_ptr<Half[]> halves_;   // the first page is that of none, and so is the last one of a dense set
  std::vector<std::uint32_t> used_;  // words with members
};

class MemberSet::Sink {
 public:
  /// The members among nodes 64 word .. 64 word + 63; rising words, no word twice.
  void put(std::uint32_t word, std::uint64_t bits) {
    if (bits == 0) return;
    pages_ += words_.empty() || words_.back() / kWordsPerPage != word / kWordsPerPage ? 1 : 0;
    members_ += static_cast<std::uint32_t>(std::popcount(bits));
    words_.push_back(word);
    bits_.push_back(bits);
  }

 private:
  friend class MemberSet;
  std::uint32_t pages_ = 0, members_ = 0;
  std::vector<std::uint32_t> words_;
  std::vector<std::uint64_t> bits_;
};

}  // namespace arete
