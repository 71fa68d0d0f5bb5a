// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/cut/member_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/mt/multitriangulation.h"

namespace arete {
namespace {

std::vector<std::uint32_t> membersOf(const NodeSet& in) {
  std::vector<std::uint32_t> members;
  for (std::uint32_t n = 0; n < in.size(); ++n)
    if (in[n]) members.push_back(n);
  return members;
}

template <class Lookup>
void expectFinds(const Lookup& lookup, const NodeSet& in, const std::vector<std::uint32_t>& members) {
  for (std::uint32_t n = 0; n < in.size(); ++n) ASSERT_EQ(lookup.contains(n), in[n] != 0) << n;
  for (std::uint32_t beyond = 0; beyond < 5000; beyond += 7)
    ASSERT_FALSE(lookup.contains(static_cast<std::uint32_t>(in.size()) + beyond));
  EXPECT_FALSE(lookup.contains(MultiTriangulation::kNone));
  for (std::uint32_t i = 0; i < members.size(); ++i) ASSERT_EQ(lookup.rank(members[i]), i);
}

/// What the set says of everything that can be asked, against a byte a node.
void expectSame(const MemberSet& set, const NodeSet& in) {
  const std::vector<std::uint32_t> members = membersOf(in);
  ASSERT_EQ(set.size(), members.size());
  expectFinds(set.lookup(), in, members);
  if (set.isDense()) expectFinds(set.denseLookup(), in, members);

  std::vector<std::uint32_t> listed, span(MemberSet::kMostInSpan);
  for (std::uint32_t p = 0; p < set.spans(); ++p) {
    EXPECT_EQ(set.before(p), listed.size());
    const std::uint32_t count = set.list(p, span.data());
    listed.insert(listed.end(), span.begin(), span.begin() + count);
  }
  EXPECT_EQ(listed, members);
  EXPECT_EQ(set.toNodeSet(static_cast<std::uint32_t>(in.size())), in);
}

TEST(MemberSet, IsWhatItWasMadeOfBeItFullSparseOrEmpty) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    for (const std::uint32_t nodes : {0u, 1u, 63u, 64u, 1023u, 1024u, 1025u, 70'000u})
      for (const double share : {0.0, 0.0005, 0.3, 1.0}) {
        NodeSet in(nodes);
        for (auto& n : in) n = std::uniform_real_distribution<>()(random) < share;
        expectSame(MemberSet(in), in);
        expectSame(MemberSet(membersOf(in), nodes), in);
      }
  }
}

TEST(MemberSet, IsDenseWhereHardlyAPageIsWithoutMembers) {
  std::mt19937 random(4);
  const auto spread = [&](std::uint32_t nodes, double share) {
    NodeSet in(nodes);
    for (auto& n : in) n = std::uniform_real_distribution<>()(random) < share;
    return in;
  };
  const NodeSet nearly = spread(100'000, 0.003), thin = spread(100'000, 0.0003);
  int pagesWithout = 0;
  for (std::size_t group = 0; group + 1024 <= nearly.size(); group += 1024)
    pagesWithout += std::all_of(&nearly[group], &nearly[group] + 1024, [](auto n) { return n == 0; }) ? 1 : 0;
  EXPECT_GT(pagesWithout, 0);
  EXPECT_TRUE(MemberSet(nearly).isDense());
  expectSame(MemberSet(nearly), nearly);
  EXPECT_FALSE(MemberSet(thin).isDense());
  expectSame(MemberSet(thin), thin);
  EXPECT_TRUE(MemberSet::prefix(5000).isDense());
}

TEST(MemberSet, OfAPrefixHasTheFirstNodes) {
  for (const std::uint32_t nodes : {0u, 1u, 64u, 1000u, 1024u, 1056u, 2047u, 2048u, 66'000u})
    expectSame(MemberSet::prefix(nodes), NodeSet(nodes, 1));
}

TEST(MemberSet, TakesWhatIsCertainForWholePagesAndAsksForTheRest) {
  constexpr std::uint32_t kEnd = 5000, kWord = MemberSet::kNodesPerWord;
  for (const std::uint32_t certain : {0u, 1u, 1024u, 1500u, 4999u, 5000u}) {
    NodeSet in(kEnd);
    for (std::uint32_t n = 0; n < kEnd; ++n) in[n] = n < certain || n % 3 == 0;
    const MemberSet set(certain, kEnd, 2,
                        [&](std::uint32_t first, std::uint32_t last, MemberSet::Sink& sink) {
                          EXPECT_GE((first + 1) * kWord + 1024, certain);
                          for (std::uint32_t word = first; word < last; ++word) {
                            std::uint64_t bits = 0;
                            for (std::uint32_t n = word * kWord; n < std::min(kEnd, (word + 1) * kWord); ++n)
                              bits |= std::uint64_t(in[n]) << n % kWord;
                            sink.put(word, bits);
                          }
                        });
    expectSame(set, in);
  }
}

}  // namespace
}  // namespace arete
