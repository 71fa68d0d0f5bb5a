// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/level_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "cli/arguments/arguments.h"
#include "io/files/text_scan.h"
#include "io/files/written_files.h"

namespace arete {

Result<LevelFiles> LevelFiles::create() {
  std::error_code error;
  std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) parent = "/tmp";
  std::string name = (parent / "arete-levels-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    return failure(
        ErrorCode::unreadable,
        fmt::format("a temporary folder cannot be made: {}", std::generic_category().message(errno)), name);
  LevelFiles files;
  files.folder_ = name;
  return files;
}

LevelFiles::LevelFiles(LevelFiles&& other) noexcept
    : folder_(std::exchange(other.folder_, {})), levels_(std::move(other.levels_)) {}

LevelFiles& LevelFiles::operator=(LevelFiles&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(levels_, other.levels_);
  return *this;
}

LevelFiles::~LevelFiles() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

ExtractRequest LevelFiles::redirected(const ExtractRequest& request) {
  levels_.push_back({.file = folder_ / fmt::format("{}.glb", levels_.size())});
  ExtractRequest level = request;
  level.output = levels_.back().file.string();
  level.format.clear();
  return level;
}

void LevelFiles::describe(double error, std::uint64_t triangles, double unit) {
  noteRestored(levels_.back().file);  // no file of the user's
  levels_.back().error = error;
  levels_.back().triangles = triangles;
  levels_.back().unit = unit;
}

Status LevelFiles::join(const ExtractRequest& like, Session& session) const {
  const bool isText =
      like.format.empty() ? text::lowerExtension(like.output) == "gltf" : like.format == "gltf";
  if (Status joined = joinGltfLevels(levels_, like.output, isText, session.context()); !joined) {
    if (joined.error().culprit.empty()) joined.error().culprit = like.output;
    return joined;
  }
  session.say(fmt::format("{}: {}, the finest is shown where MSFT_lod is not known\n", like.output,
                          grouped(levels_.size(), "level of detail", "levels of detail")));
  return {};
}

}  // namespace arete
