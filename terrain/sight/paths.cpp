// SPDX-License-Identifier: GPL-3.0-or-later
//
// Engines are prepared for the terrain alone. With clutter, a line is evaluated over its whole profile,
// raised by the clutter.
#include "terrain/sight/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/shared_progress.h"
#include "engine/parallel/with_threads.h"
#include "terrain/sight/judge.h"

namespace arete {
namespace {

constexpr std::size_t kPathsPerTask = 8;

/// The profile raised by the clutter, with steps where that begins and ends.
Profile withClutter(const Profile& profile, const SightClutter& clutter) {
  Profile high = profile;
  high.vertices.clear();
  const double first = clutter.freeMetres, last = profile.length - clutter.freeMetres;
  if (!profile.vertices.empty()) high.vertices.push_back(profile.vertices.front());
  for (std::size_t i = 1; i < profile.vertices.size(); ++i) {
    const ProfileVertex &p = profile.vertices[i - 1], &q = profile.vertices[i];
    if (!q.isJoined) {
      high.vertices.push_back(q);
      continue;
    }
    const auto at = [&](double s) {
      const double t = q.distance > p.distance ? (s - p.distance) / (q.distance - p.distance) : 0;
      return ProfileVertex{s,
                           {p.plan.x + t * (q.plan.x - p.plan.x), p.plan.y + t * (q.plan.y - p.plan.y)},
                           p.height + t * (q.height - p.height),
                           true};
    };
    std::vector<double> ends = {p.distance};
    const double step = clutter.stepMetres > 0 ? clutter.stepMetres : q.distance - p.distance;
    const auto cutAt = [&](double s) {
      if (s > p.distance && s < q.distance) ends.push_back(s);
    };
    cutAt(first);
    cutAt(last);
    if (step > 0 && q.distance - p.distance > step) {
      const int count = static_cast<int>(std::ceil((q.distance - p.distance) / step));
      for (int k = 1; k < count; ++k) cutAt(p.distance + (q.distance - p.distance) * k / count);
    }
    ends.push_back(q.distance);
    std::sort(ends.begin(), ends.end());
    for (std::size_t k = 1; k < ends.size(); ++k) {
      ProfileVertex a = at(ends[k - 1]), b = at(ends[k]);
      const double middle = (ends[k - 1] + ends[k]) / 2;
      const double more = middle >= first && middle <= last ? clutter.height(at(middle).plan) : 0;
      a.height += more;
      b.height += more;
      if (high.vertices.back().height != a.height) high.vertices.push_back(a);
      high.vertices.push_back(b);
    }
  }
  return high;
}

/// The judge's answer for a whole profile. Ends that stand on a single point of the terrain are not in a
/// profile.
SightAnswer judged(const SightLine& line, const Profile& profile, const GroundHeights& heights,
                   const SightOptions& options) {
  SightJudge judge(line, options);
  const auto addEnd = [&](const SightPoint& end) {
    if (const auto ground = heights.at(heights.model().toSource(end.plan)))
      judge.terrain(end.distance, ground->height, end.distance, ground->height);
  };
  addEnd(line.points().front());
  const double shortest = 1e-9 * profile.length;
  double done = 0;
  for (std::size_t i = 0; i < profile.vertices.size() && !judge.isDone(); ++i) {
    const ProfileVertex& q = profile.vertices[i];
    if (!q.isJoined) {
      if (q.distance > done + shortest) judge.gap(done, q.distance);
    } else {
      const ProfileVertex& p = profile.vertices[i - 1];
      judge.terrain(p.distance, p.height, q.distance, q.height);
    }
    done = q.distance;
  }
  if (profile.vertices.empty() || profile.length > done + shortest) judge.gap(done, profile.length);
  addEnd(line.points().back());
  return judge.answer(profile.vertices.size());
}

}  // namespace

Vec2 sightPlan(const TerrainModel& model, Vec2 xy) {
  const Georeference& g = model.georeference;
  if (g.isGeographic && model.isRaster) {
    const double turn = 2 * std::numbers::pi / g.angularUnitRadians;
    const double middle = g.toSource((model.columns - 1) / 2.0, (model.rows - 1) / 2.0).x;
    if (std::abs(xy.x - middle) > turn / 2) xy.x += turn * std::round((middle - xy.x) / turn);
  }
  Vec2 plan = model.toPlan(xy);
  // Rounded steps may leave a sliver between the repeated column and a whole turn.
  constexpr double kSliver = 0.1;
  const double last = model.columns - 1.0;
  if (model.isRaster && g.repeatsFirstColumn && plan.x > -kSliver && plan.x < last + kSliver)
    plan.x = std::clamp(plan.x, 0.0, last);
  return model.isRaster ? sightEnd(model, plan, GroundHeights::margin(model)) : plan;
}

Result<SightLine> sightLine(const SightPath& path, const SightEarth& earth, const TerrainModel& model) try {
  ARETE_TRY(auto track, earth.track(path.from, path.to));
  const double unit = model.georeference.verticalUnitMetres;
  ARETE_CHECK(checkSightHeights(track, path.fromHeight, path.toHeight, unit));
  return SightLine(std::move(track), path.fromHeight, path.toHeight, unit);
} catch (...) {
  return caughtFailure();
}

Result<SightPathAnswer> answerPath(const SightPath& path, const SightEarth& earth, const SightEngine& engine,
                                   const Profiles& profiles, const SightPathOptions& options) try {
  ARETE_TRY(const auto line, sightLine(path, earth, profiles.heights().model()));
  const SightTrack& track = line.track();
  SightPathAnswer answer;
  answer.distanceMetres = line.length();
  answer.azimuthDegrees = track.azimuthDegrees;
  const double unit = line.heightUnitMetres(), from = path.fromHeight * unit, to = path.toHeight * unit;
  constexpr double kDegrees = 180 / std::numbers::pi;
  // If both ends are at one place, one of them is straight above the other.
  if (line.length() > 0) {
    answer.elevationDegrees =
        std::atan(sightTangent(track.groundCurvature, from, line.length(), to)) * kDegrees;
  } else {
    answer.elevationDegrees = to > from ? 90 : to < from ? -90 : 0;
  }
  const bool hasClutter = static_cast<bool>(options.clutter.height);
  Profile profile;
  // Only clutter and Fresnel zones need the whole profile; an engine answers without it.
  if (hasClutter || options.frequencyMegahertz > 0) profile = profiles.along(track);
  if (hasClutter) profile = withClutter(profile, options.clutter);
  answer.sight = hasClutter ? judged(line, profile, profiles.heights(), options.sight)
                            : engine.answer(line, options.sight);
  if (options.frequencyMegahertz > 0)
    answer.fresnel = leastFresnelClearance(line, profile, wavelengthMetres(options.frequencyMegahertz));
  return answer;
} catch (...) {
  return caughtFailure();
}

Result<std::vector<Result<SightPathAnswer>>> answerPaths(std::span<const SightPath> paths,
                                                         const SightEarth& earth, const SightEngine& engine,
                                                         const Profiles& profiles,
                                                         const SightPathOptions& options,
                                                         const RunContext& context) try {
  // Every answer has its place beforehand, so the order of the tasks does not matter.
  std::vector<Result<SightPathAnswer>> answers(paths.size(), SightPathAnswer{});
  SharedProgress progress(context, "lines of sight", paths.size());
  context.report("lines of sight", 0);
  withThreads(context, [&] {
    parallelFor(IndexRange<std::size_t>(0, paths.size(), kPathsPerTask), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end() && !context.cancelled(); ++i)
        answers[i] = answerPath(paths[i], earth, engine, profiles, options);
      progress.add(range.size());
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the query was stopped");
  context.report("lines of sight", 1);
  return answers;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
