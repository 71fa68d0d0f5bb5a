// SPDX-License-Identifier: GPL-3.0-or-later
//
// A list of fixed size in static memory, so that a signal handler can walk it. An entry is filled in before
// its flag is set, and never moves.
#include "io/files/watched_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <mutex>

namespace arete {
namespace {

constexpr std::size_t kMostFiles = 128, kLongestWatchedPath = 1024;

struct Watched {
  std::atomic<bool> isSet = false;
  std::array<char, kLongestWatchedPath> path;
  struct stat status;
};

std::array<Watched, kMostFiles> files;
std::atomic<bool> isWatching = false;
std::mutex mutex;
std::vector<std::string> written;

bool isSameFile(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool isUnchanged(const struct stat& a, const struct stat& b) {
  return isSameFile(a, b) && a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

}  // namespace

void watchInputFiles() noexcept {
  isWatching = true;
}

void watchInputFile(const std::string& path) noexcept {
  struct stat now {};
  if (!isWatching || path.size() >= kLongestWatchedPath || ::stat(path.c_str(), &now) != 0 ||
      !S_ISREG(now.st_mode))
    return;
  const std::lock_guard lock(mutex);
  // What was noted first stays: a file that is opened twice is the same both times.
  for (const Watched& file : files)
    if (file.isSet && path == file.path.data()) return;
  for (Watched& file : files) {
    if (file.isSet) continue;
    std::memcpy(file.path.data(), path.c_str(), path.size() + 1);
    file.status = now;
    file.isSet = true;
    return;
  }
}

void forgetInputFile(const std::string& path) noexcept {
  struct stat now {};
  if (!isWatching || ::stat(path.c_str(), &now) != 0) return;
  const std::lock_guard lock(mutex);
  for (Watched& file : files)
    if (file.isSet && isSameFile(file.status, now)) file.isSet = false;
}

const char* changedInputFile() noexcept {
  for (const Watched& file : files) {
    struct stat now {};
    if (file.isSet && (::stat(file.path.data(), &now) != 0 || !isUnchanged(file.status, now)))
      return file.path.data();
  }
  return nullptr;
}

}  // namespace arete
