// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/error/attribute_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/triangle_shares.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// What rounding adds: of corners that cuts rounded to the grid of faces, and of sums.
constexpr double kRounding = 1 + 1e-9;

Vec3 placeAt(const SpaceTriangle& t, const std::array<double, 3>& shares) {
  return shares[0] * t[0] + shares[1] * t[1] + shares[2] * t[2];
}

}  // namespace

void AttributeBound::bound(const Triangle& triangle, const PieceList& pieces, std::span<double> errors) {
  std::ranges::fill(errors, 0.0);
  std::uint32_t cuts = 0;
  pieces.forEach([&](const Piece& piece) {
    cuts = std::max(cuts, piece.cuts);
    if (piece.across != 0)
      addAcross(triangle, piece, errors);
    else
      addPiece(triangle, piece, errors);
  });
  // Between pieces that were cut there are gaps of a few units of the grid.
  for (std::size_t k = 0; k < errors.size(); ++k)
    if (cuts > 0) errors[k] += 4.0 * cuts / FacePoint::kOne * field_.entries()[k].largest;
}

// Where the attributes are alike is found by least squares over the two coordinates of the triangle, each
// attribute weighed by its length, and the point goes there on a straight way, until it leaves the triangle
// or is farther from p than the error.
std::array<double, 3> AttributeBound::partner(const Triangle& triangle, const Vec3& p,
                                              std::span<const double> wanted) {
  const std::array<double, 3> nearest = nearestShares(p, triangle.places);
  const Vec3 q = placeAt(triangle.places, nearest);
  const double room = triangle.error * triangle.error - squaredDistance(p, q);
  if (!(room > 0)) return nearest;
  const auto a = field_.at(triangle.drawn[0]), b = field_.at(triangle.drawn[1]),
             c = field_.at(triangle.drawn[2]);
  double m00 = 0, m01 = 0, m11 = 0, r0 = 0, r1 = 0;
  for (const AttributeField::Entry& e : field_.entries()) {
    if (e.length == 0) continue;
    const double weight = e.weight();
    for (std::size_t i = e.first; i < e.first + e.measured(); ++i) {
      const double du = b[i] - a[i], dv = c[i] - a[i];
      const double off = wanted[i] - (nearest[0] * a[i] + nearest[1] * b[i] + nearest[2] * c[i]);
      m00 += weight * du * du;
      m01 += weight * du * dv;
      m11 += weight * dv * dv;
      r0 += weight * du * off;
      r1 += weight * dv * off;
    }
  }
  // A little of the distance in space, so that directions in which nothing changes are not taken.
  const Vec3 ab = triangle.places[1] - triangle.places[0], ac = triangle.places[2] - triangle.places[0];
  constexpr double kSpace = 1e-6;
  m00 += kSpace * dot(ab, ab);
  m01 += kSpace * dot(ab, ac);
  m11 += kSpace * dot(ac, ac);
  const double determinant = m00 * m11 - m01 * m01;
  if (!(determinant > 0) || !std::isfinite(determinant)) return nearest;
  const double du = (r0 * m11 - r1 * m01) / determinant, dv = (r1 * m00 - r0 * m01) / determinant;
  const std::array<double, 3> step = {-du - dv, du, dv};
  double part = 1;
  for (std::size_t i = 0; i < 3; ++i)
    if (step[i] < 0) part = std::min(part, nearest[i] / -step[i]);
  // |p - q - s d|^2 <= error^2.
  const Vec3 d = du * ab + dv * ac;
  const double dd = dot(d, d), pd = dot(q - p, d);
  if (dd > 0) part = std::min(part, (-pd + std::sqrt(std::max(0.0, pd * pd + dd * room))) / dd * (1 - 1e-9));
  if (!(part > 0)) return nearest;
  std::array<double, 3> moved;
  for (std::size_t i = 0; i < 3; ++i) moved[i] = std::max(0.0, nearest[i] + part * step[i]);
  return moved;
}

void AttributeBound::addPiece(const Triangle& triangle, const Piece& piece, std::span<double> errors) {
  const std::size_t components = field_.components(), corners = piece.polygon.size();
  ofPiece_.resize(components * corners);
  ofTriangle_.resize(components * corners);
  const SpaceTriangle face = original_.face(piece.face);
  for (std::size_t i = 0; i < corners; ++i) {
    const auto wanted = std::span(ofPiece_).subspan(components * i, components);
    field_.mean(field_.cornersOf(piece.face), sharesOf(piece.polygon[i]), wanted);
    const std::array<double, 3> shares = partner(triangle, placeOf(piece.polygon[i], face), wanted);
    field_.mean(triangle.drawn, shares, std::span(ofTriangle_).subspan(components * i, components));
  }
  compare(corners, errors);
}

