// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/network/remote_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace arete {
namespace {

constexpr std::uint64_t kPiece = std::uint64_t(1) << 18;
constexpr std::uint64_t kMostPieces = 32;
constexpr std::size_t kPiecesKept = 128;
constexpr int kHttpNotFound = 404, kHttpGone = 410, kHttpForbidden = 403, kHttpBeyondEnd = 416;

}  // namespace

RemoteFile::RemoteFile(std::string address, std::shared_ptr<HttpClient> client, RetryRules rules)
    : address_(std::move(address)), client_(std::move(client)), rules_(rules) {
  RangeAnswer answer = requestRange(*client_, rules_, 0, kPiece - 1);
  if (answer.status == kHttpBeyondEnd) return;  // an empty file
  if (answer.problem.empty() && isPartWithoutRange(answer))
    answer.problem = "the server sends a part of the file and does not say how long the file is";
  if (!answer.problem.empty()) {
    const bool isGone = answer.status == kHttpNotFound || answer.status == kHttpGone;
    isAbsent_ = isGone || answer.status == kHttpForbidden;
    problem_ = Error{isGone ? ErrorCode::notFound : ErrorCode::unreadable, answer.problem, address_};
    return;
  }
  length_ = answer.length;
  version_ = answer.version;
  if (answer.isRange)
    keep(0, std::move(answer.bytes));
  else
    whole_ = std::move(answer.bytes);
}

/// An answer without a range is a whole file. One of exactly as many bytes as were asked for may as well be
/// the part, from a server that does not say so: such a server sends one byte where one is asked for.
bool RemoteFile::isPartWithoutRange(const RangeAnswer& answer) const {
  if (answer.isRange || answer.bytes.size() != kPiece) return false;
  const RangeAnswer again = requestRange(*client_, rules_, 0, 0);
  return again.problem.empty() && !again.isRange && again.length != answer.length;
}

Status RemoteFile::failed(std::string problem) const {
  if (problem.empty()) return {};
  return failure(ErrorCode::unreadable, std::move(problem), address_);
}

Status RemoteFile::read(std::uint64_t offset, std::span<std::byte> target) const {
  if (problem_) return tl::unexpected(*problem_);
  if (target.empty()) return {};
  if (whole_) {
    std::memcpy(target.data(), whole_->data() + offset, target.size());
    return {};
  }
  const std::lock_guard lock(mutex_);
  return failed(readPieces(offset, target));
}

Status RemoteFile::compare() const {
  if (problem_ || length_ == 0) return {};
  const RangeAnswer answer = requestRange(*client_, rules_, 0, 0);
  return failed(answer.problem.empty() ? difference(answer) : answer.problem);
}

std::string RemoteFile::difference(const RangeAnswer& answer) const {
  if (answer.length != length_)
    return fmt::format("it had {} bytes and has {} now: it was replaced while it was read", length_,
                       answer.length);
  return answer.version == version_ ? "" : "it was replaced while it was read";
}

std::string RemoteFile::readPieces(std::uint64_t offset, std::span<std::byte> target) const {
  while (!target.empty()) {
    const std::uint64_t number = offset / kPiece, from = offset % kPiece;
    // A reader that takes no notice of a failure goes on reading: the server is not asked again.
    if (broken_.empty() && !pieces_.contains(number))
      broken_ = fetch(number, (from + target.size() + kPiece - 1) / kPiece);
    if (!broken_.empty()) return broken_;
    const Bytes& piece = pieces_.at(number);
    const std::size_t part = std::min(target.size(), piece.size() - std::size_t(from));
    std::memcpy(target.data(), piece.data() + from, part);
    target = target.subspan(part);
    offset += part;
  }
  return {};
}

void RemoteFile::keep(std::uint64_t number, Bytes bytes) const {
  pieces_[number] = std::move(bytes);
  order_.push_back(number);
  if (order_.size() <= kPiecesKept) return;
  pieces_.erase(order_.front());
  order_.pop_front();
}

std::string RemoteFile::fetch(std::uint64_t number, std::uint64_t needed) const {
  ahead_ = number == next_ ? std::min(2 * ahead_, kMostPieces) : 1;
  const std::uint64_t last = (length_ - 1) / kPiece;
  std::uint64_t end = number + std::clamp(needed, ahead_, kMostPieces);
  end = std::min(end, last + 1);
  for (std::uint64_t piece = number + 1; piece < end; ++piece)
    if (pieces_.contains(piece)) end = piece;
  const std::uint64_t first = number * kPiece, stop = std::min(end * kPiece, length_);
  const RangeAnswer answer = requestRange(*client_, rules_, first, stop - 1);
  if (!answer.problem.empty()) return answer.problem;
  if (std::string changed = difference(answer); !changed.empty()) return changed;
  if (!answer.isRange) return "the server sent the whole file instead of a part of it";
  for (std::uint64_t piece = number; piece < end; ++piece) {
    const std::uint64_t begin = piece * kPiece - first;
    keep(piece, Bytes(answer.bytes.begin() + std::ptrdiff_t(begin),
                      answer.bytes.begin() + std::ptrdiff_t(std::min(begin + kPiece, stop - first))));
  }
  next_ = end;
  return {};
}

}  // namespace arete
