// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/mt/outward_scale.h"

namespace arete {

/// How far an attribute of the source is from what each triangle of an MT has, where both are as near as the
/// error of the triangle says: for every point x of what the triangle stands for there is one point y of it,
/// the same for all attributes, with |x - y| at most the error and the attributes as far apart as this says.
/// In the unit of AttributeDistance (surface/attributes/attribute_distance.h); texture coordinates in their
/// own unit.
struct AttributeErrors {
  std::string name;       ///< as options have it
  std::string inFile;     ///< the name of the attribute
  bool ofWedges = false;  ///< else of vertices
  /// The length that a unit of the distance counts as, where attributes are weighed against the shape.
  double length = 0;
  OutwardScale scale;
  std::vector<std::uint16_t> codes;  ///< by triangle id; zero of slots that are no triangle

  /// Of a triangle of which no bound is known, or of labels that differ.
  static constexpr OutwardScale::Code kUnbounded = OutwardScale::kMaxCode;
  double of(std::uint32_t triangle) const {
    const OutwardScale::Code code = codes[triangle];
    return code == kUnbounded ? std::numeric_limits<double>::infinity() : double(scale.decode(code));
  }

  bool operator==(const AttributeErrors& other) const {
    return name == other.name && inFile == other.inFile && ofWedges == other.ofWedges &&
           length == other.length && scale.base() == other.scale.base() && codes == other.codes;
  }
};

}  // namespace arete
