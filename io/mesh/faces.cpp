// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fan lists the corners of its face: the first triangle has three of them, each other one more. Fans that
// are right, and triangulations of as many triangles, are written in place; from the first face that has
// another number of triangles on, the list is written anew.
#include "io/mesh/faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "io/mesh/polygon.h"

namespace arete {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t kFacesPerCancelCheck = 1 << 14;

/// The triangles of a mesh, with their errors, of which some are replaced by others, in order.
class TriangleRewriter {
 public:
  explicit TriangleRewriter(MeshFile& file)
      : triangles_(file.mesh.triangles), errors_(file.triangleErrors), hasErrors_(!errors_.empty()) {}

  /// Replaces the `count` triangles from `first` on, which lie behind all replaced before.
  void replace(std::size_t first, std::size_t count, const std::vector<Triangle>& by) {
    if (!isMoving_ && by.size() == count) {
      std::copy(by.begin(), by.end(), triangles_.begin() + std::ptrdiff_t(first));
      return;
    }
    moveTo(first);
    const float error = hasErrors_ ? errors_[first] : 0;
    moved_.insert(moved_.end(), by.begin(), by.end());
    if (hasErrors_) movedErrors_.insert(movedErrors_.end(), by.size(), error);
    at_ = first + count;
  }

  /// Leaves triangles as they are.
  void keep(std::size_t first, std::size_t count) {
    if (isMoving_) moveTo(first + count);
  }

  void finish() {
    if (!isMoving_) return;
    moveTo(triangles_.size());
    triangles_ = std::move(moved_);
    errors_ = std::move(movedErrors_);
  }

 private:
  void moveTo(std::size_t end) {
    isMoving_ = true;
    moved_.insert(moved_.end(), triangles_.begin() + std::ptrdiff_t(at_),
                  triangles_.begin() + std::ptrdiff_t(end));
    if (hasErrors_)
      movedErrors_.insert(movedErrors_.end(), errors_.begin() + std::ptrdiff_t(at_),
                          errors_.begin() + std::ptrdiff_t(end));
    at_ = end;
  }

  std::vector<Triangle>& triangles_;
  std::vector<float>& errors_;
  bool hasErrors_, isMoving_ = false;
  std::size_t at_ = 0;
  std::vector<Triangle> moved_;
  std::vector<float> movedErrors_;
};

/// True if some triangles have an area seen from above and all of these are turned the same way. An area
/// within the rounding of the coordinates, as a wall has, does not count.
bool isTerrain(const TriangleMesh& mesh) {
  constexpr double kNoise = 64 * std::numeric_limits<double>::epsilon();
  int side = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y, area = ux * vy - uy * vx;
    const double largest =
        std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y), std::abs(c.x), std::abs(c.y)});
    if (!(std::abs(area) > kNoise * largest * (std::abs(ux) + std::abs(uy) + std::abs(vx) + std::abs(vy))))
      continue;
    const int own = area > 0 ? 1 : -1;
    if (side == -own) return false;
    side = own;
  }
  return side != 0;
}

}  // namespace

void MeshFaces::add(std::vector<Triangle>& triangles, std::span<const std::uint32_t> corners) {
  ++faces_;
  if (corners.size() > 3) fans_.push_back({faces_, triangles.size(), corners.size()});
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

Status MeshFaces::finish(MeshFile& file, const RunContext& context) {
  if (fans_.empty()) return {};
  const PolygonView view = isTerrain(file.mesh) ? PolygonView::above : PolygonView::along;
  TriangleRewriter rewriter(file);
  std::vector<std::uint32_t> corners;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  std::size_t crossing = 0;
  std::uint64_t firstCrossing = 0;
  for (std::size_t f = 0; f < fans_.size(); ++f) {
    if (f % kFacesPerCancelCheck == 0 && context.cancelled())
      return failure(ErrorCode::interrupted, "reading was interrupted");
    const Fan& fan = fans_[f];
    const auto fanTriangle = [&](std::size_t i) { return file.mesh.triangles[fan.first + i]; };
    const Triangle start = fanTriangle(0);
    corners.assign(start.begin(), start.end());
    for (std::size_t i = 1; i + 2 < fan.corners; ++i) corners.push_back(fanTriangle(i)[2]);
    positions.clear();
    for (const std::uint32_t v : corners) positions.push_back(file.mesh.positions[v]);

    if (hasRightFan(positions, view)) {
      rewriter.keep(fan.first, fan.corners - 2);
      continue;
    }
    const PolygonTriangles polygon = triangulatePolygon(positions, view);
    if (!polygon.isSimple && crossing++ == 0) firstCrossing = fan.face;
    triangles.clear();
    for (const auto& [a, b, c] : polygon.triangles) {
      const Triangle t = {corners[a], corners[b], corners[c]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    rewriter.replace(fan.first, fan.corners - 2, triangles);
  }
  rewriter.finish();
  fans_.clear();
  if (crossing > 0)
    file.warnings.push_back(fmt::format(
        "{} of its {} faces have an outline that crosses itself, so their triangles are a guess (the first "
        "is face {})",
        crossing, faces_, firstCrossing));
  return {};
}

}  // namespace arete
