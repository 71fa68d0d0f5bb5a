// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/scene/open_scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <system_error>
#include <utility>
#include <variant>

#include "io/geo/crs/names.h"
#include "io/geo/crs/transform.h"
#include "io/query/source/any_model.h"
#include "terrain/locate/ground_height.h"

namespace arete {
namespace {

/// The same for all paths that lead to one file.
std::string identityOf(const std::string& file) {
  std::error_code failed;
  const auto real = std::filesystem::canonical(file, failed);
  return failed ? file : real.string();
}

Error inObject(const Error& error, const StatedObject& object) {
  Error named = error;
  named.culprit = error.culprit.empty() || error.culprit == object.file
                      ? fmt::format("\"{}\", {}", object.name, object.file)
                      : fmt::format("\"{}\", {}", object.name, error.culprit);
  return named;
}

tl::unexpected<Error> refused(std::string sentence, const SceneFile& file, const StatedObject& object,
                              ErrorCode code = ErrorCode::invalidData) {
  return failure(code, std::move(sentence), fmt::format("{}, \"{}\"", file.path, object.name));
}

/// Finds where objects stand on a terrain, or in a space without one.
class Places {
 public:
  Places(const SceneFile& file, const TerrainModel* terrain) : file_(file), terrain_(terrain) {
    if (terrain) heights_.emplace(*terrain);
  }

  Status find(PlacedObject& object) {
    const StatedObject& stated = object.stated;
    object.xy = stated.place;
    if (stated.isLonLat || (terrain_ && !file_.crs.empty())) {
      ARETE_TRY(const CrsTransform* const toTerrain, transformOf(stated));
      const auto xy = (*toTerrain)(stated.place);
      if (!xy) return refused("its place is outside the CRS of the terrain", file_, stated);
      object.xy = *xy;
    } else if (terrain_) {
      object.xy = LongitudeTurns(*terrain_)(stated.place);
    }
    if (stated.height) {
      object.height = *stated.height;
      return {};
    }
    if (!terrain_) {
      object.height = stated.above;
      return {};
    }
    const auto ground = heights_->at(object.xy);
    if (!ground)
      return refused(fmt::format("it stands on the ground, and there is none at {:.10g}, {:.10g}",
                                 object.xy.x, object.xy.y),
                     file_, stated);
    object.height = ground->height + stated.above;
    return {};
  }

 private:
  Result<const CrsTransform*> transformOf(const StatedObject& stated) {
    std::optional<CrsTransform>& made = stated.isLonLat ? fromLonLat_ : fromScene_;
    if (made) return &*made;
    if (!terrain_)
      return refused("longitude and latitude need a terrain with a CRS", file_, stated, ErrorCode::usage);
    auto transform = stated.isLonLat ? CrsTransform::fromLonLat(terrain_->georeference)
                                     : CrsTransform::between(file_.crs, terrain_->georeference.crsWkt);
    if (!transform) return refused(transform.error().describe(), file_, stated, transform.error().code);
    transform->setTurns(LongitudeTurns(*terrain_));
    made = std::move(*transform);
    return &*made;
  }

  const SceneFile& file_;
  const TerrainModel* terrain_;
  std::optional<GroundHeights> heights_;
  std::optional<CrsTransform> fromLonLat_, fromScene_;
};

}  // namespace

const TerrainModel* OpenScene::terrain() const {
  return ground ? std::get_if<TerrainModel>(models[objects[*ground].model].get()) : nullptr;
}

Result<SceneRead> openScene(const SceneFile& file, const RunContext& context) {
  SceneRead read;
  OpenScene& scene = read.scene;
  std::map<std::string, std::size_t> opened;
  for (std::size_t i = 0; i < file.objects.size(); ++i) {
    const StatedObject& stated = file.objects[i];
    const auto [at, isNew] = opened.try_emplace(identityOf(stated.file), scene.models.size());
    if (isNew) {
      auto model = openAnyModel(stated.file, {}, context);
      if (!model) return tl::unexpected(inObject(model.error(), stated));
      for (Warning& warning : model->warnings) {
        warning.sentence = fmt::format("{}: {}", stated.file, warning.sentence);
        read.warnings.push_back(std::move(warning));
      }
      scene.models.push_back(std::make_shared<const Model>(std::move(model->model)));
      scene.files.push_back(stated.file);
    }
    const bool isTerrain = std::holds_alternative<TerrainModel>(*scene.models[at->second]);
    if (isTerrain && stated.hasPlace)
      return refused("it is a terrain, which lies where its coordinates say", file, stated);
    if (isTerrain && !scene.ground) scene.ground = i;
    scene.objects.push_back({stated, at->second});
  }
  const TerrainModel* const terrain = scene.terrain();
  Places places(file, terrain);
  for (PlacedObject& object : scene.objects) {
    if (const auto* other = std::get_if<TerrainModel>(scene.models[object.model].get())) {
      const auto& a = terrain->georeference.crsWkt;
      const auto& b = other->georeference.crsWkt;
      if (a != b && compareCrs(a, b) == CrsAgreement::different)
        return refused(fmt::format("it is in the CRS {}, the first terrain in {}", crsName(b), crsName(a)),
                       file, object.stated);
      continue;
    }
    if (!object.stated.hasPlace && terrain)
      return refused("it has no place: at or lonlat", file, object.stated);
    ARETE_CHECK(places.find(object));
  }
  return read;
}

}  // namespace arete
