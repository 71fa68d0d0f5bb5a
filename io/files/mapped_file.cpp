// SPDX-License-Identifier: GPL-3.0-or-later
//
// open(), fstat(), mmap(), close(): a mapping needs no descriptor once it exists.
#include "io/files/mapped_file.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <cerrno>
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

// What another part of the mapping needs too, on the first and the last page of memory, stays.
void MappedFile::forget(Part part) const {
  constexpr std::size_t kPage = 4096;
  const auto begin = static_cast<std::size_t>(part.data() - bytes_.data());
  const std::size_t first = (begin + kPage - 1) / kPage * kPage, end = (begin + part.size()) / kPage * kPage;
  if (first < end) ::madvise(const_cast<std::byte*>(bytes_.data()) + first, end - first, MADV_DONTNEED);
}

}  // namespace arete
