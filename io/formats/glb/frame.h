// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/geo/crs/local_frame.h"

namespace arete {

/// The frame of a GLB that Arete writes: the object "arete" in asset.extras.
struct GlbFrame {
  LocalFrameSpec local;
  std::string crsWkt;
  std::string verticalUnit;
  std::vector<std::string> notes;
};

nlohmann::ordered_json toJson(const GlbFrame& frame);

/// Reads all but the notes. Errors: corrupt: a field is missing or of the wrong type; the message names it.
Result<GlbFrame> glbFrameFromJson(const nlohmann::json& json);

/// glTF is Y up and right-handed: x east, y up, z south.
inline Vec3 localToGltf(const Vec3& p) {
  return {p.x, p.z, -p.y};
}
inline Vec3 gltfToLocal(const Vec3& p) {
  return {p.x, -p.z, p.y};
}

}  // namespace arete
