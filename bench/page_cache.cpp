// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/page_cache.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

namespace arete::bench {
namespace {

class Descriptor {
 public:
  explicit Descriptor(const std::string& path) : number_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

tl::unexpected<Error> systemFailure(const std::string& path) {
  return failure(errno == ENOENT ? ErrorCode::notFound : ErrorCode::unreadable, std::strerror(errno), path);
}

}  // namespace

Result<double> cachedFraction(const std::string& path) {
  const Descriptor file(path);
  struct stat status = {};
  if (file.number() < 0 || fstat(file.number(), &status) != 0) return systemFailure(path);
  const auto bytes = static_cast<std::size_t>(status.st_size);
  if (bytes == 0) return 1.0;
  void* const mapped = mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file.number(), 0);
  if (mapped == MAP_FAILED) return systemFailure(path);
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  std::vector<unsigned char> isResident((bytes + page - 1) / page);
  const bool isKnown = mincore(mapped, bytes, isResident.data()) == 0;
  const int cause = errno;
  munmap(mapped, bytes);
  errno = cause;
  if (!isKnown) return systemFailure(path);
  const auto resident =
      std::count_if(isResident.begin(), isResident.end(), [](unsigned char flags) { return flags & 1; });
  return double(resident) / double(isResident.size());
}

Result<double> dropFromCache(const std::string& path) {
  {
    const Descriptor file(path);
    if (file.number() < 0) return systemFailure(path);
    // Pages not yet on the disk cannot be forgotten.
    if (fdatasync(file.number()) != 0) return systemFailure(path);
    if (const int error = posix_fadvise(file.number(), 0, 0, POSIX_FADV_DONTNEED); error != 0) {
      errno = error;
      return systemFailure(path);
    }
  }
  return cachedFraction(path);
}

}  // namespace arete::bench
