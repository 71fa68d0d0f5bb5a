// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/ranges/range_plan.h"

#include <algorithm>
#include <numeric>

namespace arete {

std::vector<ByteRange> joinedRanges(std::vector<ByteRange> ranges) {
  std::ranges::sort(ranges, {}, &ByteRange::begin);
  std::vector<ByteRange> joined;
  for (const ByteRange& range : ranges) {
    if (range.begin >= range.end) continue;
    if (!joined.empty() && range.begin <= joined.back().end)
      joined.back().end = std::max(joined.back().end, range.end);
    else
      joined.push_back(range);
  }
  return joined;
}

// The shortest gaps are closed first, as far as their budget goes, so that ranges which lie scattered do not
// fetch many times their bytes.
std::vector<ByteRange> planRequests(const std::vector<ByteRange>& ranges, const RangeRules& rules) {
  if (ranges.empty()) return {};
  const auto gapBehind = [&](std::size_t i) { return ranges[i + 1].begin - ranges[i].end; };
  std::vector<std::size_t> gaps(ranges.size() - 1);
  std::iota(gaps.begin(), gaps.end(), std::size_t{0});
  std::ranges::stable_sort(gaps, {}, gapBehind);
  std::uint64_t wanted = 0;
  for (const ByteRange& range : ranges) wanted += range.size();
  double left = static_cast<double>(rules.gapsBytes) + rules.gapsShare * static_cast<double>(wanted);
  std::size_t requests = ranges.size();
  std::vector<bool> isClosed(gaps.size());
  for (const std::size_t i : gaps) {
    const std::uint64_t gap = gapBehind(i);
    left -= static_cast<double>(gap);
    if (left < 0 || (gap >= rules.gap && requests <= rules.fewRequests)) break;
    isClosed[i] = true;
    --requests;
  }
  std::vector<ByteRange> planned;
  for (std::size_t i = 0; i < ranges.size();) {
    const std::uint64_t begin = ranges[i].begin;
    while (i + 1 < ranges.size() && isClosed[i]) ++i;
    const std::uint64_t end = ranges[i++].end;
    for (std::uint64_t at = begin; at < end; at += rules.longest)
      planned.push_back({at, std::min(end, at + rules.longest)});
  }
  return planned;
}

}  // namespace arete
