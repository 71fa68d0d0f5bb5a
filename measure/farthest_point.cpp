// SPDX-License-Identifier: GPL-3.0-or-later
//
// Branch and bound over parts of the triangle, which are triangles themselves. The distance to one triangle
// of the target, a convex set, is a convex function: over a part it is largest at a corner, and the distance
// to the whole target is no larger. So the target's triangles nearest to the corners bound the part from
// above [GutheBorodinKlein2005], [TangLeeKim2009]. So does the distance itself, which has the Lipschitz
// constant 1: every point of a part is within 1 / sqrt(3) of its longest side from a corner. The target
// triangle that gave a part its bound is tried for its halves too.
//
// A part that lies across an edge of the target is cut there rather than in the middle, so that each half has
// a triangle of its own: where the meshes coincide, no number of halves in the middle would settle it.
#include "measure/farthest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

namespace arete {
namespace {

constexpr std::uint64_t kPointsPerStopCheck = 256;
/// Cuts at edges of the target before the next one in the middle, without which long parts would not end.
constexpr std::uint8_t kMostCuts = 4;
/// A cut so near to a corner would leave the part as it is, but for rounding.
constexpr double kLeastShare = 1e-6;
/// Larger parts, beside the target's triangle, are cut in the middle.
constexpr double kLargest = 4;

struct Part {
  SpaceTriangle corners;
  std::array<NearestOnMesh::Answer, 3> answers;
  std::uint32_t guide = 0;  // the target's triangle that gave the least bound
  double atMost = 0;
  std::uint8_t cuts = 0;  // at edges, since the last one in the middle

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

/// Where a part is cut: between two of its corners, at a share of the way from the first to the second.
struct Split {
  int from = 0, to = 0;
  double share = 0.5;
  bool isMiddle = true;
};

/// On a side of a part that leads to the corner farthest from the triangle that gave the bound, where it
/// crosses the plane that stands on a side of that triangle; in the middle of the longest side where there is
/// no such place.
Split splitOf(const Part& part, const TriangleMesh& target) {
  const int longest = longestSide(part.corners);
  const Split middle{longest, (longest + 1) % 3};
  if (part.cuts == kMostCuts) return middle;
  const auto& v = target.triangles[part.guide];
  const SpaceTriangle triangle{target.positions[v[0]], target.positions[v[1]], target.positions[v[2]]};
  const int side = longestSide(triangle);
  if (squaredDistance(part.corners[middle.from], part.corners[middle.to]) >
      kLargest * kLargest * squaredDistance(triangle[side], triangle[(side + 1) % 3]))
    return middle;
  std::array<double, 3> distances{};
  for (int i = 0; i < 3; ++i) distances[i] = distanceToTriangle(part.corners[i], triangle);
  const auto to = static_cast<int>(std::ranges::max_element(distances) - distances.begin());
  const Vec3 normal = areaNormal(triangle);
  Split best = middle;
  for (const int from : {(to + 1) % 3, (to + 2) % 3}) {
    double share = 1;  // at the first plane that the way crosses outwards
    for (int i = 0; i < 3; ++i) {
      const Vec3 inward = cross(normal, triangle[(i + 1) % 3] - triangle[i]);
      const double inside = dot(inward, part.corners[from] - triangle[i]),
                   outside = dot(inward, part.corners[to] - triangle[i]);
      if (inside > 0 && outside < 0) share = std::min(share, inside / (inside - outside));
    }
    if (share > kLeastShare && share < 1 - kLeastShare && (best.isMiddle || share > best.share))
      best = {from, to, share, false};
  }
  return best;
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
    const Split split = splitOf(part, target);
    const Vec3 between =
        part.corners[split.from] + split.share * (part.corners[split.to] - part.corners[split.from]);
    const NearestOnMesh::Answer answer = to.nearest(between);
    take(between, answer);
    for (const int replaced : {split.from, split.to}) {
      Part half = part;
      half.cuts = split.isMiddle ? 0 : static_cast<std::uint8_t>(part.cuts + 1);
      half.corners[replaced] = between;
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
