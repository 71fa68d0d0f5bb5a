// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace arete {

/// What fresh memory has cost so far, by the kind of pages that it was made of, and so which kind to ask the
/// system for next. On one machine large pages are a fiftieth of the price, on another four times as dear,
/// and on a third now one and then the other, as its host has the memory at hand or not
/// (docs/decisions/0028): nothing but trying tells.
///
/// Large pages must be sure to pay: the dearest of their last prices is held against the cheapest of the
/// small ones'. Whoever is not chosen is tried every now and then.
class PagePrices {
 public:
  enum class Kind : std::uint8_t { small, large };

  /// Whether there is anything to compare.
  bool areKnown() const { return small_.count > 0 && large_.count > 0; }

  /// The kind to ask for.
  Kind cheaper() const { return large_.dearest() < small_.cheapest() ? Kind::large : Kind::small; }

  /// The kind whose price is to be found out next: the one that is asked for, but for one time in eight, and
  /// until both are known.
  Kind toTry() const {
    if (small_.count == 0) return Kind::small;
    if (large_.count == 0) return Kind::large;
    const Kind chosen = cheaper();
    if (tries_ % kTriesOfOne != 0) return chosen;
    return chosen == Kind::small ? Kind::large : Kind::small;
  }

  /// What an amount of memory has cost that is always the same.
  void note(Kind kind, double seconds) {
    ++tries_;
    (kind == Kind::large ? large_ : small_).add(seconds);
  }

 private:
  static constexpr std::size_t kTriesOfOne = 8;

  struct Last {
    std::array<double, 3> seconds{};
    std::size_t count = 0;
    void add(double s) { seconds[count++ % seconds.size()] = s; }
    auto end() const {
      return seconds.begin() + static_cast<std::ptrdiff_t>(std::min(count, seconds.size()));
    }
    double cheapest() const { return count == 0 ? 0 : *std::min_element(seconds.begin(), end()); }
    double dearest() const {
      return count == 0 ? std::numeric_limits<double>::infinity() : *std::max_element(seconds.begin(), end());
    }
  };
  Last small_, large_;
  std::size_t tries_ = 0;
};

}  // namespace arete
