// SPDX-License-Identifier: GPL-3.0-or-later
//
// Let y be the point of the triangle that is nearest to a corner x of a piece, with the shares b. Displaced
// it is y + sum b_i s_i d_i: its distance from x is a convex function of the scales s, so over a box of
// scales it is largest at one of the box's 8 corners, where each scale is 0 or s. There it is that of x from
// a point that moves from y along the sum of some b_i d_i: it leaves the ball of radius `error` around x
// where a quadratic function is zero. And the distance from the displaced triangle is a convex function of
// x: what holds for the corners of a piece holds for all of it.
#include "surface/displacement/reach.h"

#include <algorithm>
#include <cmath>

#include "engine/base/triangle_shares.h"
#include "surface/error/piece_division.h"
#include "surface/model/displacement.h"

namespace arete {
namespace {

/// The largest s, at most `most`, for which |r - t u| <= radius for all t from 0 to s.
/// Precondition: |r| <= radius.
double scaleWithin(const Vec3& r, const Vec3& u, double radius, double most) {
  const double uu = dot(u, u), ru = dot(r, u), left = std::max(0.0, radius * radius - dot(r, r));
  if (!(uu > 0)) return most;
  const double root = std::sqrt(ru * ru + uu * left);
  // The larger zero, without cancellation.
  const double zero = ru >= 0 ? (ru + root) / uu : left / (root - ru);
  return std::min(most, zero);
}

/// The shares of the point nearest to x on the side opposite to a corner.
std::array<double, 3> sharesOnSide(const Vec3& x, const SpaceTriangle& triangle, std::size_t corner) {
  const std::size_t from = (corner + 1) % 3, to = (corner + 2) % 3;
  const Vec3 along = triangle[to] - triangle[from];
  std::array<double, 3> shares{};
  shares[to] = std::clamp(dot(x - triangle[from], along) / dot(along, along), 0.0, 1.0);
  shares[from] = 1 - shares[to];
  return shares;
}

}  // namespace

std::uint8_t reachOf(const OriginalSurface& original, const PieceList& pieces, const SpaceTriangle& triangle,
                     const std::array<Vec3, 3>& directions, double error,
                     const std::array<std::uint32_t, 3>& corners) {
  const Vec3 normal = areaNormal(triangle);
  if (!(dot(normal, normal) > 0)) return 0;
  const double longest = std::max({norm(directions[0]), norm(directions[1]), norm(directions[2])});
  double least = error;
  pieces.forEach([&](const Piece& piece) {
    if (least < error / SurfaceDisplacement::kWhole) return;
    const SpaceTriangle face = original.face(piece.face);
    const double radius = error - roundingOf(original, face, piece.cuts);
    for (const FacePoint& p : piece.polygon) {
      const Vec3 x = placeOf(p, face);
      const std::array<double, 3> shares =
          piece.across == 0 ? sharesAt(nearestOnTriangle(x, triangle), triangle)
                            : sharesOnSide(x, triangle, oppositeCorner(piece.across, corners));
      const Vec3 r = x - (shares[0] * triangle[0] + shares[1] * triangle[1] + shares[2] * triangle[2]);
      if (!(radius > 0) || dot(r, r) > radius * radius) {
        least = 0;
        return;
      }
      if (norm(r) + least * longest <= radius) continue;
      for (unsigned some = 1; some < 8; ++some) {
        Vec3 u{0, 0, 0};
        for (std::size_t i = 0; i < 3; ++i)
          if ((some >> i & 1) != 0) u = u + shares[i] * directions[i];
        least = scaleWithin(r, u, radius, least);
      }
    }
  });
  // A billionth less makes up for the roundings above.
  return static_cast<std::uint8_t>(SurfaceDisplacement::kWhole * std::max(0.0, least / error - 1e-9));
}

}  // namespace arete
