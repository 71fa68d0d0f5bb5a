// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files are opened first, so that the first terrain is known; then each place is transformed to its CRS, and
// to its metric space. Where the grid north of the scene's CRS leads there is found by a small step.
#include "io/query/scene/open_scene.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/reader.h"
#include "io/geo/crs/transform.h"
#include "terrain/locate/ground_height.h"
#include "terrain/model/camera.h"

namespace arete {
namespace {

// What is off by less than a thousandth of its distance is off by about a pixel.
constexpr double kMostOfUnits = 1e-3;

Status wrongPlace(const SceneFile& file, std::size_t object, std::string_view key, std::string message) {
  return failure(ErrorCode::invalidData, std::move(message), sceneCulprit(file, object, key));
}

/// One file under all of its names.
std::string identityOf(const std::string& path) {
  std::error_code unknown;
  const auto canonical = std::filesystem::canonical(path, unknown);
  return unknown ? path : canonical.string();
}

Status openFiles(OpenScene& scene, const RunContext& context) {
  std::unordered_map<std::string, std::size_t> byPath, byFile;
  for (std::size_t i = 0; i < scene.file.objects.size(); ++i) {
    const std::string& path = scene.file.objects[i].file;
    auto [known, isNew] = byPath.try_emplace(path, scene.models.size());
    if (isNew) {
      const auto [same, isNewFile] = byFile.try_emplace(identityOf(path), scene.models.size());
      known->second = same->second;
      if (isNewFile) {
        auto opened = openAnyModel(path, {}, context);
        if (!opened) {
          opened.error().culprit = sceneCulprit(
              scene.file, i, opened.error().culprit.empty() ? "file" : "file: " + opened.error().culprit);
          return tl::unexpected(std::move(opened).error());
        }
        for (const Warning& warning : opened->warnings) scene.warnings.push_back(warning.behind(path + ": "));
        scene.models.push_back(std::make_shared<const Model>(std::move(opened->model)));
        scene.paths.push_back(path);
      }
    }
    PlacedObject object;
    object.model = known->second;
    scene.objects.push_back(object);
  }
  return {};
}

bool isSameCrs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (a.empty() || b.empty()) return false;
  const auto one = crsFromText(a), other = crsFromText(b);
  return one && other && one->IsSame(&*other);
}

/// By how much the map units of two terrains of one CRS differ in length, as a part of one: degrees
/// and Web Mercator have their length in the middle of each DEM.
double differenceOfUnits(const TerrainModel& a, const TerrainModel& b) {
  const Vec2 corner = a.toSource({0, 0});
  const auto step = [&](const TerrainModel& model, Vec2 by) {
    return metricPosition(corner + by, 0, model) - metricPosition(corner, 0, model);
  };
  double most = 0;
  for (const Vec2 by : {Vec2{1, 0}, Vec2{0, 1}})
    most = std::max(most, std::abs(norm(step(a, by)) / norm(step(b, by)) - 1));
  return most;
}

Status checkTerrains(OpenScene& scene) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const auto* terrain = std::get_if<TerrainModel>(scene.models[scene.objects[i].model].get());
    if (!terrain) continue;
    if (scene.file.objects[i].statesPlacement)
      return wrongPlace(
          scene.file, i, {},
          "is terrain, which lies where its own coordinates say: at, lonlat, above, turn, scale, "
          "up and anchor are for meshes");
    if (scene.terrain &&
        terrain->georeference.verticalUnitMetres != scene.terrainModel()->georeference.verticalUnitMetres)
      return wrongPlace(scene.file, i, "file",
                        fmt::format("has heights in another unit than the first terrain, '{}'",
                                    scene.file.objects[*scene.terrain].name));
    if (!scene.terrain) {
      scene.terrain = i;
    } else if (!isSameCrs(terrain->georeference.crsWkt, scene.terrainModel()->georeference.crsWkt)) {
      return wrongPlace(scene.file, i, "file",
                        fmt::format("is in another CRS than the first terrain, '{}'",
                                    scene.file.objects[*scene.terrain].name));
    } else if (const double part = differenceOfUnits(*terrain, *scene.terrainModel()); part > kMostOfUnits) {
      return wrongPlace(
          scene.file, i, "file",
          fmt::format("has map units that differ by {:.2g} % in length from the first terrain's, '{}'; "
                      "in a projected CRS they do not",
                      100 * part, scene.file.objects[*scene.terrain].name));
    }
  }
  return {};
}

