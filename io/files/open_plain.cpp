// SPDX-License-Identifier: GPL-3.0-or-later
//
// With O_NONBLOCK, opening a pipe returns at once; it is refused afterwards.
#include "io/files/open_plain.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace arete {
namespace {

tl::unexpected<Error> systemFailure(int error, const std::string& path) {
  if (error == ENOENT || error == ENOTDIR) return failure(ErrorCode::notFound, "there is no such file", path);
  return failure(ErrorCode::unreadable,
                 fmt::format("cannot be read: {}", std::generic_category().message(error)), path);
}

}  // namespace

Result<PlainFile> openPlain(const std::string& path) {
  PlainFile file{FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)), {}};
  if (file.descriptor.value < 0) return systemFailure(errno, path);
  if (::fstat(file.descriptor.value, &file.status) != 0) return systemFailure(errno, path);
  if (S_ISDIR(file.status.st_mode)) return failure(ErrorCode::unreadable, "is a folder, not a file", path);
  if (!S_ISREG(file.status.st_mode))
    return failure(ErrorCode::unreadable, "is a pipe or a device, not a file", path);
  if (file.status.st_size == 0) return failure(ErrorCode::unreadable, "is empty", path);
  return file;
}

}  // namespace arete
