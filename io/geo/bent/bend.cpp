// SPDX-License-Identifier: GPL-3.0-or-later
//
// Let T be the map, A the linear map that agrees with T at the corners of a triangle t. A point p of t has
// its place at T(p), the triangle passes through A(p); d(p) = T(p) - A(p). Above T(p) the plane of t is off
// by d.N / N.up, where N is its normal. If T is quadratic, d = 4 * sum over edges of l_i l_j d(middle of edge
// ij) in barycentric coordinates l, and is at most 4/3 of the largest at a middle. This is the first part.
//
// T(t) leaves t between an edge and its image alone: a lens as high as the edge's d. There another triangle
// gives the height, and the difference of the two gradients times the lens's height bounds what it adds. The
// lens lies within the triangle of the edge's ends and a point twice as high. Where the neighbour contains
// that point, it contains the lens; otherwise the largest gradient around both triangles stands for what may
// be there. The rim has no neighbour beyond it, and a sample in the lens belongs to the nearest point of the
// edge.
//
// A round finds what is too much, marks edges, and splits all of them. Triangles of which two corners come
// together in the target, as along a row of samples at a pole, vanish in the end.
#include "io/geo/bent/bend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/geo/bent/divided_triangles.h"

namespace arete {
namespace {

constexpr std::uint32_t kNoTriangle = 0xFFFFFFFF;
constexpr int kMostRounds = 48;
constexpr std::uint8_t kGenerationsOfASeam = 12;  // an edge split so often is straight, or torn
constexpr double kMostTriangles = 2e7, kMostPieces = 4096;
constexpr int kRoundsOfCoarseTriangles = 3;  // whose shapes say little about how many are needed
constexpr double kSafety = 1.05, kLongEdgeMetres = 10'000;

struct BendEdge {
  std::uint32_t a = 0, b = 0;                             // vertices, a < b
  std::uint32_t left = kNoTriangle, right = kNoTriangle;  // the triangle that has a -> b, and the other
  bool isPlain = true;                                    // no more than two triangles
  bool isMeasured = false, isMarked = false;
  Vec3 middle;      // of the source, led into the target
  Vec3 off;         // from the middle of the straight edge to its image
  double rest = 0;  // how far the image may be from a parabola
};

/// A triangle in the target.
struct BentShape {
  Vec3 normal, up, gradient;
  double rise = 0;  // normal . up
  double slope = 0;
  bool vanishes = false, isFolded = false;
};

class Bender {
 public:
  Bender(TriangleMesh mesh, std::span<const float> errors, const PlaceMap& map, const BendOptions& options,
         const RunContext& context)
      : map_(map), options_(options), context_(context) {
    result_.source = std::move(mesh);
    vertices_ = result_.source.positions.size();
    triangles_ = result_.source.triangles.size();
    own_.assign(triangles_, 0);
    turnUp();
    for (std::size_t t = 0; t < errors.size(); ++t) own_[t] = double{errors[t]};
  }

  Result<BentMesh> run() {
    ARETE_CHECK(lead(0));
    if (map_.isLinear()) {
      turnBack();
      result_.errors = own_;
      return std::move(result_);
    }
    generation_.assign(vertices_, 0);
    bool isFirst = true;
    for (int round = 0; round < kMostRounds; ++round) {
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "was interrupted");
      findEdges();
      ARETE_CHECK(measureEdges());
      shapeTriangles();
      if (std::exchange(isFirst, false)) ARETE_CHECK(setRimLimit());
      if (!judge()) return finish();
      if (round >= kRoundsOfCoarseTriangles && wanted_ > kMostTriangles)
        return failure(
            ErrorCode::usage,
            fmt::format("would need about {:.2g} triangles to keep the error, the most near {:.9g}, "
                        "{:.9g}; a larger tolerance needs fewer",
                        wanted_, worst_.x, worst_.y),
            map_.culprit());
      ARETE_CHECK(split());
    }
    return refuse("cannot be split finely enough to keep its heights there", result_.source.positions[0]);
  }

