// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory is reserved as one anonymous mapping of the size of the file, so that the bytes have the places
// that they would have in a mapping of the file; blocks that were not read take none. A block is read by one
// thread at a time, and its flag is set once it is whole.
#include "io/files/copied_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "engine/memory/required_memory.h"
#include "io/files/open_plain.h"

namespace arete {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16;

}  // namespace

CopiedFile::CopiedFile(std::string path, int descriptor, const struct ::stat& status, std::byte* begin)
    : path_(std::move(path)),
      descriptor_(descriptor),
      status_(status),
      begin_(begin),
      isLoaded_((static_cast<std::size_t>(status.st_size) + kBlock - 1) / kBlock) {
  bytes_ = {begin, static_cast<std::size_t>(status.st_size)};
}

CopiedFile::~CopiedFile() {
  ::munmap(begin_, bytes_.size());
  ::close(descriptor_);
}

Result<std::shared_ptr<const CopiedFile>> CopiedFile::open(const std::string& path) {
  ARETE_TRY(PlainFile file, openPlain(path));
  const auto size = static_cast<std::size_t>(file.status.st_size);
  allowReserved(size);
  void* const begin =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (begin == MAP_FAILED)
    return failure(ErrorCode::outOfMemory, fmt::format("its {} bytes do not fit into memory", size), path);
  return std::shared_ptr<const CopiedFile>(new CopiedFile(path, std::exchange(file.descriptor.value, -1),
                                                          file.status, static_cast<std::byte*>(begin)));
}

// Blocks are read at different times, so each must be of the same file: its size and time of change are
// compared after every read.
Status CopiedFile::checkUnchanged() const {
  struct ::stat now {};
  if (::fstat(descriptor_, &now) != 0)
    return failure(ErrorCode::unreadable,
                   fmt::format("cannot be read: {}", std::generic_category().message(errno)), path_);
  if (now.st_size == status_.st_size && now.st_mtim.tv_sec == status_.st_mtim.tv_sec &&
      now.st_mtim.tv_nsec == status_.st_mtim.tv_nsec)
    return {};
  return failure(ErrorCode::unreadable, "was changed while it was open; open it again", path_);
}

Status CopiedFile::read(std::size_t begin, std::size_t end) const {
  for (std::size_t done = begin; done < end;) {
    const ssize_t got = ::pread(descriptor_, begin_ + done, end - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      return failure(ErrorCode::unreadable,
                     fmt::format("cannot be read: {}", std::generic_category().message(errno)), path_);
    if (got == 0)
      return failure(ErrorCode::unreadable, "was cut short while it was open; open it again", path_);
    done += static_cast<std::size_t>(got);
  }
  return checkUnchanged();
}

// The flags are read without the lock first, since most parts are there already. Neighbouring blocks that are
// missing are read at once.
bool CopiedFile::load(std::span<const std::byte> part) const {
  if (part.empty()) return true;
  const auto begin = static_cast<std::size_t>(part.data() - bytes_.data());
  std::size_t block = begin / kBlock;
  const std::size_t end = (begin + part.size() - 1) / kBlock + 1;
  const auto isLoaded = [&](std::size_t b) { return isLoaded_[b].load(std::memory_order_acquire); };
  while (block < end && isLoaded(block)) ++block;
  if (block == end) return true;
  const std::lock_guard lock(mutex_);
  while (block < end) {
    if (isLoaded(block)) {
      ++block;
      continue;
    }
    std::size_t behind = block + 1;
    while (behind < end && !isLoaded(behind)) ++behind;
    // A block counts as loaded only after the whole read has succeeded; the first problem is kept, so that it
    // can be reported later.
    const Status done = read(block * kBlock, std::min(behind * kBlock, bytes_.size()));
    if (!done) {
      if (!problem_) problem_ = done.error();
      return false;
    }
    for (; block < behind; ++block) isLoaded_[block].store(true, std::memory_order_release);
  }
  return true;
}

std::optional<Error> CopiedFile::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

}  // namespace arete
