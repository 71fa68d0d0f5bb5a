// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/sight_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace arete::test {
namespace {

using Real = long double;

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

double dyadic(Random& random) {
  return random.below(65) / 64.0;
}

}  // namespace

SightTerrain terrainOf(const RasterHeightfield& raster, const SightOracle& oracle) {
  SightTerrain terrain;
  terrain.oracle = &oracle;
  terrain.box = {0, 0, raster.columns - 1.0, raster.rows - 1.0};
  terrain.lowest = HUGE_VAL, terrain.highest = -HUGE_VAL;
  for (std::uint32_t row = 0; row < raster.rows; ++row)
    for (std::uint32_t column = 0; column < raster.columns; ++column) {
      const double z = raster.at(column, row);
      if (std::isnan(z)) {
        terrain.holes.push_back({double(column), double(row)});
        continue;
      }
      terrain.vertices.push_back({double(column), double(row)});
      terrain.lowest = std::min(terrain.lowest, z);
      terrain.highest = std::max(terrain.highest, z);
    }
  if (terrain.vertices.empty()) {
    terrain.vertices.push_back({0, 0});
    terrain.lowest = terrain.highest = 0;
  }
  return terrain;
}

SightTerrain terrainOf(const MultiTriangulation& mt, const Cut& front, const SightOracle& oracle) {
  SightTerrain terrain;
  terrain.oracle = &oracle;
  terrain.isRaster = false;
  terrain.box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  terrain.lowest = HUGE_VAL, terrain.highest = -HUGE_VAL;
  for (const std::uint32_t v : front.vertices) {
    const Vec3 p = mt.position(VertexId(v));
    terrain.vertices.push_back({p.x, p.y});
    Box2& box = terrain.box;
    box = {std::min(box.xMin, p.x), std::min(box.yMin, p.y), std::max(box.xMax, p.x),
           std::max(box.yMax, p.y)};
    terrain.lowest = std::min(terrain.lowest, p.z);
    terrain.highest = std::max(terrain.highest, p.z);
  }
  for (const auto& t : front.triangles)
    terrain.edges.push_back({terrain.vertices[t[0]], terrain.vertices[t[1]]});
  const Box2& b = terrain.box;
  terrain.step = std::sqrt((b.xMax - b.xMin) * (b.yMax - b.yMin) / double(terrain.vertices.size()));
  return terrain;
}

std::string describe(const SightPair& pair) {
  std::string line = pair.kind + text(", heights %.17g %.17g, unit %g m, curvature %.17g, track", pair.from,
                                      pair.to, pair.unit, pair.track.curvature);
  for (const SightPoint& p : pair.track.points)
    line += text(" (%.17g, %.17g; %.17g m)", p.plan.x, p.plan.y, p.distance);
  return line;
}

SightPair reversed(const SightPair& pair) {
  SightPair back = pair;
  std::swap(back.from, back.to);
  std::reverse(back.track.points.begin(), back.track.points.end());
  const double length = pair.track.points.back().distance;
  for (SightPoint& p : back.track.points) p.distance = length - p.distance;
  return back;
}

SightLine lineOf(const SightPair& pair) {
  return SightLine(pair.track, pair.from, pair.to, pair.unit);
}

OracleAnswer SightPairs::ask(const SightPair& pair) const {
  return terrain_.oracle->ask(pair.track, pair.from, pair.to, pair.unit);
}

Vec2 SightPairs::anywhere() {
  const Box2& b = terrain_.box;
  return {random_.between(b.xMin, b.xMax), random_.between(b.yMin, b.yMax)};
}

Vec2 SightPairs::place() {
  const Box2& b = terrain_.box;
  const Vec2 p = anywhere();
  switch (random_.below(12)) {
    case 0:
    case 1:
      return oneOf(terrain_.vertices);
    case 2:  // on an edge
      if (!terrain_.isRaster) {
        const auto& [u, v] = oneOf(terrain_.edges);
        const double f = dyadic(random_);
        return {u.x + f * (v.x - u.x), u.y + f * (v.y - u.y)};
      }
      return random_.below(2) ? Vec2{std::floor(p.x), p.y} : Vec2{p.x, std::floor(p.y)};
    case 3: {  // on a diagonal, of either kind
      const double f = dyadic(random_);
      return {std::floor(p.x) + f, std::floor(p.y) + (random_.below(2) ? f : 1 - f)};
    }
    case 4:  // on the border
      return random_.below(2) ? Vec2{random_.below(2) ? b.xMin : b.xMax, p.y}
                              : Vec2{p.x, random_.below(2) ? b.yMin : b.yMax};
    case 5: {  // outside, or not
      const double dx = (b.xMax - b.xMin) / 5 + 1, dy = (b.yMax - b.yMin) / 5 + 1;
      return {random_.between(b.xMin - dx, b.xMax + dx), random_.between(b.yMin - dy, b.yMax + dy)};
    }
    case 6:
    case 7:  // beside NODATA
      if (!terrain_.holes.empty()) {
        const Vec2 h = oneOf(terrain_.holes);
        const double x = h.x + random_.below(3) - 1.0, y = h.y + random_.below(3) - 1.0;
        const double f = random_.below(3) ? 0 : dyadic(random_);
        return {x + f, random_.below(2) ? y : y + (random_.below(2) ? f : 1 - f)};
      }
      return p;
    case 8:  // next to nothing away from a vertex
    {
      const Vec2 v = oneOf(terrain_.vertices);
      const double off = std::pow(10.0, -random_.between(2, finest()));
      return {v.x + off * (random_.below(3) - 1.0), v.y + off * (random_.below(3) - 1.0)};
    }
    default:
      return p;
  }
}

