// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/viewshed/gaps.h"
#include "terrain/viewshed/horizon.h"
#include "terrain/viewshed/image_plane.h"
#include "terrain/viewshed/near_gaps.h"
#include "terrain/viewshed/sector_grid.h"

namespace arete {

/// Directions of one sector, from u = first to u = last.
struct ViewshedWedge {
  ViewshedSector sector;
  double first, last;
  bool ownsFirst, ownsLast;  ///< samples in the direction of that end belong to this wedge
};

/// The terrain of a wedge from the observer to the sweep line, as far as it can hide what is behind it: the
/// skyline, gaps without terrain, and tips, where a line may meet the terrain in a single point.
///
/// The sweep line is far(); the lattice line before it is near(). draw() moves both on, add() adds the
/// terrain between them. Queries in between are about the terrain up to near().
class WedgeTerrain {
 public:
  WedgeTerrain(const ImagePlane& image, const ViewshedWedge& wedge);

  const SectorGrid& grid() const { return grid_; }
  const ImageLine& near() const { return near_; }
  const ImageLine& far() const { return far_; }
  Vec2 observer() const { return observer_; }
  /// @return ImagePlane::turn().
  double turn() const { return turn_; }

  /// Makes the lattice line x the sweep line: its samples in the wedge, and some beside it.
  void draw(int x);
  /// Adds the terrain between the sweep line and the one before it, and the sweep line's own edges.
  /// @param isFirst the sweep line is the first before the observer: near() is not used.
  void add(int x, bool isFirst);

  /// @return a lower bound of the skyline in a bin. One comparison with it settles most samples.
  double low(int bin) const { return skyline_.low(bin); }
  /// @return bounds of the skyline in the direction u.
  ViewshedHorizon::Bounds skyline(double u) const { return skyline_.at(u); }
  /// Raises bounds of the skyline by terrain in front of a sample of the sweep line that is not in the
  /// skyline yet: edges between near() and far() that do not end at the sample, as far as they are higher
  /// than `above`; and, of a mapped plan, edges that may be in front of the sample as well as beside it.
  void raiseByPending(int y, double above, ViewshedHorizon::Bounds& skyline) const;
  /// @return whether a line in the direction u may meet the terrain in a single point that is on the skyline.
  bool isAtTip(int bin, double u) const { return tips_.has(bin, u); }
  /// @return whether there may be no terrain in a cell that leads from the observer to a sample of far().
  bool isBesideGap(int x, int y) const;
  /// @return whether a line in the direction u is over a gap.
  ViewshedNearGaps::Crossing gapsTowards(double u) const;

 private:
  /// One end of an edge: a sample of near() or far().
  struct End {
    const ImageLine& line;
    std::size_t at;
    Vec2 place() const { return {line.away[at], line.u[at] * line.away[at]}; }
  };

  void addTips(int x);
  void addFirst(int x);
  void addNear(const ImagePlane::Sample& a, const ImagePlane::Sample& b);
  void addNearGap(int x, int y);
  void addEdges(int x);
  void addCells(int x, int from, int to);
  void addWholeCells(int x, int from, int count);
  template <bool kIsMapped>
  void addWholeCells(int x, int from, int count);
  void addPartialCell(int x, int y);
  void addMappedEdge(End a, End b, int triangles);
  void addBesideGap(End a, End b, bool isRim);
  void addBorder(int x, int y, int outside);

  double slack(const ImageLine& a, std::size_t i, const ImageLine& b, std::size_t j) const;

  const ImagePlane& image_;
  const ViewshedWedge& wedge_;
  SectorGrid grid_;
  Vec2 observer_;
  int shear_;  ///< u is measured from y = shear * x: 1 near the diagonal, where u is exact that way
  double turn_;
  bool wantsGaps_;
  ViewshedHorizon skyline_;
  /// Of a mapped plan: edges that may be in front of a line but may as well be beside it. The lower bound of
  /// the whole skyline is that of skyline_, its upper bound that of both.
  ViewshedHorizon uncertain_;
  ViewshedGaps gaps_;
  ViewshedNearGaps nearGaps_;
  ViewshedTips tips_;
  ImageLine near_, far_;
};

}  // namespace arete
