// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// The bytes of a whole file, read into memory. Not mapped: if another program truncates the file meanwhile,
/// this is an error, not a signal.
class FileBytes {
 public:
  /// Errors: notFound. unreadable: with the system's reason; a folder or a device; a file that is
  /// changed while it is read.
  static Result<FileBytes> read(const std::filesystem::path& path);

  /// The same for a text: UTF-16 becomes UTF-8, and carriage returns without line feeds become line feeds
  /// (io/files/text_decoder.h). Errors: also outOfMemory.
  static Result<FileBytes> readText(const std::filesystem::path& path);
  /// Decodes bytes that turn out to be a text.
  ///
  /// Errors: outOfMemory.
  Status decodeText(const std::filesystem::path& path);

  const char* begin() const { return bytes_.get(); }
  const char* end() const { return bytes_.get() + size_; }
  std::size_t size() const { return size_; }
  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace arete
