// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace arete {

/// The bytes [begin, end) of a file.
struct ByteRange {
  std::uint64_t begin = 0, end = 0;
  std::uint64_t size() const { return end - begin; }
  bool operator==(const ByteRange&) const = default;
};

/// How ranges become requests.
struct RangeRules {
  /// Fewer bytes than this between two ranges are fetched with them,
  std::uint64_t gap = std::uint64_t{1} << 17;
  /// and more where there are more requests than these,
  std::size_t fewRequests = 5;
  /// as long as all gaps have at most these bytes, and this share of the wanted ones.
  std::uint64_t gapsBytes = std::uint64_t{1} << 17;
  double gapsShare = 1;
  std::uint64_t longest = std::uint64_t{1} << 23;  ///< of one request
};

/// Sorts ranges, and joins those that meet.
std::vector<ByteRange> joinedRanges(std::vector<ByteRange> ranges);

/// The requests for ranges, in the order of the file: all bytes of the ranges, and what lies between near
/// ones.
///
/// @param ranges As joinedRanges() returns them. O(n log n).
std::vector<ByteRange> planRequests(const std::vector<ByteRange>& ranges, const RangeRules& rules = {});

}  // namespace arete
