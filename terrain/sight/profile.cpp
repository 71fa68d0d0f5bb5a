// SPDX-License-Identifier: GPL-3.0-or-later
//
// The spans of a leg over the triangles of a node's star are sorted, and each is refined in turn, so
// stretches are found in order. If the track runs along an edge, both its triangles have the span; the first
// keeps it. A triangle whose bound is within the tolerance, or that is never removed, is a stretch.
//
// A raster at full resolution needs no descent: walking over its cells gives the same stretches, in about an
// eightieth of the time.
#include "terrain/sight/profile.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "terrain/locate/triangle_locator.h"
#include "terrain/sight/cells.h"
#include "terrain/sight/mt_crossing.h"
#include "terrain/sight/walk.h"

namespace arete {
namespace {

using Stretch = TriangleSpan;

class ProfileDescent {
 public:
  ProfileDescent(const TriangleLocator& locator, const SightLeg& leg, OutwardScale::Code allowed,
                 bool mayFill, std::vector<Stretch>& stretches)
      : crossing_(locator, leg),
        mt_(locator.mt()),
        below_(mt_.column(kBelow)),
        above_(mt_.column(kAbove)),
        allowed_(allowed),
        mayFill_(mayFill),
        stretches_(stretches) {}

  void run() {
    crossing_.addRoots(spans_);
    follow(0, 0);
  }

 private:
  bool isFineEnough(std::uint32_t triangle) const {
    return !mt_.remover(TriangleId(triangle)).isValid() ||
           (!mayFill_ && allowed_ > 0 && std::max(below_[triangle], above_[triangle]) <= allowed_);
  }

  /// Treats the spans from `begin` on, as far as they are beyond `done`; then removes them.
  void follow(std::size_t begin, double done) {
    MtCrossing::sort(std::span(spans_).subspan(begin));
    const std::size_t end = spans_.size();
    for (std::size_t i = begin; i < end;) {
      Stretch span = spans_[i++];
      if (span.t1 <= done) continue;
      span.cut(done, span.t1);
      done = span.t1;
      if (isFineEnough(span.triangle)) {
        stretches_.push_back(span);
        continue;
      }
      // Adjacent spans that the same node removes are refined together.
      const NodeId node = mt_.remover(TriangleId(span.triangle));
      for (; i < end && spans_[i].t0 <= done + crossing_.shortest(); ++i) {
        if (spans_[i].t1 <= done) continue;
        if (mt_.remover(TriangleId(spans_[i].triangle)) != node || isFineEnough(spans_[i].triangle)) break;
        done = spans_[i].t1;
      }
      star(node.index(), span.t0, done);
    }
    spans_.resize(begin);
  }

  void star(std::uint32_t node, double first, double last) {
    const std::size_t begin = spans_.size();
    crossing_.addStar(node, first, last, spans_);
    follow(begin, first);
  }

  MtCrossing crossing_;
  const MultiTriangulation& mt_;
  std::span<const OutwardScale::Code> below_, above_;
  OutwardScale::Code allowed_;
  bool mayFill_;
  std::vector<Stretch> spans_;
  std::vector<Stretch>& stretches_;
};

/// A sink (CellWalk) that collects stretches. Near a sample, rounding leaves slivers of the cells around it;
/// they are merged into their neighbours.
struct CellStretches {
  std::vector<Stretch>& stretches;
  double shortest;

