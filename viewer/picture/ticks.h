// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace arete {

/// The largest of 1, 2, 5 times a power of ten that is <= `value`. Precondition: value > 0, finite.
double roundDownNice(double value);

/// Multiples of a round step within [low, high], about `count` of them. Precondition: low < high, finite.
std::vector<double> linearTicks(double low, double high, int count);

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
