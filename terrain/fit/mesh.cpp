// SPDX-License-Identifier: GPL-3.0-or-later
//
// The star of a vertex is a linked list through the corners of its triangles, in no particular order: a fit
// only ever visits all of them. The samples of a triangle are a linked list too; a removal distributes the
// lists of a star among its floor, so each sample is located only once.
#include "terrain/fit/mesh.h"

#include <utility>

#include "terrain/model/plan_orientation.h"

namespace arete {

FitMesh::FitMesh(const MultiTriangulation& mt, const Cut& cut, FitSamples samples, FitBounds bounds)
    : mt_(mt),
      perColumn_(1.0 / std::max(1u, mt.vertices().columns)),
      mtVertices_(cut.vertices),
      heights_(cut.vertices.size()),
      isFixed_(cut.vertices.size(), false),
      star_(cut.vertices.size(), kNone),
      triangles_(cut.triangles.size()),
      nextSample_(std::move(samples.next)),
      bounds_(std::move(bounds)) {
  for (std::size_t v = 0; v < heights_.size(); ++v)
    heights_[v] = mt.vertices().height(VertexId(mtVertices_[v]));
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    triangles_[t] = {.corners = cut.triangles[t], .id = cut.ids[t], .firstSample = samples.first[t]};
    link(t);
  }
}

void FitMesh::link(std::uint32_t slot) {
  Triangle& t = triangles_[slot];
  for (int i = 0; i < 3; ++i) t.next[i] = std::exchange(star_[t.corners[i]], slot);
}

void FitMesh::unlink(std::uint32_t slot) {
  const Triangle& t = triangles_[slot];
  for (int i = 0; i < 3; ++i) {
    std::uint32_t* at = &star_[t.corners[i]];
    while (*at != slot) {
      Triangle& other = triangles_[*at];
      int j = 0;
      while (other.corners[j] != t.corners[i]) ++j;
      at = &other.next[j];
    }
    *at = t.next[i];
  }
}

FitMesh::Weights FitMesh::weights(const Corners& corners) const {
  Weights w;
  for (int i = 0; i < 3; ++i) w.at[i] = plan(mtVertices_[corners[i]]);
  const double left = (w.at[1].x - w.at[0].x) * (w.at[2].y - w.at[0].y),
               right = (w.at[1].y - w.at[0].y) * (w.at[2].x - w.at[0].x), area = left - right;
  w.inverse = 1 / area;
  constexpr double kTrusted = 0x1p-12;
  // On a lattice the terms are integers, computed exactly.
  w.isThin = !mt_.vertices().isLattice() && !(area > kTrusted * (std::abs(left) + std::abs(right)));
  return w;
}

double FitMesh::severity(std::uint32_t slot) const {
  const Corners& corners = triangles_[slot].corners;
  const Weights w = weights(corners);
  double worst = 0;
  forSamples(slot, [&](std::uint32_t s) {
    worst = std::max(worst, std::abs(residual(corners, w.of(plan(s)), s)) / bounds_.at(s));
  });
  return worst;
}

bool FitMesh::isLeaf(NodeId node) const {
  const std::uint32_t begin = mt_.slotTriangle(node, 0).index(), end = begin + mt_.slotCount(node);
  std::uint32_t own = 0;
  bool isWhole = true;
  forStar(indexOf(mt_.apex(node).index()), [&](std::uint32_t t) {
    isWhole = isWhole && triangles_[t].id >= begin && triangles_[t].id < end;
    ++own;
  });
  // A damaged model may have removed some of them away from the apex.
  return isWhole && own == mt_.ceilingSize(node);
}

void FitMesh::remove(NodeId leaf, std::span<FloorTriangle> floor) {
  const std::uint32_t apex = indexOf(mt_.apex(leaf).index());
  while (star_[apex] != kNone) {
    const std::uint32_t slot = star_[apex];
    unlink(slot);
    triangles_[slot] = {};
    free_.push_back(slot);
  }
  for (FloorTriangle& made : floor) {
    const std::uint32_t slot = free_.back();  // a floor is smaller than its star
    free_.pop_back();
    Triangle& t = triangles_[slot];
    t.corners = made.corners;
    t.id = made.id;
    for (const std::uint32_t s : made.samples) nextSample_[s] = std::exchange(t.firstSample, s);
    made.samples.clear();
    link(slot);
  }
}

std::vector<double> FitMesh::errors() const {
  std::vector<double> errors(triangles_.size(), 0);
  const auto widen = [&](std::uint32_t slot, double error) { errors[slot] = std::max(errors[slot], error); };
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (!isLive(t)) continue;
    const Corners& corners = triangles_[t].corners;
    const Weights w = weights(corners);
    forSamples(t, [&](std::uint32_t s) {
      const Vec2 p = plan(s);
      // isOn[i]: the sample lies on the edge opposite to corner i. On two of them, it is a vertex.
      std::array<bool, 3> isOn;
      for (int i = 0; i < 3; ++i) isOn[i] = planOrientation(w.at[(i + 1) % 3], w.at[(i + 2) % 3], p) == 0;
      // A weight is right to a few ulp, so the error is right to a few ulp of the height differences. Corners
      // opposite to an edge with the sample have no weight, and at a vertex nothing is rounded.
      std::array<double, 3> part = w.of(p);
      double apart = 0;
      for (int i = 0; i < 3; ++i) {
        const bool isVertex = isOn[(i + 1) % 3] && isOn[(i + 2) % 3];
        if (isOn[i]) part[i] = 0;
        if (isVertex) part[i] = 1;
        const double difference = heights_[corners[i]] - mt_.vertices().height(VertexId(s));
        if (!isOn[i] && !isVertex) apart = std::max(apart, std::abs(difference));
      }
      const double error = std::abs(residual(corners, part, s)) + 0x1p-50 * apart;
      widen(t, error);
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t from = corners[(i + 1) % 3], to = corners[(i + 2) % 3];
        if (isOn[(i + 1) % 3] && isOn[(i + 2) % 3])  // the vertex opposite to edge i
          forStar(corners[i], [&](std::uint32_t other) { widen(other, error); });
        else if (isOn[i])
          forStar(from, [&](std::uint32_t other) {
            const Corners& c = triangles_[other].corners;
            if (c[0] == to || c[1] == to || c[2] == to) widen(other, error);
          });
      }
    });
  }
  return errors;
}

}  // namespace arete
