// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "engine/base/vec.h"

namespace arete {

/// Whether a path names a scene: its name ends in .json.
bool isSceneFile(const std::string& path);

/// One object of a scene as its file states it (docs/topics/scenes.md).
struct StatedObject {
  enum class Anchor { origin, base };

  std::string name = {};              ///< stated, or that of the file; unlike in all objects
  std::string file = {};              ///< path, as seen from where the program runs
  Vec2 place = {};                    ///< in the scene's CRS, or longitude and latitude
  bool hasPlace = false;              ///< a terrain has none
  bool isLonLat = false;              ///< the place is longitude and latitude
  std::optional<double> height = {};  ///< in the vertical unit of the terrain; nothing: on the ground
  double above = 0;                   ///< over the ground, in the same unit
  Turn turn = {};                     ///< its heading from the grid's north
  double scale = 1;                   ///< metres of one unit of its file, > 0
  std::string up = {};                ///< "y" or "z"; empty: as the file says
  Anchor anchor = Anchor::origin;  ///< what of it stands at the place: the file's 0,0,0 or the middle below
  double toleranceFactor = 1;      ///< > 0
  std::optional<double> levelError = {};             ///< by hand, in the unit of its file
  std::optional<std::uint32_t> levelTriangles = {};  ///< by hand
  bool isShown = true;
};

struct SceneFile {
  std::string path;
  std::string crs = {};  ///< of the places; empty: the terrain's
  std::vector<StatedObject> objects;
};

/// Reads a scene. Files in it are found from the folder of the scene.
///
/// Errors: unreadable; corrupt: no JSON; invalidData: what is missing, unknown or out of range, naming the
/// object and the member. O(objects).
Result<SceneFile> readScene(const std::string& path);
/// The same of a text. @param path of the scene, for messages and its folder
Result<SceneFile> readSceneText(std::string_view text, const std::string& path);

}  // namespace arete
