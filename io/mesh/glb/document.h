// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

/// A GLB taken apart: its JSON, and its accessors as bytes that are sure to be there. Errors have no culprit.
class GlbDocument {
 public:
  /// `file` must outlive the document. Errors: corrupt (no GLB, truncated, chunks that do not fit, no JSON),
  /// unsupported (another version, a required extension).
  static Result<GlbDocument> open(std::string_view file);

  const nlohmann::json& json() const { return json_; }

  /// The elements of an accessor: `count` of them, `stride` bytes from one to the next.
  struct Elements {
    const char* first = nullptr;
    std::uint64_t count = 0;
    std::uint64_t stride = 0;
    int componentType = 0;
  };

  /// The accessor of that number, all of its bytes inside the file. `type`: "VEC3", "SCALAR". Errors:
  /// corrupt, unsupported (sparse, another buffer than the file's own).
  Result<Elements> accessor(std::uint64_t number, std::string_view type) const;

  /// The element of a top-level list ("nodes", 3). Errors: corrupt, when it is not there or no object.
  Result<const nlohmann::json*> element(const char* list, std::uint64_t number) const;

  /// A whole number below 2^32 of an object; `fallback` where the object does not have it. Errors: corrupt.
  static Result<std::uint64_t> wholeNumber(const nlohmann::json& object, const char* key,
                                           std::uint64_t fallback);
  /// The same, where it must be there.
  static Result<std::uint64_t> wholeNumber(const nlohmann::json& object, const char* key);

 private:
  nlohmann::json json_;
  std::string_view bytes_;  // of the chunk BIN
};

}  // namespace arete
