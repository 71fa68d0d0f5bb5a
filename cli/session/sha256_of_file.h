// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// A file as it was when its checksum was computed.
struct FileDigest {
  std::uint64_t bytes = 0;
  std::string sha256;     ///< 64 hexadecimal digits
  bool isStable = false;  ///< size and time of the file were the same before and after
};

/// The SHA-256 of a regular file, which sha256sum gives too, an empty one too. O(size of the file); memory: a
/// block.
///
/// Errors: notFound. unreadable: with the system's reason; a folder, a pipe. interrupted: `cancel` became
/// true.
Result<FileDigest> sha256OfFile(const std::string& path, const std::atomic<bool>* cancel = nullptr);

}  // namespace arete
