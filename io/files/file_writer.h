// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>

#include "engine/base/result.h"
#include "io/files/output_file.h"

namespace arete {

/// The name by which a FileWriter writes to stdout as it is: what it was redirected to is neither cut nor
/// replaced.
inline constexpr std::string_view kStandardOutput = "/dev/stdout";

/// A buffered byte stream into an OutputFile or stdout. The first error is kept and later writes do nothing;
/// finish() returns it.
class FileWriter {
 public:
  /// Errors: those of OutputFile::create(). unreadable: the file cannot be opened.
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

  /// Appends `count` bytes for the caller to fill in, for writers of many small records.
  ///
  /// @param count At most kCapacity.
  /// @return Valid until the next call.
  char* reserve(std::size_t count) {
    if (count > kCapacity - used_) flush();
    char* begin = buffer_.get() + used_;
    used_ += count;
    return begin;
  }

  /// Writes the buffer, closes the file, reads it back and renames it to its final name. Call once.
  ///
  /// Errors: unreadable: with the system's reason (disk full, ...), or the file cannot be read back; no file
  /// is left then, and an older one of the name stays.
  Status finish();

  static constexpr std::size_t kCapacity = std::size_t{1} << 20;

 private:
  struct Hash;
  FileWriter(std::filesystem::path path, std::optional<OutputFile> file, int descriptor);
  void writeThrough(std::string_view bytes);
  void flush();
  void toDisk(const char* bytes, std::size_t count);
  Status readBack() const;

  std::filesystem::path path_;
  std::optional<OutputFile> file_;  // nothing for stdout
  int descriptor_ = -1;
  int error_ = 0;               // errno of the first failure
  std::unique_ptr<Hash> hash_;  // of what was written to a file that gets its name at the end
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
};

/// Copies the bytes of a value to `to`, in the byte order of the machine.
///
/// @return The byte behind the copy.
template <class T>
char* putBytes(char* to, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::memcpy(to, &value, sizeof value);
  return to + sizeof value;
}

}  // namespace arete
