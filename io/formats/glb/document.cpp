// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offsets, lengths and counts in the JSON must be whole numbers below 2^32, so that sums and products of two
// of them do not overflow 64 bits. Each range is checked against the one that contains it: the accessor
// against the view (accessors.h), the view against the bytes of its buffer (views.h).
#include "io/formats/glb/document.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "io/files/text/utf8.h"
#include "io/files/text_scan.h"
#include "io/formats/glb/accessors.h"
#include "io/formats/glb/corrupt.h"
#include "io/formats/glb/extensions.h"

namespace arete {

namespace {

constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;

std::uint32_t numberAt(std::string_view file, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, file.data() + at, sizeof number);
  return number;
}

/// JSON is UTF-8; programs that know no better write names in Latin-1.
nlohmann::json parsed(std::string_view text) {
  if (text::isUtf8(text)) return nlohmann::json::parse(text, nullptr, false);
  return nlohmann::json::parse(text::jsonAsUtf8(text), nullptr, false);
}

}  // namespace

Result<nlohmann::json> GltfDocument::parseGlb(std::string_view file, std::string_view& chunkBin) {
  if (file.size() < kHeaderSize) return corrupt("is truncated: it ends in its header");
  if (const std::uint32_t version = numberAt(file, 4); version != 2)
    return failure(ErrorCode::unsupported, fmt::format("is a GLB of version {}, not 2", version));
  if (const std::uint32_t length = numberAt(file, 8); length != file.size())
    return corrupt(
        fmt::format("is truncated or altered: its header says {} bytes, it has {}", length, file.size()));
  std::string_view text;
  bool hasBytes = false;
  for (std::size_t at = kHeaderSize, chunk = 0; at < file.size(); ++chunk) {
    if (file.size() - at < kChunkHeaderSize) return corrupt(fmt::format("chunk {} is cut off", chunk));
    const std::uint32_t length = numberAt(file, at), type = numberAt(file, at + 4);
    at += kChunkHeaderSize;
    if (length > file.size() - at)
      return corrupt(fmt::format("chunk {} of {} bytes is longer than the file", chunk, length));
    if ((chunk == 0) != (type == kJsonChunk)) return corrupt("does not begin with its only chunk of JSON");
    if (chunk == 0) text = file.substr(at, length);
    if (type == kBinChunk && !std::exchange(hasBytes, true)) chunkBin = file.substr(at, length);
    at += length;
  }
  nlohmann::json json = parsed(text);
  if (!json.is_object()) return corrupt("its chunk of JSON is not a JSON object");
  return json;
}

Status GltfDocument::checkVersion() const {
  // Version 1 has objects where version 2 has lists, and need not state itself.
  for (const char* const list : {"accessors", "meshes", "nodes"})
    if (const auto found = json_.find(list); found != json_.end() && found->is_object() && !found->empty())
      return failure(ErrorCode::unsupported, "is glTF of version 1, not 2");
  const nlohmann::json::json_pointer place("/asset/version");
  if (!json_.contains(place) || !json_.at(place).is_string()) return {};
  const std::string& version = json_.at(place).get_ref<const std::string&>();
  if (version.starts_with("2.")) return {};
  return failure(ErrorCode::unsupported,
                 fmt::format("is glTF of version {}, not 2", text::quotedToken(version)));
}

Result<GltfDocument> GltfDocument::open(std::string_view file, const std::filesystem::path& folder) {
  GltfDocument document;
  std::string_view chunk;
  if (file.starts_with("glTF")) {
    ARETE_TRY(nlohmann::json json, parseGlb(file, chunk));
    document.json_ = std::move(json);
  } else {
    document.json_ = parsed(file);
    if (!document.json_.is_object())
      return corrupt("is not glTF: it neither begins with \"glTF\" nor is a JSON object, or it is truncated");
  }
  document.views_ = std::make_shared<GltfViews>(folder, chunk);
  document.views_->setFileBytes(file.size());
  ARETE_CHECK(document.checkVersion());
  ARETE_CHECK(checkRequiredExtensions(document.json_));
  return document;
}

Result<std::uint64_t> GltfDocument::wholeNumber(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned() ||
      found->get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
    return corrupt(fmt::format("\"{}\" is missing or no whole number below 2^32", key));
  return found->get<std::uint64_t>();
}

Result<std::uint64_t> GltfDocument::wholeNumber(const nlohmann::json& object, const char* key,
                                                std::uint64_t fallback) {
  if (!object.contains(key)) return fallback;
  return wholeNumber(object, key);
}

Result<const nlohmann::json*> GltfDocument::element(const char* list, std::uint64_t number) const {
  const auto found = json_.find(list);
  if (found == json_.end() || !found->is_array() || number >= found->size() || !(*found)[number].is_object())
    return corrupt(fmt::format("names element {} of \"{}\", which does not exist", number, list));
  return &(*found)[number];
}

Result<GltfDocument::Elements> GltfDocument::accessor(std::uint64_t number, std::string_view type) const {
  return readAccessor(*this, *views_, number, type);
}

}  // namespace arete
