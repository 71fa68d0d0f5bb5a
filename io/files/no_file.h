// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <system_error>

#include "io/files/file_writer.h"

namespace arete {

/// @return True for stdout, a pipe, a terminal or another device: what is written there cannot be read back.
inline bool isNoFile(const std::filesystem::path& path) {
  if (path == kStandardOutput) return true;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

}  // namespace arete
