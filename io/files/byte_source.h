// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// Bytes of known number that are read where they are wanted: a file of a server (io/files/network), a text
/// in memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// How many bytes there are. Thread-safe.
  virtual std::uint64_t size() const = 0;

  /// Fills `target` with the bytes from `offset` on: with all of them, or with an error. Thread-safe.
  ///
  /// @param offset Precondition: offset + target.size() <= size().
  /// Errors, naming the source: unreadable. O(bytes).
  virtual Status read(std::uint64_t offset, std::span<std::byte> target) const = 0;

 protected:
  ByteSource() = default;
};

/// Bytes in memory.
class MemoryBytes final : public ByteSource {
 public:
  explicit MemoryBytes(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  std::uint64_t size() const override { return bytes_.size(); }
  Status read(std::uint64_t offset, std::span<std::byte> target) const override {
    if (!target.empty()) std::memcpy(target.data(), bytes_.data() + offset, target.size());
    return {};
  }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace arete
