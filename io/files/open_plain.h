// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "engine/base/result.h"

namespace arete {

/// Closed with this.
struct FileDescriptor {
  int value = -1;
  explicit FileDescriptor(int opened) : value(opened) {}
  FileDescriptor(FileDescriptor&& other) noexcept : value(std::exchange(other.value, -1)) {}
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  ~FileDescriptor() {
    if (value >= 0) ::close(value);
  }
};

/// A regular file that is open for reading, with what the system says of it.
struct PlainFile {
  FileDescriptor descriptor;
  struct ::stat status {};
};

/// Errors: notFound. unreadable: with the system's reason; a folder, a device, an empty file.
Result<PlainFile> openPlain(const std::string& path);

}  // namespace arete
