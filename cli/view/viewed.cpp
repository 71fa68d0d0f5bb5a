// SPDX-License-Identifier: GPL-3.0-or-later
//
// Subjects are made before there is a context of OpenGL, as home views and flights need them; drawables
// afterwards, by functions that keep the models.
#include "cli/view/viewed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/surface/camera.h"
#include "cli/view/beside.h"
#include "io/geo/crs/data_unit.h"
#include "io/query/extract/camera_argument.h"
#include "io/query/extract/query_footprint.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/heights/contour_labels.h"
#include "viewer/inks/distance_colors.h"
#include "viewer/layers/contour_heights.h"
#include "viewer/pages/paged_drawable.h"
#include "viewer/scene/scene_subject.h"
#include "viewer/surface/surface_drawable.h"

namespace arete {
namespace {

/// Null where none are stated.
Result<std::shared_ptr<const TerrainColors>> statedColors(const ViewArguments& a, const TerrainModel& model,
                                                          Session& session) {
  if (!a.appearance.colors.isStated()) return nullptr;
  Warnings said;
  ARETE_TRY(const TerrainColors colors, a.appearance.colors.of(a.appearance.color, model, said));
  session.warn(said, a.appearance.colors.ramp);
  return std::make_shared<const TerrainColors>(colors);
}

TerrainDrawable::Options terrainOptions(const ViewArguments& a) {
  return {.path = a.detail.isCutByProcessor() ? CutPath::processor : CutPath::device,
          .heights = {.mostBytes = std::uint64_t(a.appearance.groundMebibytes) << 20}};
}

Result<Viewed> viewedTerrain(const ViewArguments& a, std::shared_ptr<const TerrainModel> model,
                             Session& session) {
  const auto subject = std::make_shared<const TerrainSubject>(*model);
  ARETE_CHECK(checkGroundUnits(model->georeference, {a.appearance.hazeWithUnit}));
  Viewed viewed{.subject = subject,
                .finestTriangles = model->mt.finestTriangleCount(),
                .georeference = model->georeference,
                .turns = LongitudeTurns(*model),
                .source = model->source,
                .addModel = {}};
  if (!a.viewpoint.camera.empty()) {
    ARETE_TRY(const auto toDem, transformOfPlaces(a.viewpoint.isLonLat, *model));
    ARETE_TRY(CameraArgument stated,
              readCameraArgument("--camera", a.viewpoint.camera, toDem, *subject->heights()));
    viewed.camera = stated.camera;
  }
  if (const std::string word = a.appearance.colors.wordOfSea(a.appearance.color, *model);
      !word.empty() && a.appearance.drapes.empty())
    session.warn(Warnings{{WarningCode::display, word}}, a.model);
  ARETE_TRY(viewed.colors, statedColors(a, *model, session));
  ARETE_TRY(StatedLayers readLayers, StatedLayers::read(a.appearance, model, session));
  const auto layers = std::make_shared<const StatedLayers>(std::move(readLayers));
  viewed.layers = layers;
  double interval = a.appearance.contours;
  if (const std::string& stated = a.appearance.contoursWithUnit; !stated.empty()) {
    ARETE_TRY(interval, inDataUnit(StatedLength{.number = interval, .unitMetres = 1},
                                   heightUnitOf(model->georeference), stated));
  }
  viewed.addModel = [&a, &session, model, subject, layers, interval,
                     ground = viewed.ground](Scene& scene) -> Status {
    ARETE_TRY(TerrainDrawable made, TerrainDrawable::create(subject, terrainOptions(a), session.context()));
    const HeightsOnGpu& heights = made.painter().heights();
    *ground = {{"bytes", heights.bytes()}, {"level", heights.finestLevel()}};
    ARETE_CHECK(scene.add(std::make_unique<TerrainDrawable>(std::move(made))));
    ARETE_CHECK(layers->addTo(scene, *model, session));
    if (interval > 0) scene.layers.put("contours", Contours{interval});
    return {};
  };
  viewed.heightsOfContours = [model](double every) -> Result<Layer::Drawn> {
    ARETE_TRY(const std::vector<ContourLabel> labels, contourLabels(*model, every));
    ARETE_TRY(auto written, ContourHeights::create(labels));
    return Layer::Drawn(std::move(written));
  };
  return viewed;
}

/// Of a stated camera, the ground below it read for its height.
Result<Camera> cameraOverPages(const ViewArguments& a, const TerrainPages& pages, Session& session) {
  const TerrainModel& outline = *pages.outline();
  ARETE_TRY(const auto toDem, transformOfPlaces(a.viewpoint.isLonLat, outline));
  ARETE_TRY(const Vec2 place, readCameraPlace("--camera", a.viewpoint.camera, toDem));
  QueryFootprint below(outline);
  below.add(outline.toPlan(place));
  ARETE_TRY(const TerrainModel ground, pages.file().read({.wanted = below.within(0)}, session.context()));
  const GroundHeights heights(ground);
  ARETE_TRY(const CameraArgument stated, readCameraArgument("--camera", a.viewpoint.camera, toDem, heights));
  if (const auto there = heights.at(stated.camera.xy); there && stated.camera.height < there->height)
    session.warn(
        fmt::format("the camera stands {} under the ground",
                    withUnit(there->height - stated.camera.height, outline.georeference.verticalUnit)));
  return stated.camera;
}

Result<Viewed> viewedPages(const ViewArguments& a, std::unique_ptr<TerrainPages> opened, Session& session) {
  const std::shared_ptr<const TerrainModel> outline = opened->outline();
  const auto subject = std::make_shared<PagedTerrainSubject>(outline);
  ARETE_CHECK(checkGroundUnits(outline->georeference, {a.appearance.hazeWithUnit}));
  Viewed viewed{.subject = subject,
                .finestTriangles = opened->file().summary().finestTriangles,
                .georeference = outline->georeference,
                .turns = LongitudeTurns(*outline),
                .source = outline->source,
                .isOfPages = true,
                .addModel = {}};
  if (!a.viewpoint.camera.empty()) {
    ARETE_TRY(viewed.camera, cameraOverPages(a, *opened, session));
  }
  if (const std::string word = a.appearance.colors.wordOfSea(a.appearance.color, *outline); !word.empty())
    session.warn(Warnings{{WarningCode::display, word}}, a.model);
  ARETE_TRY(viewed.colors, statedColors(a, *outline, session));
  const std::shared_ptr<TerrainPages> pages = std::move(opened);
  viewed.addModel = [&a, &session, pages, subject](Scene& scene) -> Status {
    ARETE_TRY(PagedTerrain made, drawPaged(std::move(*pages), subject, terrainOptions(a), session.context()));
    return scene.add(std::make_unique<PagedTerrain>(std::move(made)));
  };
  return viewed;
}

/// Of a typed camera, in a space of the unit of a file.
Result<std::optional<Camera>> statedCamera(const ViewArguments& a, const CameraSpace& space,
                                           const std::function<Vec3(const Vec3&)>& fromFile) {
  if (a.viewpoint.camera.empty()) return std::optional<Camera>();
  ARETE_TRY(const SurfaceCameraArgument stated, readSurfaceCamera(a.viewpoint.camera));
  const Vec3 eye = fromFile(stated.camera.eye);
  const Look look = space.lookAlong(fromFile(stated.camera.target) - eye);
  Camera camera = space.at({}, eye);
  camera.azimuthDegrees = look.azimuthDegrees;
  camera.pitchDegrees = look.pitchDegrees;
  if (stated.statesFieldOfView) camera.verticalFieldOfViewDegrees = stated.camera.verticalFieldOfViewDegrees;
  if (const Result<View> view = arete::viewOf(camera, space); !view)
    return failure(view.error().code, view.error().message, "--camera " + a.viewpoint.camera);
  return std::optional(camera);
}

/// The camera that is stated of a surface by itself.
Result<std::optional<Camera>> cameraAt(const ViewArguments& a, const SurfaceSubject& subject) {
  const Similarity there = placed(subject.placement(), nullptr);
  return statedCamera(a, subject.space(),
                      [&](const Vec3& p) { return there(subject.upright().fromFile(p)); });
}

Result<Viewed> viewedSurface(const ViewArguments& a, SurfaceModel opened) {
  const auto model = std::make_shared<const SurfaceModel>(std::move(opened));
  const auto form = std::make_shared<const SurfaceForm>(*model, ZUpFrame(*model, a.viewpoint.up));
  ARETE_TRY(const Turn turn, a.viewpoint.turnAngles());
  const auto subject = std::make_shared<SurfaceSubject>(form, turn);
  Viewed viewed{.subject = subject,
                .finestTriangles = model->mt.finestTriangleCount(),
                .files = {a.model},
                .addModel = [model, subject](Scene& scene) -> Status {
                  ARETE_TRY(auto assets, SurfaceAssets::create(*model, subject->upright()));
                  return scene.add(std::make_unique<SurfaceDrawable>(std::move(assets), subject));
                }};
  if (a.appearance.hasInk()) {
    auto ink = subject->ink(a.appearance.color);
    if (!ink) ink.error().culprit = "--color " + ink.error().culprit;
    ARETE_CHECK(ink);
  }
  ARETE_TRY(viewed.camera, cameraAt(a, *subject));
  return viewed;
}

Result<Viewed> viewedPages(const ViewArguments& a, std::unique_ptr<SurfacePages> opened) {
  const std::shared_ptr<const SurfaceModel> outline = opened->outline();
  ARETE_TRY(const Turn turn, a.viewpoint.turnAngles());
  const SurfaceFacts& facts = opened->file().facts();
  const auto subject = std::make_shared<PagedSurfaceSubject>(outline, ZUpFrame(*outline, a.viewpoint.up),
                                                             turn, facts.vertices);
  Viewed viewed{.subject = subject,
                .finestTriangles = outline->finestTriangles(),
                .files = {a.model},
                .isOfPages = true,
                .addModel = {}};
  ARETE_TRY(viewed.camera, cameraAt(a, *subject));
  const std::shared_ptr<SurfacePages> pages = std::move(opened);
  viewed.addModel = [pages, subject](Scene& scene) -> Status {
    ARETE_TRY(PagedSurface made, drawPaged(std::move(*pages), subject));
    return scene.add(std::make_unique<PagedSurface>(std::move(made)));
  };
  return viewed;
}

/// Where an object stands in the metric space of the scene: on the middle of the bottom of its box, which is
/// also what it turns about.
Placement placementOf(const OpenScene& scene, std::size_t i, const SurfaceForm& form, const Subject* ground) {
  const SceneObject& stated = scene.file.objects[i];
  const MetricBox& box = form.shape.box;
  const Vec3 middle = box.centre();
  Placement placement;
  placement.pivot = {middle.x, middle.y, box.low.z};
  // Headings of a scene are from the y of its space, of a placement from the north of the terrain's grid.
  placement.turn = scene.objects[i].turn;
  if (ground) {
    const Vec3 north = scene.metricOf(ground->space().forward({0, 0}));
    placement.turn.heading -= std::atan2(north.x, north.y) * 180 / std::numbers::pi;
  }
  placement.scale = stated.scale;
  const Vec3 inFile = uprightPosition(form.upright.toFile(placement.pivot), scene.objects[i].isYUp);
  placement.anchor = scene.metricOf(scene.objects[i].placement(inFile));
  return placement;
}

std::optional<HandLevel> levelOf(const SceneLevel& level) {
  if (!level.isStated()) return std::nullopt;
  constexpr std::uint64_t kMost = 0xFFFFFFFF;
  return HandLevel{.error = level.error.value_or(0),
                   .triangles = std::uint32_t(std::min(level.triangles.value_or(0), kMost))};
}

ShownObject shownObjectOf(const SceneObject& stated) {
  return {.name = stated.name,
          .toleranceFactor = stated.tolerance,
          .level = levelOf(stated.level),
          .isShown = stated.isVisible};
}

/// The subjects of a scene, before anything is drawn.
struct SceneParts {
  OpenScene scene;
  std::vector<std::shared_ptr<const Subject>> subjects;   // by object
  std::vector<std::shared_ptr<SurfaceSubject>> surfaces;  // the same, as they can be moved; null of a terrain
  std::unique_ptr<SceneSubject> all;