 private:
  tl::unexpected<Error> refuse(const std::string& what, const Vec3& at) const {
    return failure(ErrorCode::invalidData, fmt::format("{}, near {:.9g}, {:.9g}", what, at.x, at.y),
                   map_.culprit());
  }

  /// Triangles that turn clockwise on the map, as other programs may write them, are turned over meanwhile.
  void turnUp() {
    const auto& p = result_.source.positions;
    isTurned_.assign(triangles_, 0);
    for (std::size_t t = 0; t < triangles_; ++t) {
      auto& v = result_.source.triangles[t];
      const Vec3 b = p[v[1]] - p[v[0]], c = p[v[2]] - p[v[0]];
      if (!(b.x * c.y - b.y * c.x < 0)) continue;
      std::swap(v[1], v[2]);
      isTurned_[t] = 1;
    }
  }
  void turnBack() {
    for (std::size_t t = 0; t < isTurned_.size(); ++t)
      if (isTurned_[t]) {
        std::swap(result_.source.triangles[t][1], result_.source.triangles[t][2]);
        std::swap(result_.mesh.triangles[t][1], result_.mesh.triangles[t][2]);
      }
  }

  /// The target's positions of the vertices from `first` on, and their directions up.
  Status lead(std::size_t first) {
    const auto& source = result_.source.positions;
    auto& target = result_.mesh.positions;
    target.resize(first);
    target.insert(target.end(), source.begin() + std::ptrdiff_t(first), source.end());
    map_.apply(std::span(target).subspan(first));
    for (std::size_t v = first; v < target.size(); ++v) {
      if (!isFinite(target[v]))
        return refuse(fmt::format("{} has no place for a vertex", map_.name()), source[v]);
      up_.push_back(map_.upAt(source[v]));
    }
    result_.mesh.triangles = result_.source.triangles;
    return {};
  }

  const Vec3& at(std::uint32_t v) const { return result_.mesh.positions[v]; }
  Vec3 upOf(const BendEdge& e) const { return unit(up_[e.a] + up_[e.b]); }
  static Vec3 levelPart(const Vec3& d, const Vec3& up) { return d - dot(d, up) * up; }

  void findEdges() {
    const auto& all = result_.source.triangles;
    struct Side {
      std::uint32_t a, b, triangle;
      std::uint8_t k;
    };
    std::vector<Side> sides;
    sides.reserve(3 * all.size());
    for (std::uint32_t t = 0; t < all.size(); ++t)
      for (std::uint8_t k = 0; k < 3; ++k) {
        const std::uint32_t p = all[t][k], q = all[t][(k + 1) % 3];
        sides.push_back({std::min(p, q), std::max(p, q), t, k});
      }
    std::ranges::sort(sides, [](const Side& s, const Side& r) {
      return std::pair(s.a, s.b) != std::pair(r.a, r.b) ? std::pair(s.a, s.b) < std::pair(r.a, r.b)
                                                        : s.triangle < r.triangle;
    });
    const std::vector<BendEdge> before = std::exchange(edges_, {});
    edgeOf_.assign(all.size(), {});
    std::size_t known = 0;
    for (const Side& side : sides) {
      if (edges_.empty() || edges_.back().a != side.a || edges_.back().b != side.b) {
        while (known < before.size() &&
               std::pair(before[known].a, before[known].b) < std::pair(side.a, side.b))
          ++known;
        BendEdge edge;
        if (known < before.size() && before[known].a == side.a && before[known].b == side.b)
          edge = before[known];
        edge.a = side.a;
        edge.b = side.b;
        edge.left = edge.right = kNoTriangle;
        edge.isMarked = false;
        edges_.push_back(edge);
      }
      BendEdge& edge = edges_.back();
      const bool isLeft = all[side.triangle][side.k] == side.a;
      std::uint32_t& place = isLeft ? edge.left : edge.right;
      if (place != kNoTriangle) edge.isPlain = false;
      place = side.triangle;
      edgeOf_[side.triangle][side.k] = static_cast<std::uint32_t>(edges_.size() - 1);
    }
  }

