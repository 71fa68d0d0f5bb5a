// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/files/file_image.h"
#include "io/files/network/checked_request.h"
#include "io/files/ranges/range_plan.h"
#include "io/files/ranges/span_cache.h"
#include "io/files/ranges/web_settings.h"

namespace arete {

/// A file of a server as one range of memory. Address space of its length is reserved; its first 64 KiB are
/// fetched when it is opened, and other parts when they are loaded, in blocks of 16 KiB: never the whole
/// where a part is asked for, unless the server gives no parts of files. The parts of one call are fetched
/// together: near ones by one request (planRequests()), several requests at once. Every answer is held
/// against the first one's length, ETag and date.
class RangedFile final : public FileImage {
 public:
  /// What the file is called, and how it is asked for.
  struct Source {
    std::string name;     ///< names the file in errors
    std::string host;     ///< names the server in sentences
    std::string address;  ///< for the cache
    std::shared_ptr<HttpClient> client;
    RetryRules rules = {};
  };

  /// Sends the first request. Errors, naming the file: notFound: the server answers 404 or 410. unreadable:
  /// any other answer than bytes that were asked for, or an empty file. outOfMemory: its length cannot be
  /// reserved.
  ///
  /// @param cancel Ends the opening, in place of the settings' one. May be null.
  static Result<std::shared_ptr<const RangedFile>> open(Source source, const WebSettings& settings,
                                                        const std::atomic<bool>* cancel = nullptr);
  ~RangedFile() override;

  bool load(Part part) const override { return loadParts({&part, 1}); }
  /// Reports "fetch" as its progress where it takes more than a few requests.
  bool loadParts(std::span<const Part> parts, const RunContext& context = {}) const override;
  void forget(Part part) const override;
  bool isFar() const override { return true; }
  /// unreadable: a request failed, or the file was replaced. interrupted. Nothing is asked for after that.
  std::optional<Error> problem() const override;

 private:
  RangedFile(Source source, const WebSettings& settings, const RangeAnswer& first, std::byte* begin);
  std::vector<ByteRange> missing(std::span<const Part> parts) const;
  std::vector<ByteRange> takeCached(const std::vector<ByteRange>& ranges) const;
  bool fetch(const std::vector<ByteRange>& requests, const RunContext& context) const;
  std::string take(const RangeAnswer& answer, const ByteRange& range) const;
  void keep(const ByteRange& range) const;
  void mark(const ByteRange& range) const;
  bool fail(ErrorCode code, const std::string& sentence) const;
  bool isLoaded(std::uint64_t block) const { return isLoaded_[block].load(std::memory_order_acquire); }

  Source source_;
  WebSettings settings_;
  std::string version_;
  std::optional<CacheKey> key_;  ///< none: nothing is kept on disk
  std::byte* begin_;
  mutable std::mutex mutex_;                         ///< held while something is fetched
  mutable std::vector<std::atomic<bool>> isLoaded_;  ///< by block
  mutable std::optional<Error> problem_;
};

}  // namespace arete
