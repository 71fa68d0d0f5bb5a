// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/base/id_array.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/ids.h"
#include "engine/memory/paged_array.h"

namespace arete {
namespace {

using Heights = IdArray<VertexId, std::vector<double>>;

template <class Array, class Index>
concept HasElementAt = requires(Array& array, Index index) {
  array[index];
};

static_assert(HasElementAt<Heights, VertexId> && HasElementAt<const Heights, VertexId>);
static_assert(!HasElementAt<Heights, TriangleId> && !HasElementAt<const Heights, TriangleId>);
static_assert(!HasElementAt<Heights, std::uint32_t> && !HasElementAt<const Heights, std::size_t>);
static_assert(std::is_same_v<decltype(std::declval<const Heights&>()[VertexId()]), const double&>);

TEST(IdArray, GivesTheElementsInTheOrderOfTheirIds) {
  Heights heights({5, 6, 7});
  EXPECT_EQ(heights[VertexId(0)], 5);
  heights[VertexId(1)] = 9;
  heights.push_back(8);
  const Heights& fixed = heights;
  EXPECT_EQ(fixed[VertexId(1)], 9);
  EXPECT_EQ(fixed[VertexId(3)], 8);
  EXPECT_EQ(fixed, (std::vector<double>{5, 9, 7, 8})) << "as the array that it is";
}

TEST(IdArray, TakesAnArray) {
  std::vector<double> elements = {5, 6};
  const Heights heights(std::move(elements));
  EXPECT_EQ(heights[VertexId(1)], 6);
  EXPECT_TRUE(Heights().empty());
}

TEST(IdArray, IsMadeAsItsArrayIs) {
  IdArray<TriangleId, PagedArray<int>> paged(2);
  paged[TriangleId(1)] = 3;
  EXPECT_EQ(std::as_const(paged)[TriangleId(1)], 3);
  EXPECT_EQ(paged.size(), 2u);
}

}  // namespace
}  // namespace arete
