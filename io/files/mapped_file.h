// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "engine/base/result.h"
#include "io/files/file_image.h"

namespace arete {

/// A file mapped for reading. Pages are read on first access. The mapping stays valid if the file is replaced
/// by renaming (as OutputFile does). If the file is truncated in place, an access to the lost part ends the
/// program with SIGBUS, as with every mapping; arete says why (cli/session/faults.h). What other programs
/// load uses CopiedFile instead.
class MappedFile final : public FileImage {
 public:
  /// Errors: notFound. unreadable: with the system's reason; a folder, a device, an empty file.
  static Result<std::shared_ptr<const MappedFile>> open(const std::string& path);
  ~MappedFile() override;

  void adviseRandomAccess() const override;

 private:
  MappedFile(const std::byte* begin, std::size_t size) { bytes_ = {begin, size}; }
};

/// Says that a part of an image is not used for a while. Of a mapped file its pages, and those within 64 KiB
/// of it, go back to the system; they can be used again, and are then read again. Of another image nothing
/// happens. Thread-safe.
void releaseMapped(const FileImage& image, FileImage::Part part);

}  // namespace arete
