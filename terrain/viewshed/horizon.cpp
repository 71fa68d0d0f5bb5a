// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two lines cross at most once: between two ends of parts, the new segment is above the old part everywhere,
// nowhere, or on one side of their crossing. Rounding of the crossing does not matter, since both lines have
// nearly the same height there.
#include "terrain/viewshed/horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();
constexpr std::uint32_t kFirstCapacity = 6;
/// Directions nearer to each other than this may be the same.
constexpr double kSameDirection = 1e-15;

}  // namespace

ViewshedHorizon::ViewshedHorizon(double first, double last, std::uint32_t bins)
    : first_(first),
      width_((last - first) / bins),
      perUnit_(bins / (last - first)),
      lastBin_(static_cast<int>(bins) - 1),
      low_(bins, kNone),
      high_(bins, kNone),
      bins_(bins),
      parts_(std::size_t{bins} * kFirstCapacity) {
  for (std::uint32_t b = 0; b < bins; ++b) {
    bins_[b] = {b * kFirstCapacity, 1, kFirstCapacity};
    parts_[bins_[b].from] = {startOf(static_cast<int>(b)), kNone, 0, 0};
  }
}

void ViewshedHorizon::add(double u0, double v0, double u1, double v1, double slack) {
  if (u0 > u1) {
    std::swap(u0, u1);
    std::swap(v0, v1);
  }
  if (!(u1 > u0) || u1 < first_ || u0 > startOf(lastBin_ + 1)) return;
  const int from = bin(u0), to = bin(u1);
  const double higher = v0 > v1 ? v0 : v1;
  Part line{0, 0, 0, slack};
  bool isMade = false;
  for (int b = from; b <= to; ++b) {
    if (higher <= low_[static_cast<std::size_t>(b)]) continue;
    if (!isMade) {
      line.b = (v1 - v0) / (u1 - u0);
      line.a = v0 - line.b * u0;
      isMade = true;
    }
    // at() reads both bins of a direction within rounding of their border, so the segment is added up to the
    // border.
    const double start = startOf(b), end = startOf(b + 1);
    add(b, line, b == from ? std::clamp(u0, start, end) : start, b == to ? std::clamp(u1, start, end) : end);
  }
}

void ViewshedHorizon::add(int b, const Part& line, double from, double to) {
  Bin& bin = bins_[static_cast<std::size_t>(b)];
  const Part* old = parts_.data() + bin.from;
  const double end = startOf(b + 1), least = line.slack < -kNone ? line.slack / 100 : 0;
  scratch_.clear();
  bool isChanged = false;
  const auto push = [&](double start, const Part& part) {
    if (!scratch_.empty() && scratch_.back().a == part.a && scratch_.back().b == part.b) return;
    scratch_.push_back({start, part.a, part.b, part.slack});
  };
  for (std::uint32_t i = 0; i < bin.count; ++i) {
    const Part& part = old[i];
    const double start = part.start, stop = i + 1 < bin.count ? old[i + 1].start : end;
    const double l = std::max(start, from), r = std::min(stop, to);
    if (!(l < r)) {
      push(start, part);
      continue;
    }
    const double above0 = line.at(l) - part.at(l), above1 = line.at(r) - part.at(r);
    const bool is0 = above0 > least, is1 = above1 > least;
    if (!is0 && !is1) {
      push(start, part);
      continue;
    }
    isChanged = true;
    double a = l, z = r;  // the new line is higher from a to z
    if (!is0 || !is1) {
      const double crossing = above0 == above1 ? l : l + (r - l) * (above0 / (above0 - above1));
      if (above0 < 0) a = std::clamp(crossing, l, r);
      if (above1 < 0) z = std::clamp(crossing, l, r);
    }
    if (start < a) push(start, part);
    push(a, line);
    if (z < stop) push(z, part);
  }
  if (!isChanged) return;
  if (scratch_.size() > bin.capacity) {
    const auto capacity = static_cast<std::uint32_t>(scratch_.size() * 2);
    bin.from = static_cast<std::uint32_t>(parts_.size());
    bin.capacity = capacity;
    parts_.resize(parts_.size() + capacity);
  }
  bin.count = static_cast<std::uint32_t>(scratch_.size());
  Part* to_ = parts_.data() + bin.from;
  double low = -kNone, high = kNone;
  for (std::size_t i = 0; i < scratch_.size(); ++i) {
    const Part& part = to_[i] = scratch_[i];
    const double v0 = part.at(part.start),
                 v1 = part.at(i + 1 < scratch_.size() ? scratch_[i + 1].start : end);
    low = std::min(low, std::min(v0, v1) - part.slack);
    high = std::max(high, std::max(v0, v1));
  }
  low_[static_cast<std::size_t>(b)] = low;
  high_[static_cast<std::size_t>(b)] = high;
}

ViewshedHorizon::Bounds ViewshedHorizon::at(double u) const {
  const auto inBin = [&](int b, Bounds bounds) {
    const Bin& bin = bins_[static_cast<std::size_t>(b)];
    const Part* part = parts_.data() + bin.from;
    std::uint32_t i = 0;
    while (i + 1 < bin.count && part[i + 1].start < u - kSameDirection) ++i;
    for (; i < bin.count && (part[i].start <= u + kSameDirection || i == 0); ++i) {
      const double v = part[i].at(u);
      bounds.upper = std::max(bounds.upper, v);
      bounds.lower = std::min(bounds.lower, v - part[i].slack);
    }
    return bounds;
  };
  const int before = bin(u - kSameDirection), after = bin(u + kSameDirection);
  Bounds bounds = inBin(before, {-kNone, kNone});
  if (after != before) bounds = inBin(after, bounds);
  return bounds;
}

}  // namespace arete
