// SPDX-License-Identifier: GPL-3.0-or-later
//
// The attributes of a drawn vertex on its way are, with what the floor's corners have there,
//
//     own + part * ((floor as it is now - floor at rest) - share * (own - floor at rest))
//
// the law of places (engine/morph/geomorph.h); `part` is 1, or what the clamp left of the place's offset, so
// that what is painted on the surface stays where it is. The floor triangle is the
// nearest one on the vertex's side of a seam: it has at least two corners in common with the star's triangles
// at this wedge. A wedge without such a triangle keeps what it has.
#include "viewer/fronts/own_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_shares.h"

namespace arete {
namespace {

/// Nodes that rest again are forgotten in batches.
constexpr std::size_t kRestingKept = 4096;

double squaredLength(const std::array<float, 3>& v) {
  return double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2];
}

}  // namespace

OwnVertices::OwnVertices(const SurfaceModel& model, const ZUpFrame& upright,
                         std::shared_ptr<const DrawnVertices> resting)
    : model_(&model),
      upright_(upright),
      resting_(std::move(resting)),
      positions_(resting_->positions),
      isMoving_(model.mt.vertexCount()) {}

void OwnVertices::clear() {
  for (const std::uint32_t v : moving_) isMoving_[v] = 0;
  moving_.clear();
  list_.clear();
  slotOf_.clear();
  moved_ = nullptr;
}

void OwnVertices::begin(std::span<const float> positions) {
  clear();
  positions_ = positions;
}

void OwnVertices::begin(const GeomorphedSurface& moved) {
  clear();
  positions_ = resting_->positions;
  moved_ = &moved;
  const MultiTriangulation& mt = model_->mt;
  for (const GeomorphedSurface::Moving& m : moved.moving()) {
    const std::uint32_t v = mt.apex(m.node).index();
    isMoving_[v] = 1;
    moving_.push_back(v);
    const double part = partOf(m);
    if (!model_->hasWedges()) {
      OwnVertex now = onTheWay({v, m.place->corner, m.place->weight}, m.share, part);
      move(now, v, v);
      add(v, now);
      continue;
    }
    auto known = startsOf_.find(m.node.index());
    if (known == startsOf_.end()) known = startsOf_.insert({m.node.index(), startsOf(m.node)}).first;
    for (const Start& start : known->second) {
      OwnVertex now = onTheWay(start, m.share, part);
      move(now, start.drawn, v);
      add(start.drawn, now);
    }
  }
  if (startsOf_.size() > 2 * moving_.size() + kRestingKept) forgetResting(moved.moving());
}

void OwnVertices::forgetResting(std::span<const GeomorphedSurface::Moving> moving) {
  tsl::robin_map<std::uint32_t, std::vector<Start>, ScatteredId> kept;
  for (const GeomorphedSurface::Moving& m : moving)
    if (const auto known = startsOf_.find(m.node.index()); known != startsOf_.end())
      kept[known->first] = std::move(known.value());
  startsOf_ = std::move(kept);
}

std::vector<OwnVertices::Start> OwnVertices::startsOf(NodeId n) const {
  const MultiTriangulation& mt = model_->mt;
  const std::uint32_t apex = mt.apex(n).index();
  const Vec3 place = mt.position(mt.apex(n));
  std::vector<Start> starts;
  std::vector<std::uint32_t> around;  // wedges of the link that the star has at this wedge
  for (std::uint32_t slot = 0; slot < mt.ceilingSize(n); ++slot) {
    const TriangleId first = mt.slotTriangle(n, slot);
    const auto apexWedge = [&](TriangleId t) {
      const auto corners = mt.corners(t, n);
      return model_->wedgesOf[t.index()][std::size_t(std::ranges::find(corners, apex) - corners.begin())];
    };
    const std::uint32_t wedge = apexWedge(first);
    if (std::ranges::find(starts, wedge, &Start::drawn) != starts.end()) continue;
    around.clear();
    for (std::uint32_t other = slot; other < mt.ceilingSize(n); ++other) {
      const TriangleId t = mt.slotTriangle(n, other);
      if (apexWedge(t) != wedge) continue;
      for (const std::uint32_t w : model_->wedgesOf[t.index()])
        if (w != wedge) around.push_back(w);
    }
    Start start{wedge, {wedge, wedge, wedge}, {0, 0}};
    std::ptrdiff_t mostShared = 1;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : mt.floor(n)) {
      const auto& wedges = model_->wedgesOf[t];
      const std::ptrdiff_t shared = std::ranges::count_if(
          wedges, [&](std::uint32_t w) { return std::ranges::find(around, w) != around.end(); });
      if (shared < 2 || shared < mostShared) continue;
      const auto ids = mt.corners(TriangleId(t));
      const SpaceTriangle corners = {mt.position(VertexId(ids[0])), mt.position(VertexId(ids[1])),
                                     mt.position(VertexId(ids[2]))};
      const double distance = distanceToTriangle(place, corners);
      if (shared == mostShared && !(distance < least)) continue;
      mostShared = shared;
      least = distance;
      const auto weights = nearestShares(place, corners);
      start.corner = wedges;
      start.weight = {float(weights[0]), float(weights[1])};
    }
    starts.push_back(start);
  }
  return starts;
}

