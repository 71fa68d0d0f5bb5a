// SPDX-License-Identifier: GPL-3.0-or-later
//
// The spans of the track over the triangles of a node's star are sorted, and each is followed down in its
// turn, so stretches come out in order. What two triangles both claim (the track runs along their edge) goes
// to the first. A triangle that says enough, by its bound or because nothing is finer, is a stretch.
#include "terrain/profile.h"

#include <algorithm>
#include <cmath>

#include "terrain/sight_walk.h"
#include "terrain/triangle_locator.h"

namespace arete {
namespace {

/// Parameters of a piece, and the heights there.
struct Stretch {
  double t0, t1, z0, z1;
  std::uint32_t triangle = 0;
  double at(double t) const { return t1 > t0 ? z0 + (z1 - z0) * ((t - t0) / (t1 - t0)) : z0; }
};

using Span = Stretch;

/// A vertex as the piece sees it: on which side of it, at which parameter, how high.
struct Seen {
  double side, along, z;
};

class Descent {
 public:
  Descent(const TriangleLocator& locator, const SightPiece& piece, OutwardScale::Code allowed, bool mayFill,
          std::vector<Stretch>& stretches)
      : locator_(locator),
        mt_(locator.mt()),
        arrays_(mt_.arrays()),
        piece_(piece),
        allowed_(allowed),
        mayFill_(mayFill),
        perLength_(1 / (piece.dx * piece.dx + piece.dy * piece.dy)),
        shortest_(kShortestInPlan * std::sqrt(perLength_)),
        stretches_(stretches) {}

  void run() {
    std::vector<std::uint32_t> roots;
    locator_.roots().along({piece_.x, piece_.y}, {piece_.x + piece_.dx, piece_.y + piece_.dy}, roots);
    for (const std::uint32_t r : roots) {
      const auto& corners = arrays_.rootTriangles[r];
      addSpan(r, see(corners[0]), see(corners[1]), see(corners[2]), 0, 1);
    }
    follow(0, 0);
  }

 private:
  Seen see(std::uint32_t vertex) const {
    const Vec2 p = locator_.planPosition(vertex);
    const double x = p.x - piece_.x, y = p.y - piece_.y;
    return {piece_.dx * y - piece_.dy * x, (piece_.dx * x + piece_.dy * y) * perLength_,
            mt_.vertices().height(VertexId(vertex))};
  }

  void addSpan(std::uint32_t triangle, const Seen& a, const Seen& b, const Seen& c, double first,
               double last) {
    Span span{HUGE_VAL, -HUGE_VAL, 0, 0, triangle};
    const auto meet = [&span](double t, double z) {
      if (t < span.t0) {
        span.t0 = t;
        span.z0 = z;
      }
      if (t > span.t1) {
        span.t1 = t;
        span.z1 = z;
      }
    };
    const auto cross = [&meet](const Seen& p, const Seen& q) {
      if (p.side == 0) meet(p.along, p.z);
      if (!((p.side < 0 && q.side > 0) || (p.side > 0 && q.side < 0))) return;
      const double f = p.side / (p.side - q.side);
      meet(p.along + f * (q.along - p.along), p.z + f * (q.z - p.z));
    };
    cross(a, b);
    cross(b, c);
    cross(c, a);
    if (!(span.t0 < last && span.t1 > first)) return;
    cut(span, first, last);
    if (span.t1 > span.t0) spans_.push_back(span);
  }

  static void cut(Stretch& stretch, double first, double last) {
    const Stretch whole = stretch;
    if (whole.t0 < first) stretch = {first, stretch.t1, whole.at(first), stretch.z1, whole.triangle};
    if (whole.t1 > last) stretch = {stretch.t0, last, stretch.z0, whole.at(last), whole.triangle};
  }

  bool saysEnough(std::uint32_t triangle) const {
    return arrays_.remover[triangle] == MultiTriangulation::kNone ||
           (!mayFill_ && allowed_ > 0 &&
            std::max(arrays_.below[triangle], arrays_.above[triangle]) <= allowed_);
  }

  /// Takes the spans from `begin` on, as far as they are beyond `done`, and drops them.
  void follow(std::size_t begin, double done) {
    std::sort(spans_.begin() + static_cast<std::ptrdiff_t>(begin), spans_.end(),
              [](const Span& p, const Span& q) { return p.t0 != q.t0 ? p.t0 < q.t0 : p.t1 > q.t1; });
    const std::size_t end = spans_.size();
    for (std::size_t i = begin; i < end;) {
      Span span = spans_[i++];
      if (span.t1 <= done) continue;
      cut(span, done, span.t1);
      done = span.t1;
      if (saysEnough(span.triangle)) {
        stretches_.push_back(span);
        continue;
      }
      // Neighbours that the same node removes are followed together.
      const std::uint32_t node = arrays_.remover[span.triangle];
      for (; i < end && spans_[i].t0 <= done + shortest_; ++i) {
        if (spans_[i].t1 <= done) continue;
        if (arrays_.remover[spans_[i].triangle] != node || saysEnough(spans_[i].triangle)) break;
        done = spans_[i].t1;
      }
      star(node, span.t0, done);
    }
    spans_.resize(begin);
  }

  void star(std::uint32_t node, double first, double last) {
    const std::uint32_t begin = arrays_.slotBegin[node], end = arrays_.slotBegin[node + 1];
    const std::uint32_t roots = mt_.rootTriangleCount();
    const Seen apex = see(arrays_.rootVertices + node), firstLink = see(arrays_.link[begin]);
    const std::size_t mine = spans_.size();
    Seen p = firstLink;
    for (std::uint32_t slot = begin; slot < end; ++slot) {
      const Seen q = slot + 1 < end ? see(arrays_.link[slot + 1]) : firstLink;
      // The last slot of an open star is no triangle.
      if (slot + 1 < end || arrays_.remover[roots + slot] != node)
        addSpan(roots + slot, apex, p, q, first, last);
      p = q;
    }
    follow(mine, first);
  }

  const TriangleLocator& locator_;
  const MultiTriangulation& mt_;
  const MtArrays& arrays_;
  const SightPiece& piece_;
  OutwardScale::Code allowed_;
  bool mayFill_;
  double perLength_, shortest_;
  std::vector<Span> spans_;
  std::vector<Stretch>& stretches_;
};

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
    if (!(plan > 0)) {
      if (const auto height = heights_.at(model.toSource(track.points[i].plan)))
        stretches.push_back({0, 1, height->height, height->height, 0});
    } else {
      Descent(heights_.locator(), piece, allowed, model.options.rimTolerance > 0, stretches).run();
    }
    const double shortest = plan > 0 ? kShortestInPlan / plan : 0;
    joinParts(piece, model.isRaster && allowed == 0, shortest, stretches);
    isOpen = append(profile, piece, track.points[i].distance, stretches, shortest, isOpen);
  }
  return profile;
}

}  // namespace arete
