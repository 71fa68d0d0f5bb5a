// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "surface/decimate/decimate.h"
#include "surface/decimate/quadric.h"
#include "surface/model/attribute.h"

namespace arete {

/// What the triangles around a vertex or a wedge say of its attributes [Hoppe1999]: each attribute is linear
/// over a triangle, and costs the squared difference from that, times the triangle's weight.
struct AttributeQuadric {
  /// Of one number of an attribute: weighted sums over the triangles.
  struct Channel {
    Vec3 gradient{0, 0, 0};
    double atOrigin = 0, weight = 0;
    double low = 0, high = 0;  ///< of the triangles' corners; meaningless where weight is 0
  };
  std::vector<Channel> channels;
  Quadric squares;  ///< of the linear functions, in squared lengths

  AttributeQuadric& operator+=(const AttributeQuadric& other);
};

/// Those that are no labels, in their order.
std::vector<const Attribute*> continuousOnes(const std::vector<Attribute>& all);

/// The numbers of the continuous attributes of vertices or of wedges, one after the other, and what a
/// difference of each counts beside a length.
class AttributeChannels {
 public:
  /// @param attributes  of the same elements; they outlive this
  /// @param diagonal    of the mesh: what a difference of 1 counts by a weight of 1
  AttributeChannels(std::span<const Attribute* const> attributes, std::span<const AttributeWeight> weights,
                    double diagonal);

  std::size_t size() const { return places_.size(); }
  bool areWeighed() const { return areWeighed_; }
  /// The attribute of a channel, and which of its numbers the channel is.
  std::size_t attributeOf(std::size_t channel) const { return places_[channel].attribute; }
  std::size_t componentOf(std::size_t channel) const { return places_[channel].component; }

  /// Of a triangle. Numbers that are not finite do not count; nor does a triangle without area.
  /// @param number called with a channel and a corner
  AttributeQuadric ofTriangle(const std::array<Vec3, 3>& places, double weight,
                              const std::function<double(std::size_t, std::size_t)>& number) const;
  /// What a place costs with the best attributes there. At least 0 everywhere, but for rounding.
  Quadric withBest(const AttributeQuadric& quadric) const;
  /// What a number costs more than the best one at a place.
  double gap(const AttributeQuadric& quadric, std::size_t channel, const Vec3& place, double number) const;
  /// The best number at a place, within the range of the triangles' corners. Precondition: the channel has
  /// a weight.
  static double best(const AttributeQuadric::Channel& channel, const Vec3& place, bool isHeldInRange);

 private:
  struct Place {
    std::size_t attribute, component;
    double squared;  // of what a difference counts
  };
  std::vector<Place> places_;
  bool areWeighed_ = false;
};

}  // namespace arete
