// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/mt/outward_scale.h"

namespace arete {

/// How far an attribute of the source is from what each triangle of an MT has, where both are near: for every
/// point x of what the triangle stands for there is one point y of it, the same for all attributes, with
/// |x - y| at most a distance and the attributes as far apart as this says. At level 0 the distance is the
/// error of the triangle, at the others at most the larger of that and SurfaceModel::attributeDistances.
/// In the unit of AttributeDistance (surface/attributes/attribute_distance.h); texture coordinates in their
/// own unit.
struct AttributeErrors {
  std::string name;       ///< as options have it
  std::string inFile;     ///< the name of the attribute
  bool ofWedges = false;  ///< else of vertices
  /// The length that a unit of the distance counts as, where attributes are weighed against the shape.
  double length = 0;
  OutwardScale scale;
  /// By level, by triangle id; zero of slots that are no triangle.
  std::vector<std::uint16_t> codes;

  /// Of a triangle of which no bound is known, or of labels that differ.
  static constexpr OutwardScale::Code kUnbounded = OutwardScale::kMaxCode;
  double of(std::uint32_t triangle) const { return atSlot(triangle); }
  /// @param slot level * triangle ids + triangle
  double atSlot(std::size_t slot) const {
    const OutwardScale::Code code = codes[slot];
    return code == kUnbounded ? std::numeric_limits<double>::infinity() : double(scale.decode(code));
  }

  bool operator==(const AttributeErrors& other) const {
    return name == other.name && inFile == other.inFile && ofWedges == other.ofWedges &&
           length == other.length && scale.base() == other.scale.base() && codes == other.codes;
  }
};

}  // namespace arete
