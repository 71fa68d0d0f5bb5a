// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/local_frame.h"

namespace arete {

/// What a GLB of ours says of its frame, under "arete" in the extras of its asset.
struct GlbFrame {
  LocalFrameSpec local;
  std::string crsWkt;
  std::string verticalUnit;
  std::vector<std::string> notes;
};

nlohmann::ordered_json toJson(const GlbFrame& frame);

/// Errors: corrupt, naming the field that is missing or makes no sense. Notes are not read.
Result<GlbFrame> glbFrameFromJson(const nlohmann::json& json);

/// glTF is Y up and right-handed: x east, y up, z south.
inline Vec3 localToGltf(const Vec3& p) {
  return {p.x, p.z, -p.y};
}
inline Vec3 gltfToLocal(const Vec3& p) {
  return {p.x, -p.z, p.y};
}

}  // namespace arete
