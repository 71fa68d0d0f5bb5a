// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ticks are multiples of a step of 1, 2 or 5 times a power of ten, counted in whole multiples so that errors
// do not add up.
#include "viewer/picture/ticks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace arete {
namespace {

constexpr std::string_view kThinSpace = "\u2009";
constexpr std::string_view kMinus = "\u2212";
constexpr double kSlack = 1e-9;  // a tick on the end of an axis is on the axis, whatever the rounding

constexpr double kLargestWhole = 1e15;  // of doubles that can still be counted one by one

/// Groups the digits before the decimal point in threes.
std::string grouped(const std::string& digits) {
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  if (whole <= 4) return digits;
  std::string text;
  for (std::size_t i = 0; i < whole; ++i) {
    if (i > 0 && (whole - i) % 3 == 0) text += kThinSpace;
    text += digits[i];
  }
  return text + digits.substr(whole);
}

}  // namespace

double roundDownNice(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value) + kSlack));
  for (const double factor : {5.0, 2.0}) {
    if (decade * factor <= value * (1 + kSlack)) return decade * factor;
  }
  return decade;
}

std::vector<double> linearTicks(double low, double high, int count) {
  const double wanted = (high - low) / std::max(count, 1);
  double step = roundDownNice(wanted);
  if (wanted > step * 1.5) step = roundDownNice(step * 2.5);
  std::vector<double> ticks;
  if (!(std::max(std::abs(low), std::abs(high)) / step < kLargestWhole)) return {low, high};
  const double last = std::floor(high / step + kSlack);
  for (double i = std::ceil(low / step - kSlack); i <= last; ++i) ticks.push_back(i * step);
  return ticks;
}

std::vector<std::string> tickTexts(std::span<const double> ticks) {
  double largest = 0, step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    largest = std::max(largest, std::abs(ticks[i]));
    for (std::size_t j = 0; j < i; ++j)
      if (ticks[i] != ticks[j]) step = std::min(step, std::abs(ticks[i] - ticks[j]));
  }
  // One number alone has four digits.
  if (!std::isfinite(step)) step = largest * 1e-3;
  // The fewest decimals that move no tick by more than a hundredth of their distance.
  constexpr int kMostDecimals = 12;
  const auto isExact = [&](int decimals) {
    const double unit = std::pow(10, -decimals);
    return std::ranges::all_of(
        ticks, [&](double v) { return std::abs(std::round(v / unit) * unit - v) <= step / 100; });
  };
  int decimals = 0;
  while (decimals < kMostDecimals && !isExact(decimals)) ++decimals;
  const bool isPlain = largest < 1e12 && isExact(decimals);
  const int digits = largest > 0 ? std::clamp(int(std::ceil(std::log10(largest / step))) + 1, 2, 16) : 1;
  std::vector<std::string> texts;
  for (const double v : ticks) {
    std::string text = isPlain ? grouped(fmt::format("{:.{}f}", std::abs(v), decimals))
                               : fmt::format("{:.{}e}", std::abs(v), digits);
    const bool isZero = text.find_first_of("123456789") == std::string::npos;
    texts.push_back(v < 0 && !isZero ? std::string(kMinus) + text : text);
  }
  return texts;
}

std::vector<LogTick> logTicks(double low, double high) {
  const bool fewDecades = std::log10(high / low) <= 3;
  std::vector<LogTick> ticks;
  for (double exponent = std::floor(std::log10(low)); exponent <= std::ceil(std::log10(high)); ++exponent) {
    for (int factor = 1; factor <= 9; ++factor) {
      const double value = factor * std::pow(10, exponent);
      if (value < low * (1 - kSlack) || value > high * (1 + kSlack)) continue;
      ticks.push_back({value, factor == 1 || (fewDecades && (factor == 2 || factor == 5))});
    }
  }
  return ticks;
}

std::string countText(std::uint64_t count) {
  return grouped(fmt::format("{}", count));
}

std::string numberText(double value) {
  if (!std::isfinite(value)) return "?";
  const double size = std::abs(value);
  if (size == 0) return "0";
  std::string digits;
  if (size < 1e-4 || size >= 1e12) {
    digits = fmt::format("{:.3g}", size);
  } else {
    const int decimals = std::max(0, 3 - int(std::floor(std::log10(size))));
    digits = fmt::format("{:.{}f}", size, decimals);
    if (digits.find('.') != std::string::npos) {
      digits.erase(digits.find_last_not_of('0') + 1);
      if (digits.back() == '.') digits.pop_back();
    }
    digits = grouped(digits);
  }
  return fmt::format("{}{}", value < 0 ? kMinus : "", digits);
}

std::string signedText(double value) {
  return fmt::format("{}{}", value > 0 ? "+" : "", numberText(value));
}

}  // namespace arete
