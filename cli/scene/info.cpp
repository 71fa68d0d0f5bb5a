// SPDX-License-Identifier: GPL-3.0-or-later
//
// All files are opened, so that info also says whether the scene can be opened at all.
#include "cli/scene/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "io/files/text/grouped.h"
#include "io/query/scene/open_scene.h"

namespace arete {
namespace {

/// More objects than these have a line of their own in JSON alone.
constexpr std::size_t kMostLines = 50;

std::uint64_t finestTriangles(const Model& model) {
  return std::visit([](const auto& m) { return std::uint64_t{m.mt.finestTriangleCount()}; }, model);
}

std::string placeText(const SceneObject& object) {
  if (!object.place) return "where its coordinates are";
  const ScenePlace& place = *object.place;
  std::string text =
      fmt::format("{}{:.10g},{:.10g}", place.isLonLat ? "lonlat " : "", place.xy.x, place.xy.y);
  text += place.height ? fmt::format(",{:g}", *place.height) : " on the ground";
  if (object.above != 0) text += fmt::format(", {:g} m above", object.above);
  if (object.scale != 1) text += fmt::format(", scale {:g}", object.scale);
  if (object.turn != Turn{})
    text += fmt::format(", turned {:g},{:g},{:g}", object.turn.heading, object.turn.pitch, object.turn.roll);
  return object.isVisible ? text : text + ", not visible";
}

}  // namespace

Status sayAboutScene(const std::string& path, Session& session) {
  ARETE_TRY(auto file, readScene(path));
  ARETE_TRY(const OpenScene scene, openScene(std::move(file), session.context()));
  session.warn(scene.warnings, path);
  const std::size_t count = scene.objects.size();
  std::vector<std::uint64_t> uses(scene.models.size()), finest;
  for (const auto& model : scene.models) finest.push_back(finestTriangles(*model));
  std::uint64_t shown = 0;
  Json files = Json::array(), objects = Json::array();
  std::string lines;
  std::size_t widest = 0;
  for (std::size_t i = 0; i < std::min(count, kMostLines); ++i)
    widest = std::max(widest, scene.file.objects[i].name.size());
  for (std::size_t i = 0; i < count; ++i) {
    const SceneObject& object = scene.file.objects[i];
    const PlacedObject& placed = scene.objects[i];
    const std::uint64_t triangles = finest[placed.model];
    ++uses[placed.model];
    shown += object.isVisible ? triangles : 0;
    if (i < kMostLines)
      lines +=
          fmt::format("  {:<{}}  {:>12}  {}\n", object.name, widest, grouped(triangles), placeText(object));
    Json json = {{"name", object.name},
                 {"file", object.file},
                 {"kind", scene.surfaceOf(i) ? "surface" : "terrain"},
                 {"triangles", triangles},
                 {"visible", object.isVisible}};
    if (scene.surfaceOf(i)) {
      const Vec3 at = placed.placement({0, 0, 0});
      json["origin"] = {at.x, at.y, at.z};
    }
    objects.push_back(std::move(json));
  }
  for (std::size_t m = 0; m < scene.models.size(); ++m)
    files.push_back({{"file", scene.paths[m]}, {"objects", uses[m]}, {"triangles", finest[m]}});
  session.say(fmt::format("{}: {} of {}, {} shown at the finest\n  {:<{}}  {:>12}  place\n{}", path,
                          grouped(count, "object", "objects"), grouped(scene.models.size(), "file", "files"),
                          grouped(shown, "triangle", "triangles"), "name", widest, "triangles", lines));
  if (count > kMostLines)
    session.say(fmt::format("  and {}\n", grouped(count - kMostLines, "further object", "further objects")));
  session.answer({{"scene", path},
                  {"crs", scene.file.crs},
                  {"terrain", scene.terrain ? Json(scene.file.objects[*scene.terrain].name) : Json()},
                  {"triangles", shown},
                  {"files", std::move(files)},
                  {"objects", std::move(objects)}});
  return {};
}

}  // namespace arete
