// SPDX-License-Identifier: GPL-3.0-or-later
//
// The temporary file is in the folder of the target: rename is atomic only within a file system.
#include "io/file/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "io/file/temporary_files.h"
#include "io/file/watched_files.h"

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
      inPlace_(other.inPlace_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  if (this != &other) {
    discard();
    path_ = std::move(other.path_);
    target_ = std::move(other.target_);
    temporary_ = std::exchange(other.temporary_, {});
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
  forgetInputFile(target_.string());
  if (const char* const changed = changedInputFile()) {
    discard();
    return failure(ErrorCode::unreadable, "was changed while it was read", changed);
  }
  // Whatever needs memory comes before the file appears under its name.
  const fs::path following = withSuffix(temporary_, kFollowing), stale = withSuffix(target_, kFollowing);
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
  discard();
  return {};
}

}  // namespace arete
