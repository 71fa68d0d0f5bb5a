// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/cache/cache_argument.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace arete {
namespace {

constexpr double kLeastBudget = 1e6, kMostBudget = 1e18;

std::optional<double> bytesOf(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
  const std::string_view unit(end, text.data() + text.size());
  constexpr std::array<std::pair<std::string_view, double>, 11> kUnits = {{{"", 1},
                                                                           {"B", 1},
                                                                           {"kB", 1e3},
                                                                           {"KB", 1e3},
                                                                           {"MB", 1e6},
                                                                           {"GB", 1e9},
                                                                           {"TB", 1e12},
                                                                           {"KiB", 0x1p10},
                                                                           {"MiB", 0x1p20},
                                                                           {"GiB", 0x1p30},
                                                                           {"TiB", 0x1p40}}};
  for (const auto& [name, factor] : kUnits)
    if (unit == name) return number * factor;
  return std::nullopt;
}

}  // namespace

Result<CacheArgument> parseCacheArgument(const std::string& text) {
  CacheArgument argument;
  argument.folder = text;
  if (const std::size_t colon = text.rfind(':');
      colon != text.npos && colon + 1 < text.size() &&
      std::isdigit(static_cast<unsigned char>(text[colon + 1])) != 0) {
    const std::string bytes = text.substr(colon + 1);
    const auto budget = bytesOf(bytes);
    if (!budget || *budget < kLeastBudget || *budget > kMostBudget)
      return failure(ErrorCode::usage,
                     fmt::format("'{}' is not a number of bytes of at least 1MB, as 500MB or 2GB", bytes),
                     text);
    argument.budget = static_cast<std::uint64_t>(*budget);
    argument.folder.resize(colon);
  }
  if (argument.folder.empty()) return failure(ErrorCode::usage, "names no folder", text);
  return argument;
}

CLI::Validator cacheArgument() {
  return {[](std::string& text) {
            const auto argument = parseCacheArgument(text);
            return argument ? std::string() : argument.error().message;
          },
          ""};
}

Result<std::shared_ptr<SpanCache>> openCache(const std::string& text) {
  if (text.empty()) return std::shared_ptr<SpanCache>();
  ARETE_TRY(const CacheArgument argument, parseCacheArgument(text));
  return SpanCache::open(argument.folder, argument.budget);
}

}  // namespace arete
