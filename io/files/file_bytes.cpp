// SPDX-License-Identifier: GPL-3.0-or-later
//
// open(), fstat(), then read() until the size that fstat() stated. The buffer is one byte longer than the
// file, so that an empty file has a valid range too.
#include "io/files/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <string>
#include <system_error>

#include "io/files/text_decoder.h"

namespace arete {

namespace {

struct Descriptor {
  int value;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

}  // namespace

Result<FileBytes> FileBytes::read(const std::filesystem::path& path) {
  const auto unreadable = [&](int error) {
    return failure(error == ENOENT || error == ENOTDIR ? ErrorCode::notFound : ErrorCode::unreadable,
                   fmt::format("cannot be read: {}", std::generic_category().message(error)), path.string());
  };
  // O_NONBLOCK: opening a pipe without a writer must not hang. Pipes are refused below.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.value < 0) return unreadable(errno);
  struct stat status {};
  if (::fstat(file.value, &status) != 0) return unreadable(errno);
  if (!S_ISREG(status.st_mode)) return failure(ErrorCode::unreadable, "is not a regular file", path.string());

  FileBytes result;
  result.size_ = static_cast<std::size_t>(status.st_size);
  result.bytes_.reset(new (std::nothrow) char[result.size_ + 1]);
  if (!result.bytes_)
    return failure(ErrorCode::outOfMemory, fmt::format("its {} bytes do not fit into memory", result.size_),
                   path.string());
  std::size_t done = 0;
  while (done < result.size_) {
    const ssize_t got = ::read(file.value, result.bytes_.get() + done, result.size_ - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return unreadable(errno);
    if (got == 0) return failure(ErrorCode::unreadable, "became shorter while it was read", path.string());
    done += static_cast<std::size_t>(got);
  }
  struct stat after {};
  if (::fstat(file.value, &after) != 0) return unreadable(errno);
  if (after.st_size != status.st_size || after.st_mtim.tv_sec != status.st_mtim.tv_sec ||
      after.st_mtim.tv_nsec != status.st_mtim.tv_nsec)
    return failure(ErrorCode::unreadable, "was changed while it was read", path.string());
  return result;
}

Result<FileBytes> FileBytes::readText(const std::filesystem::path& path) {
  Result<FileBytes> file = read(path);
  if (!file) return file;
  ARETE_CHECK(file->decodeText(path));
  return file;
}

Status FileBytes::decodeText(const std::filesystem::path& path) {
  if (!TextDecoder::isNeededFor(view())) return {};
  TextDecoder decoder;
  std::string text;
  decoder.decode(view(), text);
  decoder.finish(text);
  bytes_.reset(new (std::nothrow) char[text.size() + 1]);
  if (!bytes_)
    return failure(ErrorCode::outOfMemory, fmt::format("its {} bytes do not fit into memory", text.size()),
                   path.string());
  std::memcpy(bytes_.get(), text.data(), text.size());
  size_ = text.size();
  return {};
}

}  // namespace arete
