// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polygon is seen along the coordinate axis that is nearest to its normal, or from above: dropping one
// coordinate keeps the others exact, and so are CGAL's predicates over them. The edges of the rings are
// constraints of a Delaunay triangulation. The winding number of each triangle follows from crossing edges,
// one by one, from the outside: an edge that the outline follows there and back changes nothing, so bridges
// to holes need no case of their own. Triangles of winding number 1 are those of the polygon. Where edges
// cross, or the outline overlaps itself, the polygon is seen from other sides.
//
// Several corners may be at one position. Each has the angle from the edge that leaves it, counter-clockwise
// to the next constraint: the triangles in there are its own.
#include "io/formats/common/polygon.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace arete {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;

struct FaceNote {
  std::array<int, 3> jump = {0, 0, 0};  ///< change of the winding number across each edge, outwards
  std::array<std::int64_t, 3> corner = {-1, -1, -1};
  int winding = 0;
  bool isVisited = false;
};

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<FaceNote, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using DataStructure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, DataStructure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// From this many corners on, an outline that crosses itself is a fan: the search for the least area takes
/// the cube of their number.
constexpr std::size_t kMostCornersForLeastArea = 64;

using Rings = std::vector<std::vector<std::uint32_t>>;  ///< the corners of each

Rings ringsOf(std::size_t corners, std::span<const std::uint32_t> ringEnds) {
  Rings rings;
  std::uint32_t begin = 0;
  const auto add = [&](std::uint32_t end) {
    rings.emplace_back(end - begin);
    std::iota(rings.back().begin(), rings.back().end(), begin);
    begin = end;
  };
  for (const std::uint32_t end : ringEnds) add(end);
  if (rings.empty()) add(static_cast<std::uint32_t>(corners));
  return rings;
}

