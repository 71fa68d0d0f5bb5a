// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two trees of boxes: of the objects in the scene, and of the triangles of each model in the model's own
// space, which instances share. Chords of the line find boxes, and may miss the curve by what the boxes are
// grown by; whether a triangle is in the way is then decided with the curve itself, in the scene's space.
#include "io/query/sight/scene_sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/cut/cut.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "io/query/sight/crossing.h"
#include "io/query/sight/mesh_boxes.h"

namespace arete {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();
/// Largest distance of the line from its chords: of an object's size, and in metres among objects.
constexpr double kSagOfObject = 1e-5, kSagOfScene = 0.1;
/// Legs overlap by this at their joints, in metres, so that no rounding opens a gap between them.
constexpr double kOverlap = 1e-6;

/// A model's triangles in its upright space.
struct SightMesh {
  std::vector<Vec3> places;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  SightBox box;
  double size = 0;
  std::unique_ptr<MeshBoxes> boxes;
};

SightMesh sightMesh(const SurfaceModel& model, bool isYUp) {
  const MultiTriangulation& mt = model.mt;
  const Cut cut = frontOfPrefix(mt, mt.nodeCount());
  SightMesh mesh;
  mesh.box = {{kFarAway, kFarAway, kFarAway}, {-kFarAway, -kFarAway, -kFarAway}};
  mesh.places.reserve(cut.vertices.size());
  for (const std::uint32_t v : cut.vertices) {
    mesh.places.push_back(uprightPosition(mt.position(VertexId(v)), isYUp));
    mesh.box.add(mesh.places.back());
  }
  std::vector<SightBox> boxes;
  boxes.reserve(cut.triangles.size());
  mesh.triangles.reserve(cut.triangles.size());
  for (const auto& t : cut.triangles) {
    mesh.triangles.push_back({t[0], t[1], t[2]});
    SightBox box{mesh.places[t[0]], mesh.places[t[0]]};
    box.add(mesh.places[t[1]]);
    box.add(mesh.places[t[2]]);
    boxes.push_back(box);
  }
  mesh.size = norm(mesh.box.high - mesh.box.low);
  mesh.boxes = std::make_unique<MeshBoxes>(boxes, 2 * kSagOfObject * mesh.size);
  return mesh;
}

struct Obstacle {
  std::size_t object = 0;
  const SightMesh* mesh = nullptr;
  Similarity placement, back;
  SightBox box;    ///< in the scene
  double sag = 0;  ///< metres
};

/// A line in the scene's space.
class LineInScene {
 public:
  LineInScene(const SightLine& line, const MetricFrame& frame, bool isMirrored)
      : line_(line), frame_(frame), isMirrored_(isMirrored) {
    const auto points = line.points();
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Vec2 from = placeOf(points[i - 1].plan), to = placeOf(points[i].plan);
      const double s0 = points[i - 1].distance, s1 = points[i].distance;
      if (!(s1 > s0)) continue;
      legs_.push_back({from,
                       {to.x - from.x, to.y - from.y},
                       s0,
                       s1 - s0,
                       i == 1 ? s0 : s0 - kOverlap,
                       i + 1 == points.size() ? s1 : s1 + kOverlap});
    }
    for (SceneLeg& leg : legs_) {
      leg.first = std::max(leg.first, 0.0);
      leg.last = std::min(leg.last, line.length());
    }
  }

  const SightLine& line() const { return line_; }
  const std::vector<SceneLeg>& legs() const { return legs_; }
  bool isUpright() const { return legs_.empty(); }
  Vec2 start() const { return placeOf(line_.points().front().plan); }

  double metric(double height) const { return (height - frame_.origin.z) * frame_.scale.z; }
  Vec3 at(const SceneLeg& leg, double s, double raised) const {
    const double t = (s - leg.s0) / leg.ds;
    return {leg.from.x + t * leg.step.x, leg.from.y + t * leg.step.y, metric(line_.height(s) + raised)};
  }

