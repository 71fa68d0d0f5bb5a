// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/attributes/chart_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "measure/near_numbers.h"
#include "measure/nearest_on_mesh.h"
#include "surface/topology/disjoint_sets.h"

namespace arete {
namespace {

constexpr double kMuch = 0.25, kDecided = 0.75, kWidths = 4;

/// A corner as both sides of an edge have it, wherever their vertices are.
struct PlacedCorner {
  Vec3 place;
  std::array<double, 2> coords;

  auto key() const { return std::tuple(place.x, place.y, place.z, coords[0], coords[1]); }
  bool operator<(const PlacedCorner& other) const { return key() < other.key(); }
  bool operator==(const PlacedCorner& other) const { return key() == other.key(); }
};

struct ChartedSide {
  PlacedCorner low, high;
  std::uint32_t part, triangle;

  auto key() const { return std::tuple(low.key(), high.key(), part); }
};

/// Points of a mesh, evenly over its area, and some of each triangle of a chart that has few.
struct SpreadPoints {
  std::vector<Vec3> places;
  std::vector<std::uint32_t> triangles;
};

double areaOf(const TriangleMesh& mesh, std::uint32_t t) {
  const auto at = [&](std::size_t i) { return mesh.positions[mesh.triangles[t][i]]; };
  return norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
}

/// Point k of a sequence that fills a triangle evenly [Roberts2018].
Vec3 pointIn(const TriangleMesh& mesh, std::uint32_t t, std::uint64_t k) {
  const auto part = [k](double step) {
    const double x = 0.5 + double(k) * step;
    return x - std::floor(x);
  };
  double u = part(0.7548776662466927), v = part(0.5698402909980532);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const auto at = [&](std::size_t i) { return mesh.positions[mesh.triangles[t][i]]; };
  return at(0) + u * (at(1) - at(0)) + v * (at(2) - at(0));
}

SpreadPoints spreadOver(const TriangleMesh& mesh, const PlacedCharts& charts) {
  constexpr double kPoints = 30000;
  const std::size_t count = charts.areas.size();
  // Of a chart, where there are not very many.
  const double least = std::clamp(kPoints / double(count), 1.0, 32.0);
  double whole = 0;
  for (const double area : charts.areas) whole += area;
  SpreadPoints points;
  std::vector<double> owed(count, 0.5);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t c = charts.ofTriangle[t];
    if (!(charts.areas[c] > 0)) continue;
    owed[c] += areaOf(mesh, t) / charts.areas[c] * std::max(kPoints * charts.areas[c] / whole, least);
    for (; owed[c] >= 1; --owed[c]) {
      points.triangles.push_back(t);
      points.places.push_back(pointIn(mesh, t, points.places.size()));
    }
  }
  return points;
}

/// How many points of each chart have which chart of the other mesh at their nearest place.
using ChartVotes = std::vector<std::map<std::uint32_t, double>>;

Result<ChartVotes> votesOf(const TriangleMesh& from, const PlacedCharts& charts, const TriangleMesh& to,
                           const PlacedCharts& there, const RunContext& context) {
  const SpreadPoints points = spreadOver(from, charts);
  std::vector<std::uint32_t> at(points.places.size());
  const NearestOnMesh nearest(to);
  withThreads(context, [&] {
    parallelFor(IndexRange<std::size_t>(0, at.size(), 512), [&](const auto& range) {
      if (context.cancelled()) return;
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        at[i] = there.ofTriangle[nearest.nearest(points.places[i]).triangle];
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "interrupted");
  ChartVotes votes(charts.areas.size());
  for (std::size_t i = 0; i < at.size(); ++i) ++votes[charts.ofTriangle[points.triangles[i]]][at[i]];
  return votes;
}

/// A side of the match: one of the meshes.
struct MatchSide {
  PlacedCharts charts;
  std::vector<std::uint32_t> parts;  // by chart
  ChartVotes votes;
  std::vector<double> points;  // by chart, those on a chart of the same part
  std::vector<bool> isWide, isDecided;

  MatchSide(const ChartedShape& mesh, const std::vector<std::uint32_t>& partOf, double within)
      : charts(chartsByPlace(mesh, partOf)), parts(charts.areas.size()) {
    for (std::size_t t = 0; t < partOf.size(); ++t) parts[charts.ofTriangle[t]] = partOf[t];
    for (std::size_t c = 0; c < parts.size(); ++c)
      isWide.push_back(charts.borders[c] == 0 || 2 * charts.areas[c] / charts.borders[c] >= kWidths * within);
  }

  void count(const MatchSide& other) {
    for (std::size_t c = 0; c < votes.size(); ++c) {
      double sum = 0;
      for (const auto& [o, n] : votes[c]) sum += other.parts[o] == parts[c] ? n : 0;
      points.push_back(sum);
    }
  }

  bool holdsMuch(std::uint32_t chart, std::uint32_t of) const {
    const auto found = votes[chart].find(of);
    return found != votes[chart].end() && found->second >= kMuch * points[chart];
  }

  bool isLinked(std::uint32_t chart, const MatchSide& other, std::uint32_t of) const {
    return parts[chart] == other.parts[of] && (holdsMuch(chart, of) || other.holdsMuch(of, chart));
  }

  void decide(const MatchSide& other) {
    for (std::uint32_t c = 0; c < votes.size(); ++c) {
      double held = 0;
      for (const auto& [o, n] : votes[c]) held += isLinked(c, other, o) ? n : 0;
      isDecided.push_back(isWide[c] && points[c] > 0 && held >= kDecided * points[c]);
    }
  }
};

}  // namespace

PlacedCharts chartsByPlace(const ChartedShape& mesh, std::span<const std::uint32_t> partOf) {
  const TriangleMesh& shape = mesh.shape;
  std::vector<ChartedSide> sides;
  sides.reserve(3 * shape.triangles.size());
  for (std::uint32_t t = 0; t < shape.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto corner = [&](std::size_t c) {
        return PlacedCorner{shape.positions[shape.triangles[t][c]],
                            {mesh.coords[2 * (3 * t + c)], mesh.coords[2 * (3 * t + c) + 1]}};
      };
      ChartedSide side{corner(i), corner((i + 1) % 3), partOf.empty() ? 0 : partOf[t], t};
      if (side.high < side.low) std::swap(side.low, side.high);
      sides.push_back(side);
    }
  std::ranges::sort(sides, [](const ChartedSide& a, const ChartedSide& b) { return a.key() < b.key(); });
  DisjointSets sets(shape.triangles.size());
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i - 1].key() == sides[i].key()) sets.unite(sides[i - 1].triangle, sides[i].triangle);
  std::uint32_t count = 0;
  const auto numbered = sets.numbered(count);
  PlacedCharts charts{
      {numbered.begin(), numbered.end()}, std::vector<double>(count, 0), std::vector<double>(count, 0)};
  for (std::uint32_t t = 0; t < shape.triangles.size(); ++t)
    charts.areas[charts.ofTriangle[t]] += areaOf(shape, t);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool isAlone = (i == 0 || sides[i - 1].key() != sides[i].key()) &&
                         (i + 1 == sides.size() || sides[i + 1].key() != sides[i].key());
    if (isAlone)
      charts.borders[charts.ofTriangle[sides[i].triangle]] += norm(sides[i].high.place - sides[i].low.place);
  }
  return charts;
}