/// The corners relative to the first, the largest coordinate being 1, so that nothing overflows.
std::vector<Vec3> scaled(std::span<const Vec3> corners) {
  std::vector<Vec3> result;
  result.reserve(corners.size());
  double largest = 0;
  for (const Vec3& p : corners) {
    const Vec3 q = p / 4 - corners.front() / 4;
    largest = std::max({largest, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    result.push_back(q);
  }
  if (largest > 0)
    for (Vec3& q : result) q = q / largest;
  return result;
}

/// Adds an edge to twice the vector area of a ring, by the sum of Newell.
void addEdge(Vec3& sum, const Vec3& p, const Vec3& q) {
  sum = {sum.x + (p.y - q.y) * (p.z + q.z), sum.y + (p.z - q.z) * (p.x + q.x),
         sum.z + (p.x - q.x) * (p.y + q.y)};
}

Vec3 areaOf(const std::vector<Vec3>& corners, const std::vector<std::uint32_t>& ring) {
  Vec3 sum;
  for (std::size_t i = 0; i < ring.size(); ++i)
    addEdge(sum, corners[ring[i]], corners[ring[(i + 1) % ring.size()]]);
  return sum;
}

Vec3 areaOf(std::span<const Vec3> corners) {
  Vec3 sum;
  for (std::size_t i = 0; i < corners.size(); ++i)
    addEdge(sum, corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  return sum;
}

/// The coordinates that are left when a point is seen along an axis, from the side from which an area of that
/// sign is counter-clockwise.
Point2 seenAlong(int axis, bool fromBelow, const Vec3& p) {
  const double u = axis == 0 ? p.y : axis == 1 ? p.z : p.x, v = axis == 0 ? p.z : axis == 1 ? p.x : p.y;
  return fromBelow ? Point2(v, u) : Point2(u, v);
}

std::vector<Point2> seenAlong(int axis, bool fromBelow, std::span<const Vec3> corners) {
  std::vector<Point2> points;
  points.reserve(corners.size());
  for (const Vec3& p : corners) points.push_back(seenAlong(axis, fromBelow, p));
  return points;
}

/// Seen along the normal itself, for polygons so bent that no axis will do. Precondition: it is not 0.
std::vector<Point2> seenAlongNormal(const Vec3& normal, const std::vector<Vec3>& corners) {
  const Vec3 n = arete::unit(normal);
  const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = cross(other, n), v = cross(n, u);
  std::vector<Point2> points;
  points.reserve(corners.size());
  for (const Vec3& p : corners) points.emplace_back(dot(p, u), dot(p, v));
  return points;
}

std::vector<Triangle> fanOf(const std::vector<std::uint32_t>& ring) {
  std::vector<Triangle> fan;
  for (std::size_t i = 2; i < ring.size(); ++i) fan.push_back({ring[0], ring[i - 1], ring[i]});
  return fan;
}

/// True if the first corner sees every edge at its left, all within half a turn: the fan is right.
///
/// @param pointOf The projection of a corner.
template <class PointOf>
bool fanIsRight(std::size_t corners, PointOf pointOf) {
  const Point2 first = pointOf(0), second = pointOf(1);
  Point2 before = second;
  for (std::size_t i = 2; i < corners; ++i) {
    const Point2 point = pointOf(i);
    if (CGAL::orientation(first, before, point) != CGAL::LEFT_TURN ||
        CGAL::orientation(first, second, point) != CGAL::LEFT_TURN)
      return false;
    before = point;
  }
  return true;
}

/// In a list of axes: the normal itself.
constexpr int kNormal = 3;

enum class View { simple, clockwise, crossing, line };

/// One projection of a polygon.
class ProjectedPolygon {
 public:
  ProjectedPolygon(const std::vector<Point2>& points, Rings rings)
      : points_(points), rings_(std::move(rings)), at_(points.size()) {}

  View triangulate(std::vector<Triangle>& triangles) {
    turnHoles();
    if (!insert()) return View::crossing;
    if (delaunay_.dimension() < 2) return View::line;
    if (!mark()) return View::crossing;
    wind();
    bool isClockwise = false;
    for (const Face face : delaunay_.finite_face_handles()) {
      const int winding = face->info().winding;
      if (std::abs(winding) > 1 || (winding < 0 && rings_.size() > 1)) return View::crossing;
      isClockwise = isClockwise || winding < 0;
    }
    if (isClockwise) {
      for (const Face face : delaunay_.finite_face_handles())
        if (face->info().winding > 0) return View::crossing;
      return View::clockwise;
    }
    giveCorners();
    collect(triangles);
    return View::simple;
  }

 private:
  using Face = Delaunay::Face_handle;
  using Vertex = Delaunay::Vertex_handle;

  /// Holes run clockwise.
  void turnHoles() {
    for (std::size_t r = 1; r < rings_.size(); ++r) {
      double area = 0;
      const auto& ring = rings_[r];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 &o = points_[ring[0]], &p = points_[ring[i]], &q = points_[ring[(i + 1) % ring.size()]];
        area += (p.x() - o.x()) * (q.y() - o.y()) - (q.x() - o.x()) * (p.y() - o.y());
      }
      if (area > 0) std::reverse(rings_[r].begin(), rings_[r].end());
    }
  }

  /// False if constraints cross.
  bool insert() {
    Face near;
    const auto insertCorner = [&](std::uint32_t corner) {
      const std::size_t before = delaunay_.number_of_vertices();
      at_[corner] = delaunay_.insert(points_[corner], near);
      if (delaunay_.number_of_vertices() > before) at_[corner]->info() = corner;
      near = at_[corner]->face();
    };
    for (const std::uint32_t corner : firstTriangle()) insertCorner(corner);
    // Few corners of the whole first, as in a random order [AmentaChoiRote2003]: each search is short, since
    // it starts at a neighbour, and no corner on a long straight edge is one more corner of the hull.
    constexpr std::size_t kRound = 16;
    std::size_t stride = 1;
    while (stride * kRound < points_.size()) stride *= kRound;
    for (; stride > 0; stride /= kRound)
      for (const auto& ring : rings_)
        for (std::size_t i = 0; i < ring.size(); i += stride)
          if (at_[ring[i]] == Vertex()) insertCorner(ring[i]);
    try {
      forEdges([&](std::uint32_t a, std::uint32_t b) { delaunay_.insert_constraint(at_[a], at_[b]); });
    } catch (const Delaunay::Intersection_of_constraints_exception&) {
      return false;
    }
    return true;
  }

  /// Three corners that are not on one line: until CGAL has those, it searches all points for each. Fewer if
  /// there are none.
  std::vector<std::uint32_t> firstTriangle() const {
    std::vector<std::uint32_t> found = {0};
    for (std::uint32_t i = 1; i < points_.size() && found.size() < 3; ++i)
      if (found.size() == 1 ? points_[i] != points_[0]
                            : !CGAL::collinear(points_[found[0]], points_[found[1]], points_[i]))
        found.push_back(i);
    return found;
  }

  /// All edges of the rings that have a length.
  template <class Use>
  void forEdges(Use use) const {
    for (const auto& ring : rings_)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
        if (at_[a] != at_[b]) use(a, b);
      }
  }

  /// Notes at each edge how the winding number changes, and where each corner's angle begins. An edge that
  /// passes other corners is several.
  bool mark() {
    bool isWhole = true;
    forEdges([&](std::uint32_t a, std::uint32_t b) {
      Vertex from = at_[a], to;
      for (bool isFirst = true; isWhole && from != at_[b]; isFirst = false, from = to) {
        Face right;
        int edge = 0;
        isWhole = delaunay_.includes_edge(from, at_[b], to, right, edge);
        if (!isWhole) return;
        const Face left = right->neighbor(edge);
        right->info().jump[std::size_t(edge)] += 1;
        left->info().jump[std::size_t(left->index(right))] -= 1;
        if (isFirst) begins_.emplace_back(a, left);
      }
    });
    return isWhole;
  }

  void wind() {
    std::vector<Face> open = {delaunay_.infinite_face()};
    open.front()->info().isVisited = true;
    while (!open.empty()) {
      const Face face = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Face beside = face->neighbor(k);
        if (std::exchange(beside->info().isVisited, true)) continue;
        beside->info().winding = face->info().winding + face->info().jump[std::size_t(k)];
        open.push_back(beside);
      }
    }
  }

  void giveCorners() {
    for (const auto& [corner, first] : begins_) {
      Face face = first;
      do {
        const int k = face->index(at_[corner]);
        face->info().corner[std::size_t(k)] = corner;
        const int edge = Delaunay::ccw(k);
        if (face->is_constrained(edge)) break;
        face = face->neighbor(edge);
      } while (face != first);
    }
  }

  void collect(std::vector<Triangle>& triangles) const {
    for (const Face face : delaunay_.finite_face_handles()) {
      if (face->info().winding == 0) continue;
      Triangle triangle{};
      for (int k = 0; k < 3; ++k) {
        const std::int64_t corner = face->info().corner[std::size_t(k)];
        triangle[std::size_t(k)] = corner < 0 ? face->vertex(k)->info() : static_cast<std::uint32_t>(corner);
      }
      triangles.push_back(triangle);
    }
    for (const auto& ring : rings_) bridgeRepeats(ring, triangles);
  }

  /// Corners that repeat, one after the other, at one position: the last of them has the triangles, the
  /// others are joined to it by triangles of no area, so that both neighbours of the polygon keep their edge.
  void bridgeRepeats(const std::vector<std::uint32_t>& ring, std::vector<Triangle>& triangles) const {
    const std::size_t count = ring.size();
    const auto position = [&](std::size_t i) { return at_[ring[i % count]]; };
    for (std::size_t i = 0; i < count; ++i) {
      if (position(i) == position(i + count - 1)) continue;  // not the first of a run
      for (std::size_t j = i; j + 1 < i + count && position(j) == position(j + 1); ++j)
        triangles.push_back({ring[(i + count - 1) % count], ring[j % count], ring[(j + 1) % count]});
    }
  }

  const std::vector<Point2>& points_;
  Rings rings_;
  std::vector<Vertex> at_;
  Delaunay delaunay_;
  std::vector<std::pair<std::uint32_t, Face>> begins_;
};

