// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace arete {

/// What a server answers to one request, as it came: nothing in it is checked.
struct HttpReply {
  std::string problem;     ///< why there are no bytes; empty: there are
  int status = 0;          ///< of HTTP, where it is an error: 404
  bool isLasting = false;  ///< the same request would fail again: no such host, nothing listens there
  double retryAfter = 0;   ///< seconds after which the server wants the next request; 0: not stated
  std::vector<std::byte> bytes;
  /// Headers; empty where the server sent none. All are texts of the server.
  std::string tag, date, range, length, encoding;
};

/// The bytes `first` to `last` of a file.
struct HttpRange {
  std::uint64_t first = 0, last = 0;
};

/// Sends the requests: through which library, with which certificates and proxies, is its own matter.
class HttpClient {
 public:
  virtual ~HttpClient() = default;

  /// Requests the bytes `first` to `last` of the file, uncompressed. Follows redirections. Ends soon after
  /// isCancelled() became true. Thread-safe.
  virtual HttpReply get(std::uint64_t first, std::uint64_t last) = 0;

  /// Requests several ranges, some of them at once where the client can. The replies are in the order of the
  /// ranges. Thread-safe.
  virtual std::vector<HttpReply> getAll(std::span<const HttpRange> ranges) {
    std::vector<HttpReply> replies;
    for (const HttpRange& range : ranges) replies.push_back(get(range.first, range.last));
    return replies;
  }

  /// What ends the requests that follow, beside what the client knows itself. Null: nothing more.
  virtual void cancelBy(const std::atomic<bool>* /*cancel*/) {}

  /// Waits before a request is repeated.
  /// @return False where the wait was cut off.
  virtual bool wait(double seconds) = 0;

  virtual bool isCancelled() const = 0;
};

/// How often a request is repeated that failed for what may pass.
struct RetryRules {
  int retries = 4;
  double firstDelay = 0.25;  ///< seconds, where the server states none; twice as many each time
};

}  // namespace arete
