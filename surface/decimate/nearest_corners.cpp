// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the source around a triangle is what a search from its face reaches within a ball that holds
// the triangle. On the sides of a slit two points are equally near to a vertex: the one that is nearer to the
// middle of the triangle is on its side.
#include "surface/decimate/nearest_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_bvh.h"
#include "surface/decimate/mesh_quadrics.h"
#include "surface/model/labels.h"
#include "surface/model/parts.h"
#include "surface/topology/edges.h"

namespace arete {
namespace {

constexpr std::uint32_t kNoFace = MeshAttributes::kNone;
/// How many times as long as the straight one a way to a face may be, and how many sides of a face longer:
/// the far side of a slit is reached by no shorter way than around.
constexpr double kMostDetour = 2, kMostSides = 4;

/// A point of the source.
struct Seat {
  std::uint32_t face = kNoFace;
  std::array<double, 3> shares{};
  double squared = std::numeric_limits<double>::infinity();  // the distance to it
  double toMiddle = 0;
};

/// Of equal distances but for rounding.
bool isAsNear(double a, double b, double scale) {
  return std::fabs(a - b) <= 1e-9 * std::max(a, b) + 1e-18 * scale;
}

class NearestCorners {
 public:
  NearestCorners(const FramedMesh& source, DecimatedMesh& result)
      : source_(source.source),
        shape_(source.shape),
        mesh_(result.mesh),
        faceOf_(result.faceOf),
        edges_(source.shape.triangles, source.shape.positions.size()),
        seenBy_(source.shape.triangles.size(), kNoFace) {
    const std::vector<std::uint32_t> partOf = partsOf(source_, source_.triangles.size());
    isBlocked_.resize(edges_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e)
      isBlocked_[e] = edges_[e].sides.size() != 2 || isLine(source_, partOf, edges_[e]) ? 1 : 0;
  }

  void run() {
    seats_.resize(mesh_.positions.size());
    vertexSeats_.resize(mesh_.positions.size());
    std::vector<Seat> wedgeSeats;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::array<std::uint32_t, 3> corners = mesh_.triangles[t];
      const std::array<Vec3, 3> at = {mesh_.positions[corners[0]], mesh_.positions[corners[1]],
                                      mesh_.positions[corners[2]]};
      const Vec3 middle = (at[0] + at[1] + at[2]) / 3.0;
      collect(t, at, middle);
      std::array<std::uint32_t, 3> wedges{};
      for (std::size_t c = 0; c < 3; ++c) {
        const Seat seat = nearest(at[c], middle);
        if (seat.squared < vertexSeats_[corners[c]].squared) vertexSeats_[corners[c]] = seat;
        if (!source_.hasWedges()) continue;
        auto& known = seats_[corners[c]];
        const auto same = std::ranges::find_if(known, [&](std::uint32_t w) {
          return seenBy_[wedgeSeats[w].face] == t && isAsNear(wedgeSeats[w].squared, seat.squared, scale_);
        });
        if (same != known.end()) {
          wedges[c] = *same;
          continue;
        }
        wedges[c] = static_cast<std::uint32_t>(wedgeSeats.size());
        known.push_back(wedges[c]);
        wedgeSeats.push_back(seat);
      }
      if (source_.hasWedges()) mesh_.wedges.push_back(wedges);
    }
    mesh_.wedgeCount = static_cast<std::uint32_t>(wedgeSeats.size());
    for (const Attribute& attribute : source_.wedgeAttributes)
      mesh_.wedgeAttributes.push_back(taken(attribute, wedgeSeats, source_.wedges));
    // Labels of vertices stay as they are.
    for (std::size_t a = 0; a < source_.vertexAttributes.size(); ++a)
      if (!isLabel(source_.vertexAttributes[a]))
        mesh_.vertexAttributes[a] = taken(source_.vertexAttributes[a], vertexSeats_, source_.triangles);
  }

 private:
  SpaceTriangle placesOf(std::uint32_t face) const {
    const auto& [i, j, k] = shape_.triangles[face];
    return {shape_.positions[i], shape_.positions[j], shape_.positions[k]};
  }

