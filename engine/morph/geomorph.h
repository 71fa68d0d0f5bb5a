// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/criteria/view.h"
#include "engine/mt/multitriangulation.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Where the vertex v of a node lies on the surface that the node refines: in the floor triangle with these
/// corners (MT vertices, all older than v), at the weights weight[0], weight[1] and 1 minus both. A vertex on
/// a border or rim that rounding puts outside all of them is assigned to the nearest. 24 bytes without
/// padding, as a GPU reads them.
struct MorphNode {
  std::array<std::uint32_t, 3> corner;
  std::array<float, 2> weight;
  float detail;  ///< height of v minus the floor's there; at most the node's error, up to rounding

  double interpolate(double at0, double at1, double at2) const {
    return at2 + weight[0] * (at0 - at2) + weight[1] * (at1 - at2);
  }
};
static_assert(sizeof(MorphNode) == 24);

/// The MorphNode of one node. O(k), k the vertex's degree.
MorphNode morphNode(const MultiTriangulation& mt, NodeId n);
/// The MorphNodes of all nodes. O(N), parallel, the same for any number of threads.
std::vector<MorphNode> makeMorphNodes(const MultiTriangulation& mt, const RunContext& context = {});

/// The two parts of a tolerance in pixels: `cut` for the errors of triangles, `offset` for vertices that are
/// moving.
struct MorphTolerance {
  double cut = 1, offset = 0;
};

/// Geomorphing [Hoppe1998] for one camera (docs/topics/geomorphing.md). An offset is added to a vertex's
/// height, in the unit of heights; those of root vertices are 0. Evaluated parents first,
///
///     rho_n = saturated error of n * pixelsPerHeight(sphere of n)
///     offset(v) = clamp(interpolation of the corners' offsets - share(rho_n) * detail_n,
///                       +-mostOffset(pixelsPerHeight(sphere of n)))
///
/// keeps the surface within the tolerance of every sample in sight, over the saturated cut of a ViewError of
/// this view and tolerance().cut pixels. rho does not increase from parents to children, so if the share of a
/// node is 0 its ancestors are at rest, too.
class MorphCamera {
 public:
  struct Options {
    View view;
    double pixels = 1;          ///< tolerance, > 0
    bool moves = true;          ///< false: all offsets are 0, and the whole tolerance is the cut's
    double cutShare = 2.0 / 3;  ///< of the tolerance, in (0, 1)
  };
  /// Precondition: the view is valid.
  MorphCamera(const Options& options, const MetricFrame& metric);

  const Frustum& frustum() const { return frustum_; }
  const MorphTolerance& tolerance() const { return tolerance_; }
  bool moves() const { return moves_; }
  /// Adapts to a budget that only allows a cut of a larger tolerance: both parts of the tolerance grow by the
  /// same factor. Precondition: cutPixels is finite and > 0.
  void widen(double cutPixels);

  /// An upper bound of the pixels that a unit of height takes anywhere in both the ball and the frustum: 0
  /// out of sight, infinity around the eye of a view without a near distance. Not smaller for a ball that
  /// contains this one.
  double pixelsPerHeight(const Sphere& ball) const;
  /// The same for the convex hull of points in metric space. Precondition: at least one.
  double pixelsPerHeight(std::span<const Vec3> hull) const;
  /// The same for many balls, up to rounding. Precondition: equal sizes.
  void pixelsPerHeight(std::span<const Sphere> balls, std::span<double> results) const;
  bool mayMeet(std::span<const Vec3> hull) const { return pixelsPerHeight(hull) > 0; }
  /// An upper bound of the pixels of a displacement of the given height, including the change of scale along
  /// it. Infinity if it may pass the eye.
  double pixelsOf(double height, double pixelsPerHeight) const;
  /// The same for a displacement that takes pixelsThere at the scale of its start.
  double pixelsOf(double pixelsThere) const;

  /// The part of a node's detail that is still hidden: 1 at its threshold, 0 from twice the threshold on.
  double share(double rho) const {
    return moves_ ? (rho < tolerance_.cut ? 1 : rho < 2 * tolerance_.cut ? 2 - rho / tolerance_.cut : 0) : 0;
  }
  double mostOffset(double pixelsPerHeight) const { return tolerance_.offset / pixelsPerHeight; }
  /// The offset of the node's vertex, given those of its corners.
  double offset(const MorphNode& node, double rho, double pixelsPerHeight, double at0, double at1,
                double at2) const {
    const double s = share(rho);
    if (s == 0) return 0;
    const double free = node.interpolate(at0, at1, at2) - s * node.detail, most = mostOffset(pixelsPerHeight);
    return free > most ? most : free < -most ? -most : free;
  }

 private:
  Frustum frustum_;
  double pixelsPerReach_;  // of a unit of height
  double bend_;            // how fast the reach may change along a displacement
  MorphTolerance tolerance_;
  bool moves_;
};

}  // namespace arete
