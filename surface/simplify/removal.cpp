// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/simplify/removal.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "engine/base/triangle_shares.h"
#include "engine/simplify/floor_joins.h"
#include "surface/error/star_division.h"

namespace arete {
namespace {

/// A removal seldom makes its neighbours much cheaper: they are evaluated again at this part of their cost.
constexpr float kLeastChange = 0.8F;

}  // namespace

bool SurfaceRemover::remove(VertexId v, RemovalId removal, std::span<Seam> seams) {
  [[maybe_unused]] const bool isGathered = hole_.gather(s_, v);
  assert(isGathered);
  const Star& star = hole_.star();
  const VertexId around(s_.records[v].witness);
  int corner = 0;
  while (star.link[corner] != around) ++corner;
  const HoleTriangulation floor = fanAround(corner, star.linkSize);

  for (int f = 0; f < floor.size; ++f) labels_[f] = hole_.labelsOf(s_, floor.triangles[f]);
  dividePieces(floor);
  const std::uint32_t firstLabel = s_.recorder.firstSlot(removal);
  s_.firstStarLabel[v] = firstLabel;
  for (int i = 0; i < star.triangleCount; ++i) {
    TriangleLabels labels = s_.labelsOf(star.slot(i));
    // The apex first, as the MT has the corners of a star.
    std::rotate(labels.wedges.begin(), labels.wedges.begin() + LiveMesh::sideOf(star.outgoing[i]),
                labels.wedges.end());
    s_.starLabels.set(firstLabel + static_cast<std::uint32_t>(i), labels);
    s_.starAttributeErrors.copy(star.slot(i).index(), s_.attributeErrors,
                                firstLabel + static_cast<std::size_t>(i));
  }
  if (s_.acrossSides.size() > 0) gatherAcross();

  for (int f = 0; f < star.triangleCount; ++f)
    s_.pieces[star.slot(f)] = f < floor.size ? division_.takePieces(f) : PieceList();
  for (int f = 0; f < floor.size; ++f) rms_[f] = rmsOf(floor, f);
  record(removal, floor.size);
  refill(s_.mesh, star, floor, FloorJoins(floor), s_.recorder.firstFloorTriangle(removal), removal, seams);
  for (int f = 0; f < floor.size; ++f) s_.labels.set(star.slot(f).index(), labels_[f]);
  if (s_.boundsAttributes) boundAttributes(floor);
  updateLink();
  s_.mesh.vertexHalfedge[v] = HalfedgeId();
  return star.isOpen;
}

void SurfaceRemover::dividePieces(const HoleTriangulation& floor) {
  const Star& star = hole_.star();
  std::array<std::uint32_t, kMaxHoleCorners> link;
  for (int i = 0; i < star.linkSize; ++i) link[i] = star.link[i].index();
  drawn_.clear();
  if (s_.boundsAttributes)
    for (int f = 0; f < floor.size; ++f) {
      const auto& corners = floor.triangles[f];
      drawn_.push_back(s_.parts.hasWedges ? labels_[f].wedges
                                          : std::array{link[corners[0]], link[corners[1]], link[corners[2]]});
    }
  const ReplacedStar replaced{star.triangleCount,
                              hole_.vertex().index(),
                              {link.data(), static_cast<std::size_t>(star.linkSize)},
                              hole_.places(),
                              floor,
                              hole_.line(),
                              drawn_};
  divideStar(division_, replaced, [&](int i, const auto& take) {
    const SlotId slot = star.slot(i);
    // A triangle without pieces is still the whole of its face.
    if (s_.pieces[slot].isEmpty())
      take(Piece{s_.labelsOf(slot).face, 0, wholeFace()});
    else
      s_.pieces[slot].forEach(take);
  });
}

/// Before the star is rewritten: what is across each edge of its rim. Where a side of the line is a single
/// triangle, which goes, the pieces across its edge are its own.
void SurfaceRemover::gatherAcross() {
  const Star& star = hole_.star();
  rimSides_.assign(static_cast<std::size_t>(star.triangleCount), {});
  for (int i = 0; i < star.triangleCount; ++i) {
    const int after = i + 1 < star.linkSize ? i + 1 : 0;
    const std::uint32_t a = star.link[i].index(), b = star.link[after].index();
    AcrossSide& side = rimSides_[static_cast<std::size_t>(i)];
    if (i == hole_.ear()) {
      TriangleLabels labels = s_.labelsOf(star.slot(i));
      std::rotate(labels.wedges.begin(), labels.wedges.begin() + LiveMesh::sideOf(star.outgoing[i]),
                  labels.wedges.end());
      side = {{a, b}, {labels.wedges[1], labels.wedges[2]}};
      continue;
    }
    for (const AcrossSide& known : s_.acrossSides[star.slot(i)])
      if (known.isOf(a, b)) side = known;
  }
}

/// After the pieces are divided and stored. The slots of the floor are the first ones of the star.
void SurfaceRemover::boundAttributes(const HoleTriangulation& floor) {
  const Star& star = hole_.star();
  attributeErrors_.resize(s_.attributeErrors.perTriangle());
  for (int f = 0; f < floor.size; ++f) {
    AttributeBound::Triangle triangle;
    for (std::size_t c = 0; c < 3; ++c) {
      const int corner = floor.triangles[f][c];
      triangle.places[c] = hole_.corner(corner);
      triangle.vertices[c] = star.link[corner].index();
    }
    triangle.drawn = s_.parts.hasWedges ? labels_[f].wedges : triangle.vertices;
    triangle.error = division_.bound(f);
    if (s_.acrossSides.size() > 0) {
      auto& sides = s_.acrossSides[star.slot(f)];
      sides = {};
      std::size_t count = 0;
      for (std::size_t c = 0; c < 3; ++c)
        for (const AcrossSide& side : rimSides_)
          if (side.isOf(triangle.vertices[c], triangle.vertices[(c + 1) % 3])) sides[count++] = side;
      triangle.across = sides;
    }
    attributeBound_.bound(triangle, s_.pieces[star.slot(f)], attributeErrors_);
    // Rounded upwards, so that a float bounds what a double did.
    for (std::size_t a = 0; a < attributeErrors_.size(); ++a)
      s_.attributeErrors.set(star.slot(f).index(), a,
                             static_cast<float>(attributeErrors_[a] * (1 + 0x1p-22)));
  }
}

/// Of distances, and of attributes where a build weighs them for the order of a cut alone.
double SurfaceRemover::rmsOf(const HoleTriangulation& floor, int f) {
  const double ofDistances = division_.rms(f);
  if (s_.field.isEmpty() || s_.boundsAttributes) return ofDistances;
  samples_.clear();
  s_.pieces[hole_.star().slot(f)].forEach([&](const Piece& piece) {
    if (piece.across == 0) s_.samples.append(piece, samples_);
  });
  SpaceTriangle places;
  std::array<std::uint32_t, 3> drawn = labels_[f].wedges;
  for (std::size_t c = 0; c < 3; ++c) {
    const int corner = floor.triangles[f][c];
    places[c] = hole_.corner(corner);
    if (!s_.parts.hasWedges) drawn[c] = hole_.star().link[corner].index();
  }
  wanted_.resize(s_.field.components());
  found_.resize(s_.field.components());
  double squares = 0, area = 0;
  for (const SurfaceSample& sample : samples_) {
    s_.field.mean(s_.field.cornersOf(sample.face), sample.shares, wanted_);
    s_.field.mean(drawn, nearestShares(sample.place, places), found_);
    squares += sample.area * s_.field.weighedSquares(wanted_, found_);
    area += sample.area;
  }
  return area > 0 ? std::sqrt(ofDistances * ofDistances + squares / area) : ofDistances;
}

void SurfaceRemover::record(RemovalId removal, int floorSize) {
  const Star& star = hole_.star();
  for (int i = 0; i < star.triangleCount; ++i) {
    ceiling_[i] = s_.mesh.triangles[star.slot(i)].recorderId;
    creator_[i] = s_.mesh.triangles[star.slot(i)].creator;
  }
  // The sphere of the node holds the link and the apex.
  for (int i = 0; i < star.linkSize; ++i) metric_[i] = s_.metric.toMetric(hole_.corner(i));
  metric_[star.linkSize] = s_.metric.toMetric(hole_.apex());
  for (int f = 0; f < floorSize; ++f)
    codes_[f] = {s_.recorder.scale().encode(division_.bound(f)), s_.recorder.scale().encode(rms_[f]), 0};
  const auto size = [](int n) { return static_cast<std::size_t>(n); };
  VertexRemoval what;
  what.vertex = hole_.vertex();
  what.link = star.linkView();
  what.isOpen = star.isOpen;
  what.metricPositions = {metric_.data(), size(star.linkSize + 1)};
  what.ceiling = {ceiling_.data(), size(star.triangleCount)};
  what.ceilingCreator = {creator_.data(), size(star.triangleCount)};
  what.floor = {codes_.data(), size(floorSize)};
  s_.recorder.record(removal, what);
  s_.recorder.saturate(removal, what);
}

/// Two stars can share a link vertex: both threads store the same values.
void SurfaceRemover::updateLink() {
  for (const VertexId u : hole_.star().linkView()) {
    RemovalRecord& of = s_.records[u];
    std::atomic_ref(of.isTouched).store(1, std::memory_order_relaxed);
    std::atomic_ref(of.isWitnessGone).store(1, std::memory_order_relaxed);
    using State = RemovalRecord::State;
    if (of.state == State::fixed) continue;
    const bool isKnown = of.state == State::exact || of.state == State::atLeast;
    s_.thresholds.set(u, isKnown ? kLeastChange * of.cost : ThresholdList::kNow);
  }
}

}  // namespace arete
