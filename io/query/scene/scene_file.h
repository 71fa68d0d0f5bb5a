// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "engine/base/vec.h"

namespace arete {

/// The detail of an object, set by hand: one of the two.
struct SceneLevel {
  std::optional<double> error;  ///< in the object's own unit
  std::optional<std::uint64_t> triangles;
  bool isStated() const { return error || triangles; }
  bool operator==(const SceneLevel&) const = default;
};

/// Where an object stands.
struct ScenePlace {
  Vec2 xy;                ///< in the scene's CRS, or longitude and latitude in degrees
  bool isLonLat = false;  ///< of WGS 84, where the scene is on the Earth
  std::optional<double>
      height;  ///< in the unit and above the zero of the terrain's heights; none: the ground
};

struct SceneObject {
  enum class Anchor : std::uint8_t {
    origin,  ///< 0,0,0 of the file stands at the place
    base,    ///< the middle of the bottom of its box, once it is pitched and rolled, does
  };
  std::string name;  ///< unlike all others
  std::string file;  ///< a path that can be opened
  std::optional<ScenePlace> place;
  double above = 0;  ///< metres above the place
  Turn turn;         ///< its heading is from the grid north of the scene's CRS
  double scale = 1;  ///< metres of a unit of the file
  std::string up;    ///< "y", "z", or empty: as the file says, else z
  Anchor anchor = Anchor::origin;
  double tolerance = 1;  ///< factor of the tolerance of the whole scene
  SceneLevel level;
  bool isVisible = true;
  bool statesPlacement = false;  ///< has a key that terrain cannot have
};

/// What a scene.json says (docs/topics/scenes.md, docs/topics/scene.schema.json).
struct SceneFile {
  std::string path;
  std::string crs;  ///< empty: the first terrain's; without terrain plain metres
  std::vector<SceneObject> objects;
};

/// "scene.json: objects[3] 'mast': at", the culprit of an error; without a key the object alone.
std::string sceneCulprit(const SceneFile& scene, std::size_t object, std::string_view key = {});

/// Reads a scene. Opens no file but this one. Errors: as FileBytes::readText(); invalidData naming the object
/// and the key: not JSON, an unknown, missing or repeated key, a value of another type or out of range, two
/// objects of one name, no objects. O(size).
Result<SceneFile> readScene(const std::string& path);

/// Whether a path is a scene by its name: it ends in .json.
bool isSceneFile(std::string_view path);

}  // namespace arete
