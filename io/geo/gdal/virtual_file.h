// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "io/files/file_image.h"

namespace arete {

/// How many bytes a file has whose first bytes are these; 0: it is of another kind, and no more is read.
using SizeByHeader = std::function<std::uint64_t(std::span<const std::byte> header)>;

/// Reads a file of one of GDAL's virtual file systems (isVirtualPath()) into memory, from the beginning to
/// the end: an archive cannot be read elsewhere without being read up to there. At most one byte more than
/// `sizeOf` says is read, so that a small archive does not fill the memory.
///
/// @param headerBytes how many bytes `sizeOf` gets, or as many as the file has
/// Errors: notFound, unreadable: with GDAL's reason; outOfMemory. O(bytes).
Result<std::shared_ptr<const FileImage>> readVirtualFile(const std::string& path, std::size_t headerBytes,
                                                         const SizeByHeader& sizeOf);

}  // namespace arete
