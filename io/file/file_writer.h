// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <type_traits>

#include "engine/base/result.h"
#include "io/file/output_file.h"

namespace arete {

/// A buffered byte stream into an OutputFile. The first error sticks: write on and ask finish() once.
class FileWriter {
 public:
  /// Errors: those of OutputFile::create, and unreadable when the file cannot be opened.
  static Result<FileWriter> create(const std::filesystem::path& path);

  FileWriter(FileWriter&& other) noexcept;
  FileWriter& operator=(FileWriter&&) = delete;
  ~FileWriter();

  void write(std::string_view bytes) {
    if (bytes.empty()) return;
    if (bytes.size() <= kCapacity - used_) {
      std::memcpy(buffer_.get() + used_, bytes.data(), bytes.size());
      used_ += bytes.size();
    } else {
      writeThrough(bytes);
    }
  }

  /// `count` bytes (at most kCapacity) to fill in place, for writers of many small records.
  char* reserve(std::size_t count) {
    if (count > kCapacity - used_) flush();
    char* place = buffer_.get() + used_;
    used_ += count;
    return place;
  }

  /// Writes what is buffered, closes and gives the file its name.
  /// Errors: unreadable, with the system's reason (disk full, ...); nothing is left behind then.
  Status finish();

  static constexpr std::size_t kCapacity = std::size_t{1} << 20;

 private:
  FileWriter(OutputFile file, int descriptor);
  void writeThrough(std::string_view bytes);
  void flush();
  void toDisk(const char* bytes, std::size_t count);

  OutputFile file_;
  int descriptor_ = -1;
  int error_ = 0;  // errno of the first failure
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
};

/// Copies a trivially copyable value to `to` as it lies in memory and returns the place behind it.
template <class T>
char* putBytes(char* to, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::memcpy(to, &value, sizeof value);
  return to + sizeof value;
}

}  // namespace arete
