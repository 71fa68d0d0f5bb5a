// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/files/byte_source.h"
#include "io/files/network/checked_request.h"

namespace arete {

/// A file of a server. It never gives fewer bytes than were asked for, or bytes of another version of the
/// file, without an error: each answer is held against the length, the ETag and the date of the first one.
///
/// It is known after its first request, for its first piece. Pieces of 256 KiB are kept, the newest 128;
/// where a read follows the one before, more pieces are requested at once, up to 32. A server that knows no
/// ranges sends the file as a whole.
class RemoteFile final : public ByteSource {
 public:
  /// Requests the first piece. problem() says whether the file can be read.
  ///
  /// @param address names the file in errors
  RemoteFile(std::string address, std::shared_ptr<HttpClient> client, RetryRules rules);

  /// Why the file cannot be read, with its address. Errors: notFound: the server answers 404 or 410.
  /// unreadable.
  const std::optional<Error>& problem() const { return problem_; }
  /// Whether the server lacks the file, as far as it says (403 included: stores of clouds say no more). It
  /// may be one of the many that a driver looks for beside its own.
  bool isAbsent() const { return isAbsent_; }

  std::uint64_t size() const override { return length_; }
  /// Errors: unreadable: a request failed, or the file was replaced. After an error no server is asked again.
  Status read(std::uint64_t offset, std::span<std::byte> target) const override;

  /// Asks the server once more whether the file is the one that was opened.
  ///
  /// Errors: unreadable.
  Status compare() const;

 private:
  using Bytes = std::vector<std::byte>;

  Status failed(std::string problem) const;
  std::string difference(const RangeAnswer& answer) const;
  std::string readPieces(std::uint64_t offset, std::span<std::byte> target) const;
  std::string fetch(std::uint64_t number, std::uint64_t needed) const;
  void keep(std::uint64_t number, Bytes bytes) const;
  bool isPartWithoutRange(const RangeAnswer& answer) const;

  std::string address_;
  std::shared_ptr<HttpClient> client_;
  RetryRules rules_;
  std::optional<Error> problem_;
  bool isAbsent_ = false;
  std::uint64_t length_ = 0;
  std::string version_;
  std::optional<Bytes> whole_;
  mutable std::mutex mutex_;  // guards what follows
  mutable std::string broken_;
  mutable std::map<std::uint64_t, Bytes> pieces_;
  mutable std::deque<std::uint64_t> order_;
  mutable std::uint64_t next_ = 1, ahead_ = 1;
};

}  // namespace arete
