// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/viewshed/gaps.h"
#include "terrain/viewshed/horizon.h"
#include "terrain/viewshed/image_plane.h"
#include "terrain/viewshed/near_gaps.h"

namespace arete {

/// Directions of one sector, from u = first to u = last.
struct ViewshedWedge {
  ViewshedSector sector;
  double first, last;
  bool ownsFirst, ownsLast;  ///< samples at that end are its own
};

/// Sweeps one wedge: fills the result's cells, and values, that are in it.
class ViewshedWedgeSweep {
 public:
  ViewshedWedgeSweep(const ImagePlane& picture, const ViewshedWedge& wedge, Viewshed& result);
  /// Errors: those of the earth. Stops when told to.
  Status run(const RunContext& context);
  std::uint64_t rays() const { return rays_; }

 private:
  double height(int x, int y) const;
  std::size_t index(int x, int y) const;

  void take(int x, PictureLine& line) const;
  Status ask(int x);
  Status askOne(int x, int y);
  bool isBesideGap(int x, int y) const;
  ViewshedHorizon::Bounds linkBefore(int y, double target) const;
  enum class Side { inside, doubtful, outside };
  Side fieldAt(const PictureLine& line, std::size_t i, double target) const;
  Status exactly(std::size_t at, int x, int y);
  bool isBeyond(double x) const;

  void addEdges(int x);
  void addTips(int x);
  bool isTip(int x, int y, double u) const;
  bool isAtTip(int bin, double u) const {
    return !tips_.isEmpty() && binsWithTips_[static_cast<std::size_t>(bin)] != 0 && tips_.has(u);
  }
  void addCells(int x, int from, int to);
  void addWholeCells(int x, int from, int count);
  template <bool kIsFan>
  void addWholeCells(int x, int from, int count);
  struct End {
    const PictureLine& line;
    std::size_t at;
    Vec2 place() const { return {line.away[at], line.u[at] * line.away[at]}; }
  };
  void addFanEdge(End a, End b, int triangles);
  void addBesideGap(End a, End b, bool isRim);
  int trianglesAlong(int x, int y) const;
  int trianglesAcross(int x, int y) const;
  void addPartialCell(int x, int y);
  void addBorder(int x, int y, int outside);
  void addFirst(int x);
  void addNearGap(int x, int y);
  ViewshedNearGaps::Crossing gapsTowards(double u) const;
  void addNear(const ImagePlane::Sample& a, const ImagePlane::Sample& b);

  double slack(const PictureLine& a, std::size_t i, const PictureLine& b, std::size_t j) const {
    return picture_.slack(std::min(a.x, b.x) * 0.99, picture_.isFan() ? std::max(a.doubt[i], b.doubt[j]) : 0);
  }

  const ImagePlane& picture_;
  const ViewshedTask& task_;
  const ViewshedWedge& wedge_;
  Viewshed& result_;
  int xLeast_, xGreatest_, yLeast_, yGreatest_;
  Vec2 observer_;
  int shear_;
  double turn_;
  double first_, last_;  ///< of u, sheared, padded
  bool hasField_, wantsValue_, wantsGaps_;
  ViewshedHorizon horizon_;
  /// Over a fan: what may be before a line, but may as well be beside it. The lower bound of the skyline is
  /// that of the other horizon alone, the upper one that of both.
  ViewshedHorizon doubtful_;
  ViewshedGaps gaps_;
  ViewshedNearGaps nearGaps_;
  DirectionSet tips_;  ///< where lines may meet terrain on the skyline in a single point
  std::vector<char> binsWithTips_;
  PictureLine near_, far_;  ///< the lattice lines before and at x
  std::uint64_t rays_ = 0;
};

}  // namespace arete
