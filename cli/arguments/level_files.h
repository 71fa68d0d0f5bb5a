// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/formats/glb/levels/join_levels.h"
#include "io/query/request/extract_request.h"

namespace arete {

/// The files of the levels of detail of one glTF, in a folder for temporary files, which is removed at the
/// end.
class LevelFiles {
 public:
  /// Errors: unreadable: the folder cannot be made.
  static Result<LevelFiles> create();
  LevelFiles(LevelFiles&& other) noexcept;
  LevelFiles& operator=(LevelFiles&& other) noexcept;
  LevelFiles(const LevelFiles&) = delete;
  LevelFiles& operator=(const LevelFiles&) = delete;
  ~LevelFiles();

  /// A request that writes the next level instead of its output.
  ExtractRequest redirected(const ExtractRequest& request);
  /// What is known of the level that was written. @param unit of the error, in the file's.
  void describe(double error, std::uint64_t triangles, double unit = 1);
  /// Writes the levels as one file, and says so. Errors: as joinGltfLevels().
  Status join(const ExtractRequest& like, Session& session) const;

 private:
  LevelFiles() = default;
  std::filesystem::path folder_;
  std::vector<GltfLevel> levels_;
};

}  // namespace arete
