// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// The bytes of a file as one range of memory. Where they are read piece by piece, those of a piece that was
/// not loaded are zeros.
class FileImage {
 public:
  virtual ~FileImage() = default;
  FileImage(const FileImage&) = delete;
  FileImage& operator=(const FileImage&) = delete;

  /// Some of the bytes.
  using Part = std::span<const std::byte>;

  std::span<const std::byte> bytes() const { return bytes_; }

  /// Reads a part of bytes() if it was not read before. Thread-safe. O(part).
  /// @return false if it cannot be read; problem() says why
  virtual bool load(Part /*part*/) const { return true; }
  /// Reads several parts, with as few and as concurrent requests as where the bytes come from allows.
  /// Thread-safe. O(parts).
  /// @param context  reports progress where the bytes come from afar, and ends it; the parts cannot be read
  /// then
  /// @return false if one of them cannot be read; problem() says why
  virtual bool loadParts(std::span<const Part> parts, [[maybe_unused]] const RunContext& context = {}) const {
    return std::ranges::all_of(parts, [this](Part part) { return load(part); });
  }
  /// Why the first part could not be read that could not. Thread-safe.
  virtual std::optional<Error> problem() const { return std::nullopt; }

  /// Gives back the memory of a part, in whole blocks that lie in it; load() reads them anew. A mapped file
  /// gives back what lies within 64 KiB of it too, and reads it again by itself. Precondition: what lies in
  /// the part is not used by any thread. O(part).
  virtual void forget(Part /*part*/) const {}

  /// Whether what is loaded comes from a server.
  virtual bool isFar() const { return false; }

  /// Advises the system of random access, so that it does not read ahead.
  virtual void adviseRandomAccess() const {}

 protected:
  FileImage() = default;
  std::span<const std::byte> bytes_;
};

}  // namespace arete
