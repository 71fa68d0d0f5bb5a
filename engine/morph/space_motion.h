// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"
#include "engine/morph/geomorph.h"

namespace arete {

/// A displacement in space, as it is stored.
struct SpaceOffset {
  float x = 0, y = 0, z = 0;

  bool operator==(const SpaceOffset&) const = default;
  Vec3 vector() const { return {x, y, z}; }
};

/// Where the vertex v of a node of a surface starts: at the point of the floor that is nearest to it. The
/// point lies in the floor triangle with these corners (vertices of the multitriangulation, all older than
/// v), at the weights weight[0], weight[1] and 1 minus both.
struct SpaceMorphNode {
  std::array<std::uint32_t, 3> corner;
  std::array<float, 2> weight;
  Vec3 detail;  ///< v minus that point

  template <class T>
  T interpolate(const T& at0, const T& at1, const T& at2) const {
    return at2 + (at0 - at2) * double(weight[0]) + (at1 - at2) * double(weight[1]);
  }
};

/// How the vertices of surfaces move: in any direction. The law is MorphCamera's, with vectors
/// for heights; the clamp shortens a vector. A pixel bound of a height is one of a displacement in
/// any direction, so the tolerance holds as it does for heights, for the distance that errors bound. See
/// GeomorphedCut. Precondition everywhere: the metric frame has one scale for all axes.
struct SpaceMotion {
  using Node = SpaceMorphNode;
  using Offset = SpaceOffset;

  /// O(k), k the vertex's degree.
  static Node nodeOf(const MultiTriangulation& mt, NodeId n);
  static Offset offset(const MorphCamera& camera, const Node& node, double rho, double pixelsPerUnit,
                       const Offset& at0, const Offset& at1, const Offset& at2);
  static Vec3 moved(const Vec3& position, const Offset& offset) { return position + offset.vector(); }
  static void addPlaces(const Vec3& place, double room, const MetricFrame& metric, std::vector<Vec3>& hull);

  /// An upper bound of the distance from any point of the floor of a node to its ceiling, and of any of the
  /// ceiling to the floor, with vertices moved: by which the surface pops when the node is applied or undone.
  /// O(k^2), k the vertex's degree.
  template <class OffsetOf>
  static double popping(const MultiTriangulation& mt, NodeId n, const Node&, const OffsetOf& offset) {
    thread_local Star star;
    star.link.clear();
    star.floor.clear();
    const VertexId apex = mt.apex(n);
    const Vec3 origin = moved(mt.position(apex), offset(apex.index()));
    for (const std::uint32_t v : mt.link(n))
      star.link.push_back(moved(mt.position(VertexId(v)), offset(v)) - origin);
    const auto corner = [&](std::uint32_t v) {
      const auto link = mt.link(n);
      return static_cast<std::uint32_t>(std::ranges::find(link, v) - link.begin());
    };
    for (const std::uint32_t t : mt.floor(n)) {
      const auto ids = mt.corners(TriangleId(t));
      star.floor.push_back({corner(ids[0]), corner(ids[1]), corner(ids[2])});
    }
    star.isClosed = !mt.isOpen(n);
    return bound(star);
  }

 private:
  /// A star about the origin and the floor below it.
  struct Star {
    std::vector<Vec3> link;
    std::vector<std::array<std::uint32_t, 3>> floor;  // of the link
    bool isClosed = true;
  };
  static double bound(const Star& star);
};

}  // namespace arete
