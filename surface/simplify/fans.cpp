// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/simplify/fans.h"

#include <algorithm>

namespace arete {
namespace {

/// Walks around a vertex, one neighbour a step.
class LinkWalk {
 public:
  LinkWalk(const LiveMesh& mesh, VertexId v) : mesh_(mesh), first_(mesh.vertexHalfedge[v]), at_(first_) {}

  bool isDone() const { return isDone_; }
  int steps() const { return steps_; }
  VertexId take() {
    ++steps_;
    if (isLast_) {
      isDone_ = true;
      return mesh_.origin(LiveMesh::previousInTriangle(at_));
    }
    const VertexId v = mesh_.origin(LiveMesh::nextInTriangle(at_));
    const HalfedgeId after = mesh_.twinOf(LiveMesh::previousInTriangle(at_));
    if (after == first_)
      isDone_ = true;
    else if (after.isValid())
      at_ = after;
    else
      isLast_ = true;
    return v;
  }

 private:
  const LiveMesh& mesh_;
  HalfedgeId first_, at_;
  bool isLast_ = false, isDone_ = false;
  int steps_ = 0;
};

}  // namespace

bool KnownEdges::haveEdge(const LiveMesh& mesh, VertexId a, VertexId b) {
  constexpr int kFew = 64;
  const std::uint64_t edge = std::uint64_t{std::min(a, b).index()} << 32 | std::max(a, b).index();
  LinkWalk aroundA(mesh, a), aroundB(mesh, b);
  for (int steps = 0; !aroundA.isDone() && !aroundB.isDone(); ++steps) {
    if (steps == kFew)
      if (const auto found = known_.find(edge); found != known_.end()) return found->second;
    if (aroundA.take() != b && aroundB.take() != a) continue;
    if (steps >= kFew) known_[edge] = true;
    return true;
  }
  if (aroundA.steps() > kFew) known_[edge] = false;
  return false;
}

namespace {

Vec3 unitOrZero(const Vec3& normal) {
  const double length = norm(normal);
  return length > 0 ? normal / length : Vec3{};
}

/// 1 where there is no angle.
double cosineOf(const Vec3& a, const Vec3& b) {
  return a == Vec3{} || b == Vec3{} ? 1 : dot(a, b);
}

}  // namespace

HoleTriangulation fanAround(int corner, int corners) {
  HoleTriangulation fan;
  fan.size = 0;
  for (int k = 1; k + 1 < corners; ++k) {
    const int a = (corner + k) % corners, b = (corner + k + 1) % corners;
    // From the lowest corner on; that keeps the turn.
    if (corner < a && corner < b)
      fan.add(corner, a, b);
    else if (a < b)
      fan.add(a, b, corner);
    else
      fan.add(b, corner, a);
  }
  return fan;
}

bool SurfaceHole::gather(const SurfaceState& state, VertexId v) {
  const auto most = static_cast<int>(state.maxDegree);
  vertex_ = v;
  hasBeyond_ = false;
  if (!star_.gather(state.mesh, v, most + 1) || star_.triangleCount > most || star_.linkSize < 3)
    return false;
  if (star_.isOpen && star_.link[0] == star_.link[star_.linkSize - 1]) return false;
  apex_ = state.position(v);
  for (int i = 0; i < star_.linkSize; ++i) places_[i] = state.position(star_.link[i]);
  normal_ = {};
  for (int i = 0; i < star_.triangleCount; ++i) {
    normals_[i] = cross(places_[i] - apex_, places_[next(i)] - apex_);
    normal_ = normal_ + normals_[i];
  }
  line_ = {};
  if (!state.parts.hasLines()) return true;
  line_ = lineThrough(state.parts, star_.triangleCount, star_.isOpen, [&](int t) {
    TriangleLabels labels = state.labelsOf(star_.slot(t));
    std::rotate(labels.wedges.begin(), labels.wedges.begin() + LiveMesh::sideOf(star_.outgoing[t]),
                labels.wedges.end());
    return labels;
  });
  return line_.passes;
}

/// Whether no line and no border runs along the edge of a triangle of the star at the rim.
bool SurfaceHole::goesOnBeyond(const SurfaceState& state, int triangle) const {
  const auto from = [&](HalfedgeId h) {
    TriangleLabels labels = state.labelsOf(LiveMesh::slotOf(h));
    std::rotate(labels.wedges.begin(), labels.wedges.begin() + LiveMesh::sideOf(h), labels.wedges.end());
    return labels;
  };
  const HalfedgeId rim = star_.rim(triangle), beyond = state.mesh.twinOf(rim);
  if (!beyond.isValid()) return false;
  const TriangleLabels a = from(rim), b = from(beyond);
  return state.parts.areAlike(a, b) && a.wedges[0] == b.wedges[1] && a.wedges[1] == b.wedges[0];
}

bool SurfaceHole::keepsShape(int corner) const {
  if (line_.isThere() && corner != line_.ends[0] && corner != line_.ends[1]) return false;
  const Vec3& u = places_[corner];
  for (int a = next(corner); next(a) != corner; a = next(a)) {
    const Vec3 normal = cross(places_[a] - u, places_[next(a)] - u);
    const Vec3& before = a < star_.triangleCount ? normals_[a] : normal_;
    if (!(dot(normal, before) > 0)) return false;
  }
  return true;
}

void SurfaceHole::gatherBeyond(const SurfaceState& state) {
  hasBeyond_ = true;
  sharpest_ = 1;
  const auto normalOf = [&](HalfedgeId h) -> Vec3 {
    if (!h.isValid()) return {};
    const LiveMesh::Corners& corners = state.mesh.triangles[LiveMesh::slotOf(h)].corners;
    const Vec3 &a = state.position(corners[0]), &b = state.position(corners[1]),
               &c = state.position(corners[2]);
    return unitOrZero(cross(b - a, c - a));
  };
  std::array<Vec3, kMaxHoleCorners> own;
  for (int i = 0; i < star_.triangleCount; ++i) {
    own[i] = unitOrZero(normals_[i]);
    beyond_[i] = normalOf(state.mesh.twinOf(star_.rim(i)));
    sharpest_ = std::min(sharpest_, cosineOf(own[i], beyond_[i]));
  }
  for (int i = star_.triangleCount; i < star_.linkSize; ++i) beyond_[i] = {};
  const int spokes = star_.isOpen ? star_.triangleCount - 1 : star_.triangleCount;
  for (int i = 0; i < spokes; ++i)
    sharpest_ = std::min(sharpest_, cosineOf(own[i], own[i + 1 < star_.triangleCount ? i + 1 : 0]));
}

bool SurfaceHole::folds(const SurfaceState& state, int corner) {
  if (!hasBeyond_) gatherBeyond(state);
  constexpr double kFolded = -0.5;  // the cosine of 120 degrees
  const double least = std::min(kFolded, sharpest_);
  const Vec3& u = places_[corner];
  Vec3 before{};
  for (int a = next(corner); next(a) != corner; a = next(a)) {
    const Vec3 normal = unitOrZero(cross(places_[a] - u, places_[next(a)] - u));
    if (cosineOf(normal, beyond_[a]) < least || cosineOf(normal, before) < least) return true;
    // The first and the last have two edges of the link.
    if (a == next(corner) && cosineOf(normal, beyond_[corner]) < least) return true;
    if (next(next(a)) == corner && cosineOf(normal, beyond_[next(a)]) < least) return true;
    before = normal;
  }
  return false;
}

bool SurfaceHole::mayBeFilled(const SurfaceState& state) {
  if (ear() >= 0 && !goesOnBeyond(state, ear())) return false;
  if (star_.isOpen) return !edges_.haveEdge(state.mesh, star_.link[0], star_.link[star_.linkSize - 1]);
  if (star_.linkSize > 3) return true;
  // The triangle that would fill the hole may be there already, beyond the star.
  const HalfedgeId beyond = state.mesh.twinOf(star_.rim(0));
  return !beyond.isValid() || state.mesh.origin(LiveMesh::previousInTriangle(beyond)) != star_.link[2];
}

bool SurfaceHole::keepsTopology(const SurfaceState& state, int corner) {
  constexpr int kFew = 64;
  int steps = 0;
  bool keeps = true;
  const VertexId u = star_.link[corner];
  forLink(state.mesh, u, [&](VertexId w) {
    if (++steps > kFew) return false;
    for (int i = 0; i < star_.linkSize; ++i)
      if (star_.link[i] == w && !areNeighbours(i, corner)) keeps = false;
    return keeps;
  });
  if (steps <= kFew) return keeps;
  for (int i = 0; i < star_.linkSize; ++i)
    if (i != corner && !areNeighbours(i, corner) && edges_.haveEdge(state.mesh, u, star_.link[i]))
      return false;
  return true;
}

TriangleLabels SurfaceHole::labelsOf(const SurfaceState& state,
                                     const std::array<std::uint8_t, 3>& triangle) const {
  const int ownSide = line_.sideOf(triangle);
  const auto isOnSide = [&](int t) { return line_.sideOfStar(t) == ownSide; };
  // The face of the triangle of the star that has the edge opposite the fan's corner; a new border edge has
  // none, so that of any triangle of its side.
  int heir = -1;
  for (int t = 0; t < star_.triangleCount && heir < 0; ++t)
    if (isOnSide(t)) heir = t;
  for (int c = 0; c < 3; ++c) {
    const int t = triangle[static_cast<std::size_t>(c)];
    const int after = triangle[static_cast<std::size_t>((c + 1) % 3)];
    if (t < star_.triangleCount && next(t) == after && isOnSide(t)) heir = t;
  }
  TriangleLabels labels;
  labels.face = state.labelsOf(star_.slot(heir)).face;
  if (!state.parts.hasWedges) return labels;
  for (int c = 0; c < 3; ++c) {
    const int i = triangle[static_cast<std::size_t>(c)];
    // The triangle after the corner, or before it.
    int t = i < star_.triangleCount ? i : i - 1;
    std::uint32_t at = (LiveMesh::sideOf(star_.outgoing[t]) + (t == i ? 1 : 2)) % 3;
    if (!isOnSide(t)) {
      t = i > 0 ? i - 1 : star_.triangleCount - 1;
      at = (LiveMesh::sideOf(star_.outgoing[t]) + 2) % 3;
    }
    labels.wedges[static_cast<std::size_t>(c)] = state.labelsOf(star_.slot(t)).wedges[at];
  }
  return labels;
}

}  // namespace arete
