// SPDX-License-Identifier: GPL-3.0-or-later
//
// A histogram over the range of the heights shows whether there is a long run of empty bins; most DEMs have
// none, and one pass is all. Such runs divide the heights into parts. The part with the most samples that has
// more than one height is the terrain; the others are looked at sample by sample. Heights that stand alone
// are taken out, and the rest is looked at again: beside 1e20, the gap between -9999 and hills is not seen.
#include "terrain/model/lone_heights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kBins = 1024, kLongRun = kBins / 5, kSamplesAtOnce = 1 << 16;
constexpr double kFar = 2, kFarIfSingle = 10, kFarIfUsual = 0.5, kRemote = 1000, kHuge = 1e19;
constexpr std::uint64_t kFewSamples = 64, kManySamples = 4096, kRare = 1000;  // one of so many
constexpr int kMostRounds = 8;

/// Raw values that producers of DEMs use for missing data.
bool isUsualMark(double raw) {
  constexpr std::array kMarks = {-9999.0, 9999.0,  -99999.0, 99999.0, -999999.0,    -32768.0,     -32767.0,
                                 32767.0, 65535.0, -999.0,   -9998.0, 2147483647.0, -2147483648.0};
  return std::ranges::find(kMarks, raw) != kMarks.end();
}

struct Range {
  double low = kInfinity, high = -kInfinity;
  void take(double z) {
    low = z < low ? z : low;  // false for NODATA
    high = z > high ? z : high;
  }
  void take(const Range& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  bool holds(double z) const { return z >= low && z <= high; }
  /// high - low, in halves so that it does not overflow.
  double half() const { return high / 2 - low / 2; }
};

/// The exact content of a part of the histogram.
struct Part {
  Range range;
  std::uint64_t count = 0;
  std::vector<LoneHeights::Value> values;  // distinct, rising, of at most kMostValues + 1

  void take(double z, std::uint64_t times = 1) {
    range.take(z);
    count += times;
    const auto at = std::ranges::lower_bound(values, z, {}, &LoneHeights::Value::height);
    if (at != values.end() && at->height == z)
      at->count += times;
    else if (values.size() <= LoneHeights::kMostValues)
      values.insert(at, {z, times});
  }
  void take(const Part& other) {
    const std::uint64_t both = count + other.count;
    for (const LoneHeights::Value& value : other.values) take(value.height, value.count);
    count = both;
    range.take(other.range);
  }
  bool isListed() const { return values.size() <= LoneHeights::kMostValues; }
};

using Histogram = std::array<std::uint64_t, kBins>;

/// The bins of a range.
class Bins {
 public:
  explicit Bins(const Range& range) : low_(range.low / 2), perBin_(double(kBins) / range.half()) {}
  std::size_t of(double z) const {
    return std::min(static_cast<std::size_t>((z / 2 - low_) * perBin_), kBins - 1);
  }

 private:
  double low_, perBin_;
};

template <class T, class Take, class Join>
T reduce(std::span<const double> heights, const T& nothing, const Take& take, const Join& join) {
  return parallelReduce(
      IndexRange<std::size_t>(0, heights.size(), kSamplesAtOnce), nothing,
      [&](const auto& part, T found) {
        for (const double z : heights.subspan(part.begin(), part.size())) take(found, z);
        return found;
      },
      join);
}

/// The first bin of each part, when long runs of empty bins divide them.
std::vector<std::size_t> partsOf(const Histogram& histogram) {
  std::vector<std::size_t> begins = {0};
  std::size_t last = 0;  // the first bin is not empty: it has the lowest height
  for (std::size_t bin = 1; bin < kBins; ++bin) {
    if (histogram[bin] == 0) continue;
    if (bin - last > kLongRun) begins.push_back(bin);
    last = bin;
  }
  return begins;
}

/// Whether every sixteenth height shows that no long run of bins is empty, as in most DEMs.
bool isFilled(std::span<const double> heights, const Range& range) {
  constexpr std::size_t kEvery = 16;
  if (!(range.half() > 0)) return true;
  const Bins bins(range);
  Histogram histogram{};
  histogram.front() = histogram.back() = 1;
  for (std::size_t i = 0; i < heights.size(); i += kEvery)
    if (heights[i] == heights[i]) histogram[bins.of(heights[i])] = 1;
  return partsOf(histogram).size() == 1;
}

struct Search {
  std::span<const double> heights;
  double scale, offset;
  std::uint64_t samples = 0;

