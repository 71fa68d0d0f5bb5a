// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of pages are filled by different threads; each notes the words with members. Once the runs before one
// are counted it is known where its words go, and they are put there, in parallel again. So a small cut of a
// large MT pays for an index a page and for the words of its own pages: what a front looks up stays in the
// caches nearest to a processor. Where nearly all pages have members the few others are there as well: then
// a node's half word is found without the index.
#include "engine/cut/member_set.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cassert>
#include <cstring>
#include <numeric>

namespace arete {
namespace {

constexpr std::uint32_t kPagesPerRun = 64;

/// A bit per byte, set where the byte is not 0. Precondition: count <= 64.
std::uint64_t bitsOf(const std::uint8_t* bytes, std::uint32_t count) {
  std::uint64_t bits = 0;
  for (std::uint32_t at = 0; at < count; at += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes + at, std::min(8u, count - at));
    // The lowest bit of each byte says whether any of it was set; the product brings them side by side.
    constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F;
    const std::uint64_t any = (((eight & kLow) + kLow) | eight) >> 7 & 0x0101010101010101;
    bits |= any * 0x0102040810204080 >> 56 << at;
  }
  return bits;
}

}  // namespace

MemberSet::MemberSet(std::uint32_t certain, std::uint32_t end, std::uint32_t pagesPerRun, const Fill& fill) {
  const std::uint32_t words = (end + kNodesPerWord - 1) / kNodesPerWord,
                      pages = (words + kWordsPerPage - 1) / kWordsPerPage,
                      full = std::min(certain, end) / kNodesPerPage;
  std::vector<Sink> runs((pages - full + pagesPerRun - 1) / pagesPerRun);
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t run) {
    const std::uint32_t first = (full + static_cast<std::uint32_t>(run) * pagesPerRun) * kWordsPerPage;
    fill(first, std::min(words, first + pagesPerRun * kWordsPerPage), runs[run]);
  });

  struct Place {
    std::uint32_t page, used, members;
  };
  std::vector<Place> place(runs.size() + 1);
  place[0] = {1 + full, full * kWordsPerPage, full * kNodesPerPage};
  for (std::size_t run = 0; run < runs.size(); ++run)
    place[run + 1] = {place[run].page + runs[run].pages_,
                      place[run].used + static_cast<std::uint32_t>(runs[run].words_.size()),
                      place[run].members + runs[run].members_};
  size_ = place.back().members;
  begins_.assign(std::size_t(pages) + 1, 0);
  used_.resize(place.back().used);
  constexpr std::uint32_t kFewWithout = 8;  // one page in so many, or less, is worth a page of none
  isDense_ = (1 + pages - place.back().page) * kFewWithout <= pages;
  if (isDense_) {
    std::iota(begins_.begin(), begins_.end(), 1u);
    for (std::uint32_t& begin : begins_) begin *= kHalvesPerPage;
    for (std::size_t run = 0; run < runs.size(); ++run)
      place[run + 1].page = 1 + std::min(pages, full + (static_cast<std::uint32_t>(run) + 1) * pagesPerRun);
  }
  const std::uint32_t pagesHere = place.back().page + (isDense_ ? 1 : 0);
  halves_ = std::make_unique_for_overwrite<Half[]>(std::size_t(pagesHere) * kHalvesPerPage);
  std::fill_n(halves_.get(), kHalvesPerPage, Half{});
  if (isDense_) std::fill_n(halves_.get() + std::size_t(1 + pages) * kHalvesPerPage, kHalvesPerPage, Half{});
  tbb::parallel_for(std::uint32_t(0), full, [&](std::uint32_t page) {
    begins_[page] = (1 + page) * kHalvesPerPage;
    for (std::uint32_t h = page * kHalvesPerPage; h < (page + 1) * kHalvesPerPage; ++h)
      halves_[kHalvesPerPage + h] = {~std::uint32_t(0), h * kNodesPerHalf};
    std::iota(&used_[page * kWordsPerPage], &used_[page * kWordsPerPage] + kWordsPerPage,
              page * kWordsPerPage);
  });
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t run) {
    Place at = place[run];
    std::fill_n(halves_.get() + std::size_t(at.page) * kHalvesPerPage,
                std::size_t(place[run + 1].page - at.page) * kHalvesPerPage, Half{});
    for (std::size_t i = 0; i < runs[run].words_.size(); ++i) {
      const std::uint32_t w = runs[run].words_[i];
      if (begins_[w / kWordsPerPage] == 0) begins_[w / kWordsPerPage] = at.page++ * kHalvesPerPage;
      for (std::uint32_t k = 0; k < 2; ++k) {
        const auto bits = static_cast<std::uint32_t>(runs[run].bits_[i] >> (k * kNodesPerHalf));
        halves_[begins_[w / kWordsPerPage] + w % kWordsPerPage * 2 + k] = {bits, at.members};
        at.members += static_cast<std::uint32_t>(std::popcount(bits));
      }
      used_[at.used++] = w;
    }
  });
}

MemberSet::MemberSet(const NodeSet& set)
    : MemberSet(0, static_cast<std::uint32_t>(set.size()), kPagesPerRun,
                [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
                  for (std::uint32_t word = first; word < last; ++word) {
                    const std::size_t begin = std::size_t(word) * kNodesPerWord;
                    const std::size_t count = std::min<std::size_t>(kNodesPerWord, set.size() - begin);
                    sink.put(word, bitsOf(set.data() + begin, static_cast<std::uint32_t>(count)));
                  }
                }) {}

MemberSet::MemberSet(const std::vector<std::uint32_t>& nodes, std::uint32_t end)
    : MemberSet(0, end, kPagesPerRun, [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
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
  return MemberSet(nodes, nodes, 1, [&](std::uint32_t first, std::uint32_t last, Sink& sink) {
    for (std::uint32_t word = first; word < last; ++word) {
      const std::uint32_t count = std::min(kNodesPerWord, nodes - word * kNodesPerWord);
      sink.put(word, ~std::uint64_t(0) >> (kNodesPerWord - count));
    }
  });
}

MemberSet::Lookup MemberSet::lookup() const {
  Lookup lookup;
  lookup.begins_ = begins_.data();
  lookup.halves_ = halves_.get();
  lookup.pages_ = static_cast<std::uint32_t>(begins_.size() - 1);
  return lookup;
}

MemberSet::DenseLookup MemberSet::denseLookup() const {
  assert(isDense_);
  DenseLookup lookup;
  lookup.halves_ = halves_.get() + kHalvesPerPage;
  lookup.end_ = static_cast<std::uint32_t>(begins_.size() - 1) * kHalvesPerPage;
  return lookup;
}

std::uint32_t MemberSet::pieces() const {
  return static_cast<std::uint32_t>((used_.size() + kWordsPerPiece - 1) / kWordsPerPiece);
}

std::uint32_t MemberSet::list(std::uint32_t piece, std::uint32_t* members) const {
  const std::size_t begin = std::size_t(piece) * kWordsPerPiece;
  std::uint32_t count = 0;
  for (std::size_t i = begin; i < std::min(used_.size(), begin + kWordsPerPiece); ++i) {
    const Half* const half = halves(used_[i]);
    for (std::uint64_t bits = half[0].bits | std::uint64_t(half[1].bits) << kNodesPerHalf; bits != 0;
         bits &= bits - 1)
      members[count++] = used_[i] * kNodesPerWord + static_cast<std::uint32_t>(std::countr_zero(bits));
  }
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
