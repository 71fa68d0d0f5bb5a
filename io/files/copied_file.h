// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "engine/base/result.h"
#include "io/files/file_image.h"

namespace arete {

/// A file whose parts are read into memory of our own when they are asked for. A library does so in a program
/// that is not ours: if a file is truncated in place, an access to a mapping of it ends that program with
/// SIGBUS. Here it is an error, and so is a rewrite in place before the last part was read: each time, size
/// and time of the file are compared with those at open(). What was read stays as it was. A file that is
/// replaced by renaming stays readable.
class CopiedFile final : public FileImage {
 public:
  /// Reads nothing yet. Errors: as MappedFile::open(); outOfMemory: its size cannot be reserved.
  static Result<std::shared_ptr<const CopiedFile>> open(const std::string& path);
  ~CopiedFile() override;

  bool load(std::span<const std::byte> part) const override;
  /// unreadable: the file was changed or cut short while it was open, or the system's reason.
  std::optional<Error> problem() const override;

 private:
  CopiedFile(std::string path, int descriptor, const struct ::stat& status, std::byte* begin);
  Status read(std::size_t begin, std::size_t end) const;
  Status checkUnchanged() const;

  std::string path_;
  int descriptor_;
  struct ::stat status_;
  std::byte* begin_;
  mutable std::mutex mutex_;
  mutable std::vector<std::atomic<bool>> isLoaded_;  // by block
  mutable std::optional<Error> problem_;
};

}  // namespace arete
