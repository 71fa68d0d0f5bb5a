// SPDX-License-Identifier: GPL-3.0-or-later
//
// URIs are percent-decoded. Some exporters write names as they are, so a name that does not exist decoded is
// tried undecoded.
#include "io/formats/glb/buffers.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/files/text_scan.h"
#include "io/formats/glb/base64.h"
#include "io/formats/glb/corrupt.h"
#include "io/geo/gdal/confined.h"

namespace arete {

namespace {

constexpr std::string_view kBase64 = ";base64";

/// True for a relative path that stays in its folder.
bool staysBelow(const std::string& name) {
  if (name.empty() || name.find('\0') != std::string::npos || name.find('\\') != std::string::npos)
    return false;
  const std::size_t colon = name.find(':');
  if (colon != std::string::npos && colon < name.find('/')) return false;
  const std::filesystem::path path = name;
  if (!path.is_relative()) return false;
  for (const auto& part : path)
    if (part == "..") return false;
  return true;
}

}  // namespace

// A per cent sign without two digits stands for itself.
std::string percentDecoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    const char* const digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
      text += static_cast<char>(value);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// Only base 64 is read; a data URI of text is refused.
Result<std::string> GltfBuffers::dataOf(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(kBase64))
    return failure(ErrorCode::unsupported, "is a data URI that is not of base 64");
  std::optional<std::string> decoded = fromBase64(uri.substr(comma + 1));
  if (!decoded) return corrupt("is not valid base 64");
  return std::move(*decoded);
}

// A decoded data URI is kept by the number of its buffer, since views point into it. A file may be longer
// than the buffer, as chunks are padded.
Result<std::string_view> GltfBuffers::bytesOf(std::uint64_t number, const nlohmann::json& buffer) {
  const auto found = buffer.find("uri");
  if (found == buffer.end()) {
    if (number == 0 && chunk_.data() != nullptr) return chunk_;
    return corrupt(fmt::format("buffer {} has no bytes", number));
  }
  if (!found->is_string()) return corrupt(fmt::format("buffer {} has a \"uri\" that is no text", number));
  const std::string& uri = found->get_ref<const std::string&>();
  std::string_view bytes;
  std::string what = "its data URI";
  if (isDataUri(uri)) {
    auto known = decoded_.find(number);
    if (known == decoded_.end()) {
      Result<std::string> decoded = dataOf(uri);
      if (!decoded)
        return failure(decoded.error().code, fmt::format("buffer {} {}", number, decoded.error().message));
      known = decoded_.emplace(number, std::move(*decoded)).first;
    }
    bytes = known->second;
  } else {
    const Result<std::string_view> file = fileNamed(uri);
    if (!file)
      return failure(file.error().code,
                     fmt::format("buffer {}, {}, {}", number, text::quotedToken(uri), file.error().message));
    bytes = *file;
    what = text::quotedToken(uri);
  }
  const auto length = buffer.find("byteLength");
  if (length == buffer.end() || !length->is_number_unsigned())
    return corrupt(fmt::format("buffer {} has no \"byteLength\"", number));
  if (const auto wanted = length->get<std::uint64_t>(); wanted > bytes.size())
    return corrupt(fmt::format("buffer {} is truncated: it needs {} bytes, {} has {}", number, wanted, what,
                               bytes.size()));
  return bytes;
}

Result<std::string_view> GltfBuffers::fileNamed(const std::string& uri) {
  const std::string decoded = percentDecoded(uri);
  if (!staysBelow(decoded) || !staysBelow(uri))
    return failure(ErrorCode::unsupported, "is not the name of a file beside it");
  if (folder_.empty()) return failure(ErrorCode::unsupported, "is a file outside, which is not read here");
  // One file may be named in many ways: it is read once.
  const auto readOnce = [&](const std::string& name) -> Result<std::string_view> {
    const std::string path = (folder_ / name).lexically_normal().string();
    if (!mayRead(path)) return failure(ErrorCode::unsupported, "is another file, which is not read");
    auto known = files_.find(path);
    if (known == files_.end()) {
      Result<FileBytes> file = FileBytes::read(path);
      if (!file) return failure(file.error().code, file.error().message);
      bytesBeside_ += file->size();
      known = files_.emplace(path, std::move(*file)).first;
    }
    return known->second.view();
  };
  Result<std::string_view> bytes = readOnce(decoded);
  if (!bytes && bytes.error().code == ErrorCode::notFound && decoded != uri) bytes = readOnce(uri);
  return bytes;
}

}  // namespace arete
