// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "surface/model/attribute.h"

namespace arete {

/// How two values of an attribute are compared, and in what unit:
///
///     colours              the largest difference of a channel, in 255ths of its range
///     normals, tangents    the angle in degrees; a tangent of the other sign is infinitely far
///     texture coordinates  the Euclidean distance in their unit, or in pixels of a picture
///     integers, labels     0 if equal, else infinity: they are not averaged
///     other numbers        the Euclidean distance in their unit
///
/// A linear mean of values is compared as it is drawn: normals are brought to length 1 first.
class AttributeDistance {
 public:
  /// @param pixels of a picture, width and height, in which texture coordinates are counted; {1, 1}: their
  /// own unit.
  explicit AttributeDistance(const Attribute& attribute, std::array<double, 2> pixels = {1, 1});

  /// Whether values may be averaged. Labels may not.
  bool isLinear() const { return isLinear_; }
  std::size_t components() const { return components_; }
  /// "255ths", "degrees", "pixels", "units", or "" of labels.
  std::string unit() const;

  /// The numbers of an element in the unit of the distance, as are averaged.
  std::vector<double> values(const Attribute& attribute, std::size_t element) const;
  /// The same as they are drawn: directions have length 1, so that one of another length at another corner
  /// does not pull the mean towards itself; (0, 0, 0) stays.
  std::vector<double> drawnValues(const Attribute& attribute, std::size_t element) const;
  /// Precondition: both have components() numbers from values(), or are linear means of such. In [0,
  /// infinity]; infinity where a number is not finite and the other is not the same.
  double operator()(std::span<const double> a, std::span<const double> b) const;

 private:
  AttributeMeaning meaning_;
  bool isLinear_ = true;
  bool isInPixels_ = false;
  std::size_t components_;
  std::vector<double> scale_;  // by component
};

}  // namespace arete
