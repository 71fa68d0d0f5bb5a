// SPDX-License-Identifier: GPL-3.0-or-later
//
// As in io/files/copied_file.h the memory is an anonymous mapping of the length of the file, in which blocks
// that were not fetched take nothing and are zeros; the flag of a block is set once it is whole.
#include "io/files/ranges/ranged_file.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/memory/required_memory.h"
#include "io/files/network/network_use.h"

namespace arete {
namespace {

constexpr std::uint64_t kBlockBytes = SpanCache::kBlock, kSpanBytes = SpanCache::kSpan;
/// The first request: the header, the metadata, the root of the directory of pages and the tables of a usual
/// model, and its first blocks.
constexpr std::uint64_t kFirstBytes = std::uint64_t{1} << 16;
static_assert(kFirstBytes % kBlockBytes == 0);
/// What one round of requests fetches, and may take in memory beside the file: 32 MiB, of 64 requests at
/// most.
constexpr std::uint64_t kRoundBytes = std::uint64_t{1} << 25;
constexpr std::size_t kRoundRequests = 64;
constexpr int kAbsent = 404, kRemoved = 410, kBeyond = 416;

/// An answer without a range is a whole file. One of exactly as many bytes as were asked for may as well be
/// the part, from a server that does not say so: such a server sends one byte where one is asked for.
bool isUnsaidPart(HttpClient& client, const RetryRules& rules, const RangeAnswer& answer) {
  if (answer.isRange || answer.bytes.size() != kFirstBytes) return false;
  const RangeAnswer again = requestRange(client, rules, 0, 0);
  return again.problem.empty() && !again.isRange && again.length != answer.length;
}

}  // namespace

RangedFile::RangedFile(Source source, const WebSettings& settings, const RangeAnswer& first, std::byte* begin)
    : source_(std::move(source)),
      settings_(settings),
      version_(first.version),
      begin_(begin),
      isLoaded_((first.length + kBlockBytes - 1) / kBlockBytes) {
  bytes_ = {begin, first.length};
  std::memcpy(begin, first.bytes.data(), first.bytes.size());
  mark({0, first.bytes.size()});
  // Without an ETag and a date another version of the same length could not be told from this one.
  if (settings_.cache && first.isRange && version_.find_first_not_of(' ') != version_.npos)
    key_ = CacheKey::of(source_.address, version_, first.length);
}

RangedFile::~RangedFile() {
  ::munmap(begin_, bytes_.size());
}

Result<std::shared_ptr<const RangedFile>> RangedFile::open(Source source, const WebSettings& settings,
                                                           const std::atomic<bool>* cancel) {
  source.client->cancelBy(cancel != nullptr ? cancel : settings.cancel);
  RangeAnswer first = requestRange(*source.client, source.rules, 0, kFirstBytes - 1);
  if (first.problem.empty() && isUnsaidPart(*source.client, source.rules, first))
    first.problem = "the server sends a part of the file and does not say how long the file is";
  const bool isCancelled = source.client->isCancelled();
  source.client->cancelBy(settings.cancel);
  if (first.status == kBeyond || (first.problem.empty() && first.length == 0))
    return failure(ErrorCode::unreadable, "is empty", source.name);
  if (!first.problem.empty() && isCancelled)
    return failure(ErrorCode::interrupted, "reading was stopped", source.name);
  if (first.status == kAbsent || first.status == kRemoved)
    return failure(ErrorCode::notFound,
                   fmt::format("is not on {}, which answers {}", source.host, first.status), source.name);
  if (!first.problem.empty())
    return failure(ErrorCode::unreadable,
                   fmt::format("cannot be read from {}: {}", source.host, first.problem), source.name);
  allowReserved(first.length);
  void* const begin = first.length > static_cast<std::uint64_t>(PTRDIFF_MAX)
                          ? MAP_FAILED
                          : ::mmap(nullptr, first.length, PROT_READ | PROT_WRITE,
                                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (begin == MAP_FAILED)
    return failure(ErrorCode::outOfMemory, fmt::format("its {} bytes do not fit into memory", first.length),
                   source.name);
  // Few blocks of many places are to take no more than themselves.
  static_cast<void>(::madvise(begin, first.length, MADV_NOHUGEPAGE));
  return std::shared_ptr<const RangedFile>(
      new RangedFile(std::move(source), settings, first, static_cast<std::byte*>(begin)));
}

void RangedFile::mark(const ByteRange& range) const {
  for (std::uint64_t b = range.begin / kBlockBytes; b * kBlockBytes < range.end; ++b)
    isLoaded_[b].store(true, std::memory_order_release);
}

bool RangedFile::fail(ErrorCode code, const std::string& sentence) const {
  problem_ = Error{code, sentence, source_.name};
  return false;
}

std::optional<Error> RangedFile::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

// The mark of a block that lies in the part wholly goes before its bytes become zeros.
void RangedFile::forget(Part part) const {
  const auto begin = static_cast<std::uint64_t>(part.data() - bytes_.data());
  const std::uint64_t first = (begin + kBlockBytes - 1) / kBlockBytes,
                      end = (begin + part.size()) / kBlockBytes;
  if (part.empty() || first >= end) return;
  const std::lock_guard lock(mutex_);
  for (std::uint64_t b = first; b < end; ++b) isLoaded_[b].store(false, std::memory_order_release);
  static_cast<void>(::madvise(begin_ + first * kBlockBytes, (end - first) * kBlockBytes, MADV_DONTNEED));
}

/// The blocks of parts that are not there.
std::vector<ByteRange> RangedFile::missing(std::span<const Part> parts) const {
  std::vector<ByteRange> ranges;
  for (const Part part : parts) {
    if (part.empty()) continue;
    const auto begin = static_cast<std::uint64_t>(part.data() - bytes_.data());
    const std::uint64_t end = (begin + part.size() - 1) / kBlockBytes + 1;
    for (std::uint64_t block = begin / kBlockBytes; block < end; ++block) {
      if (isLoaded(block)) continue;
      std::uint64_t behind = block + 1;
      while (behind < end && !isLoaded(behind)) ++behind;
      ranges.push_back({block * kBlockBytes, std::min<std::uint64_t>(behind * kBlockBytes, bytes_.size())});
      block = behind;
    }
  }
  return joinedRanges(std::move(ranges));
}

/// @return what the cache does not have
std::vector<ByteRange> RangedFile::takeCached(const std::vector<ByteRange>& ranges) const {
  if (!key_) return ranges;
  std::vector<Part> parts;
  std::vector<std::byte> kept;
  std::uint64_t next = 0;
  for (const ByteRange& range : ranges) {
    parts.emplace_back(begin_ + range.begin, range.size());
    for (std::uint64_t s = std::max(next, range.begin / kSpanBytes); s * kSpanBytes < range.end; ++s) {
      next = s + 1;
      const std::uint64_t at = s * kSpanBytes;
      kept.resize(std::min<std::uint64_t>(kSpanBytes, bytes_.size() - at));
      const unsigned blocks = settings_.cache->read(*key_, s, kept);
      for (std::uint64_t i = 0; i * kBlockBytes < kept.size(); ++i) {
        const std::uint64_t block = at / kBlockBytes + i, from = i * kBlockBytes;
        if ((blocks >> i & 1) == 0 || isLoaded(block)) continue;
        const std::uint64_t count = std::min<std::uint64_t>(kBlockBytes, kept.size() - from);
        std::memcpy(begin_ + at + from, kept.data() + from, count);
        mark({at + from, at + from + count});
        noteCached(count);
      }
    }
  }
  return missing(parts);
}

bool RangedFile::loadParts(std::span<const Part> parts, const RunContext& context) const {
  if (missing(parts).empty()) return true;
  const std::lock_guard lock(mutex_);
  std::vector<ByteRange> ranges = missing(parts);
  if (ranges.empty()) return true;
  if (problem_) return false;
  ranges = takeCached(ranges);
  source_.client->cancelBy(context.cancel != nullptr ? context.cancel : settings_.cancel);
  const bool isThere = fetch(planRequests(ranges), context);
  source_.client->cancelBy(settings_.cancel);
  return isThere;
}

/// What an answer lacks; empty: its bytes are in their place.
std::string RangedFile::take(const RangeAnswer& answer, const ByteRange& range) const {
  if (answer.status == kBeyond) return "it was replaced while it was read";
  if (!answer.problem.empty()) return answer.problem;
  if (answer.length != bytes_.size())
    return fmt::format("it had {} bytes and has {} now: it was replaced while it was read", bytes_.size(),
                       answer.length);
  if (answer.version != version_) return "it was replaced while it was read";
  if (!answer.isRange) return "the server sent the whole file instead of a part of it";
  // What is there already may be in use on another thread.
  for (std::uint64_t at = range.begin; at < range.end; at += kBlockBytes)
    if (!isLoaded(at / kBlockBytes))
      std::memcpy(begin_ + at, answer.bytes.data() + (at - range.begin),
                  std::min<std::uint64_t>(kBlockBytes, range.end - at));
  mark(range);
  return {};
}

bool RangedFile::fetch(const std::vector<ByteRange>& requests, const RunContext& context) const {
  std::uint64_t all = 0, done = 0;
  for (const ByteRange& range : requests) all += range.size();
  const bool isLong = all > kRoundBytes;
  for (std::size_t i = 0; i < requests.size();) {
    std::vector<HttpRange> round;
    const std::size_t first = i;
    std::uint64_t size = 0;
    for (; i < requests.size() && round.size() < kRoundRequests; ++i) {
      if (!round.empty() && size + requests[i].size() > kRoundBytes) break;
      size += requests[i].size();
      round.push_back({requests[i].begin, requests[i].end - 1});
    }
    const std::vector<RangeAnswer> answers = requestRanges(*source_.client, source_.rules, round);
    if (source_.client->isCancelled()) return fail(ErrorCode::interrupted, "reading was stopped");
    std::string lack;
    for (std::size_t k = 0; k < answers.size(); ++k) {
      const std::string sentence = take(answers[k], requests[first + k]);
      if (lack.empty()) lack = sentence;
    }
    if (!lack.empty())
      return fail(ErrorCode::unreadable, fmt::format("cannot be read from {}: {}", source_.host, lack));
    for (std::size_t k = first; k < i; ++k) keep(requests[k]);
    done += size;
    if (isLong) context.report("fetch", static_cast<double>(done) / static_cast<double>(all));
  }
  return true;
}

void RangedFile::keep(const ByteRange& range) const {
  if (!key_) return;
  for (std::uint64_t s = range.begin / kSpanBytes; s * kSpanBytes < range.end; ++s) {
    const std::uint64_t at = s * kSpanBytes, end = std::min<std::uint64_t>(at + kSpanBytes, bytes_.size());
    unsigned blocks = 0;
    for (std::uint64_t b = std::max(range.begin, at); b < std::min(range.end, end); b += kBlockBytes)
      blocks |= 1u << ((b - at) / kBlockBytes);
    settings_.cache->write(*key_, s, {begin_ + at, end - at}, static_cast<SpanCache::Blocks>(blocks));
  }
}

}  // namespace arete
