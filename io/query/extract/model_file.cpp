// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/model_file.h"

#include <cstring>

#include "engine/base/caught_failure.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/virtual_file.h"
#include "io/geo/network/network_path.h"

namespace arete {
namespace {

/// As many bytes as its header says; 0 of another file.
std::uint64_t statedBytes(std::span<const std::byte> front) {
  AmtHeader header;
  if (front.size() < sizeof header) return 0;
  std::memcpy(&header, front.data(), sizeof header);
  return std::memcmp(front.data(), kAmtMagic.data(), kAmtMagic.size()) == 0 ? header.fileBytes : 0;
}

}  // namespace

Result<AmtContainer> openModelFile(const std::string& path, const AmtOpenOptions& options) try {
  if (!isVirtualPath(networkPathOf(path))) return AmtContainer::open(path, options);
  ARETE_TRY(auto image, readVirtualFile(path, sizeof(AmtHeader), statedBytes));
  return AmtContainer::open(path, std::move(image));
} catch (...) {
  return caughtFailure(path);
}

Result<AmtFile> openTerrainFile(const std::string& path, const AmtOpenOptions& options) {
  ARETE_TRY(AmtContainer container, openModelFile(path, options));
  return openAmt(std::move(container));
}

}  // namespace arete