  /// Calls visit(a, b) for chords between two distances of a leg, which the line is within `sag` metres of.
  template <class Visit>
  void forChords(const SceneLeg& leg, double s0, double s1, double sag, double raised,
                 const Visit& visit) const {
    if (s1 - s0 > 1e-6 && bend(s0, s1) > sag) {
      const double middle = s0 / 2 + s1 / 2;
      forChords(leg, s0, middle, sag, raised, visit);
      forChords(leg, middle, s1, sag, raised, visit);
    } else {
      visit(at(leg, s0, raised), at(leg, s1, raised));
    }
  }

 private:
  Vec2 placeOf(Vec2 plan) const {
    const Vec3 p = frame_.toMetric({plan.x, plan.y, 0});
    return {p.x, isMirrored_ ? -p.y : p.y};
  }
  /// How far the line is from its chord, at most, in metres.
  double bend(double s0, double s1) const {
    const double h0 = line_.height(s0), h1 = line_.height(s1);
    const double below = -std::min(0.0, line_.leastBound(s0, h0, s1, h1));
    const double above = line_.track().curvature < 0
                             ? 2 * std::max(0.0, line_.height(s0 / 2 + s1 / 2) - (h0 / 2 + h1 / 2))
                             : 0;
    return std::max(below, above) * frame_.scale.z;
  }

  const SightLine& line_;
  const MetricFrame& frame_;
  bool isMirrored_;
  std::vector<SceneLeg> legs_;
};

/// The part of a leg over the plan of a box, as distances; false: nothing.
bool rangeOverBox(const SceneLeg& leg, const SightBox& box, double& first, double& last) {
  first = leg.first;
  last = leg.last;
  for (const auto& [p, d, low, high] : {std::array{leg.from.x, leg.step.x, box.low.x, box.high.x},
                                        std::array{leg.from.y, leg.step.y, box.low.y, box.high.y}}) {
    if (d == 0) {
      if (p < low || p > high) return false;
      continue;
    }
    double s0 = leg.s0 + (low - p) / d * leg.ds, s1 = leg.s0 + (high - p) / d * leg.ds;
    if (s0 > s1) std::swap(s0, s1);
    first = std::max(first, s0);
    last = std::min(last, s1);
  }
  return first <= last;
}

/// Where an object is first in the way of the raised line: a distance, or of an upright line how far its
/// height is from the first end.
std::optional<double> firstOf(const Obstacle& obstacle, const LineInScene& line, const MetricFrame& frame,
                              double raised) {
  const LineCrossing crossing(line.line(), frame, raised);
  const SightMesh& mesh = *obstacle.mesh;
  double nearest = kFarAway;
  const auto cornersOf = [&](std::uint32_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    return std::array{obstacle.placement(mesh.places[a]), obstacle.placement(mesh.places[b]),
                      obstacle.placement(mesh.places[c])};
  };
  if (line.isUpright()) {
    const Vec2 p = line.start();
    const double from = line.line().fromHeight(), to = line.line().toHeight();
    mesh.boxes->along(obstacle.back({p.x, p.y, line.metric(from)}),
                      obstacle.back({p.x, p.y, line.metric(to)}), [&](std::uint32_t t) {
                        if (const auto z = crossing.upright(p, cornersOf(t)))
                          nearest = std::min(nearest, std::abs(*z - from));
                      });
  } else {
    for (const SceneLeg& leg : line.legs()) {
      double first = 0, last = 0;
      if (!rangeOverBox(leg, obstacle.box, first, last)) continue;
      line.forChords(leg, first, last, obstacle.sag, raised, [&](const Vec3& a, const Vec3& b) {
        mesh.boxes->along(obstacle.back(a), obstacle.back(b), [&](std::uint32_t t) {
          if (const auto s = crossing.along(leg, cornersOf(t))) nearest = std::min(nearest, *s);
        });
      });
    }
  }
  return std::isfinite(nearest) ? std::optional(nearest) : std::nullopt;
}

}  // namespace

struct SceneSight::State {
  const TerrainModel* terrain = nullptr;
  MetricFrame frame;
  bool isMirrored = false;
  std::map<std::pair<std::size_t, bool>, SightMesh> meshes;
  std::vector<Obstacle> obstacles;
  std::unique_ptr<MeshBoxes> boxes;  ///< of the obstacles
};

