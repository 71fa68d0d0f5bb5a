// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/formats/glb/elements.h"
#include "io/formats/glb/views.h"

namespace arete {

/// A glTF file, binary (GLB) or as text: its JSON, and its accessors as elements that are checked to lie in
/// its buffers. Errors have no culprit; the caller adds the path.
class GltfDocument {
 public:
  /// @param file Must outlive the document. A GLB if it begins with "glTF", else JSON.
  /// @param folder That of the file, for buffers beside it (io/formats/glb/buffers.h); empty: none are read.
  ///
  /// Errors: corrupt: neither, truncated, chunks that do not fit, invalid JSON. unsupported: another version,
  /// a required extension.
  static Result<GltfDocument> open(std::string_view file, const std::filesystem::path& folder = {});

  const nlohmann::json& json() const { return json_; }

  using Elements = GltfElements;

  /// @param number Index of the accessor.
  /// @param type The required type: "VEC3", "SCALAR"; empty: any.
  ///
  /// Errors: those of readAccessor() (io/formats/glb/accessors.h).
  Result<Elements> accessor(std::uint64_t number, std::string_view type) const;

  /// The views of this glTF. Reading a document reads and decodes its buffers.
  GltfViews& views() const { return *views_; }

  /// An element of a top-level list: element("nodes", 3). Errors: corrupt: it is missing or not an object.
  Result<const nlohmann::json*> element(const char* list, std::uint64_t number) const;

  /// @return A member of an object; `fallback` if it is missing. Errors: corrupt: it is not a whole number
  /// below 2^32.
  static Result<std::uint64_t> wholeNumber(const nlohmann::json& object, const char* key,
                                           std::uint64_t fallback);
  /// The same; a missing member is corrupt.
  static Result<std::uint64_t> wholeNumber(const nlohmann::json& object, const char* key);

 private:
  /// Errors: those of open(). `chunk` becomes that of the name BIN.
  static Result<nlohmann::json> parseGlb(std::string_view file, std::string_view& chunk);
  Status checkVersion() const;

  nlohmann::json json_;
  std::shared_ptr<GltfViews> views_;
};

}  // namespace arete
