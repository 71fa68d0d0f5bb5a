// SPDX-License-Identifier: GPL-3.0-or-later
//
// A compressed view names the buffer that holds its compressed bytes; the buffer that the view itself names
// may hold them uncompressed, for programs without a decoder, or be empty. It is used where the decoder
// fails, if it has the bytes.
#include "io/formats/glb/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/formats/glb/corrupt.h"
#include "io/formats/glb/document.h"
#include "io/formats/glb/extensions.h"
#include "io/formats/glb/meshopt.h"

namespace arete {

namespace {

constexpr std::uint64_t kReservableAtLeast = 64 << 20, kReservablePerByte = 64;

/// A member that is a text; `fallback` if it is missing or none.
std::string textOf(const nlohmann::json& object, const char* key, const char* fallback) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : fallback;
}

}  // namespace

std::uint64_t GltfViews::reservable() const {
  // What compressed data may take grows with the file, so that a small one cannot exhaust memory.
  const std::uint64_t most =
      std::max(kReservableAtLeast, kReservablePerByte * (fileBytes_ + buffers_.bytesBeside()));
  return most - std::min(most, reserved_);
}

Status GltfViews::reserve(std::uint64_t bytes) {
  if (bytes > reservable())
    return failure(ErrorCode::unsupported, "holds compressed or sparse data far larger than the file");
  reserved_ += bytes;
  return {};
}

Result<GltfViews::View> GltfViews::decompressed(const GltfDocument& document, std::uint64_t number,
                                                const nlohmann::json& compression) {
  if (const auto known = decompressed_.find(number); known != decompressed_.end())
    return View{*known->second, 0, known->second};
  const auto buffer = GltfDocument::wholeNumber(compression, "buffer"),
             offset = GltfDocument::wholeNumber(compression, "byteOffset", 0),
             length = GltfDocument::wholeNumber(compression, "byteLength"),
             stride = GltfDocument::wholeNumber(compression, "byteStride"),
             count = GltfDocument::wholeNumber(compression, "count");
  for (const auto* value : {&buffer, &offset, &length, &stride, &count})
    if (!*value) return tl::unexpected(value->error());
  ARETE_TRY(const auto element, document.element("buffers", *buffer));
  ARETE_TRY(const std::string_view bytes, buffers_.bytesOf(*buffer, *element));
  if (*offset + *length > bytes.size())
    return corrupt(fmt::format("ends at byte {} of {}", *offset + *length, bytes.size()));
  ARETE_CHECK(reserve(*count * *stride));
  ARETE_TRY(std::string decoded,
            decodeMeshopt(bytes.substr(*offset, *length), *count, *stride,
                          textOf(compression, "mode", "ATTRIBUTES"), textOf(compression, "filter", "NONE")));
  // Several accessors may share a view, so its bytes are kept.
  const auto kept =
      decompressed_.emplace(number, std::make_shared<const std::string>(std::move(decoded))).first;
  return View{*kept->second, 0, kept->second};
}

Result<GltfViews::View> GltfViews::view(const GltfDocument& document, std::uint64_t number) {
  ARETE_TRY(const auto found, document.element("bufferViews", number));
  const nlohmann::json& view = *found;
  const auto bufferNumber = GltfDocument::wholeNumber(view, "buffer"),
             offset = GltfDocument::wholeNumber(view, "byteOffset", 0),
             length = GltfDocument::wholeNumber(view, "byteLength"),
             stride = GltfDocument::wholeNumber(view, "byteStride", 0);
  for (const auto* value : {&bufferNumber, &offset, &length, &stride})
    if (!*value) return corrupt(fmt::format("bufferView {}: {}", number, value->error().message));

  // The extension has two names with the same members.
  const nlohmann::json* compression = extensionOf(view, "EXT_meshopt_compression");
  if (compression == nullptr) compression = extensionOf(view, "KHR_meshopt_compression");
  Error decoding;
  if (compression != nullptr) {
    Result<View> decoded = decompressed(document, number, *compression);
    if (decoded) {
      decoded->stride = *stride;
      return decoded;
    }
    decoding = decoded.error();
    decoding.message = fmt::format("bufferView {}: {}", number, decoding.message);
  }
  ARETE_TRY(const auto buffer, document.element("buffers", *bufferNumber));
  const Result<std::string_view> bytes = buffers_.bytesOf(*bufferNumber, *buffer);
  const bool isWhole = bytes && *offset + *length <= bytes->size();
  if (compression != nullptr && !isWhole) return tl::unexpected(decoding);
  if (!bytes) return tl::unexpected(bytes.error());
  if (!isWhole)
    return corrupt(
        fmt::format("bufferView {} ends at byte {} of {}", number, *offset + *length, bytes->size()));
  return View{bytes->substr(*offset, *length), *stride};
}

}  // namespace arete
