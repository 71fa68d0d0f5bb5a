// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/network/checked_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace arete {
namespace {

constexpr double kLongestWaitSeconds = 30;

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end == text.data()) return std::nullopt;
  return value;
}

/// Fills in what the headers say, and checks the bytes against it.
void checkReply(RangeAnswer& answer, const HttpReply& reply, std::uint64_t first, std::uint64_t last) {
  answer.version = fmt::format("{} {}", reply.tag, reply.date);
  if (!reply.encoding.empty() && reply.encoding != "identity") {
    answer.problem = fmt::format("the server sent the bytes as {}, which was not asked for", reply.encoding);
    return;
  }
  const std::string_view range = reply.range;
  answer.isRange = !range.empty();
  const std::size_t got = answer.bytes.size();
  if (!answer.isRange) {
    const auto stated = wholeNumber(reply.length);
    answer.length = stated.value_or(got);
    if (got != answer.length)
      answer.problem = fmt::format("the server sent {} of {} bytes", got, answer.length);
    return;
  }
  const std::size_t slash = range.find('/'), space = range.find(' ');
  const auto total = slash == range.npos ? std::nullopt : wholeNumber(range.substr(slash + 1));
  const auto start = space == range.npos ? std::nullopt : wholeNumber(range.substr(space + 1));
  if (!total || !start) {
    answer.problem = fmt::format("the server does not say how long the file is: '{}'", range);
    return;
  }
  answer.length = *total;
  const std::uint64_t wanted = std::min(last + 1, *total) - std::min(first, *total);
  if (*start != first || got != wanted)
    answer.problem = fmt::format("the server sent {} bytes from {} instead of {} bytes from {}", got, *start,
                                 wanted, first);
}

bool mayPass(const RangeAnswer& answer, const HttpReply& reply) {
  constexpr int kPassing[] = {429, 500, 502, 503, 504};
  if (answer.status != 0) return std::ranges::find(kPassing, answer.status) != std::end(kPassing);
  return !answer.problem.empty() && !reply.isLasting;
}

}  // namespace

RangeAnswer requestRange(HttpClient& client, const RetryRules& rules, std::uint64_t first,
                         std::uint64_t last) {
  double delay = rules.firstDelay;
  for (int attempt = 0;; ++attempt) {
    HttpReply reply = client.get(first, last);
    RangeAnswer answer;
    answer.problem = reply.problem;
    answer.status = reply.status;
    answer.bytes = std::move(reply.bytes);
    if (answer.problem.empty()) checkReply(answer, reply, first, last);
    if (!mayPass(answer, reply) || client.isCancelled()) return answer;
    if (attempt >= rules.retries) {
      if (rules.retries > 0) answer.problem += fmt::format(", {} times", rules.retries + 1);
      return answer;
    }
    const double seconds = reply.retryAfter > 0 ? reply.retryAfter : delay;
    if (!client.wait(std::min(seconds, kLongestWaitSeconds))) return answer;
    delay *= 2;
  }
}

}  // namespace arete
