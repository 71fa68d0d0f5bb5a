// SPDX-License-Identifier: GPL-3.0-or-later
//
// Offsets, lengths and counts in the JSON must be whole numbers below 2^32, so that sums and products of two
// of them do not overflow 64 bits. Each range is checked against the one that contains it: the accessor
// against the view, the view against the bytes of the chunk.
#include "io/mesh/glb/document.h"

#include <fmt/format.h>

#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "io/file/text_scan.h"

namespace arete {

namespace {

constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;

std::uint32_t numberAt(std::string_view file, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, file.data() + at, sizeof number);
  return number;
}

tl::unexpected<Error> corrupt(std::string message) {
  return failure(ErrorCode::corrupt, std::move(message));
}

/// Bytes of one component; 0 for an unknown component type.
std::uint64_t componentSize(std::uint64_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::uint64_t componentsOf(std::string_view type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
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
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return corrupt("its chunk of JSON is not a JSON object");
  return json;
}

Status GltfDocument::checkVersion() const {
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
    Result<nlohmann::json> json = parseGlb(file, chunk);
    if (!json) return tl::unexpected(json.error());
    document.json_ = std::move(*json);
  } else {
    document.json_ = nlohmann::json::parse(file, nullptr, false);
    if (!document.json_.is_object())
      return corrupt("is not glTF: it neither begins with \"glTF\" nor is a JSON object, or it is truncated");
  }
  document.buffers_ = std::make_shared<GltfBuffers>(folder, chunk);
  if (const Status ok = document.checkVersion(); !ok) return tl::unexpected(ok.error());
  const auto required = document.json_.find("extensionsRequired");
  if (required != document.json_.end() && !(required->is_array() && required->empty())) {
    std::string names;
    if (required->is_array())
      for (const auto& name : *required)
        if (name.is_string())
          names += (names.empty() ? "" : ", ") + text::quotedToken(name.get_ref<const std::string&>());
    return failure(ErrorCode::unsupported,
                   fmt::format("requires the extension {}, which Arete does not read", names));
  }
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
  const auto found = element("accessors", number);
  if (!found) return tl::unexpected(found.error());
  const nlohmann::json& accessor = **found;
  const auto wrong = [&](ErrorCode code, std::string_view what) {
    return failure(code, fmt::format("accessor {} {}", number, what));
  };
  if (accessor.contains("sparse"))
    return wrong(ErrorCode::unsupported, "is sparse, which Arete does not read");
  if (!accessor.contains("bufferView")) return wrong(ErrorCode::unsupported, "has no bufferView");
  const auto typeName = accessor.find("type");
  if (typeName == accessor.end() || *typeName != type)
    return wrong(ErrorCode::corrupt, fmt::format("is not of the type {} that is needed", type));
  const auto count = wholeNumber(accessor, "count"), component = wholeNumber(accessor, "componentType"),
             offset = wholeNumber(accessor, "byteOffset", 0),
             viewNumber = wholeNumber(accessor, "bufferView");
  for (const auto* value : {&count, &component, &offset, &viewNumber})
    if (!*value) return wrong(ErrorCode::corrupt, value->error().message);
  const std::uint64_t size = componentSize(*component) * componentsOf(type);
  if (size == 0)
    return wrong(ErrorCode::corrupt, fmt::format("has the unknown component type {}", *component));

  const auto foundView = element("bufferViews", *viewNumber);
  if (!foundView) return tl::unexpected(foundView.error());
  const nlohmann::json& view = **foundView;
  const auto bufferNumber = wholeNumber(view, "buffer"), viewOffset = wholeNumber(view, "byteOffset", 0),
             viewLength = wholeNumber(view, "byteLength"), stride = wholeNumber(view, "byteStride", size);
  for (const auto* value : {&bufferNumber, &viewOffset, &viewLength, &stride})
    if (!*value) return corrupt(fmt::format("bufferView {}: {}", *viewNumber, value->error().message));
  const auto buffer = element("buffers", *bufferNumber);
  if (!buffer) return tl::unexpected(buffer.error());
  const Result<std::string_view> bytes = buffers_->bytesOf(*bufferNumber, **buffer);
  if (!bytes) return tl::unexpected(bytes.error());
  if (*viewOffset + *viewLength > bytes->size())
    return corrupt(fmt::format("bufferView {} ends at byte {} of {}", *viewNumber, *viewOffset + *viewLength,
                               bytes->size()));
  if (*stride < size)
    return corrupt(fmt::format("bufferView {} has a stride of {} bytes", *viewNumber, *stride));
  if (*count == 0) return wrong(ErrorCode::corrupt, "has no elements");
  if (*offset + (*count - 1) * *stride + size > *viewLength)
    return wrong(ErrorCode::corrupt, fmt::format("of {} elements is longer than its bufferView", *count));
  return Elements{bytes->data() + *viewOffset + *offset, *count, *stride, static_cast<int>(*component)};
}

}  // namespace arete
