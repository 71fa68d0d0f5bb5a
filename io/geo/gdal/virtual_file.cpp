// SPDX-License-Identifier: GPL-3.0-or-later
//
// The size that a file system states is not asked for: of compressed files some compute it by unpacking them,
// and write it beside the file.
#include "io/geo/gdal/virtual_file.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/network_path.h"
#include "io/geo/network/network_reading.h"

namespace arete {
namespace {

constexpr std::size_t kAtOnce = std::size_t{1} << 20;

class BytesInMemory final : public FileImage {
 public:
  explicit BytesInMemory(std::vector<std::byte> read) : all_(std::move(read)) { bytes_ = all_; }

 private:
  std::vector<std::byte> all_;
};

struct VirtualCloser {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

}  // namespace

Result<std::shared_ptr<const FileImage>> readVirtualFile(const std::string& path, std::size_t headerBytes,
                                                         const SizeByHeader& sizeOf) try {
  const GdalErrors errors;
  NetworkReading network(nullptr);
  const std::unique_ptr<VSILFILE, VirtualCloser> file(VSIFOpenExL(servedPath(path).c_str(), "rb", TRUE));
  if (!file) return tl::unexpected(explainOpenFailure(path, "file", errors));
  std::vector<std::byte> bytes;
  // Until there are so many, or no more.
  const auto readUpTo = [&](std::uint64_t wanted) {
    while (bytes.size() < wanted) {
      const std::size_t before = bytes.size();
      bytes.resize(before + static_cast<std::size_t>(std::min<std::uint64_t>(kAtOnce, wanted - before)));
      const std::size_t got = VSIFReadL(bytes.data() + before, 1, bytes.size() - before, file.get());
      bytes.resize(before + got);
      if (got == 0) return;
    }
  };
  readUpTo(headerBytes);
  if (const std::uint64_t size = sizeOf(bytes); size > bytes.size()) readUpTo(size + 1);
  if (errors.anyFailure())
    return failure(ErrorCode::unreadable, "cannot be read: " + errors.firstFailure(), path);
  if (Status same = network.finish(); !same) return failure(same.error().code, same.error().message, path);
  if (bytes.empty()) return failure(ErrorCode::unreadable, "is empty", path);
  return std::make_shared<const BytesInMemory>(std::move(bytes));
} catch (...) {
  return caughtFailure(path);
}

}  // namespace arete