  const SurfaceModel* surface(std::size_t model) const {
    return std::get_if<SurfaceModel>(scene.models[model].get());
  }
};

/// A terrain that the scene keeps.
std::shared_ptr<const TerrainModel> terrainOf(const OpenScene& scene, std::size_t model) {
  return {scene.models[model], std::get_if<TerrainModel>(scene.models[model].get())};
}

Result<Viewed> viewedScene(const ViewArguments& a, OpenScene opened, Session& session) {
  const auto parts = std::make_shared<SceneParts>();
  parts->scene = std::move(opened);
  const OpenScene& scene = parts->scene;
  Viewed viewed;
  std::shared_ptr<const Subject> ground;  // terrain, which nothing turns
  FillScene addGround;
  if (scene.terrain) {
    ARETE_TRY(viewed, viewedTerrain(a, terrainOf(scene, scene.objects[*scene.terrain].model), session));
    ground = viewed.subject;
    addGround = viewed.addModel;
    viewed.finestTriangles = 0;
  }
  // One for each file and axis that is up in it.
  std::map<std::pair<std::size_t, bool>, std::shared_ptr<const SurfaceForm>> forms;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const PlacedObject& object = scene.objects[i];
    const bool isSurface = parts->surface(object.model) != nullptr;
    viewed.files.push_back(isSurface ? scene.paths[object.model] : std::string());
    if (const SurfaceModel* const surface = parts->surface(object.model)) {
      auto& form = forms[{object.model, object.isYUp}];
      if (!form)
        form = std::make_shared<const SurfaceForm>(*surface, ZUpFrame(*surface, scene.file.objects[i].up));
      parts->surfaces.push_back(
          std::make_shared<SurfaceSubject>(form, placementOf(scene, i, *form, ground.get()), ground.get()));
      parts->subjects.push_back(parts->surfaces.back());
      viewed.finestTriangles += surface->mt.finestTriangleCount();
    } else {
      const auto terrain = terrainOf(scene, object.model);
      parts->surfaces.push_back(nullptr);
      parts->subjects.push_back(i == *scene.terrain ? ground
                                                    : std::make_shared<const TerrainSubject>(*terrain));
      viewed.finestTriangles += terrain->mt.finestTriangleCount();
    }
  }
  std::vector<const Subject*> subjects;
  for (const auto& subject : parts->subjects) subjects.push_back(subject.get());
  parts->all = std::make_unique<SceneSubject>(std::move(subjects));
  viewed.subject = {parts, parts->all.get()};
  if (!ground) {
    ARETE_TRY(viewed.camera, statedCamera(a, parts->all->space(), [](const Vec3& p) { return p; }));
  }

