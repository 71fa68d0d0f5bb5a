// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of pages in memory share, of terrain and of surfaces.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "io/query/pages/resident_pages.h"

namespace arete::test {

inline constexpr std::uint64_t kAnyBytes = std::numeric_limits<std::uint64_t>::max();

template <class T>
T got(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().describe());
  return std::move(*result);
}

/// Steps until nothing changes any more.
template <class Model>
typename ResidentPages<Model>::Step settled(ResidentPages<Model>& pages, const PageDemand& demand,
                                            std::uint64_t mostBytes) {
  for (int i = 0; i < 20'000; ++i) {
    auto step = got(pages.step(demand, mostBytes));
    if (step.isDone) return step;
  }
  ADD_FAILURE() << "the steps do not end";
  return got(pages.step(demand, mostBytes));
}

}  // namespace arete::test
