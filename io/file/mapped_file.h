// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// A file mapped for reading; nothing of it is read before it is touched, and nothing is asked of the system
/// ahead. The mapping outlives the file's name: a file replaced by renaming (as OutputFile does) is not
/// disturbed. A file cut short in place while it is mapped ends the program with SIGBUS when the lost part is
/// touched, as with every mapping.
class MappedFile {
 public:
  /// Errors: notFound; unreadable, with the system's reason (a folder, a device, an empty file).
  static Result<std::shared_ptr<const MappedFile>> open(const std::string& path);

  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return {begin_, size_}; }

  /// Tells the system that the order of reading is no order: it then reads no neighbours ahead.
  void adviseRandomAccess() const;

 private:
  MappedFile(const std::byte* begin, std::size_t size) : begin_(begin), size_(size) {}
  const std::byte* begin_;
  std::size_t size_;
};

}  // namespace arete