Result<ChartMatch> matchCharts(const ChartedShape& source, const ChartedShape& other,
                               const AttributeParts& named, double within, const RunContext& context) {
  MatchSide here(source, named.ofSource, within), there(other, named.ofOther, within);
  ARETE_TRY(here.votes, votesOf(source.shape, here.charts, other.shape, there.charts, context));
  ARETE_TRY(there.votes, votesOf(other.shape, there.charts, source.shape, here.charts, context));
  here.count(there);
  there.count(here);
  here.decide(there);
  there.decide(here);
  const auto count = static_cast<std::uint32_t>(here.parts.size()),
             countThere = static_cast<std::uint32_t>(there.parts.size());
  DisjointSets sets(std::size_t{count} + countThere);  // the other's behind the source's
  for (std::uint32_t a = 0; a < count; ++a)
    for (const auto& [b, n] : here.votes[a])
      if (here.isDecided[a] && there.isDecided[b] && here.isLinked(a, there, b)) sets.unite(a, count + b);
  for (std::uint32_t b = 0; b < countThere; ++b)
    for (const auto& [a, n] : there.votes[b])
      if (here.isDecided[a] && there.isDecided[b] && here.isLinked(a, there, b)) sets.unite(a, count + b);
  const auto numbersOf = [&](const MatchSide& side, std::uint32_t first) {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t c : side.charts.ofTriangle)
      numbers.push_back(side.isDecided[c] ? sets.find(first + c) : ComparedNumbers::kNoPart);
    return numbers;
  };
  ChartMatch match{numbersOf(here, 0), numbersOf(there, count), count, 0};
  std::vector<std::uint32_t> members(std::size_t{count} + countThere, 0);
  for (std::uint32_t a = 0; a < count; ++a) ++members[sets.find(a)];
  for (std::uint32_t a = 0; a < count; ++a)
    match.apart += here.isDecided[a] && members[sets.find(a)] == 1 ? 1 : 0;
  return match;
}

}  // namespace arete
