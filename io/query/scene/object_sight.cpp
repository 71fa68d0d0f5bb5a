// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each object has a ball around it in metric space. The part of a line over the ball is cut at the corners of
// its track and into chords short enough; each chord, carried into the object's own space, is followed
// through its multitriangulation to the finest triangles (surface/rays). Nothing is decided on a coarse
// front.
#include "io/query/scene/object_sight.h"

#include <algorithm>
#include <cmath>

#include "engine/base/caught_failure.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/shared_progress.h"
#include "engine/parallel/with_threads.h"
#include "io/query/scene/placed_surface.h"
#include "surface/rays/first_hit.h"

namespace arete {
namespace {

constexpr std::size_t kPathsPerTask = 8;

struct Obstacle {
  std::size_t object = 0;
  const MultiTriangulation* mt = nullptr;
  Similarity toScene, fromScene;
  Vec3 centre;  // of its ball in metric space
  double radius = 0;
};

Vec3 metricOf(const MetricFrame& metric, Vec2 plan, double height) {
  return metric.toMetric({plan.x, plan.y, height});
}

std::vector<Obstacle> obstaclesOf(const OpenScene& scene) {
  std::vector<Obstacle> all;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const PlacedObject& object = scene.objects[i];
    const auto* const surface = std::get_if<SurfaceModel>(scene.models[object.model].get());
    if (!surface || !object.stated.isShown) continue;
    Obstacle made;
    made.object = i;
    made.mt = &surface->mt;
    made.toScene = placedInScene(object, *surface, scene.terrain());
    made.fromScene = made.toScene.inverse();
    double squared = 0;
    for (std::uint32_t v = 0; v < surface->mt.vertexCount(); ++v) {
      const Vec3 p = surface->mt.metric().toMetric(surface->mt.position(VertexId(v)));
      squared = std::max(squared, dot(p, p));
    }
    made.centre = made.toScene({});
    made.radius = std::sqrt(squared) * made.toScene.scale() * (1 + 1e-9) + kChordSag;
    all.push_back(made);
  }
  return all;
}

/// One line against the obstacles.
class LineOfSight {
 public:
  LineOfSight(const SightLine& line, const MetricFrame& metric) : line_(line), metric_(metric) {
    const double k = std::abs(line.track().curvature);
    // The second derivative of the height in metres is at most the sag, of steep lines far more than k.
    const double bend = std::max(line.sag() * line.heightUnitMetres(), k);
    longest_ = bend > 0 ? std::sqrt(8 * kChordSag / bend) : INFINITY;
  }

  /// The distance along the ground at which it meets the obstacle first, before `most`.
  std::optional<double> hit(const Obstacle& obstacle, double most) const {
    if (!(line_.length() > 0)) return hitUpright(obstacle);
    const auto points = line_.points();
    for (std::size_t leg = 0; leg + 1 < points.size(); ++leg) {
      const SightPoint &a = points[leg], &b = points[leg + 1];
      if (!(b.distance > a.distance) || a.distance > most) continue;
      const Vec3 from = metricOf(metric_, a.plan, 0), to = metricOf(metric_, b.plan, 0);
      const auto part = overBall(from, to, obstacle);
      if (!part) continue;
      const double s0 = a.distance + part->first * (b.distance - a.distance),
                   s1 = a.distance + part->second * (b.distance - a.distance);
      const auto count = std::max(1.0, std::ceil((s1 - s0) / longest_));
      Vec3 start = at(s0);
      double before = s0;
      for (double i = 1; i <= count; ++i) {
        const double after = i == count ? s1 : s0 + (s1 - s0) * (i / count);
        const Vec3 end = at(after);
        if (const auto along = chordHit(obstacle, start, end)) return before + *along * (after - before);
        start = end;
        before = after;
      }
    }
    return std::nullopt;
  }

 private:
  Vec3 at(double s) const { return metricOf(metric_, line_.planAt(s), line_.height(s)); }

