// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace arete {

/// The largest of 1, 2, 5 times a power of ten that is <= `value`. Precondition: value > 0, finite.
double roundDownNice(double value);

/// Multiples of a round step within [low, high], about `count` of them; the two ends where doubles are too
/// far apart for any. Precondition: low < high, finite.
std::vector<double> linearTicks(double low, double high, int count);

/// The numbers of an axis, all with as many decimals as tell them apart: 4321.2, 4321.4 and never 4321 twice.
/// Grouped, with a true minus sign. The same text means the same number.
std::vector<std::string> tickTexts(std::span<const double> ticks);

/// A tick of a logarithmic axis; minor ticks have no number.
struct LogTick {
  double value = 1;
  bool major = true;
};

/// Ticks of a logarithmic axis within [low, high]: decades are major, and so are 2 and 5 in between on an
/// axis of up to three decades. Precondition: 0 < low < high, finite.
std::vector<LogTick> logTicks(double low, double high);

/// "12 345", thin spaces between groups of three; "1234" stays together.
std::string countText(std::uint64_t count);

/// Formats a number with four significant digits, no trailing zeros, grouped, with a true minus sign.
std::string numberText(double value);

/// The same with a plus sign where the value is positive.
std::string signedText(double value);

}  // namespace arete
