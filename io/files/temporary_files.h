// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace arete {

// Temporary files of OutputFile, beside the file that they become. A run that is killed cannot remove its
// own: their names tell the machine and the process, and the next run that writes into the folder removes
// them.

/// A name that no other process uses: hidden, in the folder of the target, with its extension, and with the
/// id of this process.
std::filesystem::path temporaryBeside(const std::filesystem::path& target);

/// Removes what processes of this machine that no longer run have left in a folder. Once per folder.
void removeAbandonedFiles(const std::filesystem::path& folder) noexcept;

/// Notes that a temporary file may exist, until noteRemoved().
void noteTemporary(const std::filesystem::path& path) noexcept;
void noteRemoved(const std::filesystem::path& path) noexcept;

/// Removes all that are noted. For a signal handler that ends the process.
void removeNotedFiles() noexcept;

}  // namespace arete
