// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// A file that appears under its name whole or not at all: it is written under a temporary name in the same
/// folder, and commit() renames it. Without a commit the destructor removes it, so an error, an exception or
/// Ctrl-C (which sets a flag, and functions return) leaves nothing behind and an older file of that name
/// untouched.
///
/// Who writes the temporary file does not matter: a FileWriter, GDAL, a memory map. The temporary name keeps
/// the extension, which GDAL drivers look at, and is unique across processes; the file itself is not created
/// here, because some drivers refuse to create what exists. Side files that GDAL leaves ("<name>.aux.xml")
/// follow along.
///
/// A target that exists and is no regular file (/dev/null, a pipe) is written in place. A symbolic link is
/// followed: what it points to is replaced, the link stays.
class OutputFile {
 public:
  /// Errors: notFound when the folder is not there, unreadable when it cannot be written to or `path` is a
  /// folder.
  static Result<OutputFile> create(const std::filesystem::path& path);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Where to write. Close it before commit().
  const std::filesystem::path& temporaryPath() const { return temporary_; }
  /// The name that was asked for.
  const std::filesystem::path& path() const { return path_; }

  /// Renames the temporary file to its final name. At most once.
  /// Errors: unreadable, naming the path, when nothing was written or the rename fails; the temporary file is
  /// then removed.
  Status commit();

 private:
  OutputFile() = default;
  void discard() noexcept;

  std::filesystem::path path_;
  std::filesystem::path target_;     // path_ with links resolved
  std::filesystem::path temporary_;  // empty once committed or moved from
  bool inPlace_ = false;
};

}  // namespace arete