/// Turns places into the scene's space.
class ScenePlacer {
 public:
  static Result<ScenePlacer> of(OpenScene& scene) {
    ScenePlacer placer(scene);
    const SceneFile& file = scene.file;
    const TerrainModel* terrain = scene.terrainModel();
    std::string crs = file.crs;
    if (!crs.empty()) {
      auto read = crsFromUser(crs);
      if (!read) {
        read.error().culprit = fmt::format("{}: crs", file.path);
        read.error().code = ErrorCode::invalidData;
        return tl::unexpected(std::move(read).error());
      }
      placer.isGeographic_ = read->IsGeographic() != 0;
      if (!terrain && placer.isGeographic_)
        return failure(ErrorCode::invalidData,
                       "is in degrees, which needs terrain: without terrain state a CRS of lengths",
                       fmt::format("{}: crs", file.path));
      placer.unit_ = placer.isGeographic_ ? 1 : read->GetLinearUnits();
    }
    if (terrain) {
      const Georeference& g = terrain->georeference;
      if (!crs.empty() && g.crsWkt.empty())
        return failure(ErrorCode::invalidData, "the first terrain has no CRS to bring places to",
                       fmt::format("{}: crs", file.path));
      if (crs.empty()) placer.isGeographic_ = g.isGeographic;
      if (!crs.empty()) {
        ARETE_TRY(placer.toTerrain_, CrsTransform::between(crs, g.crsWkt));
        placer.toTerrain_.setTurns(LongitudeTurns(*terrain));
      }
      if (crs.empty()) crs = g.crsWkt;
      placer.ground_.emplace(*terrain);
      const auto metric = [&](double x, double y) { return metricPosition({x, y}, 0, *terrain); };
      const Vec2 middle = terrain->toSource({terrain->mt.metric().origin.x, terrain->mt.metric().origin.y});
      const double step = g.isGeographic ? 1e-3 : 1;
      const Vec3 o = metric(middle.x, middle.y), e = metric(middle.x + step, middle.y) - o,
                 n = metric(middle.x, middle.y + step) - o;
      scene.isMirrored = e.x * n.y - e.y * n.x < 0;
    }
    placer.crs_ = crs;
    return placer;
  }

  /// Where it stands, in the scene's space, and the heading of grid north there.
  struct Stand {
    Vec3 at;
    double north = 0;
  };
  Result<Stand> standOf(std::size_t i) {
    const SceneObject& object = scene_.file.objects[i];
    const TerrainModel* terrain = scene_.terrainModel();
    if (!object.place) {
      if (terrain) return fail(i, {}, "is a mesh on terrain: it needs a place, at or lonlat");
      return Stand{{0, 0, object.above}};
    }
    const ScenePlace& place = *object.place;
    const char* key = place.isLonLat ? "lonlat" : "at";
    Vec2 xy = place.xy;
    if (place.isLonLat) {
      if (crs_.empty()) return fail(i, key, "needs a CRS, which neither the scene nor its terrain has");
      if (!fromLonLat_) {
        Georeference target;
        if (terrain && scene_.file.crs.empty()) {
          target = terrain->georeference;
        } else {
          target.crsWkt = crs_;
        }
        ARETE_TRY(fromLonLat_, CrsTransform::fromLonLat(target));
      }
      const auto there = (*fromLonLat_)(xy);
      if (!there) return fail(i, key, "has no coordinates in the scene's CRS");
      xy = *there;
    }
    if (!terrain) return withoutTerrain(xy, place, object.above);
    const auto inTerrain = toTerrain_(xy);
    const double step = isGeographic_ ? 1e-5 : 1;
    const auto north = toTerrain_({xy.x, xy.y + step}), south = toTerrain_({xy.x, xy.y - step});
    if (!inTerrain || !north || !south || !std::isfinite(inTerrain->x + inTerrain->y))
      return fail(i, key, "has no coordinates in the terrain's CRS");
    double height = 0;
    if (place.height) {
      height = *place.height;
    } else {
      const auto ground = ground_->at(*inTerrain);
      if (!ground) return fail(i, key, "has no terrain below it to stand on; a third number states a height");
      height = ground->height;
    }
    Stand stand;
    stand.at = scene_.metricOf(metricPosition(*inTerrain, height, *terrain));
    stand.at.z += object.above;
    const Vec3 up = scene_.metricOf(metricPosition(*north, 0, *terrain)) -
                    scene_.metricOf(metricPosition(*south, 0, *terrain));
    stand.north = std::atan2(up.x, up.y) * 180 / std::numbers::pi;
    if (std::abs(stand.north) < 1e-9) stand.north = 0;  // rounding of large coordinates
    return stand;
  }

