// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/attribute.h"

namespace arete {

struct DracoAttribute {
  int uniqueId = 0;
  int components = 0;
  ScalarType type = ScalarType::float32;
  bool normalized = false;
  std::string bytes;
};

struct DracoMesh {
  std::uint64_t points = 0;
  std::vector<std::uint32_t> indices;
  std::vector<DracoAttribute> attributes;
};

/// Stands in for the decoder of KHR_draco_mesh_compression.
Result<DracoMesh> decodeDraco(std::string_view bytes, std::uint64_t mostBytes);

}  // namespace arete
