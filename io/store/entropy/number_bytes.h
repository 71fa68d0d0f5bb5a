// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace arete {

/// Writes numbers as LEB128: seven bits per byte, the lowest first; the eighth bit is set if more bytes
/// follow.
class NumberWriter {
 public:
  void number(std::uint64_t value) {
    for (; value >= 128; value >>= 7) bytes_.push_back(static_cast<std::byte>(value | 128));
    bytes_.push_back(static_cast<std::byte>(value));
  }
  template <class T>
  void plain(const T& value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads zeros beyond the end, and isDone() is false then.
class NumberReader {
 public:
  explicit NumberReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = plain<std::uint8_t>();
      value |= std::uint64_t{byte & 127u} << shift;
      if (byte < 128) return value;
    }
    isBad_ = true;
    return 0;
  }
  /// A number of at most `limit`; a larger one makes the source bad.
  std::uint32_t number(std::uint64_t limit) {
    const std::uint64_t value = number();
    if (value <= limit) return static_cast<std::uint32_t>(value);
    isBad_ = true;
    return 0;
  }
  template <class T>
  T plain() {
    T value{};
    if (bytes_.size() - at_ < sizeof value) {
      isBad_ = true;
      at_ = bytes_.size();
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  /// How many bytes are left.
  std::size_t left() const { return bytes_.size() - at_; }
  bool isBad() const { return isBad_; }
  bool isDone() const { return !isBad_ && at_ == bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool isBad_ = false;
};

}  // namespace arete
