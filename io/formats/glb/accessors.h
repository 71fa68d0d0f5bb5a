// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/base/result.h"
#include "io/formats/glb/document.h"
#include "io/formats/glb/elements.h"
#include "io/formats/glb/views.h"

namespace arete {

/// Reads an accessor of any kind: of every type and component type, normalized, interleaved, sparse, or
/// without a bufferView, which is zeros.
///
/// @param type The required type: "VEC3", "SCALAR"; empty: any.
/// Errors: those of GltfViews. corrupt: a missing accessor, another type, bytes outside the view, sparse
/// indices that do not grow or are out of range. O(1), but for sparse ones.
Result<GltfElements> readAccessor(const GltfDocument& document, GltfViews& views, std::uint64_t number,
                                  std::string_view type);

/// The type of a glTF's number for it: 5126 is float.
std::optional<ScalarType> scalarTypeOf(std::uint64_t componentType);

}  // namespace arete