std::array<Vec2, 2> SightPairs::ends(std::string& kind, bool& isExact) {
  auto [from, to] = anyEnds(kind, isExact);
  // What is rounding is none: ends are put on lattice lines that they are that near to.
  for (double* at : {&from.x, &from.y, &to.x, &to.y})
    if (std::fabs(*at - std::round(*at)) <= 1e-9) *at = std::round(*at) + 0.0;
  if (std::hypot(to.x - from.x, to.y - from.y) < 1e-8 * std::max(1.0, terrain_.step)) to = from;
  return {from, to};
}

std::array<Vec2, 2> SightPairs::anyEnds(std::string& kind, bool& isExact) {
  const Box2& b = terrain_.box;
  isExact = false;
  const auto named = [&](const char* name, Vec2 from, Vec2 to) {
    kind = name;
    if (random_.below(2)) std::swap(from, to);
    return std::array{from, to};
  };
  const auto inBox = [&](Vec2 p) { return p.x >= b.xMin && p.x <= b.xMax && p.y >= b.yMin && p.y <= b.yMax; };
  switch (random_.below(16)) {
    case 0: {  // along a lattice line or a triangle's edge
      const Vec2 v = oneOf(terrain_.vertices), p = anywhere(), q = anywhere();
      if (!terrain_.isRaster) {
        const auto& [u, w] = oneOf(terrain_.edges);
        return named("along an edge", u, w);
      }
      isExact = true;
      const double over = random_.below(4) ? 0 : 1.5;
      if (random_.below(2)) return named("along a row", {p.x + over, v.y}, {q.x - over, v.y});
      return named("along a column", {v.x, p.y - over}, {v.x, q.y + over});
    }
    case 1: {  // along a diagonal
      const Vec2 v = oneOf(terrain_.vertices);
      const double reach = std::max(b.xMax - b.xMin, b.yMax - b.yMin);
      const double before = std::floor(random_.unit() * reach * 64) / 64,
                   after = std::floor(random_.unit() * reach * 64) / 64;
      const double up = random_.below(2) ? 1 : -1;
      const Vec2 p = {v.x - before, v.y - up * before}, q = {v.x + after, v.y + up * after};
      isExact = terrain_.isRaster;
      if (terrain_.isRaster && before + after > 0 && (random_.below(4) == 0 || (inBox(p) && inBox(q))))
        return named("along a diagonal", p, q);
      const double b1 = std::min({before, v.x - b.xMin, up > 0 ? v.y - b.yMin : b.yMax - v.y});
      const double a1 = std::min({after, b.xMax - v.x, up > 0 ? b.yMax - v.y : v.y - b.yMin});
      return named("along a diagonal", {v.x - b1, v.y - up * b1}, {v.x + a1, v.y + up * a1});
    }
    case 2: {  // through a vertex, to the bit where coordinates are small
      const Vec2 v = oneOf(terrain_.vertices);
      const double dx = random_.below(2048) / 64.0 - 16, dy = random_.below(2048) / 64.0 - 16;
      return named("through a vertex", {v.x - dx, v.y - dy}, {v.x + dx, v.y + dy});
    }
    case 3:  // from vertex to vertex
      return named("vertex to vertex", oneOf(terrain_.vertices), oneOf(terrain_.vertices));
    case 4: {
      const Vec2 p = place();
      if (random_.below(3) == 0) return named("vertical", p, p);
      const double off = std::pow(10.0, -random_.between(0, 9));
      return named("short", p, {p.x + off * random_.between(-1, 1), p.y + off * random_.between(-1, 1)});
    }
    case 5: {  // next to a lattice line
      const Vec2 v = oneOf(terrain_.vertices), p = anywhere(), q = anywhere();
      const double e = std::pow(10.0, -random_.between(2, finest())),
                   f = std::pow(10.0, -random_.between(2, finest()));
      if (random_.below(2)) return named("next to a row", {p.x, v.y + e}, {q.x, v.y - f});
      return named("next to a column", {v.x + e, p.y}, {v.x + f, q.y});
    }
    case 6: {  // across the whole
      // One statement each: compilers take arguments in different orders.
      const bool isAlong = random_.below(2) != 0;
      const Vec2 to = anywhere(), from = anywhere();
      if (isAlong) return named("across", {b.xMin, from.y}, {b.xMax, to.y});
      return named("across", {from.x, b.yMin}, {to.x, b.yMax});
    }
    default: {
      const Vec2 to = place(), from = place();
      return named("between places", from, to);
    }
  }
}

