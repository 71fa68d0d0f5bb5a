// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fan lists the corners of its face: the first triangle has three of them, each other one more. Fans that
// are right, and triangulations of as many triangles, are written in place; from the first face that has
// another number of triangles on, the lists are written anew. faceOf is filled from the first face on that is
// no triangle, since most meshes have triangles alone.
#include "io/formats/common/faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/counted.h"
#include "io/formats/common/polygon.h"

namespace arete {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr std::size_t kFacesPerCancelCheck = 1 << 14;

/// A list with an element for each triangle, of which some are replaced by others, in order.
template <class Element>
class ListRewriter {
 public:
  explicit ListRewriter(std::vector<Element>& list) : list_(list) {}

  /// Replaces the `count` elements from `first` on, which lie behind all replaced before.
  void replace(std::size_t first, std::size_t count, std::span<const Element> by) {
    if (!isMoving_ && by.size() == count) {
      std::copy(by.begin(), by.end(), list_.begin() + std::ptrdiff_t(first));
      return;
    }
    moveTo(first);
    moved_.insert(moved_.end(), by.begin(), by.end());
    at_ = first + count;
  }

  void finish() {
    if (!isMoving_) return;
    moveTo(list_.size());
    list_ = std::move(moved_);
  }

 private:
  void moveTo(std::size_t end) {
    isMoving_ = true;
    moved_.insert(moved_.end(), list_.begin() + std::ptrdiff_t(at_), list_.begin() + std::ptrdiff_t(end));
    at_ = end;
  }

  std::vector<Element>& list_;
  bool isMoving_ = false;
  std::size_t at_ = 0;
  std::vector<Element> moved_;
};

/// The lists of a mesh that have an element for each triangle.
class TriangleRewriter {
 public:
  explicit TriangleRewriter(MeshFile& file)
      : file_(file),
        triangles_(file.mesh.triangles),
        wedges_(file.mesh.wedges),
        faces_(file.mesh.faceOf),
        errors_(file.triangleErrors) {}

  /// Replaces the `count` triangles of a face.
  void replace(std::size_t first, std::size_t count, std::span<const Triangle> by,
               std::span<const Triangle> wedges) {
    const auto repeat = [&](auto& rewriter, const auto& list) {
      if (list.empty() || by.size() == count) return;
      const std::vector repeated(by.size(), list[first]);
      rewriter.replace(first, count, std::span(repeated));
    };
    repeat(faces_, file_.mesh.faceOf);
    repeat(errors_, file_.triangleErrors);
    if (file_.mesh.hasWedges()) wedges_.replace(first, count, wedges);
    triangles_.replace(first, count, by);
  }

  void finish() {
    triangles_.finish();
    wedges_.finish();
    faces_.finish();
    errors_.finish();
  }

 private:
  MeshFile& file_;
  ListRewriter<Triangle> triangles_, wedges_;
  ListRewriter<std::uint32_t> faces_;
  ListRewriter<float> errors_;
};

/// What is listed by face becomes what is listed by triangle.
void listByTriangle(SurfaceMesh& mesh) {
  for (std::vector<std::uint32_t>* list : {&mesh.objectOf, &mesh.groupOf, &mesh.materialOf}) {
    if (list->empty()) continue;
    std::vector<std::uint32_t> byTriangle(mesh.faceOf.size());
    for (std::size_t t = 0; t < byTriangle.size(); ++t) byTriangle[t] = (*list)[mesh.faceOf[t]];
    *list = std::move(byTriangle);
  }
  for (Attribute& attribute : mesh.triangleAttributes) {
    Attribute byTriangle = emptyLike(attribute);
    byTriangle.values.reserve(mesh.faceOf.size() * attribute.elementBytes());
    for (const std::uint32_t face : mesh.faceOf) byTriangle.append(attribute.element(face));
    attribute = std::move(byTriangle);
  }
}

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

void MeshFaces::add(SurfaceMesh& mesh, std::span<const std::uint32_t> corners,
                    std::span<const std::uint32_t> wedges) {
  const auto face = static_cast<std::uint32_t>(faces_++);
  if (corners.size() != 3 && mesh.faceOf.empty()) {
    mesh.faceOf.resize(mesh.triangles.size());
    std::iota(mesh.faceOf.begin(), mesh.faceOf.end(), 0u);
    listsFaces_ = true;
  }
  if (corners.size() > 3) fans_.push_back({faces_, mesh.triangles.size(), corners.size()});
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    if (!wedges.empty()) mesh.wedges.push_back({wedges[0], wedges[i - 1], wedges[i]});
    if (listsFaces_) mesh.faceOf.push_back(face);
  }
}

Status MeshFaces::finish(MeshFile& file, const RunContext& context) {
  ARETE_CHECK(triangulate(file, context));
  // Not by faceOf, which is empty if no triangle is left.
  if (listsFaces_) listByTriangle(file.mesh);
  return {};
}

Status MeshFaces::triangulate(MeshFile& file, const RunContext& context) {
  if (fans_.empty()) return {};
  const PolygonView view = isTerrain(file.mesh) ? PolygonView::above : PolygonView::along;
  TriangleRewriter rewriter(file);
  std::vector<std::uint32_t> corners, wedges;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles, triangleWedges;
  const auto cornersOf = [](const std::vector<Triangle>& list, const Fan& fan,
                            std::vector<std::uint32_t>& to) {
    to.assign(list[fan.first].begin(), list[fan.first].end());
    for (std::size_t i = 1; i + 2 < fan.corners; ++i) to.push_back(list[fan.first + i][2]);
  };
  std::size_t crossing = 0;
  std::uint64_t firstCrossing = 0;
  for (std::size_t f = 0; f < fans_.size(); ++f) {
    if (f % kFacesPerCancelCheck == 0 && context.cancelled())
      return failure(ErrorCode::interrupted, "reading was interrupted");
    const Fan& fan = fans_[f];
    cornersOf(file.mesh.triangles, fan, corners);
    positions.clear();
    for (const std::uint32_t v : corners) positions.push_back(file.mesh.positions[v]);
    if (hasRightFan(positions, view)) continue;

    if (file.mesh.hasWedges()) cornersOf(file.mesh.wedges, fan, wedges);
    const PolygonTriangles polygon = triangulatePolygon(positions, view);
    if (!polygon.isSimple && crossing++ == 0) firstCrossing = fan.face;
    triangles.clear();
    triangleWedges.clear();
    for (const auto& [a, b, c] : polygon.triangles) {
      const Triangle t = {corners[a], corners[b], corners[c]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      triangles.push_back(t);
      if (!wedges.empty()) triangleWedges.push_back({wedges[a], wedges[b], wedges[c]});
    }
    rewriter.replace(fan.first, fan.corners - 2, triangles, triangleWedges);
  }
  rewriter.finish();
  fans_.clear();
  if (crossing > 0)
    file.warnings.push_back(
        {WarningCode::geometry,
         fmt::format("{} of its {} {} an outline that crosses itself, so that triangles are a guess (the "
                     "first is face {})",
                     crossing, counted(faces_, "face", "faces"), agreeing(crossing, "has", "have"),
                     firstCrossing)});
  return {};
}

}  // namespace arete
