// SPDX-License-Identifier: GPL-3.0-or-later
//
// Branch and bound over parts of the triangle, which are triangles themselves. The distance to one triangle
// of the target, a convex set, is a convex function: over a part it is largest at a corner, and the distance
// to the whole target is no larger. So the target's triangles nearest to the corners bound the part from
// above [GutheBorodinKlein2005], [TangLeeKim2009]. So does the distance itself, which has the Lipschitz
// constant 1: every point of a part is within 1 / sqrt(3) of its longest side from a corner. The target
// triangle that gave a part its bound is tried for its halves too.
#include "terrain/measure/farthest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

namespace arete {
namespace {

constexpr std::uint64_t kPointsPerStopCheck = 256;

struct Part {
  SpaceTriangle corners;
  std::array<NearestOnMesh::Answer, 3> answers;
  std::uint32_t guide = 0;  // the target's triangle that gave the least bound
  double atMost = 0;

  bool operator<(const Part& other) const { return atMost < other.atMost; }
};

/// The index of the side's first corner.
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

void bound(Part& part, const TriangleMesh& target) {
  const int side = longestSide(part.corners);
  const double longest = std::sqrt(squaredDistance(part.corners[side], part.corners[(side + 1) % 3]));
  const double farthest =
      std::max({part.answers[0].distance, part.answers[1].distance, part.answers[2].distance});
  part.atMost = farthest + longest * std::numbers::inv_sqrt3;
  const std::array candidates = {part.guide, part.answers[0].triangle, part.answers[1].triangle,
                                 part.answers[2].triangle};
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (std::find(candidates.begin(), candidates.begin() + k, candidates[k]) != candidates.begin() + k)
      continue;
    double largest = 0;
    for (int i = 0; i < 3 && largest < part.atMost; ++i)
      largest = std::max(largest, distanceTo(target, candidates[k], part.corners[i]));
    if (largest >= part.atMost) continue;
    part.atMost = largest;
    part.guide = candidates[k];
  }
  // With rounding, the bound may lie below the distance at a corner.
  part.atMost = std::max(part.atMost, farthest);
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
  Part whole{
      .corners = triangle, .answers = {answers[0], answers[1], answers[2]}, .guide = answers[0].triangle};
  for (int i = 0; i < 3; ++i) take(triangle[i], answers[i]);
  const auto isSettled = [&](const Part& part) {
    const double reached = std::max(options.known, found.distance);
    return part.atMost <= std::max(reached * (1 + options.accuracy), options.slack);
  };
  bound(whole, target);
  if (!isSettled(whole) && options.budget > 0) {
    // Where the two meshes coincide, the target's triangle nearest to the middle gives the best bound.
    const auto& [a, b, c] = triangle;
    const Vec3 middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
    const NearestOnMesh::Answer answer = to.nearest(middle);
    take(middle, answer);
    whole.guide = answer.triangle;
    bound(whole, target);
  }

  std::priority_queue<Part> open;
  const auto keep = [&](const Part& part) {
    if (isSettled(part))
      found.atMost = std::max(found.atMost, part.atMost);
    else
      open.push(part);
  };
  keep(whole);
  for (std::uint64_t queries = 1; queries < options.budget && !open.empty(); ++queries) {
    if (queries % kPointsPerStopCheck == 0 && options.shouldStop && options.shouldStop()) break;
    const Part part = open.top();
    open.pop();
    const int side = longestSide(part.corners), other = (side + 1) % 3;
    const Vec3 middle = part.corners[side] + 0.5 * (part.corners[other] - part.corners[side]);
    const NearestOnMesh::Answer answer = to.nearest(middle);
    take(middle, answer);
    for (const int replaced : {side, other}) {
      Part half = part;
      half.corners[replaced] = middle;
      half.answers[replaced] = answer;
      bound(half, target);
      half.atMost = std::min(half.atMost, part.atMost);
      keep(half);
    }
  }
  found.atMost = std::max(found.atMost, found.distance);
  if (!open.empty()) found.atMost = std::max(found.atMost, open.top().atMost);
  return found;
}

}  // namespace arete
