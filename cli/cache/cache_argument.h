// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>

#include "engine/base/result.h"
#include "io/files/ranges/span_cache.h"

namespace arete {

/// A folder, and the bytes that may be kept in it.
struct CacheArgument {
  std::string folder;
  std::uint64_t budget = SpanCache::kUsualBudget;
};

/// Reads "FOLDER[:BYTES]": BYTES is a number, by itself or followed by a unit (parseByteSize()). What follows
/// the last colon and begins with a digit is BYTES.
///
/// Errors: usage: no folder, or bytes that are no such number, of less than 1 MB.
Result<CacheArgument> parseCacheArgument(const std::string& text);

/// Refuses other texts on the command line.
CLI::Validator cacheArgument();

/// Opens the cache of such a text; null for an empty one. Errors: as parseCacheArgument(), SpanCache::open().
Result<std::shared_ptr<SpanCache>> openCache(const std::string& text);

}  // namespace arete
