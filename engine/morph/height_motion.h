// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "engine/morph/geomorph.h"
#include "engine/morph/height_popping.h"

namespace arete {

/// How the vertices of heightfields move: up and down. See GeomorphedCut.
struct HeightMotion {
  using Node = MorphNode;
  using Offset = float;

  static Node nodeOf(const MultiTriangulation& mt, NodeId n) { return morphNode(mt, n); }
  static Offset offset(const MorphCamera& camera, const Node& node, double rho, double pixelsPerHeight,
                       Offset at0, Offset at1, Offset at2) {
    return static_cast<float>(camera.offset(node, rho, pixelsPerHeight, at0, at1, at2));
  }
  static Vec3 moved(const Vec3& position, Offset offset) {
    return {position.x, position.y, position.z + offset};
  }
  /// Adds all places that are moved from `place` by at most `room` of the unit of heights.
  static void addPlaces(const Vec3& place, double room, const MetricFrame& metric, std::vector<Vec3>& hull) {
    hull.push_back(metric.toMetric({place.x, place.y, place.z - room}));
    if (room > 0) hull.push_back(metric.toMetric({place.x, place.y, place.z + room}));
  }
  /// @param offset offset(vertex index) returns an Offset.
  template <class OffsetOf>
  static double popping(const MultiTriangulation& mt, NodeId n, const Node& node, const OffsetOf& offset) {
    return heightPopping(mt, n, node, offset);
  }
};

}  // namespace arete
