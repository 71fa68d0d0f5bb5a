// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/files/network/http_client.h"

namespace arete {

/// The checked answer to a request for a range of bytes.
struct RangeAnswer {
  std::string problem;       ///< empty: `bytes` are what was asked for
  int status = 0;            ///< of HTTP, where it is an error
  bool isRange = false;      ///< false: the server knows no ranges, and `bytes` are the whole file
  std::uint64_t length = 0;  ///< of the whole file
  std::string version;       ///< ETag and date: another version has another text
  std::vector<std::byte> bytes;
};

/// Requests the bytes `first` to `last`, or up to the end of a file that has fewer, and holds what comes
/// against what the server states of it: the begin and the number of bytes, the length of the file, that
/// nothing is compressed. Answers 429, 500, 502, 503 and 504, lost connections and answers that are not what
/// was asked for are tried again, after as many seconds as the server states (30 at most) or the rules say.
RangeAnswer requestRange(HttpClient& client, const RetryRules& rules, std::uint64_t first,
                         std::uint64_t last);

/// The same of several ranges, as many at once as the client sends. Once one of them has failed for good the
/// others are not asked for again. The answers are in the order of the ranges.
std::vector<RangeAnswer> requestRanges(HttpClient& client, const RetryRules& rules,
                                       std::span<const HttpRange> ranges);

}  // namespace arete
