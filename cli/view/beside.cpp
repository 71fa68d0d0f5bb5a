// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/view/beside.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "cli/view/layer_argument.h"
#include "surface/front/front.h"
#include "viewer/fronts/drawn_vertices.h"
#include "viewer/inks/distance_colors.h"

namespace arete {
namespace {

Result<SceneLevel> levelOf(const FileWithKeys& stated, const std::string& option) {
  SceneLevel level;
  for (const auto& [key, text] : stated.values) {
    const auto number = numberIn(text);
    const bool isWhole = number && *number == std::floor(*number) && *number >= 1 && *number < 4e9;
    if (key == "error" && number && *number >= 0 && std::isfinite(*number))
      level.error = *number;
    else if (key == "triangles" && isWhole)
      level.triangles = static_cast<std::uint64_t>(*number);
    else
      return failure(
          ErrorCode::usage,
          fmt::format("{} is not {}", text,
                      key == "error" ? "an error in the unit of the file" : "a number of triangles"),
          option);
  }
  if (level.error && level.triangles)
    return failure(ErrorCode::usage, "states an error and a number of triangles: one of them", option);
  return level;
}

}  // namespace

Result<OpenScene> openBeside(const ViewArguments& a, const RunContext& context) {
  const std::string option = "--beside " + a.viewpoint.beside;
  ARETE_TRY(const FileWithKeys other, readFileWithKeys(a.viewpoint.beside, {"error", "triangles"}));
  if (isSceneFile(a.model) || isSceneFile(other.file))
    return failure(ErrorCode::usage, "is of two models; a scene has its objects under one camera already",
                   option);
  ARETE_TRY(const SceneLevel level, levelOf(other, option));
  SceneFile file{.path = fmt::format("{} --beside {}", a.model, other.file), .crs = {}, .objects = {}};
  for (const std::string& path : {a.model, other.file}) {
    SceneObject object;
    object.name = std::filesystem::path(path).filename().string();
    if (!file.objects.empty() && file.objects.front().name == object.name) object.name += " (2)";
    object.file = path;
    object.up = a.viewpoint.up;
    file.objects.push_back(std::move(object));
  }
  file.objects.back().level = level;
  ARETE_TRY(OpenScene scene, openScene(std::move(file), context));
  if (a.viewpoint.hasDistances && scene.terrain)
    return failure(ErrorCode::usage, "is of two surfaces; `measure` has the heights of two terrains",
                   "--distances");
  return scene;
}

Result<ColoredDistances> distancesOf(const OpenScene& scene, const RunContext& context) {
  std::array<VertexDistances, 2> found;
  double most = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t other = 1 - i;
    std::vector<Vec3> places = drawnPlaces(*scene.surfaceOf(i));
    for (Vec3& p : places) p = uprightPosition(p, scene.objects[i].isYUp);
    TriangleMesh mesh = finestSurfaceOf(*scene.surfaceOf(other)).mesh.shape();
    for (Vec3& p : mesh.positions) p = uprightPosition(p, scene.objects[other].isYUp);
    ARETE_TRY(found[i], distancesTo(mesh, places, context));
    most = std::max(most, found[i].largest);
  }
  ColoredDistances made{
      .colors = {}, .json = Json::array(), .legend = distanceLegend(most, scene.surfaceOf(0)->verticalUnit)};
  for (std::size_t i = 0; i < 2; ++i) {
    made.colors[i] = distanceColors(found[i], most);
    made.json.push_back(
        {{"name", scene.file.objects[i].name}, {"largest", found[i].largest}, {"mean", found[i].mean}});
  }
  return made;
}

}  // namespace arete
