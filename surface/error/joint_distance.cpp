// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/error/joint_distance.h"

#include <cmath>

#include "engine/base/triangle_shares.h"

namespace arete {

void JointDistance::add(const SpaceTriangle& places, const DrawnCorners& drawn) {
  const Vec3 ab = places[1] - places[0], ac = places[2] - places[0];
  SquaresOverTriangle squares{dot(ab, ab), dot(ab, ac), dot(ac, ac), 0, 0};
  const auto a = field_->at(drawn[0]), b = field_->at(drawn[1]), c = field_->at(drawn[2]);
  for (const AttributeField::Entry& e : field_->entries()) {
    if (e.length == 0) continue;
    const double weight = e.weight();
    for (std::size_t i = e.first; i < e.first + e.measured(); ++i)
      if (std::isfinite(a[i] + b[i] + c[i])) squares.add(weight, b[i] - a[i], c[i] - a[i], 0);
  }
  triangles_.push_back({places, drawn, squares});
}

double JointDistance::squared(std::size_t triangle, const Vec3& p, std::span<const double> wanted) const {
  const Triangle& t = triangles_[triangle];
  const auto a = field_->at(t.drawn[0]), b = field_->at(t.drawn[1]), c = field_->at(t.drawn[2]);
  const auto forEach = [&](const auto& visit) {
    for (const AttributeField::Entry& e : field_->entries()) {
      if (e.length == 0) continue;
      const double weight = e.weight();
      for (std::size_t i = e.first; i < e.first + e.measured(); ++i)
        if (std::isfinite(a[i] + b[i] + c[i] + wanted[i])) visit(weight, i);
    }
  };
  const Vec3 ab = t.places[1] - t.places[0], ac = t.places[2] - t.places[0], ap = p - t.places[0];
  SquaresOverTriangle squares = t.squares;
  squares.u = dot(ab, ap);
  squares.v = dot(ac, ap);
  forEach([&](double weight, std::size_t i) {
    squares.u += weight * (b[i] - a[i]) * (wanted[i] - a[i]);
    squares.v += weight * (c[i] - a[i]) * (wanted[i] - a[i]);
  });
  const auto [atA, atB, atC] = squares.least();
  // From the place itself: a sum of large numbers would not see small ones.
  const Vec3 off = ap - atB * ab - atC * ac;
  double sum = dot(off, off);
  forEach([&](double weight, std::size_t i) {
    const double apart = wanted[i] - (a[i] + atB * (b[i] - a[i]) + atC * (c[i] - a[i]));
    sum += weight * apart * apart;
  });
  return sum;
}

double JointDistance::squaredAtNearest(std::size_t triangle, const Vec3& p,
                                       std::span<const double> wanted) const {
  const Triangle& t = triangles_[triangle];
  const auto a = field_->at(t.drawn[0]), b = field_->at(t.drawn[1]), c = field_->at(t.drawn[2]);
  const auto shares = nearestShares(p, t.places);
  const Vec3 off = p - (shares[0] * t.places[0] + shares[1] * t.places[1] + shares[2] * t.places[2]);
  double sum = dot(off, off);
  for (const AttributeField::Entry& e : field_->entries()) {
    if (e.length == 0) continue;
    for (std::size_t i = e.first; i < e.first + e.measured(); ++i) {
      const double apart = wanted[i] - (shares[0] * a[i] + shares[1] * b[i] + shares[2] * c[i]);
      if (std::isfinite(apart)) sum += e.weight() * apart * apart;
    }
  }
  return sum;
}

}  // namespace arete
