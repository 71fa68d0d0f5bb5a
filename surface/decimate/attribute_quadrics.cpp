// SPDX-License-Identifier: GPL-3.0-or-later
//
// With the numbers s of the attributes as further unknowns, the sum over the triangles of
//     weight (gradient p + atOrigin - s)^2
// is least for s = (sum of weight (gradient p + atOrigin)) / (sum of weights). What is left then is a quadric
// of p alone, so that the place is solved together with the attributes and only 3 x 3 numbers are inverted.
#include "surface/decimate/attribute_quadrics.h"

#include <algorithm>
#include <cmath>

#include "surface/attributes/attribute_distance.h"
#include "surface/model/labels.h"

namespace arete {

AttributeQuadric& AttributeQuadric::operator+=(const AttributeQuadric& other) {
  if (channels.empty()) channels.resize(other.channels.size());
  for (std::size_t k = 0; k < other.channels.size(); ++k) {
    Channel& mine = channels[k];
    const Channel& its = other.channels[k];
    if (!(its.weight > 0)) continue;
    mine.low = mine.weight > 0 ? std::min(mine.low, its.low) : its.low;
    mine.high = mine.weight > 0 ? std::max(mine.high, its.high) : its.high;
    mine.gradient = mine.gradient + its.gradient;
    mine.atOrigin += its.atOrigin;
    mine.weight += its.weight;
  }
  squares += other.squares;
  return *this;
}

AttributeChannels::AttributeChannels(std::span<const Attribute* const> attributes,
                                     std::span<const AttributeWeight> weights, double diagonal) {
  for (std::size_t a = 0; a < attributes.size(); ++a) {
    const Attribute& attribute = *attributes[a];
    const auto stated = std::ranges::find(weights, attribute.name, &AttributeWeight::attribute);
    const double weight = stated == weights.end() ? 0 : stated->weight;
    // The unit of AttributeDistance; the whole range of a colour is 1.
    Attribute ones = emptyLike(attribute);
    ones.append(std::vector<double>(attribute.components, 1.0));
    const std::vector<double> units = AttributeDistance(attribute).values(ones, 0);
    for (std::size_t c = 0; c < attribute.components; ++c) {
      const double unit = attribute.meaning == AttributeMeaning::color ? units[c] / 255 : units[c];
      const double counts = weight * unit * diagonal;
      places_.push_back({a, c, counts * counts});
    }
    areWeighed_ = areWeighed_ || weight > 0;
  }
}

AttributeQuadric AttributeChannels::ofTriangle(
    const std::array<Vec3, 3>& p, double weight,
    const std::function<double(std::size_t, std::size_t)>& number) const {
  AttributeQuadric made;
  made.channels.resize(places_.size());
  const Vec3 e = p[1] - p[0], f = p[2] - p[0], normal = cross(e, f);
  const double squared = dot(normal, normal);
  if (!(squared > 0)) return made;
  const Vec3 alongE = cross(f, normal) / squared, alongF = cross(normal, e) / squared;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const double a = number(k, 0), b = number(k, 1), c = number(k, 2);
    const Vec3 gradient = (b - a) * alongE + (c - a) * alongF;
    const double atOrigin = a - dot(gradient, p[0]);
    if (!isFinite(gradient) || !std::isfinite(atOrigin)) continue;
    made.channels[k] = {weight * gradient, weight * atOrigin, weight, std::min({a, b, c}),
                        std::max({a, b, c})};
    if (places_[k].squared > 0)
      made.squares += Quadric::ofLinear(gradient, atOrigin, places_[k].squared * weight);
  }
  return made;
}

Quadric AttributeChannels::withBest(const AttributeQuadric& quadric) const {
  Quadric left = quadric.squares;
  for (std::size_t k = 0; k < quadric.channels.size(); ++k) {
    const AttributeQuadric::Channel& channel = quadric.channels[k];
    if (places_[k].squared > 0 && channel.weight > 0)
      left += Quadric::ofLinear(channel.gradient, channel.atOrigin, -places_[k].squared / channel.weight);
  }
  return left;
}

double AttributeChannels::gap(const AttributeQuadric& quadric, std::size_t k, const Vec3& place,
                              double number) const {
  const AttributeQuadric::Channel& channel = quadric.channels[k];
  if (!(channel.weight > 0) || !(places_[k].squared > 0)) return 0;
  const double off = number - (dot(channel.gradient, place) + channel.atOrigin) / channel.weight;
  return std::isfinite(off) ? places_[k].squared * channel.weight * off * off : 0;
}

double AttributeChannels::best(const AttributeQuadric::Channel& channel, const Vec3& place,
                               bool isHeldInRange) {
  const double best = (dot(channel.gradient, place) + channel.atOrigin) / channel.weight;
  return isHeldInRange ? std::clamp(best, channel.low, channel.high) : best;
}

std::vector<const Attribute*> continuousOnes(const std::vector<Attribute>& all) {
  std::vector<const Attribute*> some;
  for (const Attribute& attribute : all)
    if (!isLabel(attribute)) some.push_back(&attribute);
  return some;
}

}  // namespace arete
