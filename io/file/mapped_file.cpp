// SPDX-License-Identifier: GPL-3.0-or-later
//
// open(), fstat(), mmap(), close(): a mapping needs no descriptor once it exists. With O_NONBLOCK, opening a
// pipe returns at once; it is refused afterwards.
#include "io/file/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/file/watched_files.h"

namespace arete {
namespace {

static_assert(sizeof(std::size_t) == 8, "files beyond 4 GiB are mapped whole");

struct Descriptor {
  int value = -1;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

tl::unexpected<Error> systemFailure(int error, const std::string& path) {
  if (error == ENOENT || error == ENOTDIR) return failure(ErrorCode::notFound, "there is no such file", path);
  return failure(ErrorCode::unreadable,
                 fmt::format("cannot be read: {}", std::generic_category().message(error)), path);
}

}  // namespace

Result<std::shared_ptr<const MappedFile>> MappedFile::open(const std::string& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.value < 0) return systemFailure(errno, path);
  struct stat status {};
  if (::fstat(file.value, &status) != 0) return systemFailure(errno, path);
  if (S_ISDIR(status.st_mode)) return failure(ErrorCode::unreadable, "is a folder, not a file", path);
  if (!S_ISREG(status.st_mode)) return failure(ErrorCode::unreadable, "is a pipe or a device, not a file", path);
  if (status.st_size == 0) return failure(ErrorCode::unreadable, "is empty", path);
  const auto size = static_cast<std::size_t>(status.st_size);
  watchInputFile(path);
  void* const begin = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.value, 0);
  if (begin == MAP_FAILED) return systemFailure(errno, path);
  return std::shared_ptr<const MappedFile>(new MappedFile(static_cast<const std::byte*>(begin), size));
}

MappedFile::~MappedFile() {
  ::munmap(const_cast<std::byte*>(begin_), size_);
}

void MappedFile::adviseRandomAccess() const {
  ::madvise(const_cast<std::byte*>(begin_), size_, MADV_RANDOM);
}

}  // namespace arete