  /// The faces around a triangle.
  void collect(std::uint32_t t, const std::array<Vec3, 3>& at, const Vec3& middle) {
    const auto squaredTo = [&](std::uint32_t face) {
      return squaredDistance(middle, nearestOnTriangle(middle, placesOf(face)));
    };
    const auto middleOf = [&](std::uint32_t face) {
      const SpaceTriangle p = placesOf(face);
      return (p[0] + p[1] + p[2]) / 3.0;
    };
    // What is nearest to the middle is at least as far from a corner as what is nearest to that.
    double reach = 0;
    for (const Vec3& p : at) reach = std::max(reach, 2 * norm(p - middle));
    reach += std::sqrt(squaredTo(faceOf_[t]));
    scale_ = reach * reach;
    const SpaceTriangle first = placesOf(faceOf_[t]);
    const Vec3 begin = middleOf(faceOf_[t]);
    double side = 0;
    for (std::size_t i = 0; i < 3; ++i) side = std::max(side, norm(first[(i + 1) % 3] - first[i]));
    around_.clear();
    queue_ = {};
    queue_.emplace(0, faceOf_[t]);
    while (!queue_.empty()) {
      const auto [path, face] = queue_.top();
      queue_.pop();
      if (seenBy_[face] == t) continue;
      seenBy_[face] = t;
      around_.push_back(face);
      for (unsigned i = 0; i < 3; ++i) {
        const CornerId corner = cornerOf(TriangleId(face), i);
        const std::size_t edge = edges_.edgeOf(corner);
        if (isBlocked_[edge] != 0) continue;
        const auto sides = edges_[edge].sides;
        const std::uint32_t other = triangleOf(sides[0] == corner ? sides[1] : sides[0]).index();
        if (seenBy_[other] == t || squaredTo(other) > reach * reach) continue;
        const double on = path + norm(middleOf(other) - middleOf(face));
        if (on <= kMostDetour * norm(middleOf(other) - begin) + kMostSides * side) queue_.emplace(on, other);
      }
    }
  }
  Seat nearest(const Vec3& p, const Vec3& middle) const {
    Seat best;
    for (const std::uint32_t face : around_) {
      const SpaceTriangle places = placesOf(face);
      const auto found = nearestWithShares(p, places);
      const double squared = squaredDistance(p, found.place);
      const double toMiddle = squaredDistance(middle, nearestOnTriangle(middle, places));
      const bool isAsNearAsBest = best.face != kNoFace && isAsNear(squared, best.squared, scale_);
      if (isAsNearAsBest ? !(toMiddle < best.toMiddle) : !(squared < best.squared)) continue;
      best = {face, found.shares, squared, toMiddle};
    }
    return best;
  }

  static Attribute taken(const Attribute& attribute, const std::vector<Seat>& seats,
                         const std::vector<std::array<std::uint32_t, 3>>& elementsOf) {
    Attribute made = emptyLike(attribute);
    const bool isWhole = isLabel(attribute);
    for (const Seat& seat : seats) {
      const std::array<std::uint32_t, 3>& elements = elementsOf[seat.face];
      const auto most = static_cast<std::size_t>(std::ranges::max_element(seat.shares) - seat.shares.begin());
      if (isWhole || seat.shares[most] > 1 - 1e-12) {
        made.append(attribute.element(elements[most]));
        continue;
      }
      std::vector<double> numbers(attribute.components, 0.0);
      for (std::size_t c = 0; c < 3; ++c) {
        if (!(seat.shares[c] > 0)) continue;
        const std::vector<double> its = attribute.numbers(elements[c]);
        for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] += seat.shares[c] * its[k];
      }
      if (attribute.meaning == AttributeMeaning::normal || attribute.meaning == AttributeMeaning::tangent) {
        const std::size_t n = std::min<std::size_t>(3, numbers.size());
        double size = 0;
        for (std::size_t k = 0; k < n; ++k) size += numbers[k] * numbers[k];
        // Directions of integers are as long as a corner's.
        double whole = isFloat(attribute.type) ? 1 : 0;
        if (whole == 0)
          for (std::size_t k = 0; k < n; ++k) {
            const double x = attribute.numbers(elements[most])[k];
            whole += x * x;
          }
        for (std::size_t k = n; k < numbers.size(); ++k) numbers[k] = attribute.numbers(elements[most])[k];
        if (size > 0)
          for (std::size_t k = 0; k < n; ++k) numbers[k] *= std::sqrt(whole / size);
      }
      made.append(std::span<const double>(numbers));
    }
    return made;
  }

  const SurfaceMesh& source_;
  const TriangleMesh& shape_;
  SurfaceMesh& mesh_;
  const std::vector<std::uint32_t>& faceOf_;
  MeshEdges edges_;
  std::vector<std::uint8_t> isBlocked_;  // by edge
  std::vector<std::uint32_t> seenBy_;    // by face: the last triangle around which it was
  std::vector<std::uint32_t> around_;
  using Way = std::pair<double, std::uint32_t>;  // its length, and the face
  std::priority_queue<Way, std::vector<Way>, std::greater<>> queue_;
  double scale_ = 0;
  std::vector<std::vector<std::uint32_t>> seats_;  // by vertex: its wedges
  std::vector<Seat> vertexSeats_;
};

}  // namespace

void takeNearestAttributes(const FramedMesh& source, DecimatedMesh& result) {
  const SurfaceMesh& mesh = source.source;
  const bool hasContinuous =
      std::ranges::any_of(mesh.vertexAttributes, [](const Attribute& a) { return !isLabel(a); });
  if (mesh.hasWedges() || hasContinuous) NearestCorners(source, result).run();
}

}  // namespace arete
