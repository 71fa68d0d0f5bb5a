// SPDX-License-Identifier: GPL-3.0-or-later
//
// Branch and bound. The distance to one triangle of the target, a convex set, is a convex function: over a
// piece it is largest at a corner, and the distance to the whole target is no larger. So each triangle that a
// corner is nearest to bounds the piece from above (after Guthe, Borodin, Klein 2005; Tang, Lee, Kim 2009),
// and so does the distance itself, which changes by no more than the way: every point of a piece is within
// 1 / sqrt(3) of its longest side of a corner. The bound that served a piece best serves its halves too.
#include "terrain/measure/farthest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

namespace arete {
namespace {

constexpr std::uint64_t kPointsPerStopCheck = 256;

struct Piece {
  SpaceTriangle corners;
  std::array<NearestOnMesh::Answer, 3> answers;
  std::uint32_t guide = 0;  // the triangle of the target whose bound was the least
  double atMost = 0;

  bool operator<(const Piece& other) const { return atMost < other.atMost; }
};

/// By its first corner.
int longestSide(const SpaceTriangle& corners) {
  int longest = 0;
  double most = -1;
  for (int i = 0; i < 3; ++i) {
    const double length = squaredDistance(corners[i], corners[(i + 1) % 3]);
    if (length <= most) continue;
    most = length;
    longest = i;
  }
  return longest;
}

double distanceTo(const TriangleMesh& target, std::uint32_t triangle, const Vec3& p) {
  const auto& v = target.triangles[triangle];
  const SpaceTriangle corners{target.positions[v[0]], target.positions[v[1]], target.positions[v[2]]};
  return distanceToTriangle(p, corners);
}

void bound(Piece& piece, const TriangleMesh& target) {
  const int side = longestSide(piece.corners);
  const double longest = std::sqrt(squaredDistance(piece.corners[side], piece.corners[(side + 1) % 3]));
  const double farthest =
      std::max({piece.answers[0].distance, piece.answers[1].distance, piece.answers[2].distance});
  piece.atMost = farthest + longest * std::numbers::inv_sqrt3;
  const std::array candidates = {piece.guide, piece.answers[0].triangle, piece.answers[1].triangle,
                                 piece.answers[2].triangle};
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (std::find(candidates.begin(), candidates.begin() + k, candidates[k]) != candidates.begin() + k)
      continue;
    double largest = 0;
    for (int i = 0; i < 3 && largest < piece.atMost; ++i)
      largest = std::max(largest, distanceTo(target, candidates[k], piece.corners[i]));
    if (largest >= piece.atMost) continue;
    piece.atMost = largest;
    piece.guide = candidates[k];
  }
  // The bound of a convex function at its corners may round below the distance there.
  piece.atMost = std::max(piece.atMost, farthest);
}

}  // namespace

FarthestPoint farthestPoint(const SpaceTriangle& triangle, std::span<const NearestOnMesh::Answer, 3> answers,
                            const TriangleMesh& target, const NearestOnMesh& to,
                            const FarthestPointOptions& options) {
  FarthestPoint found;
  const auto take = [&](const Vec3& p, const NearestOnMesh::Answer& answer) {
    if (answer.distance > found.distance) {
      found.from = p;
      found.nearest = answer.point;
      found.distance = answer.distance;
    }
  };
  Piece whole{
      .corners = triangle, .answers = {answers[0], answers[1], answers[2]}, .guide = answers[0].triangle};
  for (int i = 0; i < 3; ++i) take(triangle[i], answers[i]);
  const auto isSettled = [&](const Piece& piece) {
    const double reached = std::max(options.known, found.distance);
    return piece.atMost <= std::max(reached * (1 + options.accuracy), options.slack);
  };
  bound(whole, target);
  if (!isSettled(whole) && options.budget > 0) {
    // The middle is nearest to the triangle that bounds it best where the two meshes share it.
    const auto& [a, b, c] = triangle;
    const Vec3 middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
    const NearestOnMesh::Answer answer = to.nearest(middle);
    take(middle, answer);
    whole.guide = answer.triangle;
    bound(whole, target);
  }

  std::priority_queue<Piece> open;
  const auto keep = [&](const Piece& piece) {
    if (isSettled(piece))
      found.atMost = std::max(found.atMost, piece.atMost);
    else
      open.push(piece);
  };
  keep(whole);
  for (std::uint64_t asked = 1; asked < options.budget && !open.empty(); ++asked) {
    if (asked % kPointsPerStopCheck == 0 && options.shouldStop && options.shouldStop()) break;
    const Piece piece = open.top();
    open.pop();
    const int side = longestSide(piece.corners), other = (side + 1) % 3;
    const Vec3 half = piece.corners[side] + 0.5 * (piece.corners[other] - piece.corners[side]);
    const NearestOnMesh::Answer answer = to.nearest(half);
    take(half, answer);
    for (const int replaced : {side, other}) {
      Piece part = piece;
      part.corners[replaced] = half;
      part.answers[replaced] = answer;
      bound(part, target);
      part.atMost = std::min(part.atMost, piece.atMost);
      keep(part);
    }
  }
  found.atMost = std::max(found.atMost, found.distance);
  if (!open.empty()) found.atMost = std::max(found.atMost, open.top().atMost);
  return found;
}

}  // namespace arete
