// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace arete {

// A program that answers a question and ends says in the end which files it wrote, and which of them replaced
// older ones. It begins a list; OutputFile adds to it when a file gets its name. Without listWrittenFiles(),
// as in a library that runs for days, nothing is listed.

/// A file that has got its name.
struct WrittenFile {
  std::string path;                           ///< as it was named
  std::uint64_t bytes = 0;                    ///< its size when it got its name
  std::optional<std::uint64_t> olderBytes{};  ///< size of the file that had the name before; none: a new file
  bool isAddedTo = false;                     ///< it holds what the older file held, too
};

/// Begins the list, for the rest of the process. Thread-safe.
void listWrittenFiles();

/// The list, in the order in which the files got their names; of a file written twice the first entry, with
/// the last size. Thread-safe.
std::vector<WrittenFile> writtenFiles();

/// Adds a file. Does nothing before listWrittenFiles(). Thread-safe.
void noteWritten(WrittenFile file);

/// Takes a file off the list: it has got its older content back, or was for the program itself. Thread-safe.
void noteRestored(const std::filesystem::path& path);

}  // namespace arete