SceneSight::~SceneSight() = default;

SceneSight::SceneSight(const OpenScene& scene, const TerrainModel& plan) {
  auto state = std::make_unique<State>();
  state->terrain = &plan;
  state->frame = state->terrain->mt.metric();
  state->isMirrored = scene.isMirrored;
  std::vector<SightBox> boxes;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SurfaceModel* surface = scene.surfaceOf(i);
    if (!surface || !scene.file.objects[i].isVisible) continue;
    const PlacedObject& placed = scene.objects[i];
    const auto [mesh, isNew] = state->meshes.try_emplace({placed.model, placed.isYUp});
    if (isNew) mesh->second = sightMesh(*surface, placed.isYUp);
    Obstacle obstacle{i, &mesh->second, placed.placement, placed.placement.inverse(), {}, 0};
    obstacle.box = {{kFarAway, kFarAway, kFarAway}, {-kFarAway, -kFarAway, -kFarAway}};
    const SightBox& own = mesh->second.box;
    for (int corner = 0; corner < 8; ++corner)
      obstacle.box.add(
          placed.placement({corner & 1 ? own.high.x : own.low.x, corner & 2 ? own.high.y : own.low.y,
                            corner & 4 ? own.high.z : own.low.z}));
    obstacle.sag = kSagOfObject * mesh->second.size * placed.placement.scale();
    obstacle.box.grow(2 * obstacle.sag + 2 * kOverlap);
    boxes.push_back(obstacle.box);
    state->obstacles.push_back(std::move(obstacle));
  }
  state->boxes = std::make_unique<MeshBoxes>(boxes, 2 * kSagOfScene);
  state_ = std::move(state);
}

std::optional<MeshObstruction> SceneSight::first(const SightLine& sight) const {
  const LineInScene line(sight, state_->frame, state_->isMirrored);
  std::vector<std::uint32_t> near;
  const auto add = [&](std::uint32_t i) { near.push_back(i); };
  if (line.isUpright()) {
    const Vec2 p = line.start();
    state_->boxes->along({p.x, p.y, line.metric(sight.fromHeight())},
                         {p.x, p.y, line.metric(sight.toHeight())}, add);
  } else {
    for (const SceneLeg& leg : line.legs())
      line.forChords(leg, leg.first, leg.last, kSagOfScene, 0,
                     [&](const Vec3& a, const Vec3& b) { state_->boxes->along(a, b, add); });
  }
  std::ranges::sort(near);
  near.erase(std::ranges::unique(near).begin(), near.end());
  std::optional<MeshObstruction> best;
  double nearest = kFarAway;
  for (const std::uint32_t i : near) {
    const Obstacle& obstacle = state_->obstacles[i];
    const double tolerance = line.isUpright() ? 0 : sight.tolerance();
    const auto raised = firstOf(obstacle, line, state_->frame, tolerance);
    if (!raised) continue;
    const auto lowered = tolerance > 0 ? firstOf(obstacle, line, state_->frame, -tolerance) : raised;
    if (!lowered) continue;
    const double at = std::min(*raised, *lowered);
    if (!(at < nearest)) continue;
    nearest = at;
    const double distance = line.isUpright() ? 0 : at;
    const double height = !line.isUpright()                       ? sight.height(at)
                          : sight.toHeight() > sight.fromHeight() ? sight.fromHeight() + at
                                                                  : sight.fromHeight() - at;
    best = MeshObstruction{obstacle.object, distance, sight.planAt(distance), height};
  }
  return best;
}

Result<std::vector<std::optional<MeshObstruction>>> SceneSight::first(std::span<const SightPath> paths,
                                                                      const SightEarth& earth,
                                                                      const RunContext& context) const try {
  std::vector<std::optional<MeshObstruction>> all(paths.size());
  withThreads(context, [&] {
    parallelFor(IndexRange<std::size_t>(0, paths.size(), 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end() && !context.cancelled(); ++i)
        if (const auto line = sightLine(paths[i], earth, *state_->terrain)) all[i] = first(*line);
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the query was stopped");
  return all;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
