// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "engine/base/result.h"

namespace arete {

/// Finds the files that a mesh names: pictures, libraries of materials. Only files in the mesh's folder and
/// below are found; links that lead out of it and addresses are refused. '\\' counts as '/'; where no file
/// has a name, one that differs in case alone will do. An absolute path, or one that leads out of the folder,
/// was right on the machine it was written on: here it stands for the file of its name in the folder itself.
class FilesBeside {
 public:
  /// @param folder MeshFile::folder; empty: no files are found.
  explicit FilesBeside(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }

  /// @return The path below the folder, with '/', as it is there. The file may be of any kind; FileBytes
  /// reads regular ones only.
  ///
  /// Errors, with the name as culprit: notFound; unsupported: a name that is refused.
  Result<std::string> find(const std::string& name) const;

 private:
  std::string entryOf(const std::filesystem::path& folder, const std::string& name) const;

  std::filesystem::path folder_;
  mutable std::map<std::filesystem::path, std::map<std::string, std::string>> listings_;  // by lowered name
};

/// The parts of a relative path that stays where it begins, without "." and "..", joined by '/'; of any other
/// path, its last part. Empty if it names no file.
std::string pathBelow(std::string_view path);

}  // namespace arete
