// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/cut/cut.h"
#include "engine/mt/multitriangulation.h"
#include "terrain/fit/patch.h"
#include "terrain/fit/samples.h"
#include "terrain/model/plan_orientation.h"

namespace arete {

/// The largest allowed distance of the surface from each sample, in the unit of the heights.
struct FitBounds {
  double everywhere = 0;        ///< > 0; the bound of all samples where `of` is empty
  std::vector<double> of = {};  ///< per MT vertex, > 0; may be empty
  double rounding = 0;          ///< tolerance for rounding: an excess up to this is accepted

  double at(std::uint32_t sample) const { return of.empty() ? everywhere : of[sample]; }
};

/// The front of a cut during a fit: triangles with lists of their samples, vertices with their own heights. A
/// vertex is an index into the vertices of the initial cut; a triangle is a slot. Slots are reused.
class FitMesh {
 public:
  static constexpr std::uint32_t kNone = FitSamples::kNone;
  using Corners = std::array<std::uint32_t, 3>;

  struct Triangle {
    Corners corners = {};  ///< vertices, counter-clockwise in the plan
    Corners next = {};     ///< per corner: the next triangle of its star
    std::uint32_t id = kNone;
    std::uint32_t firstSample = kNone;
  };
  /// A triangle of the floor of a node that may be removed, and the samples that it would cover.
  struct FloorTriangle {
    Corners corners = {};
    std::uint32_t id = kNone;
    std::vector<std::uint32_t> samples = {};
  };

  /// The heights are those of the multitriangulation. Precondition: `samples` is what shareSamples() gave for
  /// `cut`, so its triangles are counter-clockwise; `mt` outlives this. O(vertices + triangles).
  FitMesh(const MultiTriangulation& mt, const Cut& cut, FitSamples samples, FitBounds bounds);

  const MultiTriangulation& mt() const { return mt_; }
  std::uint32_t vertexCount() const { return static_cast<std::uint32_t>(heights_.size()); }
  std::uint32_t slotCount() const { return static_cast<std::uint32_t>(triangles_.size()); }
  std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(triangles_.size() - free_.size()); }
  const Triangle& triangle(std::uint32_t slot) const { return triangles_[slot]; }
  bool isLive(std::uint32_t slot) const { return triangles_[slot].id != kNone; }

  std::uint32_t mtVertex(std::uint32_t vertex) const { return mtVertices_[vertex]; }
  /// The vertex with an MT vertex; kNone where it is not one of the initial cut. O(log vertices).
  std::uint32_t indexOf(std::uint32_t mtVertex) const {
    const auto found = std::ranges::lower_bound(mtVertices_, mtVertex);
    if (found == mtVertices_.end() || *found != mtVertex) return kNone;
    return static_cast<std::uint32_t>(found - mtVertices_.begin());
  }
  /// Whether the vertex is still in the mesh.
  bool isIn(std::uint32_t vertex) const { return star_[vertex] != kNone; }

  const std::vector<double>& heights() const { return heights_; }
  void setHeights(std::vector<double> heights) { heights_ = std::move(heights); }
  void raise(std::uint32_t vertex, double by) { heights_[vertex] += by; }
  /// Marks a vertex that must keep its height and must not be removed.
  void fix(std::uint32_t vertex) { isFixed_[vertex] = true; }
  bool isFixed(std::uint32_t vertex) const { return isFixed_[vertex]; }

  const FitBounds& bounds() const { return bounds_; }
  void setBounds(FitBounds bounds) { bounds_ = std::move(bounds); }
  /// The largest |residual| / bound that is accepted: 1 and an allowance for rounding.
  double accepted() const { return accepted_; }
  void setAccepted(double accepted) { accepted_ = accepted; }

  /// visit(slot) for the triangles at a vertex.
  template <class Visit>
  void forStar(std::uint32_t vertex, const Visit& visit) const {
    for (std::uint32_t t = star_[vertex]; t != kNone;) {
      const Triangle& triangle = triangles_[t];
      const std::uint32_t next = triangle.next[triangle.corners[0] == vertex   ? 0
                                               : triangle.corners[1] == vertex ? 1
                                                                               : 2];
      visit(t);
      t = next;
    }
  }
  /// visit(sample) for the samples in a triangle's list; samples are MT vertices.
  template <class Visit>
  void forSamples(std::uint32_t slot, const Visit& visit) const {
    for (std::uint32_t s = triangles_[slot].firstSample; s != kNone; s = nextSample_[s]) visit(s);
  }

  Vec2 plan(std::uint32_t sample) const {
    const VertexArrays& v = mt_.vertices();
    if (!v.isLattice()) return v.plan[sample];
    const std::uint32_t s = v.samples[sample];
    const auto row =
        static_cast<std::uint32_t>((s + 0.5) * perColumn_);  // exact: see TriangleLocator::planPosition()
    return {static_cast<double>(s - row * v.columns), static_cast<double>(row)};
  }
  /// A triangle of the plan, prepared for barycentric coordinates.
  struct Weights {
    std::array<Vec2, 3> at;
    double inverse;
    bool isThin = false;  ///< the area is lost to rounding: weights are computed as rational numbers
    std::array<double, 3> of(Vec2 p) const {
      if (isThin) return exactPlanWeights(at[0], at[1], at[2], p);
      const auto turn = [&](int i, int j) {
        return (at[i].x - p.x) * (at[j].y - p.y) - (at[i].y - p.y) * (at[j].x - p.x);
      };
      // Samples lie in their triangles, so a negative weight is rounding.
      const double a = std::max(0.0, turn(1, 2) * inverse), b = std::max(0.0, turn(2, 0) * inverse);
      return {a, b, std::max(0.0, 1 - a - b)};
    }
  };
  Weights weights(const Corners& corners) const;
  /// z_TIN - z_sample.
  double residual(const Corners& corners, const std::array<double, 3>& w, std::uint32_t sample) const {
    // From height differences: weights are rounded, and heights may be far from zero.
    const double z = mt_.vertices().height(VertexId(sample));
    return w[0] * (heights_[corners[0]] - z) + w[1] * (heights_[corners[1]] - z) +
           w[2] * (heights_[corners[2]] - z);
  }
  /// The largest |residual| / bound of a triangle's samples. O(samples).
  double severity(std::uint32_t slot) const;

  /// Whether all of the node's triangles are in the mesh, so that it can be removed. Precondition: its vertex
  /// isIn().
  bool isLeaf(NodeId node) const;
  /// Removes a leaf from the cut: its floor replaces its star. Precondition: `floor` is that of the leaf, its
  /// triangles are counter-clockwise and have all of the star's samples; the vectors of samples are cleared.
  void remove(NodeId leaf, std::span<FloorTriangle> floor);

  /// The largest |residual| over the samples that each triangle covers, edges and corners included; by slot,
  /// 0 where there is none. O(samples).
  std::vector<double> errors() const;

 private:
  void link(std::uint32_t slot);
  void unlink(std::uint32_t slot);

  const MultiTriangulation& mt_;
  double perColumn_;
  std::vector<std::uint32_t> mtVertices_;  // rising
  std::vector<double> heights_;
  std::vector<bool> isFixed_;
  std::vector<std::uint32_t> star_;  // per vertex: a triangle
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> nextSample_;
  FitBounds bounds_;
  double accepted_ = 1;
};

}  // namespace arete