  /// @param next  the part beside it on the side of the terrain
  bool isAlone(const Part& part, const Part& next, const Part& terrain) const {
    const Range& rest = terrain.range;
    const bool isUsual =
        part.isListed() && std::ranges::all_of(part.values, [&](const auto& value) {
          const double raw = std::nearbyint((value.height - offset) / scale * 1e6) / 1e6;
          return isUsualMark(raw) ||
                 (std::abs(raw) >= kHuge && std::max(-rest.low, rest.high) < kHuge && rest.half() > 0);
        });
    if (!part.isListed() && part.count > std::max<std::uint64_t>(8, samples / kRare)) return false;
    if (part.count * 2 > samples && !isUsual) return false;
    const double gap = part.range.low > next.range.high ? part.range.low / 2 - next.range.high / 2
                                                        : next.range.low / 2 - part.range.high / 2;
    if (isUsual && gap > kFarIfUsual * rest.half()) return true;
    if (rest.half() == 0) return 2 * gap > kRemote * std::max(1.0, std::abs(rest.low));
    const bool isSparse = samples < kFewSamples || terrain.isListed();
    const bool isSingle = part.count < 8 && samples < kManySamples;  // a peak may stand out by chance
    return gap > (isSparse ? kRemote : isSingle ? kFarIfSingle : kFar) * rest.half();
  }

  /// Takes lone heights out of the range of the others; false where none are found.
  bool narrow(Range& others, Part& lone) const {
    if (!(others.half() > 0)) return false;
    const Bins bins(others);
    const auto histogram = reduce(
        heights, Histogram{},
        [&](Histogram& counts, double z) {
          if (others.holds(z)) ++counts[bins.of(z)];
        },
        [](Histogram a, const Histogram& b) {
          for (std::size_t i = 0; i < kBins; ++i) a[i] += b[i];
          return a;
        });
    const std::vector<std::size_t> begins = partsOf(histogram);
    if (begins.size() == 1) return false;
    const auto parts = reduce(
        heights, std::vector<Part>(begins.size()),
        [&](std::vector<Part>& found, double z) {
          if (!others.holds(z)) return;
          const auto part = std::ranges::upper_bound(begins, bins.of(z)) - begins.begin() - 1;
          found[static_cast<std::size_t>(part)].take(z);
        },
        [](std::vector<Part> a, const std::vector<Part>& b) {
          for (std::size_t i = 0; i < a.size(); ++i) a[i].take(b[i]);
          return a;
        });
    const auto terrain = std::ranges::max_element(
        parts, {}, [](const Part& part) { return std::pair(part.range.half() > 0, part.count); });
    // What stands alone lies below or above all others, not between them.
    auto first = parts.begin(), last = parts.end() - 1;
    for (; first != terrain && isAlone(*first, *(first + 1), *terrain); ++first) lone.take(*first);
    for (; last != terrain && isAlone(*last, *(last - 1), *terrain); --last) lone.take(*last);
    const bool isFound = first != parts.begin() || last != parts.end() - 1;
    others = {first->range.low, last->range.high};
    return isFound;
  }
};

std::string nameOf(const LoneHeights::Value& value, double scale, double offset) {
  const double raw = (value.height - offset) / scale;
  const double whole = std::nearbyint(raw);
  return fmt::format("{}", std::abs(raw - whole) < 1e-6 ? whole : raw);
}

}  // namespace

bool LoneHeights::areRemote() const {
  const double all = std::max(high, highest) / 2 - std::min(low, lowest) / 2, others = high / 2 - low / 2;
  return count > 0 && all > kRemote * others;
}

LoneHeights loneHeights(std::span<const double> heights, double scale, double offset) {
  const Range whole = reduce(
      heights, Range{}, [](Range& found, double z) { found.take(z); },
      [](Range a, const Range& b) {
        a.take(b);
        return a;
      });
  LoneHeights result;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  result.low = result.high = kNone;
  if (!(whole.low <= whole.high)) return result;
  result.low = whole.low;
  result.high = whole.high;
  if (isFilled(heights, whole)) return result;
  Range others = whole;
  Part lone;
  const auto samples =
      static_cast<std::uint64_t>(std::ranges::count_if(heights, [](double z) { return z == z; }));
  const Search search{heights, scale, offset, samples};
  for (int round = 0; round < kMostRounds && search.narrow(others, lone); ++round) {
  }
  result.low = others.low;
  result.high = others.high;
  result.count = lone.count;
  if (lone.count == 0) return result;
  result.lowest = lone.range.low;
  result.highest = lone.range.high;
  if (lone.isListed()) result.values = std::move(lone.values);
  return result;
}

std::string describe(const LoneHeights& lone, double scale, double offset) {
  const auto times = [](std::uint64_t count) { return count == 1 ? "once" : fmt::format("{} times", count); };
  const std::string others = fmt::format("far from the other heights, from {} to {}", lone.low, lone.high);
  if (lone.values.empty())
    return lone.count == 1
               ? fmt::format("the height {} stands alone, {}: does it mark missing data, or is it an error?",
                             lone.lowest, others)
               : fmt::format(
                     "{} heights from {} to {} stand alone, {}: do they mark missing data, or are they "
                     "errors?",
                     lone.count, lone.lowest, lone.highest, others);
  std::string which;
  for (const LoneHeights::Value& value : lone.values)
    which += fmt::format("{}the value {} occurs {}", which.empty() ? "" : ", ", nameOf(value, scale, offset),
                         times(value.count));
  return fmt::format("{}, {}; if it marks missing data, state it: `nodata` {}", which, others,
                     nameOf(lone.values.front(), scale, offset));
}

}  // namespace arete
