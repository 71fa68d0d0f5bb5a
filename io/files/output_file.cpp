// SPDX-License-Identifier: GPL-3.0-or-later
//
// The temporary file is in the folder of the target: rename is atomic only within a file system.
#include "io/files/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "io/files/temporary_files.h"
#include "io/files/watched_files.h"

namespace arete {

namespace fs = std::filesystem;

namespace {

/// Files that GDAL and SQLite may leave beside a file. The first is renamed with it, the others are removed.
constexpr const char* kFollowing = ".aux.xml";
constexpr std::array kRemoved = {"-journal", "-wal", "-shm"};

fs::path withSuffix(const fs::path& path, const char* suffix) {
  fs::path result = path;
  result += suffix;
  return result;
}

std::string systemMessage(int error) {
  return std::generic_category().message(error);
}

/// What a chain of symbolic links leads to, whether that exists or not.
fs::path followed(fs::path path) {
  constexpr int kMostLinks = 40;  // as the system has it
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path to = fs::read_symlink(path, error);
    if (error) break;
    path = to.is_absolute() ? to : path.parent_path() / to;
  }
  return path;
}

/// The group of this thread that files are committed to.
thread_local OutputGroup* innermost = nullptr;

/// A second name for the content of a file that is about to be replaced.
class Older {
 public:
  Older() = default;
  Older(const Older&) = delete;
  Older& operator=(const Older&) = delete;
  ~Older() {
    std::error_code ignored;
    if (!second_.empty()) fs::remove(second_, ignored);
    noteRemoved(second_);
  }

  void keep(const fs::path& target) {
    target_ = target;
    std::error_code error;
    wasThere_ = fs::exists(fs::symlink_status(target, error));
    if (!wasThere_) return;
    const fs::path second = temporaryBeside(target);
    noteTemporary(second);
    fs::create_hard_link(target, second, error);
    if (error)
      noteRemoved(second);
    else
      second_ = second;
  }

  /// Gives the file back its older content, or removes it where there was none.
  void restore() {
    std::error_code ignored;
    if (!wasThere_)
      fs::remove(target_, ignored);
    else if (!second_.empty())
      fs::rename(second_, target_, ignored);
  }

 private:
  fs::path target_, second_;
  bool wasThere_ = false;
};

}  // namespace

Result<OutputFile> OutputFile::create(const fs::path& path) {
  OutputFile file;
  file.path_ = path;
  std::error_code error;
  if (path.filename().empty())
    return failure(ErrorCode::unreadable, "an output file needs a name, this is a folder", path.string());
  // Of the path itself: the target of /dev/stdout may have no name, if it is a pipe.
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    return failure(ErrorCode::unreadable, "is a folder, not a file", path.string());
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file.inPlace_ = true;
    file.target_ = file.temporary_ = path;
    return file;
  }
  file.target_ = fs::weakly_canonical(fs::absolute(followed(path), error), error);
  if (error)
    return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", error.message()),
                   path.string());
  const fs::path folder = file.target_.parent_path();
  if (!fs::is_directory(folder, error))
    return failure(ErrorCode::notFound, fmt::format("the folder {} does not exist", folder.string()),
                   path.string());
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return failure(
        ErrorCode::unreadable,
        fmt::format("the folder {} cannot be written to: {}", folder.string(), systemMessage(errno)),
        path.string());
  removeAbandonedFiles(folder);
  file.temporary_ = temporaryBeside(file.target_);
  noteTemporary(file.temporary_);
  return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      stale_(std::move(other.stale_)),
      inPlace_(other.inPlace_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  if (this != &other) {
    discard();
    path_ = std::move(other.path_);
    target_ = std::move(other.target_);
    temporary_ = std::exchange(other.temporary_, {});
    stale_ = std::move(other.stale_);
    inPlace_ = other.inPlace_;
  }
  return *this;
}

OutputFile::~OutputFile() {
  discard();
}

void OutputFile::discard() noexcept {
  if (!temporary_.empty() && !inPlace_) {
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    try {
      fs::remove(withSuffix(temporary_, kFollowing), ignored);
      for (const char* suffix : kRemoved) fs::remove(withSuffix(temporary_, suffix), ignored);
    } catch (...) {
      // Without memory for their names the side files stay; only GDAL's formats have any.
    }
    noteRemoved(temporary_);
  }
  temporary_.clear();
}

Status OutputFile::commit() {
  if (temporary_.empty()) return failure(ErrorCode::unreadable, "was already written", path_.string());
  if (inPlace_) {
    temporary_.clear();
    return {};
  }
  if (innermost) {
    innermost->add(std::move(*this));
    return {};
  }
  return rename();
}

Status OutputFile::rename() {
  forgetInputFile(target_.string());
  if (const char* const changed = changedInputFile()) {
    discard();
    return failure(ErrorCode::unreadable, "was changed while it was read", changed);
  }
  // Whatever needs memory comes before the file appears under its name.
  const fs::path following = withSuffix(temporary_, kFollowing), stale = withSuffix(target_, kFollowing);
  std::vector<fs::path> sides;
  for (const std::string& suffix : stale_) sides.push_back(withSuffix(target_, suffix.c_str()));
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) {
    discard();
    return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", error.message()),
                   path_.string());
  }
  // A side file of the replaced file does not describe the new one.
  std::error_code ignored;
  if (fs::exists(following, ignored))
    fs::rename(following, stale, ignored);
  else
    fs::remove(stale, ignored);
  for (const fs::path& side : sides) fs::remove(side, ignored);
  discard();
  noteWrittenFile(path_.string());
  return {};
}

OutputGroup::OutputGroup() noexcept : outer_(std::exchange(innermost, this)) {}

OutputGroup::~OutputGroup() {
  innermost = outer_;
}

void OutputGroup::add(OutputFile file) {
  std::erase_if(files_, [&](const OutputFile& older) { return older.target_ == file.target_; });
  files_.push_back(std::move(file));
}

fs::path OutputGroup::placeOf(const fs::path& path) {
  for (const OutputGroup* group = innermost; group; group = group->outer_)
    for (const OutputFile& file : group->files_)
      if (file.path_ == path) return file.temporary_;
  return path;
}

Status OutputGroup::commit() {
  std::vector<OutputFile> files = std::exchange(files_, {});
  if (outer_) {
    for (OutputFile& file : files) outer_->add(std::move(file));
    return {};
  }
  // The last one needs no second name for its older content: nothing can fail after it.
  std::vector<Older> older(files.empty() ? 0 : files.size() - 1);
  for (std::size_t i = 0; i < older.size(); ++i) older[i].keep(files[i].target_);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Status renamed = files[i].rename();
    if (renamed) continue;
    for (std::size_t before = 0; before < i; ++before) older[before].restore();
    return renamed;
  }
  return {};
}

}  // namespace arete
