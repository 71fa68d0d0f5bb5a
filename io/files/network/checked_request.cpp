// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/network/checked_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "io/files/network/network_use.h"

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

RangeAnswer answerOf(HttpReply& reply, const HttpRange& range) {
  RangeAnswer answer;
  answer.problem = reply.problem;
  answer.status = reply.status;
  answer.bytes = std::move(reply.bytes);
  noteRequest(answer.bytes.size());
  if (answer.problem.empty()) checkReply(answer, reply, range.first, range.last);
  return answer;
}

}  // namespace

RangeAnswer requestRange(HttpClient& client, const RetryRules& rules, std::uint64_t first,
                         std::uint64_t last) {
  const HttpRange range{first, last};
  return std::move(requestRanges(client, rules, {&range, 1}).front());
}

// Those that failed for what may pass are asked for again together, after the longest wait that one of them
// is to have.
std::vector<RangeAnswer> requestRanges(HttpClient& client, const RetryRules& rules,
                                       std::span<const HttpRange> ranges) {
  std::vector<RangeAnswer> answers(ranges.size());
  std::vector<std::size_t> open(ranges.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  double delay = rules.firstDelay;
  for (int attempt = 0;; ++attempt) {
    std::vector<HttpRange> asked;
    for (const std::size_t i : open) asked.push_back(ranges[i]);
    std::vector<HttpReply> replies = client.getAll(asked);
    std::vector<std::size_t> again;
    double wait = 0;
    bool isGivenUp = client.isCancelled();
    for (std::size_t k = 0; k < open.size(); ++k) {
      RangeAnswer& answer = answers[open[k]];
      answer = answerOf(replies[k], asked[k]);
      if (answer.problem.empty()) continue;
      if (!mayPass(answer, replies[k])) {
        isGivenUp = true;
      } else if (attempt >= rules.retries) {
        isGivenUp = true;
        if (rules.retries > 0) answer.problem += fmt::format(", {} times", rules.retries + 1);
      } else {
        again.push_back(open[k]);
        wait = std::max(wait, replies[k].retryAfter > 0 ? replies[k].retryAfter : delay);
      }
    }
    if (isGivenUp || again.empty() || !client.wait(std::min(wait, kLongestWaitSeconds))) return answers;
    open = std::move(again);
    delay *= 2;
  }
}

}  // namespace arete
