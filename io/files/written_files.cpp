// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/written_files.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace arete {
namespace {

struct WrittenList {
  std::mutex mutex;
  bool isKept = false;
  std::vector<WrittenFile> files;
};

WrittenList& writtenList() {
  static WrittenList list;
  return list;
}

}  // namespace

void listWrittenFiles() {
  const std::lock_guard lock(writtenList().mutex);
  writtenList().isKept = true;
}

std::vector<WrittenFile> writtenFiles() {
  const std::lock_guard lock(writtenList().mutex);
  return writtenList().files;
}

// The file has its name already, so a list that cannot grow does not fail the write.
void noteWritten(WrittenFile file) try {
  WrittenList& list = writtenList();
  const std::lock_guard lock(list.mutex);
  if (!list.isKept) return;
  const auto known = std::ranges::find(list.files, file.path, &WrittenFile::path);
  if (known == list.files.end())
    list.files.push_back(std::move(file));
  else
    known->bytes = file.bytes;
} catch (...) {
}

void noteRestored(const std::filesystem::path& path) {
  WrittenList& list = writtenList();
  const std::lock_guard lock(list.mutex);
  std::erase_if(list.files, [&](const WrittenFile& file) { return file.path == path.string(); });
}

}  // namespace arete