// The triangle beyond the side has the side's ends as the chart of the piece has them.
void AttributeBound::addAcross(const Triangle& triangle, const Piece& piece, std::span<double> errors) {
  const std::size_t opposite = oppositeCorner(piece.across, triangle.vertices);
  const std::size_t i = (opposite + 1) % 3, j = (opposite + 2) % 3;
  const std::uint32_t first = triangle.vertices[i], second = triangle.vertices[j];
  std::array<std::uint32_t, 2> ends{first, second};
  if (field_.hasWedges()) {
    const auto side =
        std::ranges::find_if(triangle.across, [&](const AcrossSide& s) { return s.isOf(first, second); });
    if (side == triangle.across.end()) {
      std::ranges::fill(errors, kInfinity);
      return;
    }
    ends = {side->drawnAt(first), side->drawnAt(second)};
  }
  const std::size_t components = field_.components(), corners = piece.polygon.size();
  ofPiece_.resize(components * corners);
  ofTriangle_.resize(components * corners);
  const SpaceTriangle face = original_.face(piece.face);
  const Vec3 a = triangle.places[i], along = triangle.places[j] - a;
  const double length = dot(along, along);
  for (std::size_t k = 0; k < corners; ++k) {
    field_.mean(field_.cornersOf(piece.face), sharesOf(piece.polygon[k]),
                std::span(ofPiece_).subspan(components * k, components));
    const Vec3 p = placeOf(piece.polygon[k], face);
    const double at = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0;
    field_.mean({ends[0], ends[1], ends[1]}, {1 - at, at, 0},
                std::span(ofTriangle_).subspan(components * k, components));
  }
  compare(corners, errors);
}

void AttributeBound::compare(std::size_t corners, std::span<double> errors) {
  using Kind = AttributeField::Entry::Kind;
  const std::size_t components = field_.components();
  for (std::size_t k = 0; k < field_.entries().size(); ++k) {
    const AttributeField::Entry& e = field_.entries()[k];
    const auto of = [&](const std::vector<double>& values, std::size_t corner) {
      return std::span(values).subspan(components * corner + e.first, e.count);
    };
    double most = 0;
    if (e.kind == Kind::labels) {
      // Equal everywhere, or not averaged: bounded only where all corners agree.
      const auto label = of(ofPiece_, 0);
      for (std::size_t i = 0; i < corners; ++i)
        if (!std::ranges::equal(of(ofPiece_, i), label) || !std::ranges::equal(of(ofTriangle_, i), label))
          most = kInfinity;
      errors[k] = std::max(errors[k], most);
      continue;
    }
    // Signs are not averaged.
    for (std::size_t c = e.measured(); c < e.count; ++c)
      for (std::size_t i = 0; i < corners; ++i)
        if ((of(ofPiece_, i)[c] < 0) != (of(ofPiece_, 0)[c] < 0) ||
            (of(ofTriangle_, i)[c] < 0) != (of(ofPiece_, 0)[c] < 0))
          most = kInfinity;
    // Directions: how long a mean may become on either side, by the corners' components along their sum.
    double shortest = kInfinity;
    if (e.kind == Kind::direction)
      for (const std::vector<double>* const side : {&ofPiece_, &ofTriangle_}) {
        std::array<double, 3> sum{};
        for (std::size_t i = 0; i < corners; ++i)
          for (std::size_t c = 0; c < 3; ++c) sum[c] += of(*side, i)[c];
        const double length = std::hypot(sum[0], sum[1], sum[2]);
        for (std::size_t i = 0; i < corners; ++i) {
          double along = 0;
          for (std::size_t c = 0; c < 3; ++c) along += of(*side, i)[c] * sum[c] / length;
          shortest = std::min(shortest, length > 0 ? along : 0);
        }
      }
    for (std::size_t i = 0; i < corners; ++i) {
      const auto a = of(ofPiece_, i), b = of(ofTriangle_, i);
      double squares = 0, channel = 0;
      bool isSame = true;
      for (std::size_t c = 0; c < e.measured(); ++c) {
        isSame = isSame && (a[c] == b[c] || (std::isnan(a[c]) && std::isnan(b[c])));
        squares += (a[c] - b[c]) * (a[c] - b[c]);
        channel = std::max(channel, std::abs(a[c] - b[c]));
      }
      if (isSame) continue;
      const double apart = e.kind == Kind::color ? channel : std::sqrt(squares);
      most = std::isfinite(squares) ? std::max(most, apart) : kInfinity;
    }
    if (e.kind == Kind::direction && most > 0 && std::isfinite(most))
      most = most < shortest ? std::asin(most / shortest) * 180 / std::numbers::pi : 180;
    errors[k] = std::max(errors[k], most * kRounding);
  }
}

}  // namespace arete