  Vec3 sourceAt(const BendEdge& e, double part) const {
    const Vec3 &a = result_.source.positions[e.a], &b = result_.source.positions[e.b];
    return part == 0.5 ? 0.5 * (a + b) : a + part * (b - a);
  }

  Status measureEdges() {
    std::vector<std::uint32_t> fresh;
    std::vector<Vec3> places;
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      if (!edges_[e].isMeasured) {
        fresh.push_back(e);
        places.push_back(sourceAt(edges_[e], 0.5));
      }
    map_.apply(places);
    std::vector<std::uint32_t> longOnes;
    std::vector<Vec3> quarters;
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      BendEdge& e = edges_[fresh[i]];
      if (!isFinite(places[i]))
        return refuse(fmt::format("{} has no place for the middle of an edge", map_.name()),
                      sourceAt(e, 0.5));
      e.middle = places[i];
      e.off = places[i] - 0.5 * (at(e.a) + at(e.b));
      e.isMeasured = true;
      const double length = norm(at(e.b) - at(e.a)), off = norm(e.off);
      e.rest = 0.02 * off;
      const Vec3 span = result_.source.positions[e.b] - result_.source.positions[e.a];
      const bool isWide = map_.isGeographicSource() && std::max(std::abs(span.x), std::abs(span.y)) > 0.5;
      if (!isWide && length * map_.unitMetres() < kLongEdgeMetres && off * 2000 < length) continue;
      longOnes.push_back(fresh[i]);
      quarters.push_back(sourceAt(e, 0.25));
      quarters.push_back(sourceAt(e, 0.75));
    }
    map_.apply(quarters);
    for (std::size_t i = 0; i < longOnes.size(); ++i) {
      BendEdge& e = edges_[longOnes[i]];
      for (const std::size_t k : {0, 1}) {
        const Vec3& q = quarters[2 * i + k];
        if (!isFinite(q))
          return refuse(fmt::format("{} has no place for a part of an edge", map_.name()), sourceAt(e, 0.5));
        const double part = k == 0 ? 0.25 : 0.75;
        const Vec3 off = q - (at(e.a) + part * (at(e.b) - at(e.a)));
        e.rest = std::max(e.rest, norm((4.0 / 3) * off - e.off) * 1.5);
      }
    }
    return {};
  }

