// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace arete {

// A program that answers questions about files and ends must not answer from a file that another program
// changed meanwhile. It begins to watch; the readers then name the files that they read piece by piece
// (mapped files, those of GDAL), and a writer checks them before a file gets its name. Without
// watchInputFiles(), as in a library, there is no list.

/// Begins to watch, for the rest of the process.
void watchInputFiles() noexcept;

/// Notes size, time and inode of a regular file that is read from now on, until the process ends. Does
/// nothing before watchInputFiles(), for other paths, and beyond 128 files. Thread-safe.
void watchInputFile(const std::string& path) noexcept;

/// Forgets a file that this process is about to replace itself. Thread-safe.
void forgetInputFile(const std::string& path) noexcept;

/// Finds a watched file that has been changed, replaced or removed. A signal handler may call it.
///
/// @return The path as it was named; null where there is none.
const char* changedInputFile() noexcept;

}  // namespace arete
