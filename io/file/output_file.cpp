// SPDX-License-Identifier: GPL-3.0-or-later
//
// The temporary name is ".<stem>.<process id>-<random>-<counter><extension>": hidden, in the same folder
// (rename is atomic only within a file system), unique within the process by the counter and across machines
// that share the folder by the random part.
#include "io/file/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

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

fs::path temporaryBeside(const fs::path& target) {
  static const unsigned processTag = std::random_device{}();
  static std::atomic<unsigned> counter = 0;
  // Common file systems limit names to 255 bytes. The stem only makes the name readable.
  constexpr std::size_t kLongestStem = 100;
  const std::string stem = target.stem().string(), extension = target.extension().string();
  return target.parent_path() / fmt::format(".{}.{}-{:08x}-{}{}",
                                            stem.substr(0, std::min(stem.size(), kLongestStem)), ::getpid(),
                                            processTag, counter++, extension);
}

std::string systemMessage(int error) {
  return std::generic_category().message(error);
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
  file.target_ = fs::weakly_canonical(fs::absolute(path, error), error);
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
  file.temporary_ = temporaryBeside(file.target_);
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
  }
  temporary_.clear();
}

Status OutputFile::commit() {
  if (temporary_.empty()) return failure(ErrorCode::unreadable, "was already written", path_.string());
  if (inPlace_) {
    temporary_.clear();
    return {};
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
