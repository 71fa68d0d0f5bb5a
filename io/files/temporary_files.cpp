// SPDX-License-Identifier: GPL-3.0-or-later
//
// A name is ".<stem>.<process id>-<place>-<counter><extension>". The place is a hash of the machine, its host
// name and its namespace of process ids: only there does the id say whether the process runs.
#include "io/files/temporary_files.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

namespace arete {
namespace {

namespace fs = std::filesystem;

/// FNV-1a: the same in every program that is built from these sources.
std::uint32_t hashOf(std::string_view text) {
  std::uint32_t hash = 2166136261u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

std::string placeOfProcesses() {
  std::string machine;
  std::getline(std::ifstream("/etc/machine-id"), machine);
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  struct stat space {};
  if (::stat("/proc/self/ns/pid", &space) != 0) space.st_ino = 0;
  return fmt::format("{:08x}", hashOf(fmt::format("{}|{}|{}", machine, host.data(), space.st_ino)));
}

const std::string& place() {
  static const std::string instance = placeOfProcesses();
  return instance;
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// The process that a name tells; 0 where it is no name of temporaryBeside() on this machine.
pid_t processOf(std::string_view name) {
  static const std::string middle = "-" + place() + "-";
  const std::size_t at = name.find(middle);
  if (at == name.npos || name.front() != '.') return 0;
  const std::size_t after = at + middle.size();
  std::size_t begin = at;
  while (begin > 0 && isDigit(name[begin - 1])) --begin;
  if (begin == at || begin < 1 || name[begin - 1] != '.' || after >= name.size() || !isDigit(name[after]))
    return 0;
  pid_t process = 0;
  std::from_chars(name.data() + begin, name.data() + at, process);
  return process;
}

bool isRunning(pid_t process) {
  return process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH;
}

constexpr std::size_t kMostNoted = 64, kLongestPath = 1024;
struct Noted {
  std::atomic<bool> isSet = false;
  std::array<char, kLongestPath> path;
};
std::array<Noted, kMostNoted> noted;
std::mutex notedMutex;

}  // namespace

fs::path temporaryBeside(const fs::path& target) {
  static std::atomic<unsigned> counter = 0;
  // Common file systems limit names to 255 bytes. The stem only makes the name readable.
  constexpr std::size_t kLongestStem = 100;
  const std::string stem = target.stem().string(), extension = target.extension().string();
  return target.parent_path() / fmt::format(".{}.{}-{}-{}{}",
                                            stem.substr(0, std::min(stem.size(), kLongestStem)), ::getpid(),
                                            place(), counter++, extension);
}

void removeAbandonedFiles(const fs::path& folder) noexcept try {
  static std::mutex mutex;
  static std::set<fs::path> done;
  const std::lock_guard lock(mutex);
  if (!done.insert(folder).second) return;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const pid_t process = processOf(name);
    // A process with our own id that has left a file before this one wrote any has ended too.
    if (process == 0 || (process != ::getpid() && isRunning(process))) continue;
    std::error_code ignored;
    if (fs::is_regular_file(entry->symlink_status(ignored))) fs::remove(entry->path(), ignored);
  }
} catch (...) {
  // The files stay: this is a courtesy.
}

void noteTemporary(const fs::path& path) noexcept {
  if (path.native().size() >= kLongestPath) return;
  const std::lock_guard lock(notedMutex);
  for (Noted& file : noted) {
    if (file.isSet) continue;
    std::memcpy(file.path.data(), path.c_str(), path.native().size() + 1);
    file.isSet = true;
    return;
  }
}

void noteRemoved(const fs::path& path) noexcept {
  const std::lock_guard lock(notedMutex);
  for (Noted& file : noted)
    if (file.isSet && path.native() == file.path.data()) file.isSet = false;
}

void removeNotedFiles() noexcept {
  for (const Noted& file : noted)
    if (file.isSet) ::unlink(file.path.data());
}

}  // namespace arete