  void shapeTriangles() {
    const auto& all = result_.source.triangles;
    shapes_.assign(all.size(), {});
    steepest_.assign(result_.source.positions.size(), 0);
    for (std::size_t t = 0; t < all.size(); ++t) {
      const auto& v = all[t];
      BentShape& s = shapes_[t];
      s.up = unit(up_[v[0]] + up_[v[1]] + up_[v[2]]);
      s.normal = cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0]));
      s.rise = dot(s.normal, s.up);
      double longest = 0;
      for (int k = 0; k < 3; ++k) {
        const double level = norm(levelPart(at(v[(k + 1) % 3]) - at(v[k]), s.up));
        longest = std::max(longest, level);
        if (level <= coincidence()) s.vanishes = true;
      }
      const auto& p = result_.source.positions;
      if (cross(Vec2{p[v[1]].x - p[v[0]].x, p[v[1]].y - p[v[0]].y},
                Vec2{p[v[2]].x - p[v[0]].x, p[v[2]].y - p[v[0]].y}) == 0)
        s.vanishes = true;
      if (s.vanishes) continue;
      if (!(s.rise > longest * map_.rounding())) {
        s.isFolded = true;
        continue;
      }
      s.gradient = s.up - s.normal / s.rise;
      s.slope = norm(s.gradient);
      for (const std::uint32_t corner : v) steepest_[corner] = std::max(steepest_[corner], s.slope);
    }
  }

  double coincidence() const { return 8 * map_.rounding(); }

  Status setRimLimit() {
    double area = 0, turned = 0, shortest = std::numeric_limits<double>::infinity();
    for (const BentShape& s : shapes_)
      if (!s.vanishes && std::isfinite(s.rise)) {
        area += std::abs(s.rise) / 2;
        turned += s.rise / 2;
      }
    for (const BendEdge& e : edges_) {
      const double length = norm(levelPart(at(e.b) - at(e.a), upOf(e)));
      if (length > coincidence()) shortest = std::min(shortest, length);
    }
    const double pixel = options_.samples > 0 ? std::sqrt(area / double(options_.samples)) : shortest;
    rimLimit_ = kRimPixels * pixel;
    constexpr double kNearlyAll = 0.9;  // coarse triangles of half the globe may turn either way
    if (turned < -kNearlyAll * area)
      return refuse(fmt::format("{} has axes that turn the other way round: the terrain would be mirrored",
                                map_.name()),
                    result_.source.positions[0]);
    return {};
  }

  /// Whether the triangle holds the lens of an edge of it.
  bool holdsLens(std::uint32_t t, const BendEdge& e, const Vec3& level) const {
    const BentShape& s = shapes_[t];
    if (s.vanishes || s.isFolded) return false;
    const double length = norm(level);
    const Vec3 tip = 0.5 * (at(e.a) + at(e.b)) + (2 * kSafety * (length + e.rest) / length) * level;
    const auto& v = result_.source.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = at(v[k]);
      if (dot(s.up, cross(at(v[(k + 1) % 3]) - p, tip - p)) < 0) return false;
    }
    return true;
  }

  /// What the lens of an edge adds to a triangle of it.
  double lensOf(std::uint32_t t, const BendEdge& e) const {
    const Vec3 up = upOf(e), level = levelPart(e.off, up);
    const double height = kSafety * (norm(level) + e.rest);
    if (height <= map_.rounding()) return 0;
    const BentShape& s = shapes_[t];
    const std::uint32_t other = e.left == t ? e.right : e.left;
    if (other == kNoTriangle) return height * s.slope;
    const double side = dot(up, cross(at(e.b) - at(e.a), level));
    const std::uint32_t receiver = side > 0 ? e.left : e.right;
    if (e.isPlain && receiver != kNoTriangle && norm(level) > 0 && holdsLens(receiver, e, level))
      if (!shapes_[other].vanishes && !shapes_[other].isFolded)
        return height * norm(s.gradient - shapes_[other].gradient);
    double steepest = 0;
    for (const std::uint32_t near : {t, other})
      for (const std::uint32_t v : result_.source.triangles[near])
        steepest = std::max(steepest, steepest_[v]);
    return height * (s.slope + steepest);
  }

  bool isRim(const BendEdge& e) const {
    return (e.left == kNoTriangle) != (e.right == kNoTriangle) &&
           norm(levelPart(at(e.b) - at(e.a), upOf(e))) > coincidence();
  }

  /// Bounds what bending adds to each triangle and marks the edges that must be split. False: none.
  bool judge() {
    bool any = false;
    const auto mark = [&](BendEdge& e) { any = e.isMarked = true; };
    for (BendEdge& e : edges_)
      if (isRim(e) && kSafety * (norm(levelPart(e.off, upOf(e))) + e.rest) > rimLimit_) mark(e);
    added_.assign(shapes_.size(), 0);
    wanted_ = 0;
    double most = 0;
    for (std::uint32_t t = 0; t < shapes_.size(); ++t) {
      const BentShape& s = shapes_[t];
      if (s.vanishes) continue;
      std::array<double, 3> parts{};
      double plane = 0, lens = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const BendEdge& e = edges_[edgeOf_[t][k]];
        if (s.isFolded) {
          parts[k] = norm(e.off) + e.rest;
          continue;
        }
        const double own =
            kSafety * (4.0 / 3) * (std::abs(dot(e.off, s.normal)) + e.rest * norm(s.normal)) / s.rise;
        const double beyond = lensOf(t, e);
        plane = std::max(plane, own);
        lens = std::max(lens, beyond);
        parts[k] = own + beyond;
      }
      added_[t] = plane + lens + map_.rounding() * (1 + s.slope);
      const double allowed = std::max(options_.least, options_.share * std::max(own_[t], options_.tolerance));
      // What bending adds falls with the square of a triangle's size, as its area does.
      const double pieces = s.isFolded ? 1.0 : std::clamp(plane / allowed, 1.0, kMostPieces);
      wanted_ += pieces;
      if (pieces > most) {
        most = pieces;
        worst_ = result_.source.positions[result_.source.triangles[t][0]];
      }
      if (!s.isFolded && added_[t] <= allowed) continue;
      const double largest = std::ranges::max(parts);
      for (std::size_t k = 0; k < 3; ++k)
        if (parts[k] > 0 && parts[k] >= largest / 2) mark(edges_[edgeOf_[t][k]]);
    }
    return any;
  }

  /// Whether the image of an edge is nearly straight, unless a seam of the target tears it. Around a pole
  /// long edges have short images, so degrees count where there are such.
  bool isShort(const BendEdge& e, std::uint8_t age) const {
    if (!map_.isGeographicSource()) return age >= kGenerationsOfASeam;
    const Vec3 span = result_.source.positions[e.b] - result_.source.positions[e.a];
    return std::max(std::abs(span.x), std::abs(span.y)) < 1;
  }

  Status split() {
    const std::size_t first = result_.source.positions.size();
    std::vector<std::uint32_t> middleOf(edges_.size(), kUnsplit);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const BendEdge& e = edges_[i];
      if (!e.isMarked) continue;
      const std::uint8_t age = std::max(generation_[e.a], generation_[e.b]);
      const Vec3 middle = sourceAt(e, 0.5);
      if (isShort(e, age) && norm(e.off) > 0.2 * norm(at(e.b) - at(e.a)))
        return refuse(fmt::format("{} cannot hold it in one piece: a seam of the map tears it", map_.name()),
                      middle);
      const Vec3 &a = result_.source.positions[e.a], &b = result_.source.positions[e.b];
      if (age == 255 || (middle.x == a.x && middle.y == a.y) || (middle.x == b.x && middle.y == b.y))
        return refuse("cannot be split finely enough to keep its heights there", middle);
      middleOf[i] = static_cast<std::uint32_t>(result_.source.positions.size());
      result_.source.positions.push_back(middle);
      generation_.push_back(static_cast<std::uint8_t>(age + 1));
    }
    constexpr std::size_t kMostVertices = 0x7FFFFFFF;
    if (result_.source.positions.size() > kMostVertices)
      return failure(ErrorCode::unsupported, "needs more vertices than an index can name", map_.culprit());
    ARETE_CHECK(lead(first));
    divide(middleOf);
    return {};
  }

  void divide(const std::vector<std::uint32_t>& middleOf) {
    std::vector<ThreeIds> middles(edgeOf_.size());
    for (std::size_t t = 0; t < middles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) middles[t][k] = middleOf[edgeOf_[t][k]];
    DividedTriangles divided = divideTriangles(result_.source.triangles, middles, result_.mesh.positions);
    std::vector<double> own;
    std::vector<std::uint8_t> turned;
    for (const std::uint32_t parent : divided.parents) {
      own.push_back(own_[parent]);
      turned.push_back(isTurned_[parent]);
    }
    result_.source.triangles = divided.triangles;
    result_.mesh.triangles = std::move(divided.triangles);
    own_ = std::move(own);
    isTurned_ = std::move(turned);
  }

  /// Joins the vertices that come together, and leaves out the triangles that vanish by it.
  Status joinCoincident() {
    const std::size_t count = result_.source.positions.size();
    std::vector<std::uint32_t> same(count);
    for (std::uint32_t v = 0; v < count; ++v) same[v] = v;
    const auto rootOf = [&](std::uint32_t v) {
      while (same[v] != v) v = same[v] = same[same[v]];
      return v;
    };
    bool any = false;
    for (const BendEdge& e : edges_) {
      const Vec3 up = upOf(e), step = at(e.b) - at(e.a);
      if (norm(levelPart(step, up)) > coincidence()) continue;
      const Vec3 &a = result_.source.positions[e.a], &b = result_.source.positions[e.b];
      if (a.x == b.x && a.y == b.y) continue;  // a wall of the source
      if (std::abs(dot(step, up)) > options_.least)
        return refuse(fmt::format("has heights that differ by {:.6g} where {} has a single place for them",
                                  std::abs(dot(step, up)), map_.name()),
                      a);
      const std::uint32_t p = rootOf(e.a), q = rootOf(e.b);
      if (p != q) same[std::max(p, q)] = std::min(p, q);
      any = true;
    }
    if (!any) return {};
    std::vector<std::uint32_t> number(count, kNoTriangle);
    std::vector<bool> isUsed(count, false);
    auto& source = result_.source;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < source.triangles.size(); ++t) {
      auto v = source.triangles[t];
      for (std::uint32_t& corner : v) corner = rootOf(corner);
      if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
      for (const std::uint32_t corner : v) isUsed[corner] = true;
      source.triangles[kept] = v;
      own_[kept] = own_[t];
      added_[kept] = added_[t];
      isTurned_[kept] = isTurned_[t];
      ++kept;
    }
    source.triangles.resize(kept);
    own_.resize(kept);
    added_.resize(kept);
    isTurned_.resize(kept);
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < count; ++v)
      if (isUsed[v]) {
        source.positions[next] = source.positions[v];
        result_.mesh.positions[next] = result_.mesh.positions[v];
        number[v] = next++;
      }
    source.positions.resize(next);
    result_.mesh.positions.resize(next);
    for (auto& triangle : source.triangles)
      for (std::uint32_t& corner : triangle) corner = number[corner];
    result_.mesh.triangles = source.triangles;
    return {};
  }

  Result<BentMesh> finish() {
    const std::size_t vertices = result_.source.positions.size(), triangles = result_.source.triangles.size();
    result_.addedVertices = vertices - vertices_;
    result_.addedTriangles = triangles - triangles_;
    ARETE_CHECK(joinCoincident());
    turnBack();
    result_.errors.resize(own_.size());
    for (std::size_t t = 0; t < own_.size(); ++t) {
      result_.errors[t] = own_[t] + added_[t];
      result_.added = std::max(result_.added, added_[t]);
    }
    return std::move(result_);
  }

  const PlaceMap& map_;
  const BendOptions& options_;
  const RunContext& context_;
  BentMesh result_;
  std::size_t vertices_ = 0, triangles_ = 0;  // before
  std::vector<double> own_, added_;           // by triangle
  std::vector<std::uint8_t> isTurned_;        // by triangle
  std::vector<Vec3> up_;                      // by vertex
  std::vector<std::uint8_t> generation_;      // by vertex: of how many splits it comes
  std::vector<BendEdge> edges_;
  std::vector<std::array<std::uint32_t, 3>> edgeOf_;  // by triangle: of the corners 0-1, 1-2, 2-0
  std::vector<BentShape> shapes_;
  std::vector<double> steepest_;  // by vertex: the largest slope of its triangles
  double rimLimit_ = 0;
  double wanted_ = 0;  // triangles in the end, nearly
  Vec3 worst_;         // where the most of them are
};

}  // namespace

Result<BentMesh> bendMesh(TriangleMesh mesh, std::span<const float> errors, const PlaceMap& map,
                          const BendOptions& options, const RunContext& context) try {
  return Bender(std::move(mesh), errors, map, options, context).run();
} catch (...) {
  return caughtFailure(map.culprit());
}

}  // namespace arete
