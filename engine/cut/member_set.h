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

/// The nodes of a cut as a bit set with ranks: 64 nodes to a word (a cluster), 16 words to a cluster group. A
/// group without members has an index and no words, unless there are hardly any such groups. Built in
/// parallel, the same for any number of threads. rank() is the number of members before a node, by which a
/// front numbers its vertices.
class MemberSet {
 public:
  static constexpr std::uint32_t kNodesPerWord = 64, kWordsPerGroup = 16;

  /// Receives the members of a run of words.
  class Sink;
  /// fill(first word, end of words, sink): puts the members among these words into the sink.
  using Fill = std::function<void(std::uint32_t, std::uint32_t, Sink&)>;

  /// @param certain Nodes before it are members. It is rounded down to a whole group, so fill() may receive
  /// words below it and must put their members again.
  /// @param end Nodes from it on are not members.
  /// @param groupsPerRun The most groups that one call of fill() receives.
  /// @param fill Called by any thread.
  MemberSet(std::uint32_t certain, std::uint32_t end, std::uint32_t groupsPerRun, const Fill& fill);
  /// The members of a set.
  explicit MemberSet(const NodeSet& set);
  /// The nodes of a rising list, all below `end`.
  MemberSet(const std::vector<std::uint32_t>& nodes, std::uint32_t end);
  static MemberSet prefix(std::uint32_t nodes);

  std::uint32_t size() const { return size_; }

 private:
  /// Half of a word's nodes: the bit and the rank of a node are in eight bytes.
  struct Half {
    std::uint32_t bits;
    std::uint32_t before;  // members before those of the half
  };
  static constexpr std::uint32_t kNodesPerHalf = 32, kHalvesPerGroup = 2 * kWordsPerGroup;

  static bool isSet(Half half, std::uint32_t n) { return (half.bits >> (n % kNodesPerHalf) & 1) != 0; }
  static std::uint32_t rankIn(Half half, std::uint32_t n) {
    // The shift leaves the members up to n, and n itself.
    return half.before + static_cast<std::uint32_t>(std::popcount(half.bits << (~n % kNodesPerHalf))) - 1;
  }

 public:
  /// contains(): whether n is a member; n may be kNone. rank(): the number of members before it;
  /// precondition: n is a member. Holds pointers by value, so that no write in a loop can alias them.
  class Lookup {
   public:
    bool contains(std::uint32_t n) const { return isSet(half(std::min(n / kNodesPerGroup, groups_), n), n); }
    std::uint32_t rank(std::uint32_t n) const { return rankIn(half(n / kNodesPerGroup, n), n); }

   private:
    friend class MemberSet;
    Half half(std::uint32_t group, std::uint32_t n) const {
      return halves_[begins_[group] + n / kNodesPerHalf % kHalvesPerGroup];
    }
    const std::uint32_t* begins_;
    const Half* halves_;
    std::uint32_t groups_;
  };
  /// The same for a set with members in nearly every group (isDense()): all groups have words, and no index
  /// is read.
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

  /// Members are divided into spans, in rising order. Different threads can visit different spans.
  static constexpr std::uint32_t kMostInSpan = 4096;
  std::uint32_t spans() const;
  /// Writes the members of a span, rising.
  /// @return Their number. Precondition: room for kMostInSpan.
  std::uint32_t list(std::uint32_t span, std::uint32_t* members) const;
  /// Calls visit(n) for every member, rising, on this thread.
  template <class Visit>
  void visit(const Visit& visit) const {
    std::array<std::uint32_t, kMostInSpan> members;
    for (std::uint32_t span = 0; span < spans(); ++span) {
      const std::uint32_t count = list(span, members.data());
      for (std::uint32_t i = 0; i < count; ++i) visit(members[i]);
    }
  }
  /// The number of members before those of the span.
  std::uint32_t before(std::uint32_t span) const { return halves(used_[span * kWordsPerSpan])[0].before; }

  NodeSet toNodeSet(std::uint32_t nodeCount) const;

 private:
  static constexpr std::uint32_t kNodesPerGroup = kNodesPerWord * kWordsPerGroup;
  static constexpr std::uint32_t kWordsPerSpan = kMostInSpan / kNodesPerWord;

  /// The two halves of a word.
  const Half* halves(std::uint32_t w) const {
    return halves_.get() + begins_[w / kWordsPerGroup] + w % kWordsPerGroup * 2;
  }

  std::uint32_t size_ = 0;
  bool isDense_ = false;
  std::vector<std::uint32_t> begins_;  // per group, and one beyond them: where its halves begin
  std::unique_ptr<Half[]> halves_;     // the first group is empty, and so is the last one of a dense set
  std::vector<std::uint32_t> used_;    // words with members
};

class MemberSet::Sink {
 public:
  /// The members among nodes 64 word .. 64 word + 63. Precondition: words rise.
  void put(std::uint32_t word, std::uint64_t bits) {
    if (bits == 0) return;
    groups_ += words_.empty() || words_.back() / kWordsPerGroup != word / kWordsPerGroup ? 1 : 0;
    members_ += static_cast<std::uint32_t>(std::popcount(bits));
    words_.push_back(word);
    bits_.push_back(bits);
  }

 private:
  friend class MemberSet;
  std::uint32_t groups_ = 0, members_ = 0;
  std::vector<std::uint32_t> words_;
  std::vector<std::uint64_t> bits_;
};

}  // namespace arete
