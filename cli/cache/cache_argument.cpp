// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/cache/cache_argument.h"

#include <fmt/format.h>

#include <cctype>

#include "io/files/text/byte_size.h"

namespace arete {
namespace {

constexpr std::uint64_t kLeastBudget = 1'000'000;

}  // namespace

Result<CacheArgument> parseCacheArgument(const std::string& text) {
  CacheArgument argument;
  argument.folder = text;
  if (const std::size_t colon = text.rfind(':');
      colon != text.npos && colon + 1 < text.size() &&
      std::isdigit(static_cast<unsigned char>(text[colon + 1])) != 0) {
    const std::string bytes = text.substr(colon + 1);
    const auto budget = parseByteSize(bytes);
    if (!budget || *budget < kLeastBudget)
      return failure(ErrorCode::usage,
                     fmt::format("'{}' is not a number of bytes of at least 1MB, as 500MB or 2GB", bytes),
                     text);
    argument.budget = *budget;
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
