// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/extract/model_file.h"

#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/curl/curl_client.h"
#include "io/files/ranges/ranged_file.h"
#include "io/geo/gdal/confined.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/virtual_file.h"
#include "io/geo/network/curl_options.h"
#include "io/geo/network/network_address.h"
#include "io/geo/network/network_path.h"
#include "io/geo/network/store_client.h"

namespace arete {
namespace {

/// As many bytes as its header says; 0 of another file.
std::uint64_t statedBytes(std::span<const std::byte> front) {
  AmtHeader header;
  if (front.size() < sizeof header) return 0;
  std::memcpy(&header, front.data(), sizeof header);
  return std::memcmp(front.data(), kAmtMagic.data(), kAmtMagic.size()) == 0 ? header.fileBytes : 0;
}

constexpr std::string_view kOfGdal = "/vsicurl";

/// "host:8080" of "https://user:password@host:8080/a/b?c".
std::string hostOf(const std::string& url) {
  std::size_t begin = url.find("://");
  begin = begin == url.npos ? 0 : begin + 3;
  const std::string authority = url.substr(begin, url.find_first_of("/?#", begin) - begin);
  return authority.substr(authority.rfind('@') + 1);
}

/// What reads a path by ranges; nothing for a path that GDAL reads from its beginning.
///
/// @param named The path as GDAL names it (networkPathOf()).
Result<std::optional<RangedFile::Source>> sourceOf(const std::string& path, const std::string& named) {
  if (gdalIsConfined()) return std::nullopt;  // GDAL says it of every path alike
  if (isStorePath(named))
    return RangedFile::Source{path, named.substr(0, named.find('/', 1)), named, storeClient(named), {}};
  if (!named.starts_with(kOfGdal)) return std::nullopt;
  std::string name = named.substr(kOfGdal.size());
  constexpr std::string_view kStreaming = "_streaming";
  if (name.starts_with(kStreaming)) name.erase(0, kStreaming.size());
  if (name.starts_with('/')) name.erase(0, 1);
  if (!name.starts_with('?') && !beginsWithAddress(name)) return std::nullopt;
  Result<NetworkAddress> address = networkAddress(name);
  if (!address) return failure(address.error().code, address.error().message, path);
  if (networkPathOf(address->url) == address->url) return std::nullopt;  // neither http nor https
  auto client = curlHttpClient(address->url, curlOptionsOf(*address));
  return RangedFile::Source{path, hostOf(address->url), address->url, std::move(client), address->rules};
}

}  // namespace

Result<AmtContainer> openModelFile(const std::string& path, const AmtOpenOptions& options) try {
  const std::string named = networkPathOf(path);
  if (!isVirtualPath(named)) return AmtContainer::open(path, options);
  ARETE_TRY(auto source, sourceOf(path, named));
  if (source) {
    ARETE_TRY(auto ranged, RangedFile::open(std::move(*source), webSettings(), options.cancel));
    return AmtContainer::open(path, std::move(ranged));
  }
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
