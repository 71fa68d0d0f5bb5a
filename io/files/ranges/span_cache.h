// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// One version of a file of a server.
struct CacheKey {
  std::uint64_t low = 0, high = 0;
  /// Of an address, with what its query may hide, and of what the server says of the version. Not reversible.
  static CacheKey of(const std::string& address, const std::string& version, std::uint64_t length);
  bool operator==(const CacheKey&) const = default;
};

/// Parts of files of servers, kept on disk within a budget. A file is divided into spans, and a span into
/// blocks; each span is a file in the folder, with the blocks that were fetched and a checksum of all its
/// bytes. What is damaged, cut short or of another key is not there. A span file appears whole or not at all,
/// so several processes may use one folder; of two that write one span the last one's blocks stay. Beyond the
/// budget the span files that were used longest ago are removed, by any process. Files of other names in the
/// folder are left alone. Thread-safe.
class SpanCache {
 public:
  static constexpr std::uint64_t kBlock = std::uint64_t{1} << 14, kSpan = std::uint64_t{1} << 18;
  static constexpr std::uint64_t kUsualBudget = 2'000'000'000;

  /// Makes the folder if it is not there. Errors, naming the folder: unreadable: it cannot be written to.
  static Result<std::shared_ptr<SpanCache>> open(const std::filesystem::path& folder, std::uint64_t budget);

  /// A bit for each block of a span.
  using Blocks = std::uint16_t;
  static_assert(kSpan / kBlock == 8 * sizeof(Blocks));

  /// Fills in the blocks that are kept.
  ///
  /// @param span The number of the span; `bytes` are all of its bytes, fewer than kSpan at the end of the
  /// file.
  /// @return the blocks that were filled in; the others' bytes are as they were
  Blocks read(const CacheKey& key, std::uint64_t span, std::span<std::byte> bytes);

  /// Keeps blocks of a span beside those that are kept. What cannot be written is not kept.
  void write(const CacheKey& key, std::uint64_t span, std::span<const std::byte> bytes, Blocks blocks);

 private:
  SpanCache(std::filesystem::path folder, std::uint64_t budget)
      : folder_(std::move(folder)), budget_(budget) {}
  std::filesystem::path fileOf(const CacheKey& key, std::uint64_t span) const;
  void keepBudget(std::uint64_t written);

  std::filesystem::path folder_;
  std::uint64_t budget_;
  std::mutex mutex_;
  std::uint64_t known_ = 0, sinceCount_ = ~std::uint64_t{0} / 2;  ///< bytes there when counted; written since
};

}  // namespace arete
