// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// A GLB file: its JSON, and its accessors as ranges of bytes that are checked to lie in the file. Errors
/// have no culprit; the caller adds the path.
class GlbDocument {
 public:
  /// @param file Must outlive the document.
  ///
  /// Errors: corrupt: not a GLB, truncated, chunks that do not fit, invalid JSON. unsupported: another
  /// version, a required extension.
  static Result<GlbDocument> open(std::string_view file);

  const nlohmann::json& json() const { return json_; }

  /// The elements of an accessor: `count` of them, `stride` bytes from one to the next.
  struct Elements {
    const char* first = nullptr;
    std::uint64_t count = 0;
    std::uint64_t stride = 0;
    int componentType = 0;
  };

  /// @param number Index of the accessor.
  /// @param type The required type: "VEC3", "SCALAR".
  ///
  /// Errors: corrupt: a missing accessor, another type, bytes outside the file. unsupported: a sparse
  /// accessor, a buffer outside the file.
  Result<Elements> accessor(std::uint64_t number, std::string_view type) const;

  /// An element of a top-level list: element("nodes", 3). Errors: corrupt: it is missing or not an object.
  Result<const nlohmann::json*> element(const char* list, std::uint64_t number) const;

  /// @return A member of an object; `fallback` if it is missing. Errors: corrupt: it is not a whole number
  /// below 2^32.
  static Result<std::uint64_t> wholeNumber(const nlohmann::json& object, const char* key,
                                           std::uint64_t fallback);
  /// The same; a missing member is corrupt.
  static Result<std::uint64_t> wholeNumber(const nlohmann::json& object, const char* key);

 private:
  nlohmann::json json_;
  std::string_view bytes_;  // of the chunk BIN
};

}  // namespace arete
