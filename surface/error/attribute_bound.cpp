// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/error/attribute_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/triangle_shares.h"
#include "surface/error/piece_division.h"
#include "surface/error/squares_over_triangle.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// What rounding adds: of corners that cuts rounded to the grid of faces, and of sums.
constexpr double kRounding = 1 + 1e-9;

/// How the weight of the distance is found: it grows by a factor until the place is near enough, and what
/// lies between is halved. Whatever it is, the place is one of the ball.
constexpr double kStep = 16;
constexpr int kSteps = 12, kHalvings = 4;

Vec3 placeAt(const SpaceTriangle& t, const std::array<double, 3>& shares) {
  return shares[0] * t[0] + shares[1] * t[1] + shares[2] * t[2];
}

}  // namespace

void AttributeBound::bound(const Triangle& triangle, const PieceList& pieces, std::span<double> errors) {
  const std::size_t count = field_.entries().size();
  Triangle farther = triangle;
  bool goesFarther = true;
  for (std::size_t level = 0; level <= distances_.size(); ++level) {
    const auto own = errors.subspan(level * count, count);
    if (level > 0) {
      std::ranges::copy(errors.subspan((level - 1) * count, count), own.begin());
      if (!goesFarther || !(distances_[level - 1] > farther.error)) continue;
      farther.error = distances_[level - 1];
    }
    goesFarther = boundWithin(farther, pieces, own);
  }
}

bool AttributeBound::boundWithin(const Triangle& triangle, const PieceList& pieces,
                                 std::span<double> errors) {
  std::ranges::fill(errors, 0.0);
  isHeld_ = false;
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
  return isHeld_;
}

// Where the attributes are alike is found by least squares over the two coordinates of the triangle, each
// attribute weighed by its length. Where that place is farther from p than the error, the distance from p
// counts as well, as much as is needed: the best place in the triangle and the ball is one of these.
std::array<double, 3> AttributeBound::partner(const Triangle& triangle, const Vec3& p, double within,
                                              std::span<const double> wanted) {
  const auto a = field_.at(triangle.drawn[0]), b = field_.at(triangle.drawn[1]),
             c = field_.at(triangle.drawn[2]);
  SquaresOverTriangle alike, apart;
  for (const AttributeField::Entry& e : field_.entries()) {
    if (e.length == 0) continue;
    const double weight = e.weight();
    for (std::size_t i = e.first; i < e.first + e.measured(); ++i)
      alike.add(weight, b[i] - a[i], c[i] - a[i], wanted[i] - a[i]);
  }
  if (!std::isfinite(alike.uu + alike.uv + alike.vv + alike.u + alike.v))
    return nearestShares(p, triangle.places);
  const Vec3 ab = triangle.places[1] - triangle.places[0], ac = triangle.places[2] - triangle.places[0],
             ap = p - triangle.places[0];
  apart = {dot(ab, ab), dot(ab, ac), dot(ac, ac), dot(ab, ap), dot(ac, ap)};
  const double most = within > 0 ? within * within * (1 - 1e-9) : 0;
  const auto isNear = [&](const std::array<double, 3>& shares) {
    return squaredDistance(p, placeAt(triangle.places, shares)) <= most;
  };
  // A little of the distance in space, so that directions in which nothing changes are not taken.
  constexpr double kSpace = 1e-6;
  double low = kSpace;
  std::array<double, 3> best = alike.plus(low, apart).least();
  if (isNear(best)) return best;
  isHeld_ = true;
  best = nearestShares(p, triangle.places);
  if (!(squaredDistance(p, placeAt(triangle.places, best)) < most)) return best;
  double high = low;
  for (int step = 0; step < kSteps; ++step) {
    high *= kStep;
    const auto shares = alike.plus(high, apart).least();
    if (isNear(shares)) {
      best = shares;
      break;
    }
    low = high;
  }
  for (int step = 0; step < kHalvings; ++step) {
    const double middle = std::sqrt(low * high);
    const auto shares = alike.plus(middle, apart).least();
    if (isNear(shares)) {
      best = shares;
      high = middle;
    } else {
      low = middle;
    }
  }
  return best;
}

void AttributeBound::addPiece(const Triangle& triangle, const Piece& piece, std::span<double> errors) {
  const std::size_t components = field_.components(), corners = piece.polygon.size();
  ofPiece_.resize(components * corners);
  ofTriangle_.resize(components * corners);
  const SpaceTriangle face = original_.face(piece.face);
  const double within = triangle.error - roundingOf(original_, face, piece.isWhole() ? 0 : piece.cuts);
  for (std::size_t i = 0; i < corners; ++i) {
    const auto wanted = std::span(ofPiece_).subspan(components * i, components);
    field_.mean(field_.cornersOf(piece.face), sharesOf(piece.polygon[i]), wanted);
    const std::array<double, 3> shares = partner(triangle, placeOf(piece.polygon[i], face), within, wanted);
    field_.mean(triangle.drawn, shares, std::span(ofTriangle_).subspan(components * i, components));
  }
  compare(corners, errors);
}

// The ball reaches as far on either side of the middle, the nearest point of the side's line, as room says;
// both are parts of the side. The middle may lie beyond the side's ends.
double AttributeBound::partnerOnSide(double middle, double room, std::span<const double> first,
                                     std::span<const double> second, std::span<const double> wanted) {
  const double nearest = std::clamp(middle, 0.0, 1.0);
  double squares = 0, slope = 0;
  for (const AttributeField::Entry& e : field_.entries()) {
    if (e.length == 0) continue;
    for (std::size_t i = e.first; i < e.first + e.measured(); ++i) {
      const double d = second[i] - first[i];
      squares += e.weight() * d * d;
      slope += e.weight() * d * (wanted[i] - first[i]);
    }
  }
  const double best = slope / squares;
  if (!(squares > 0) || !std::isfinite(best)) return nearest;
  const double inside = std::clamp(best, 0.0, 1.0),
               moved = room > 0 ? std::clamp(std::clamp(inside, middle - room, middle + room), 0.0, 1.0)
                                : nearest;
  isHeld_ = isHeld_ || moved != inside;
  return moved;
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
  const auto atFirst = field_.at(ends[0]), atSecond = field_.at(ends[1]);
  const double within = triangle.error - roundingOf(original_, face, piece.isWhole() ? 0 : piece.cuts);
  const double most = within > 0 ? within * within * (1 - 1e-9) : 0;
  for (std::size_t k = 0; k < corners; ++k) {
    const auto wanted = std::span(ofPiece_).subspan(components * k, components);
    field_.mean(field_.cornersOf(piece.face), sharesOf(piece.polygon[k]), wanted);
    const Vec3 p = placeOf(piece.polygon[k], face);
    const double middle = length > 0 ? dot(p - a, along) / length : 0;
    const double room = most - squaredDistance(p, a + middle * along);
    const double at = partnerOnSide(middle, room > 0 && length > 0 ? std::sqrt(room / length) : 0, atFirst,
                                    atSecond, wanted);
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
