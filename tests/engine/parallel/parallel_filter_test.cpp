// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/parallel/parallel_filter.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace arete {
namespace {

TEST(ParallelFilter, KeepsWhatStaysInItsOrder) {
  ParallelFilter<std::uint32_t> filter;
  for (const std::size_t size : {10000u, 0u, 1u, 63u, 64u, 65u, 5000u})
    for (const unsigned share : {0u, 3u, 8u}) {
      SCOPED_TRACE(testing::Message()
                   << size << " elements, " << share << " of 8 stay, seed " << size + share);
      std::mt19937 random(static_cast<unsigned>(size) + share);
      std::vector<std::uint32_t> elements(size), expected, kept = {7};
      for (std::uint32_t& element : elements) {
        element = static_cast<std::uint32_t>(random());
        if (element % 8 < share) expected.push_back(element);
      }
      const auto fill = [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
        for (std::size_t i = begin; i < end; ++i)
          if (elements[i] % 8 < share) *to++ = elements[i];
        return to;
      };
      filter(size, 64, kept, fill);
      EXPECT_EQ(kept, expected);
      filter(size, 64, elements, fill);
      EXPECT_EQ(elements, expected) << "into the sequence itself";
    }
}

}  // namespace
}  // namespace arete
