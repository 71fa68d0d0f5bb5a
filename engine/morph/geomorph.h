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
/// corners (MT vertices, all older than v), at weight[0], weight[1] and the rest to 1. A vertex on a border
/// or rim that is in none by rounding is put to the nearest. 24 bytes without padding, as they are for a GPU.
struct MorphNode {
  std::array<std::uint32_t, 3> corner;
  std::array<float, 2> weight;
  float detail;  ///< height of v minus the floor's there; at most the node's error, up to rounding

  double interpolate(double at0, double at1, double at2) const {
    return at2 + weight[0] * (at0 - at2) + weight[1] * (at1 - at2);
  }
};
static_assert(sizeof(MorphNode) == 24);

/// Of one node. O(k), k the vertex's degree.
MorphNode morphNode(const MultiTriangulation& mt, NodeId n);
/// Of every node. O(N), parallel, the same for any number of threads.
std::vector<MorphNode> makeMorphNodes(const MultiTriangulation& mt, const RunContext& context = {});

/// How a tolerance in pixels is shared: `cut` for the errors of triangles, `offset` for vertices on the way.
struct MorphTolerance {
  double cut = 1, offset = 0;
};

/// The law of geomorphing for one camera (docs/topics/geomorphing.md). Offsets are heights that are added to
/// a vertex's own, in the unit of heights; those of root vertices are 0. Taken parents first,
///
///     rho_n = saturated error of n * pixelsPerHeight(sphere of n)
///     offset(v) = clamp(interpolation of the corners' offsets - share(rho_n) * detail_n,
///                       +-mostOffset(pixelsPerHeight(sphere of n)))
///
/// keeps the surface within the tolerance of every sample in sight, over the saturated cut of a ViewError of
/// this view and tolerance().cut pixels. rho does not grow down the graph, so where the share is 0 all
/// ancestors rest, too.
class MorphCamera {
 public:
  struct Options {
    View view;
    double pixels = 1;          ///< tolerance, > 0
    bool moves = true;          ///< false: all offsets are 0, and the whole tolerance is the cut's
    double cutShare = 2.0 / 3;  ///< of the tolerance, in (0, 1)
  };
  /// Precondition: the view validates.
  MorphCamera(const Options& options, const MetricFrame& metric);

  const Frustum& frustum() const { return frustum_; }
  const MorphTolerance& tolerance() const { return tolerance_; }
  bool moves() const { return moves_; }
  /// The same camera where a budget allows but a cut for a larger tolerance: the shares grow with it.
  /// Precondition: finite, > 0.
  void widen(double cutPixels);

  /// An upper bound of the pixels that a unit of height takes anywhere in the ball and the frustum: 0 out of
  /// sight, infinite around the eye of a view without a near distance. Largest for the outermost of nested
  /// balls.
  double pixelsPerHeight(const Sphere& ball) const;
  /// The same of the convex hull of points in metric space. Precondition: at least one.
  double pixelsPerHeight(std::span<const Vec3> hull) const;
  /// The first of many balls, up to rounding. Precondition: equal sizes.
  void pixelsPerHeight(std::span<const Sphere> balls, std::span<double> results) const;
  bool mayMeet(std::span<const Vec3> hull) const { return pixelsPerHeight(hull) > 0; }
  /// Pixels that a displacement of the given height at a place of the ball and the frustum takes at most,
  /// the change of scale on its way included. Infinite when it may pass the eye.
  double pixelsOf(double height, double pixelsPerHeight) const;
  /// pixelsOf() with what the displacement takes at the scale of its beginning.
  double pixelsOf(double pixelsThere) const;

  /// 1 where a node appears, 0 from twice its threshold on.
  double share(double rho) const {
    return moves_ ? (rho < tolerance_.cut ? 1 : rho < 2 * tolerance_.cut ? 2 - rho / tolerance_.cut : 0) : 0;
  }
  double mostOffset(double pixelsPerHeight) const { return tolerance_.offset / pixelsPerHeight; }
  /// Of the node's vertex, given those of its corners.
  double offset(const MorphNode& node, double rho, double pixelsPerHeight, double at0, double at1,
                double at2) const {
    const double s = share(rho);
    if (s == 0) return 0;
    const double wanted = node.interpolate(at0, at1, at2) - s * node.detail,
                 most = mostOffset(pixelsPerHeight);
    return wanted > most ? most : wanted < -most ? -most : wanted;
  }

 private:
  Frustum frustum_;
  double pixelsPerReach_;  // of a unit of height
  MorphTolerance tolerance_;
  bool moves_;
};

}  // namespace arete