  /// The middle of the bottom of an object's box, pitched, rolled and scaled.
  Vec3 baseOf(std::size_t i) {
    const SceneObject& object = scene_.file.objects[i];
    const PlacedObject& placed = scene_.objects[i];
    const auto key = std::tuple{placed.model, placed.isYUp, object.turn.pitch, object.turn.roll};
    if (const auto known = bases_.find(key); known != bases_.end()) return known->second;
    const MultiTriangulation& mt = scene_.surfaceOf(i)->mt;
    const Similarity leaned(Turn{0, object.turn.pitch, object.turn.roll}, 1, Vec3{});
    constexpr double kFar = std::numeric_limits<double>::infinity();
    Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
    for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
      const Vec3 p = leaned(uprightPosition(mt.position(VertexId(v)), placed.isYUp));
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return bases_[key] = {low.x / 2 + high.x / 2, low.y / 2 + high.y / 2, low.z};
  }

 private:
  explicit ScenePlacer(OpenScene& scene) : scene_(scene) {}

  tl::unexpected<Error> fail(std::size_t i, std::string_view key, std::string message) const {
    return tl::unexpected(wrongPlace(scene_.file, i, key, std::move(message)).error());
  }

  Result<Stand> withoutTerrain(Vec2 xy, const ScenePlace& place, double above) {
    if (!origin_) origin_ = crs_.empty() ? Vec2{} : xy;
    return Stand{
        {(xy.x - origin_->x) * unit_, (xy.y - origin_->y) * unit_, place.height.value_or(0) + above}};
  }

  OpenScene& scene_;
  std::string crs_;
  CrsTransform toTerrain_;
  std::optional<CrsTransform> fromLonLat_;
  std::optional<GroundHeights> ground_;
  std::optional<Vec2> origin_;
  double unit_ = 1;
  bool isGeographic_ = false;
  std::map<std::tuple<std::size_t, bool, double, double>, Vec3> bases_;
};

/// Warns, once a model, where a file's own coordinates lead far away from the place: it may be on a map.
void warnOfFarMeshes(OpenScene& scene) {
  std::vector<std::uint8_t> isKnown(scene.models.size(), 0);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SurfaceModel* surface = scene.surfaceOf(i);
    if (!surface || surface->mt.vertexCount() == 0 || isKnown[scene.objects[i].model] != 0) continue;
    if (scene.file.objects[i].anchor == SceneObject::Anchor::base) continue;
    isKnown[scene.objects[i].model] = 1;
    const double away = norm(surface->mt.position(VertexId(0)));
    if (away > 100 * surface->diagonal)
      scene.warnings.push_back(
          {WarningCode::position,
           fmt::format(
               "{}: its coordinates are {:.3g} units from 0,0,0, which stands at its place: it lies that far "
               "away; the anchor \"base\" puts the mesh itself there",
               sceneCulprit(scene.file, i).substr(scene.file.path.size() + 2), away)});
  }
}

}  // namespace

Result<OpenScene> openScene(SceneFile file, const RunContext& context) try {
  OpenScene scene;
  scene.file = std::move(file);
  ARETE_CHECK(openFiles(scene, context));
  ARETE_CHECK(checkTerrains(scene));
  ARETE_TRY(auto placer, ScenePlacer::of(scene));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SurfaceModel* surface = scene.surfaceOf(i);
    if (!surface) continue;
    if (context.cancelled()) return failure(ErrorCode::interrupted, "opening the scene was stopped");
    const SceneObject& stated = scene.file.objects[i];
    scene.objects[i].isYUp = (stated.up.empty() ? surface->up : stated.up) == "y";
    ARETE_TRY(const auto stand, placer.standOf(i));
    Turn turn = stated.turn;
    turn.heading += stand.north;

    const Vec3 anchor = stated.anchor == SceneObject::Anchor::base
                            ? Similarity(Turn{turn.heading, 0, 0}, stated.scale, Vec3{})(placer.baseOf(i))
                            : Vec3{};
    scene.objects[i].turn = turn;
    scene.objects[i].placement = Similarity(turn, stated.scale, stand.at - anchor);
  }
  warnOfFarMeshes(scene);
  return scene;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
