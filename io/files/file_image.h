// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "engine/base/result.h"

namespace arete {

/// The bytes of a file as one range of memory. Where they are read piece by piece, those of a piece that was
/// not loaded are zeros.
class FileImage {
 public:
  virtual ~FileImage() = default;
  FileImage(const FileImage&) = delete;
  FileImage& operator=(const FileImage&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }

  /// Reads a part of bytes() if it was not read before. Thread-safe. O(part).
  /// @return false if it cannot be read; problem() says why
  virtual bool load(std::span<const std::byte> /*part*/) const { return true; }
  /// Why the first part could not be read that could not. Thread-safe.
  virtual std::optional<Error> problem() const { return std::nullopt; }

  /// Advises the system of random access, so that it does not read ahead.
  virtual void adviseRandomAccess() const {}

 protected:
  FileImage() = default;
  std::span<const std::byte> bytes_;
};

}  // namespace arete
