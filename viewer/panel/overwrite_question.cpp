// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/panel/overwrite_question.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace arete {
namespace {

namespace fs = std::filesystem;

/// "frame_00012.png", as films name their frames.
bool isFrameName(const std::string& name) {
  constexpr std::string_view kBegin = "frame_", kEnd = ".png";
  if (name.size() <= kBegin.size() + kEnd.size() || !name.starts_with(kBegin) || !name.ends_with(kEnd))
    return false;
  return std::all_of(name.begin() + kBegin.size(), name.end() - kEnd.size(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

std::uint64_t framesIn(const fs::path& folder) {
  std::error_code failed;
  std::uint64_t frames = 0;
  for (fs::directory_iterator file(folder, failed), end; !failed && file != end; file.increment(failed))
    frames += isFrameName(file->path().filename().string()) ? 1 : 0;
  return frames;
}

}  // namespace

std::string lostBySaving(Saving saving, const fs::path& path) {
  std::error_code failed;
  if (saving == Saving::frames) {
    const std::uint64_t frames = framesIn(path);
    if (frames == 0) return {};
    return path.string() + " holds " + std::to_string(frames) + (frames == 1 ? " frame" : " frames");
  }
  // A link that leads to nothing yet is written through, and loses nothing.
  if (!fs::exists(path, failed) || fs::is_directory(path, failed)) return {};
  return path.string() + " exists";
}

fs::path freePath(const fs::path& path) {
  std::error_code failed;
  fs::path free = path;
  for (int number = 2; fs::exists(free, failed); ++number)
    free = path.parent_path() /
           (path.stem().string() + "-" + std::to_string(number) + path.extension().string());
  return free;
}

bool OverwriteQuestion::mayDo(Saving saving, const fs::path& path) {
  no();
  const std::string lost = lostBySaving(saving, path);
  if (lost.empty()) return true;
  wish_ = Wish{saving, path};
  sentence_ = lost + (saving == Saving::frames ? ". Overwrite them?" : ". Overwrite it?");
  return false;
}

std::optional<OverwriteQuestion::Wish> OverwriteQuestion::yes() {
  sentence_.clear();
  return std::exchange(wish_, std::nullopt);
}

void OverwriteQuestion::no() {
  sentence_.clear();
  wish_.reset();
}

}  // namespace arete
