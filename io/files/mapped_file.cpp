// SPDX-License-Identifier: GPL-3.0-or-later
//
// open(), fstat(), mmap(), close(): a mapping needs no descriptor once it exists.
#include "io/files/mapped_file.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include "io/files/open_plain.h"
#include "io/files/watched_files.h"

namespace arete {

static_assert(sizeof(std::size_t) == 8, "files beyond 4 GiB are mapped whole");

Result<std::shared_ptr<const MappedFile>> MappedFile::open(const std::string& path) {
  ARETE_TRY(const PlainFile file, openPlain(path));
  const auto size = static_cast<std::size_t>(file.status.st_size);
  watchInputFile(path);
  void* const begin = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.descriptor.value, 0);
  if (begin == MAP_FAILED)
    return failure(ErrorCode::unreadable,
                   fmt::format("cannot be read: {}", std::generic_category().message(errno)), path);
  return std::shared_ptr<const MappedFile>(new MappedFile(static_cast<const std::byte*>(begin), size));
}

MappedFile::~MappedFile() {
  ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void MappedFile::adviseRandomAccess() const {
  ::madvise(const_cast<std::byte*>(bytes_.data()), bytes_.size(), MADV_RANDOM);
}

// The pages stay in the system's cache of files. A fault maps up to 64 KiB around what is touched, so what
// lies beside the part goes too.
void MappedFile::forget(Part part) const {
  if (part.empty()) return;
  constexpr std::uintptr_t kAround = std::uintptr_t{1} << 16;
  const auto addressOf = [](const std::byte* byte) { return reinterpret_cast<std::uintptr_t>(byte); };
  const std::uintptr_t begin = addressOf(bytes_.data()), end = begin + bytes_.size();
  const std::uintptr_t first = std::max(addressOf(part.data()) / kAround * kAround, begin);
  const std::uintptr_t last =
      std::min((addressOf(part.data()) + part.size() + kAround - 1) / kAround * kAround, end);
  ::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

}  // namespace arete
