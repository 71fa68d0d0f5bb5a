// SPDX-License-Identifier: GPL-3.0-or-later
//
// A border that passes a place twice is two holes that touch there, each with one corner at that place. Where
// the corner is a vertex and its copy, as one that fans have got, they become one vertex again. A hole of two
// edges, which lie in one place, is closed by joining its ends alone.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "surface/repair/draft.h"
#include "surface/repair/hole_filling.h"
#include "surface/repair/joining.h"
#include "surface/repair/neighbourhood.h"
#include "surface/repair/places.h"
#include "surface/topology/border_loops.h"

namespace arete::repair_passes {
namespace {

/// A corner of a hole: the vertices at which the side before it ends and the next one begins, at one place.
struct HoleCorner {
  std::uint32_t in, out;
  Vec3 apex;  ///< of the triangle at the next side
};

struct Hole {
  std::vector<HoleCorner> corners;
  std::size_t loopEdges;  ///< of the border that it is a part of
};

/// The corners of a loop in the order in which its triangles have them; missing where they turn against each
/// other.
std::optional<std::vector<HoleCorner>> cornersOf(const TriangleMesh& mesh, const MeshEdges& edges,
                                                 const BorderLoop& loop) {
  std::vector<HoleCorner> corners;
  bool isForward = true, isBackward = true;
  const std::size_t size = loop.sides.size();
  for (std::size_t i = 0; i < size; ++i) {
    const CornerId side = loop.sides[i], next = loop.sides[(i + 1) % size];
    isForward = isForward && edges.target(side) == edges.origin(next);
    isBackward = isBackward && edges.origin(side) == edges.target(next);
    const std::uint32_t from = edges.origin(side).index();
    corners.push_back({from, from, mesh.positions[edges.origin(previousCorner(side)).index()]});
  }
  if (!isForward && !isBackward) return std::nullopt;
  if (!isForward) std::ranges::reverse(corners);
  return corners;
}

/// The loops of which no one passes a place twice.
std::vector<Hole> apart(const std::vector<HoleCorner>& loop, const std::vector<std::uint32_t>& placeOf) {
  std::vector<Hole> holes;
  std::vector<HoleCorner> open;
  std::vector<std::uint32_t> placesOpen;
  // A place that is still open has been passed before: what lies between the two visits is a loop by itself.
  // It is taken out, and the walk goes on with the outer loop from there.
  for (const HoleCorner& corner : loop) {
    const std::uint32_t place = placeOf[corner.in];
    const auto before = std::ranges::find(placesOpen, place);
    HoleCorner rest = corner;
    if (before != placesOpen.end()) {
      const auto at = before - placesOpen.begin();
      Hole hole{{open.begin() + at, open.end()}, loop.size()};
      rest.in = std::exchange(hole.corners[0].in, corner.in);
      holes.push_back(std::move(hole));
      open.resize(std::size_t(at));
      placesOpen.resize(std::size_t(at));
    }
    open.push_back(rest);
    placesOpen.push_back(place);
  }
  holes.push_back({std::move(open), loop.size()});
  return holes;
}

class Filler {
 public:
  Filler(Draft& draft, std::uint32_t mostEdges)
      : draft_(draft), mostEdges_(mostEdges), placeOf_(placesOf(draft.mesh.positions)) {}

  // Loops are taken first and holes filled afterwards, since filling changes the edges. The limit counts the
  // edges of a hole; a sliver of two edges goes by the border that it is a part of.
  void run() {
    draft_.openHoles = 0;
    std::vector<Hole> holes;
    {
      const MeshEdges edges(draft_.mesh.triangles, draft_.mesh.positions.size());
      for (const BorderLoop& loop : findBorderLoops(edges, MeshFans(edges))) {
        if (!loop.isClosed) continue;
        if (const auto corners = cornersOf(draft_.mesh, edges, loop))
          for (Hole& hole : apart(*corners, placeOf_)) holes.push_back(std::move(hole));
        else if (loop.sides.size() <= mostEdges_)
          ++draft_.openHoles;
      }
    }
    std::erase_if(holes, [&](const Hole& hole) {
      return hole.corners.size() > mostEdges_ || (hole.corners.size() < 3 && hole.loopEdges > mostEdges_);
    });
    if (holes.empty()) return;
    neighbours_.emplace(draft_.mesh);
    HoleFilling filling(draft_.mesh, placeOf_);
    joining_.emplace(draft_, *neighbours_);
    for (const Hole& hole : holes) fill(hole, filling);
  }

 private:
  // Joining comes only after a filling was found: a hole that stays open leaves the mesh as it was.
  void fill(const Hole& hole, HoleFilling& filling) {
    if (!canJoin(hole)) {
      ++draft_.openHoles;
      return;
    }
    if (hole.corners.size() < 3) {
      join(hole);
      ++draft_.counts.filledHoles;
      return;
    }
    HoleOutline outline;
    for (const HoleCorner& corner : hole.corners) {
      outline.corners.push_back(draft_.mesh.positions[corner.in]);
      outline.places.push_back(placeOf_[corner.in]);
      outline.apexes.push_back(corner.apex);
    }
    const std::vector<HoleFilling::Corners> triangles = filling.fill(outline);
    if (triangles.empty()) {
      ++draft_.openHoles;
      return;
    }
    // The corners are joined now, so that the new triangles refer to the vertices that remain. Filling
    // triangles come from no triangle of the source.
    join(hole);
    ++draft_.counts.filledHoles;
    for (const HoleFilling::Corners& t : triangles) {
      draft_.addTriangle({now(hole.corners[t[0]]), now(hole.corners[t[1]]), now(hole.corners[t[2]])},
                         RepairedMesh::kNone);
      neighbours_->add(static_cast<std::uint32_t>(draft_.mesh.triangles.size() - 1));
      ++draft_.counts.fillingTriangles;
    }
  }

  bool canJoin(const Hole& hole) {
    return std::ranges::all_of(hole.corners,
                               [&](const HoleCorner& c) { return joining_->canJoin(c.in, c.out); });
  }
  void join(const Hole& hole) {
    for (const HoleCorner& corner : hole.corners) joining_->join(corner.in, corner.out);
  }
  std::uint32_t now(const HoleCorner& corner) { return joining_->now(corner.in); }

  Draft& draft_;
  const std::uint32_t mostEdges_;
  const std::vector<std::uint32_t> placeOf_;
  std::optional<Neighbourhood> neighbours_;
  std::optional<Joining> joining_;
};

}  // namespace

void fillHoles(Draft& draft, std::uint32_t mostEdges) {
  if (mostEdges > 0) Filler(draft, mostEdges).run();
}

}  // namespace arete::repair_passes