  /// The part of a leg, 0 to 1, that is over or below a ball in plan.
  static std::optional<std::pair<double, double>> overBall(const Vec3& from, const Vec3& to,
                                                           const Obstacle& obstacle) {
    const double x = to.x - from.x, y = to.y - from.y, length2 = x * x + y * y;
    const double toX = obstacle.centre.x - from.x, toY = obstacle.centre.y - from.y;
    if (!(length2 > 0)) return std::nullopt;
    const double middle = (toX * x + toY * y) / length2;
    const double offX = toX - middle * x, offY = toY - middle * y;
    const double left = obstacle.radius * obstacle.radius - (offX * offX + offY * offY);
    if (left < 0) return std::nullopt;
    const double half = std::sqrt(left / length2), first = std::max(middle - half, 0.0),
                 last = std::min(middle + half, 1.0);
    if (!(first < last)) return std::nullopt;
    return std::pair{first, last};
  }

  std::optional<double> chordHit(const Obstacle& obstacle, const Vec3& start, const Vec3& end) const {
    const double low = std::min(start.z, end.z), high = std::max(start.z, end.z);
    if (low > obstacle.centre.z + obstacle.radius || high < obstacle.centre.z - obstacle.radius)
      return std::nullopt;
    // What is near an end of the whole line is passed over.
    const double length = norm(end - start);
    double least = 0, most = 1;
    const Vec3 first = at(0), last = at(line_.length());
    if (norm(start - first) <= kFreeAtEnds) least = (kFreeAtEnds - norm(start - first)) / length;
    if (norm(end - last) <= kFreeAtEnds) most = 1 - (kFreeAtEnds - norm(end - last)) / length;
    if (!(length > 0) || !(least <= most)) return std::nullopt;
    const Vec3 from = obstacle.fromScene(start), way = obstacle.fromScene(end) - from;
    const auto found = firstHit(*obstacle.mt, from, way, least, most);
    return found ? std::optional(found->along) : std::nullopt;
  }

  /// Of two ends in one place.
  std::optional<double> hitUpright(const Obstacle& obstacle) const {
    const Vec2 plan = line_.points().front().plan;
    const Vec3 low = metricOf(metric_, plan, std::min(line_.fromHeight(), line_.toHeight())),
               high = metricOf(metric_, plan, std::max(line_.fromHeight(), line_.toHeight()));
    const double length = high.z - low.z;
    if (!(length > 2 * kFreeAtEnds)) return std::nullopt;
    const Vec3 from = obstacle.fromScene(low), way = obstacle.fromScene(high) - from;
    const double free = kFreeAtEnds / length;
    return firstHit(*obstacle.mt, from, way, free, 1 - free) ? std::optional(0.0) : std::nullopt;
  }

  const SightLine& line_;
  MetricFrame metric_;
  double longest_;  // chord, metres
};

}  // namespace

Result<std::vector<std::optional<ObjectHit>>> hitObjects(std::span<const SightPath> paths,
                                                         const SightEarth& earth, const OpenScene& scene,
                                                         const RunContext& context) try {
  std::vector<std::optional<ObjectHit>> hits(paths.size());
  const TerrainModel& terrain = *scene.terrain();
  const std::vector<Obstacle> obstacles = obstaclesOf(scene);
  SharedProgress progress(context, "objects", paths.size());
  withThreads(context, [&] {
    parallelFor(IndexRange<std::size_t>(0, paths.size(), kPathsPerTask), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end() && !context.cancelled(); ++i) {
        const auto line = sightLine(paths[i], earth, terrain);
        if (!line) continue;
        const LineOfSight sight(*line, terrain.mt.metric());
        double nearest = INFINITY;
        for (const Obstacle& obstacle : obstacles) {
          const auto s = sight.hit(obstacle, nearest);
          if (!s || !(*s < nearest)) continue;
          nearest = *s;
          const double height = line->height(nearest);
          hits[i] = ObjectHit{obstacle.object, {nearest, line->planAt(nearest), height, height}};
        }
      }
      progress.add(range.size());
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the query was stopped");
  return hits;
} catch (...) {
  return caughtFailure();
}

bool joinHit(SightAnswer& answer, const ObjectHit& hit) {
  const bool isNearer = !answer.obstruction || hit.place.distance < answer.obstruction->distance;
  answer.verdict = SightVerdict::blocked;
  if (!isNearer) return false;
  answer.obstruction = hit.place;
  answer.isObstructionLatest = false;
  return true;
}

}  // namespace arete
