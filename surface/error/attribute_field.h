// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "surface/attributes/attribute_weight.h"
#include "surface/error/face_polygon.h"
#include "surface/error/original.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The attributes of vertices and wedges of a surface, as numbers to be averaged and compared. Drawn corners
/// are wedges, or vertices where there are no wedges.
class AttributeField {
 public:
  /// One attribute.
  struct Entry {
    enum class Kind { numbers, color, direction, labels };
    std::string name, inFile;
    bool ofWedges = false;
    Kind kind = Kind::numbers;
    std::size_t first = 0, count = 0;  ///< of its components
    double largest = 0;                ///< more than any two values are apart; labels: 0
    /// Of its components, those that are distances: a fourth of a direction is a sign, which is equal or not.
    std::size_t measured() const { return kind == Kind::direction ? 3 : count; }
    /// What the square of a component's difference is multiplied by to be one of lengths.
    double weight() const;
    /// The length that a unit of its distance counts as: what a simplification weighs it by.
    double length = 0;
  };

  AttributeField() = default;
  /// @param mesh the original; only its attributes of vertices and wedges count
  /// @param diagonal of its box. O(n log n).
  AttributeField(const SurfaceMesh& mesh, double diagonal);
  /// Stated weights instead of the lengths that attributes count as by themselves: one that is not in the
  /// list counts nothing.
  void weigh(std::span<const AttributeWeight> weights, double diagonal);

  bool isEmpty() const { return entries_.empty(); }
  const std::vector<Entry>& entries() const { return entries_; }
  std::size_t components() const { return components_; }
  bool hasWedges() const { return !wedges_.empty(); }

  std::span<const double> at(std::uint32_t drawn) const {
    return std::span(values_).subspan(components_ * drawn, components_);
  }
  /// The drawn corners of a face of the original.
  const std::array<std::uint32_t, 3>& cornersOf(std::uint32_t face) const {
    return hasWedges() ? wedges_[face] : faces_[face];
  }
  /// The values at a point of a face, of the shares of its corners.
  void mean(const std::array<std::uint32_t, 3>& drawn, const std::array<double, 3>& shares,
            std::span<double> to) const;
  /// The sum over all attributes of the squared distances, weighed by Entry::length.
  double weighedSquares(std::span<const double> a, std::span<const double> b) const;

 private:
  std::vector<Entry> entries_;
  std::size_t components_ = 0;
  std::vector<double> values_;  // by drawn corner, components() each
  std::span<const std::array<std::uint32_t, 3>> faces_, wedges_;
};

}  // namespace arete
