// SPDX-License-Identifier: GPL-3.0-or-later
//
// The spans of the track over the triangles of a node's star are sorted, and each is followed down in its
// turn, so stretches come out in order. What two triangles both claim (the track runs along their edge) goes
// to the first. A triangle that says enough, by its bound or because nothing is finer, is a stretch.
//
// A raster at full resolution needs no descent: the walk over its cells gives the same stretches, in about an
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

class Descent {
 public:
  Descent(const TriangleLocator& locator, const SightPiece& piece, OutwardScale::Code allowed, bool mayFill,
          std::vector<Stretch>& stretches)
      : crossing_(locator, piece),
        arrays_(locator.mt().arrays()),
        allowed_(allowed),
        mayFill_(mayFill),
        stretches_(stretches) {}

  void run() {
    crossing_.addRoots(spans_);
    follow(0, 0);
  }

 private:
  bool saysEnough(std::uint32_t triangle) const {
    return arrays_.remover[triangle] == MultiTriangulation::kNone ||
           (!mayFill_ && allowed_ > 0 &&
            std::max(arrays_.below[triangle], arrays_.above[triangle]) <= allowed_);
  }

  /// Takes the spans from `begin` on, as far as they are beyond `done`, and drops them.
  void follow(std::size_t begin, double done) {
    MtCrossing::sort(std::span(spans_).subspan(begin));
    const std::size_t end = spans_.size();
    for (std::size_t i = begin; i < end;) {
      Stretch span = spans_[i++];
      if (span.t1 <= done) continue;
      span.cut(done, span.t1);
      done = span.t1;
      if (saysEnough(span.triangle)) {
        stretches_.push_back(span);
        continue;
      }
      // Neighbours that the same node removes are followed together.
      const std::uint32_t node = arrays_.remover[span.triangle];
      for (; i < end && spans_[i].t0 <= done + crossing_.shortest(); ++i) {
        if (spans_[i].t1 <= done) continue;
        if (arrays_.remover[spans_[i].triangle] != node || saysEnough(spans_[i].triangle)) break;
        done = spans_[i].t1;
      }
      star(node, span.t0, done);
    }
    spans_.resize(begin);
  }

  void star(std::uint32_t node, double first, double last) {
    const std::size_t mine = spans_.size();
    crossing_.addStar(node, first, last, spans_);
    follow(mine, first);
  }

  MtCrossing crossing_;
  const MtArrays& arrays_;
  OutwardScale::Code allowed_;
  bool mayFill_;
  std::vector<Stretch> spans_;
  std::vector<Stretch>& stretches_;
};

/// Takes the stretches of a walk over cells. Where the line passes a sample, rounding leaves slivers of the
/// cells around; they are left to their neighbours.
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

void walk(const SightGrid& grid, const SightPiece& piece, double shortest, std::vector<Stretch>& stretches) {
  if (grid.columns() < 2 || grid.rows() < 2) return;  // no cell
  const SightRange range = rangeOver(piece, grid.columns() - 1, grid.rows() - 1);
  CellStretches sink{stretches, shortest};
  if (range.first <= range.last) walkCells(grid, piece, range, sink);
}

/// Joins what was cut where no edge is. A node with several parents is entered below each of them, for the
/// part of the piece that is theirs, so its triangles come in parts. A piece that runs along edges is claimed
/// by triangles of either side, in turns; where a raster has edges at all is known.
void joinParts(const SightPiece& piece, bool isFinestRaster, double shortest,
               std::vector<Stretch>& stretches) {
  constexpr double kOnLine = 1e-6;
  const auto isCrossing = [&](double t) {
    const double x = piece.x + t * piece.dx, y = piece.y + t * piece.dy;
    const auto meets = [](double v, double d) { return d != 0 && std::abs(v - std::round(v)) < kOnLine; };
    return meets(x, piece.dx) || meets(y, piece.dy) || meets(x - y, piece.dx - piece.dy);
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

/// Appends what is below one piece, which ends at a distance of `end`. isOpen: the last vertex is where the
/// piece begins. Says whether there is terrain where it ends.
bool append(Profile& profile, const SightPiece& piece, double end, std::span<const Stretch> stretches,
            double shortest, bool isOpen) {
  auto& vertices = profile.vertices;
  const auto vertexAt = [&](double t, double z, bool isJoined) {
    return ProfileVertex{piece.distance(t), {piece.x + t * piece.dx, piece.y + t * piece.dy}, z, isJoined};
  };
  double done = 0;
  for (const Stretch& s : stretches) {
    if (s.t0 > done + shortest) {
      profile.gapMetres += piece.ds * (s.t0 - done);
      isOpen = false;
    }
    // By rounding a vertex may come twice, a hair apart.
    const bool isSame = isOpen && std::abs(vertices.back().height - s.z0) <=
                                      1e-9 * (1 + std::abs(s.z0) + std::abs(s.z1 - s.z0));
    if (!isSame) vertices.push_back(vertexAt(isOpen ? std::max(s.t0, done) : s.t0, s.z0, isOpen));
    vertices.push_back(vertexAt(s.t1, s.z1, true));
    isOpen = true;
    done = s.t1;
  }
  if (1 > done + shortest) {
    profile.gapMetres += piece.ds * (1 - done);
    return false;
  }
  if (isOpen) vertices.back().distance = end;
  return isOpen;
}

}  // namespace

Profile Profiles::along(const SightTrack& track, double maxError) const {
  const TerrainModel& model = heights_.model();
  const OutwardScale::Code allowed = model.mt.arrays().scale.floorCode(maxError);
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
    const SightPiece piece(track.points[i - 1], track.points[i]);
    const double plan = std::hypot(piece.dx, piece.dy);
    if (!(piece.ds > 0)) continue;
    stretches.clear();
    const double shortest = plan > 0 ? kShortestInPlan / plan : 0;
    if (!(plan > 0)) {
      if (const auto height = heights_.at(model.toSource(track.points[i].plan)))
        stretches.push_back({0, 1, height->height, height->height, 0});
    } else if (grid_ && allowed == 0) {
      walk(*grid_, piece, shortest, stretches);
    } else {
      Descent(heights_.locator(), piece, allowed, model.options.rimTolerance > 0, stretches).run();
      joinParts(piece, model.isRaster && allowed == 0, shortest, stretches);
    }
    isOpen = append(profile, piece, track.points[i].distance, stretches, shortest, isOpen);
  }
  return profile;
}

}  // namespace arete