/// The triangles over a closed line that have the least area in all [BarequetSharir1995].
std::vector<Triangle> leastArea(const std::vector<Vec3>& corners, const std::vector<std::uint32_t>& ring) {
  const std::size_t n = ring.size();
  const auto area = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Vec3& p = corners[ring[i]];
    return norm(cross(corners[ring[j]] - p, corners[ring[k]] - p));
  };
  std::vector<double> least(n * n, 0);
  std::vector<std::size_t> apex(n * n, 0);
  for (std::size_t width = 2; width < n; ++width)
    for (std::size_t i = 0; i + width < n; ++i) {
      const std::size_t k = i + width;
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t j = i + 1; j < k; ++j)
        if (const double sum = least[i * n + j] + least[j * n + k] + area(i, j, k); sum < best) {
          best = sum;
          apex[i * n + k] = j;
        }
      least[i * n + k] = best;
    }
  std::vector<Triangle> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k < i + 2) continue;
    const std::size_t j = apex[i * n + k];
    triangles.push_back({ring[i], ring[j], ring[k]});
    open.emplace_back(j, k);
    open.emplace_back(i, j);
  }
  return triangles;
}

}  // namespace

PolygonTriangles triangulatePolygon(std::span<const Vec3> corners, PolygonView wanted,
                                    std::span<const std::uint32_t> ringEnds) {
  PolygonTriangles result;
  if (corners.size() < 3) return result;
  const Rings rings = ringsOf(corners.size(), ringEnds);
  const auto& outline = rings.front();
  if (corners.size() == 3) {
    result.triangles = fanOf(outline);
    return result;
  }
  const std::vector<Vec3> unit = scaled(corners);
  const Vec3 normal = areaOf(unit, outline);
  const std::array<double, 3> components = {normal.x, normal.y, normal.z};
  const auto areaAlong = [&](int axis) { return std::abs(components[std::size_t(axis)]); };
  std::vector<int> views = {0, 1, 2};
  std::ranges::stable_sort(views, std::ranges::greater(), areaAlong);
  if (areaAlong(views[0]) > 0) views.insert(views.begin() + 1, kNormal);
  if (wanted == PolygonView::above) views.insert(views.begin(), 2);

  const auto triangulateSeen = [&](const std::vector<Point2>& points) {
    if (rings.size() == 1 && fanIsRight(points.size(), [&](std::size_t i) { return points[i]; })) {
      result.triangles = fanOf(outline);
      return View::simple;
    }
    return ProjectedPolygon(points, rings).triangulate(result.triangles);
  };
  bool isLine = true;
  for (const int axis : views) {
    const bool fromBelow = axis != kNormal && components[std::size_t(axis)] < 0;
    View view = triangulateSeen(axis == kNormal ? seenAlongNormal(normal, unit)
                                                : seenAlong(axis, fromBelow, corners));
    if (view == View::clockwise && axis != kNormal)
      view = triangulateSeen(seenAlong(axis, !fromBelow, corners));
    if (view == View::simple) return result;
    isLine = isLine && view == View::line;
    // Rings in one plane cross from wherever they are seen, and others bound nothing.
    if (view != View::line && rings.size() > 1) break;
  }
  result.isSimple = isLine;
  result.triangles =
      !isLine && outline.size() <= kMostCornersForLeastArea ? leastArea(unit, outline) : fanOf(outline);
  return result;
}

bool hasRightFan(std::span<const Vec3> corners, PolygonView view) {
  if (corners.size() <= 3) return true;
  const Vec3 normal = areaOf(corners);
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  if (!(x + y + z > 0 && x + y + z < std::numeric_limits<double>::infinity())) return false;
  const int axis = view == PolygonView::above ? 2 : x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const bool fromBelow = (axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z) < 0;
  return fanIsRight(corners.size(), [&](std::size_t i) { return seenAlong(axis, fromBelow, corners[i]); });
}

}  // namespace arete