void SightPairs::bend(SightPair& pair) {
  std::vector<SightPoint> points = {pair.track.points.front()};
  const Vec2 a = points[0].plan, b = pair.track.points.back().plan;
  const std::uint32_t pieces = 2 + random_.below(7);
  const double off = random_.below(3) == 0 ? 1 : 0.01;
  for (std::uint32_t i = 1; i < pieces; ++i) {
    const double f = double(i) / pieces;
    Vec2 p = {a.x + f * (b.x - a.x) + off * random_.between(-1, 1),
              a.y + f * (b.y - a.y) + off * random_.between(-1, 1)};
    const std::uint32_t kind = random_.below(8);
    if (terrain_.isRaster && kind == 0) p = {std::round(p.x), std::round(p.y)};
    if (terrain_.isRaster && kind == 1) p.x = std::round(p.x);
    if (kind == 2 && i > 1) p = points.back().plan;
    points.push_back({p, 0});
  }
  points.push_back({b, 0});
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double plan =
        std::hypot(points[i].plan.x - points[i - 1].plan.x, points[i].plan.y - points[i - 1].plan.y);
    points[i].distance = points[i - 1].distance + (plan + 0.01) * ground_.metresPerStep;
  }
  pair.track.points = points;
  pair.kind += ", bent";
  pair.isExact = false;
}

void SightPairs::setHeights(SightPair& pair) {
  const double metre = ground_.scale / ground_.unitMetres;
  const auto ground = [&](const SightPoint& end) {
    const auto z = terrain_.oracle->heightAt(end.plan);
    return z ? double(*z) : random_.between(terrain_.lowest, terrain_.highest);
  };
  double* const heights[2] = {&pair.from, &pair.to};
  const SightPoint* const ends[2] = {&pair.track.points.front(), &pair.track.points.back()};
  for (int i = 0; i < 2; ++i) {
    const double z = ground(*ends[i]);
    switch (random_.below(8)) {
      case 0:
        *heights[i] = z;
        break;
      case 1:
        *heights[i] = z - random_.between(0, 2) * metre;
        break;
      case 2:
        *heights[i] = random_.between(terrain_.lowest - 20 * metre, terrain_.highest + 200 * metre);
        break;
      case 3:
      case 4:
        *heights[i] = z + random_.between(0, 100) * metre;
        break;
      default:
        *heights[i] = z + random_.between(0, 5) * metre;
    }
  }
  answer_ = ask(pair);
  if (!answer_.clearance) return;
  const std::uint32_t wish = random_.below(100);
  if (wish < 16) return;
  Real wanted = 0;
  if (wish < 34)
    wanted = random_.between(-0.1, 0.1);
  else if (wish < 40)
    wanted = random_.between(-1e-3, 1e-3);
  else if (wish < 47)
    wanted = random_.between(-1e-5, 1e-5);
  else if (wish < 50)
    wanted = 0;
  else if (wish < 77)
    wanted = random_.between(0, random_.below(2) ? 2 : 50);
  else
    wanted = -random_.between(0, random_.below(2) ? 2 : 50);
  wanted *= metre;
  // Both ends up or down, or one of them; with one the clearance follows by the part of the way that the
  // least is at, until another place becomes the least.
  const Real length = pair.track.points.back().distance;
  const std::uint32_t which = length > 0 ? random_.below(4) : 3;
  const int steps = wish < 50 && wish >= 34 ? 6 : 2;
  for (int i = 0; i < steps && answer_.clearance; ++i) {
    const Real missing = wanted - *answer_.clearance;
    if (std::fabs(missing) < 1e-9L * metre) break;
    const Real part = length > 0 ? answer_.at / length : 0;
    const Real weight = which == 0 ? 1 - part : part;
    if (which < 2 && weight > 0.05L && std::fabs(missing / weight) < 200 * metre) {
      *heights[which] += double(missing / weight);
    } else {
      pair.from += double(missing);
      pair.to += double(missing);
    }
    answer_ = ask(pair);
  }
}

SightPair SightPairs::next() {
  SightPair pair;
  pair.unit = ground_.unitMetres;
  pair.step = terrain_.step;
  const auto [from, to] = ends(pair.kind, pair.isExact);
  pair.track.curvature = ground_.curvature;
  pair.track.points = {{from, 0}, {to, std::hypot(to.x - from.x, to.y - from.y) * ground_.metresPerStep}};
  if (pair.track.points[1].distance > 0 && random_.below(5) == 0) bend(pair);
  setHeights(pair);
  return pair;
}

}  // namespace arete::test
