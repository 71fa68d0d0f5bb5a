// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// A file mapped for reading. Pages are read on first access. The mapping stays valid if the file is replaced
/// by renaming (as OutputFile does). If the file is truncated in place, an access to the lost part ends the
/// program with SIGBUS, as with every mapping; arete says why (cli/session/faults.h).
class MappedFile {
 public:
  /// Errors: notFound. unreadable: with the system's reason; a folder, a device, an empty file.
  static Result<std::shared_ptr<const MappedFile>> open(const std::string& path);

  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return {begin_, size_}; }

  /// Advises the system of random access, so that it does not read ahead.
  void adviseRandomAccess() const;

 private:
  MappedFile(const std::byte* begin, std::size_t size) : begin_(begin), size_(size) {}
  const std::byte* begin_;
  std::size_t size_;
};

}  // namespace arete