OwnVertex OwnVertices::resting(std::uint32_t drawn) const {
  OwnVertex v;
  const auto take = [&](auto& to, const auto& from) {
    if (from.empty()) return;
    const std::size_t count = to.size();
    std::copy_n(from.begin() + std::ptrdiff_t(count * drawn), count, to.begin());
  };
  take(v.position, positions_);
  take(v.normal, resting_->normals);
  take(v.smoothNormal, resting_->smoothNormals);
  take(v.textureCoords, resting_->textureCoords);
  take(v.color, resting_->colors);
  return v;
}

OwnVertex OwnVertices::current(std::uint32_t drawn) const {
  const auto listed = slotOf_.find(drawn);
  return listed == slotOf_.end() ? resting(drawn) : list_[listed->second];
}

double OwnVertices::partOf(const GeomorphedSurface::Moving& moving) const {
  const auto at = [&](std::size_t i) { return moved_->offset(VertexId(moving.place->corner[i])).vector(); };
  const Vec3 free = moving.place->interpolate(at(0), at(1), at(2)) - moving.share * moving.place->detail;
  const double length = norm(free), kept = norm(moved_->offset(model_->mt.apex(moving.node)).vector());
  return length > kept ? kept / length : 1;
}

OwnVertex OwnVertices::onTheWay(const Start& start, double share, double part) const {
  OwnVertex own = resting(start.drawn);
  std::array<OwnVertex, 3> rest, now;
  for (std::size_t i = 0; i < 3; ++i) {
    rest[i] = resting(start.corner[i]);
    now[i] = current(start.corner[i]);
  }
  const double w0 = start.weight[0], w1 = start.weight[1], w2 = 1 - w0 - w1;
  const auto at = [&](double own0, const auto& numberOf) {
    const auto blend = [&](const std::array<OwnVertex, 3>& of) {
      return w0 * numberOf(of[0]) + w1 * numberOf(of[1]) + w2 * numberOf(of[2]);
    };
    const double atRest = blend(rest);
    return own0 + part * ((blend(now) - atRest) - share * (own0 - atRest));
  };
  const auto turn = [&](auto normal) {
    const auto isStated = [&](const OwnVertex& v) { return squaredLength(v.*normal) > 0; };
    if (!isStated(own) || !std::ranges::all_of(rest, isStated) || !std::ranges::all_of(now, isStated)) return;
    std::array<float, 3> turned;
    for (std::size_t c = 0; c < 3; ++c)
      turned[c] = float(at((own.*normal)[c], [&](const OwnVertex& v) { return double((v.*normal)[c]); }));
    const double length = std::sqrt(squaredLength(turned));
    // Opposite normals have no mean.
    if (!(length > 0.1)) return;
    for (std::size_t c = 0; c < 3; ++c) (own.*normal)[c] = float(turned[c] / length);
  };
  turn(&OwnVertex::normal);
  turn(&OwnVertex::smoothNormal);
  for (std::size_t c = 0; c < own.textureCoords.size(); ++c)
    own.textureCoords[c] =
        float(at(own.textureCoords[c], [&](const OwnVertex& v) { return double(v.textureCoords[c]); }));
  for (std::size_t c = 0; c < own.color.size(); ++c)
    own.color[c] = std::uint8_t(std::lround(
        std::clamp(at(own.color[c], [&](const OwnVertex& v) { return double(v.color[c]); }), 0.0, 255.0)));
  return own;
}

void OwnVertices::move(OwnVertex& vertex, std::uint32_t drawn, std::uint32_t of) const {
  const Vec3 offset = upright_.turned(moved_->offset(VertexId(of)).vector());
  vertex.position = {float(positions_[3 * drawn] + offset.x), float(positions_[3 * drawn + 1] + offset.y),
                     float(positions_[3 * drawn + 2] + offset.z)};
}

std::uint32_t OwnVertices::add(std::uint32_t drawn, const OwnVertex& vertex) {
  const auto slot = static_cast<std::uint32_t>(list_.size());
  slotOf_[drawn] = slot;
  list_.push_back(vertex);
  return slot;
}

std::uint32_t OwnVertices::slotOf(std::uint32_t drawn, std::uint32_t vertex) {
  if (const auto listed = slotOf_.find(drawn); listed != slotOf_.end()) return listed->second;
  OwnVertex own = resting(drawn);
  if (isMoving(vertex)) move(own, drawn, vertex);
  return add(drawn, own);
}

}  // namespace arete