  void terrain(double t0, double z0, double t1, double z1) {
    if (!(t1 > t0)) return;
    if (!stretches.empty()) {
      Stretch& last = stretches.back();
      const bool isSliver = t1 - t0 <= shortest || last.t1 - last.t0 <= shortest;
      if (isSliver && t0 - last.t1 <= shortest) {
        last.t1 = t1;
        last.z1 = z1;
        return;
      }
    }
    stretches.push_back({t0, t1, z0, z1, 0});
  }
  void gap(double, double) {}
  bool isDone() const { return false; }
};

void walk(const SightGrid& grid, const SightLeg& leg, double shortest, std::vector<Stretch>& stretches) {
  if (grid.columns() < 2 || grid.rows() < 2) return;  // no cell
  const SightRange range = rangeOver(leg, grid.columns() - 1, grid.rows() - 1);
  CellStretches sink{stretches, shortest};
  if (range.first <= range.last) walkCells(grid, leg, range, sink);
}

/// Joins stretches that were cut where there is no edge. A node with several parents is entered below each of
/// them, for the part of the leg that is below the parent, so its triangles come in parts. A leg that runs
/// along edges has stretches of triangles on either side in turn; of a raster, the crossings of edges are
/// known.
void joinParts(const SightLeg& leg, bool isFinestRaster, double shortest, std::vector<Stretch>& stretches) {
  constexpr double kOnLine = 1e-6;
  const auto isCrossing = [&](double t) {
    const double x = leg.x + t * leg.dx, y = leg.y + t * leg.dy;
    const auto meets = [](double v, double d) { return d != 0 && std::abs(v - std::round(v)) < kOnLine; };
    return meets(x, leg.dx) || meets(y, leg.dy) || meets(x - y, leg.dx - leg.dy);
  };
  std::size_t kept = 0;
  for (std::size_t i = 1; i < stretches.size(); ++i) {
    Stretch& last = stretches[kept];
    const Stretch& next = stretches[i];
    const bool isOne = next.triangle == last.triangle || (isFinestRaster && !isCrossing(next.t0));
    if (isOne && std::abs(next.t0 - last.t1) <= shortest) {
      last.t1 = next.t1;
      last.z1 = next.z1;
    } else {
      stretches[++kept] = next;
    }
  }
  if (!stretches.empty()) stretches.resize(kept + 1);
}

/// Appends the terrain below one leg to the profile.
/// @param end distance of the leg's end.
/// @param isOpen the profile's last vertex is where the leg begins.
/// @return whether there is terrain where the leg ends.
bool append(Profile& profile, const SightLeg& leg, double end, std::span<const Stretch> stretches,
            double shortest, bool isOpen) {
  auto& vertices = profile.vertices;
  const auto vertexAt = [&](double t, double z, bool isJoined) {
    return ProfileVertex{leg.distance(t), {leg.x + t * leg.dx, leg.y + t * leg.dy}, z, isJoined};
  };
  double done = 0;
  for (const Stretch& s : stretches) {
    if (s.t0 > done + shortest) {
      profile.gapMetres += leg.ds * (s.t0 - done);
      isOpen = false;
    }
    // Rounding may give one vertex twice, slightly apart. At the seam of longitudes a leg begins on the other
    // side of the plan.
    const auto isHere = [&](Vec2 p) {
      const Vec2 begin = vertexAt(s.t0, s.z0, true).plan;
      return std::abs(p.x - begin.x) < std::abs(leg.dx) + 1 && std::abs(p.y - begin.y) < std::abs(leg.dy) + 1;
    };
    const bool isSame =
        isOpen && isHere(vertices.back().plan) &&
        std::abs(vertices.back().height - s.z0) <= 1e-9 * (1 + std::abs(s.z0) + std::abs(s.z1 - s.z0));
    if (!isSame) vertices.push_back(vertexAt(isOpen ? std::max(s.t0, done) : s.t0, s.z0, isOpen));
    vertices.push_back(vertexAt(s.t1, s.z1, true));
    isOpen = true;
    done = s.t1;
  }
  if (1 > done + shortest) {
    profile.gapMetres += leg.ds * (1 - done);
    return false;
  }
  if (isOpen) vertices.back().distance = end;
  return isOpen;
}

}  // namespace

Profile Profiles::along(const SightTrack& track, double maxError) const {
  const TerrainModel& model = heights_.model();
  const OutwardScale::Code allowed = model.mt.scale().floorCode(maxError);
  Profile profile;
  profile.length = track.points.back().distance;
  if (!(profile.length > 0)) {
    const Vec2 place = track.points.front().plan;
    if (const auto height = heights_.at(model.toSource(place)))
      profile.vertices.push_back({0, place, height->height, false});
    return profile;
  }
  std::vector<Stretch> stretches;
  bool isOpen = false;
  for (std::size_t i = 1; i < track.points.size(); ++i) {
    const SightLeg leg(track.points[i - 1], track.points[i]);
    const double plan = std::hypot(leg.dx, leg.dy);
    if (!(leg.ds > 0)) continue;
    stretches.clear();
    const double shortest = plan > 0 ? kShortestInPlan / plan : 0;
    if (!(plan > 0)) {
      if (const auto height = heights_.at(model.toSource(track.points[i].plan)))
        stretches.push_back({0, 1, height->height, height->height, 0});
    } else if (grid_ && allowed == 0) {
      walk(*grid_, leg, shortest, stretches);
    } else {
      ProfileDescent(heights_.locator(), leg, allowed, model.options.rimTolerance > 0, stretches).run();
      joinParts(leg, model.isRaster && allowed == 0, shortest, stretches);
    }
    isOpen = append(profile, leg, track.points[i].distance, stretches, shortest, isOpen);
  }
  return profile;
}

}  // namespace arete