  viewed.addModel = [&a, &session, parts, addGround, distances = viewed.distances](Scene& shown) -> Status {
    ColoredDistances colored;
    if (a.viewpoint.hasDistances) {
      ARETE_TRY(colored, distancesOf(parts->scene, session.context()));
      *distances = colored.json;
    }
    std::map<std::pair<std::size_t, bool>, std::shared_ptr<SurfaceAssets>> assets;
    for (std::size_t i = 0; i < parts->subjects.size(); ++i) {
      const PlacedObject& object = parts->scene.objects[i];
      if (parts->scene.terrain == i) {
        ARETE_CHECK(addGround(shown));
        shown.objects().back() = shownObjectOf(parts->scene.file.objects[i]);
        continue;
      }
      if (!parts->surface(object.model)) {
        ARETE_TRY(TerrainDrawable made,
                  TerrainDrawable::create(std::static_pointer_cast<const TerrainSubject>(parts->subjects[i]),
                                          terrainOptions(a), session.context()));
        ARETE_CHECK(shown.add(std::make_unique<TerrainDrawable>(std::move(made)),
                              shownObjectOf(parts->scene.file.objects[i])));
        continue;
      }
      const auto& subject = parts->surfaces[i];
      std::shared_ptr<SurfaceAssets> own;  // colours are of one object
      auto& shared = a.viewpoint.hasDistances ? own : assets[{object.model, object.isYUp}];
      if (!shared) {
        ARETE_TRY(shared, SurfaceAssets::create(
                              subject->model(), subject->upright(),
                              a.viewpoint.hasDistances ? colored.colors[i] : std::vector<std::uint8_t>()));
      }
      ARETE_CHECK(shown.add(std::make_unique<SurfaceDrawable>(shared, subject),
                            shownObjectOf(parts->scene.file.objects[i])));
    }
    if (!a.viewpoint.beside.empty())
      for (std::size_t i = 0; i < shown.objects().size(); ++i) shown.objects()[i].pane = int(i);
    if (a.viewpoint.hasDistances)
      shown.layers.put(kDistanceLayer, SpaceVertices{}).legend = std::move(colored.legend);
    return {};
  };
  return viewed;
}

}  // namespace

Result<Viewed> viewedOf(const ViewArguments& a, Opened opened, Session& session) {
  if (auto* terrain = std::get_if<TerrainModel>(&opened))
    return viewedTerrain(a, std::make_shared<const TerrainModel>(std::move(*terrain)), session);
  if (auto* pages = std::get_if<std::unique_ptr<TerrainPages>>(&opened))
    return viewedPages(a, std::move(*pages), session);
  if (auto* pages = std::get_if<std::unique_ptr<SurfacePages>>(&opened))
    return viewedPages(a, std::move(*pages));
  if (auto* surface = std::get_if<SurfaceModel>(&opened)) return viewedSurface(a, std::move(*surface));
  return viewedScene(a, std::get<OpenScene>(std::move(opened)), session);
}

}  // namespace arete
