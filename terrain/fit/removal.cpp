// SPDX-License-Identifier: GPL-3.0-or-later
//
// The samples of a leaf's star are distributed among its floor. If they are within their bounds there, no
// height has to change. Otherwise the heights of the link may change: every sample under a triangle with a
// vertex of the link, those of the floor included, is a row of a small problem (FitPatch). If that has no
// solution, the next ring of vertices is added, and so on. Of the removals that need changes, six in seven
// need only the link.
#include "terrain/fit/removal.h"

#include <algorithm>
#include <cmath>

#include "terrain/model/plan_orientation.h"

namespace arete {
namespace {

/// With an error of more than this many bounds the removal is rejected untried; 2.5 was the most that
/// succeeded.
constexpr double kHopeless = 4;
/// The largest |residual| / bound of samples under heights that change: so far below 1 that no rounding
/// breaks the bound.
constexpr double kSolved = 1 - 0x1p-36;
/// Weights up to this are zero but for rounding.
constexpr double kNoWeight = 1e-12;
/// A patch with more unknowns gets no further ring: solving it takes time proportional to their cube.
constexpr std::size_t kMostUnknowns = 128;

}  // namespace

void FitPatches::begin() {
  if (vertexStamp_.size() != mesh_.vertexCount()) {
    vertexStamp_.assign(mesh_.vertexCount(), 0);
    unknownOf_.assign(mesh_.vertexCount(), 0);
    slotStamp_.assign(mesh_.slotCount(), 0);
    now_ = 0;
  }
  // A stamp marks what belongs to the patch, so that a new patch need not clear the arrays.
  ++now_;
  unknowns_.clear();
  slots_.clear();
  ringBegin_ = 0;
}

void FitPatches::addUnknown(std::uint32_t vertex) {
  if (vertexStamp_[vertex] == now_ || mesh_.isFixed(vertex)) return;
  vertexStamp_[vertex] = now_;
  unknownOf_[vertex] = static_cast<std::uint32_t>(unknowns_.size());
  unknowns_.push_back(vertex);
}

void FitPatches::grow(std::uint32_t without) {
  const std::size_t end = unknowns_.size();
  // The outermost ring begins at ringBegin_; the stars of its vertices hold the next one.
  for (; ringBegin_ < end; ++ringBegin_)
    mesh_.forStar(unknowns_[ringBegin_], [&](std::uint32_t slot) {
      for (const std::uint32_t v : mesh_.triangle(slot).corners)
        if (v != without) addUnknown(v);
    });
}

void FitPatches::collectSlots() {
  for (const std::uint32_t v : unknowns_)
    mesh_.forStar(v, [&](std::uint32_t slot) {
      if (slotStamp_[slot] == now_) return;
      slotStamp_[slot] = now_;
      slots_.push_back(slot);
    });
}

template <class Samples>
bool FitPatches::addRows(const FitMesh::Corners& corners, const Samples& samples, bool spares) {
  const FitMesh::Weights weights = mesh_.weights(corners);
  std::array<bool, 3> moves;
  FitPatch::Row row;
  for (int i = 0; i < 3; ++i) {
    moves[i] = vertexStamp_[corners[i]] == now_;
    row.unknown[i] = moves[i] ? unknownOf_[corners[i]] : 0;
  }
  bool isWithin = true;
  samples([&](std::uint32_t s) {
    double bound = mesh_.bounds().at(s);
    const std::array<double, 3> w = weights.of(mesh_.plan(s));
    const double r = mesh_.residual(corners, w, s);
    // A spared sample may stay as far away as it is, but not go further.
    if (spares) bound = std::max(bound, std::abs(r));
    row.rest = r / bound;
    bool isMoved = false;
    for (int i = 0; i < 3; ++i) {
      row.weight[i] = moves[i] && w[i] > kNoWeight ? w[i] / bound : 0;
      isMoved = isMoved || row.weight[i] > 0;
    }
    // A sample that no unknown moves must be within its bound already.
    if (isMoved)
      patch_.add(row);
    else if (std::abs(row.rest) > mesh_.accepted())
      isWithin = false;
  });
  return isWithin;
}

bool FitPatches::isInMesh(std::uint32_t vertex) const {
  return vertex != FitMesh::kNone && mesh_.isIn(vertex);
}

bool FitPatches::isTriangle(const FitMesh::Corners& corners) const {
  if (!std::ranges::all_of(corners, [&](std::uint32_t v) { return isInMesh(v); })) return false;
  std::array<Vec2, 3> at;
  for (int k = 0; k < 3; ++k) at[k] = mesh_.plan(mesh_.mtVertex(corners[k]));
  return planOrientation(at[0], at[1], at[2]) > 0;
}

void FitPatches::tryRemoval(NodeId leaf, std::uint32_t rings, RemovalTrial& trial) {
  const MultiTriangulation& mt = mesh_.mt();
  const std::uint32_t apex = mesh_.indexOf(mt.apex(leaf).index());
  trial.node = leaf;
  trial.isFeasible = false;
  trial.moved.clear();
  trial.rise.clear();
  trial.read.assign(1, apex);
  std::vector<std::uint32_t>& link = trial.read;
  for (const std::uint32_t v : mt.link(leaf)) link.push_back(mesh_.indexOf(v));
  // Without all of its link in the mesh, the leaf cannot be removed; then only the apex has been read.
  if (!std::ranges::all_of(link, [&](std::uint32_t v) { return isInMesh(v); })) {
    link.resize(1);
    return;
  }
  const std::size_t linkEnd = link.size();

  const auto ids = mt.floor(leaf);
  trial.floorSize = ids.size();
  if (trial.floor.size() < ids.size()) trial.floor.resize(ids.size());
  const std::span<FitMesh::FloorTriangle> floor(trial.floor.data(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    floor[i].id = ids[i];
    floor[i].samples.clear();
    const auto corners = mt.corners(TriangleId(ids[i]));
    for (int k = 0; k < 3; ++k) floor[i].corners[k] = mesh_.indexOf(corners[k]);
    if (!isTriangle(floor[i].corners)) return;  // of a damaged model
  }
  double worst = 0;
  std::vector<FitMesh::Weights> weights;
  for (const auto& t : floor) weights.push_back(mesh_.weights(t.corners));
  bool isShared = true;
  mesh_.forStar(apex, [&](std::uint32_t slot) {
    mesh_.forSamples(slot, [&](std::uint32_t s) {
      const Vec2 p = mesh_.plan(s);
      for (std::size_t i = 0; i < floor.size(); ++i) {
        const auto& at = weights[i].at;
        if (planOrientation(at[0], at[1], p) < 0 || planOrientation(at[1], at[2], p) < 0 ||
            planOrientation(at[2], at[0], p) < 0)
          continue;
        floor[i].samples.push_back(s);
        const double r = mesh_.residual(floor[i].corners, weights[i].of(p), s);
        worst = std::max(worst, std::abs(r) / mesh_.bounds().at(s));
        return;
      }
      isShared = false;
    });
  });
  if (!isShared || worst > kHopeless) return;
  if (worst <= mesh_.accepted()) {
    trial.isFeasible = true;
    return;
  }

  begin();
  mesh_.forStar(apex, [&](std::uint32_t slot) { slotStamp_[slot] = now_; });  // these will be removed
  for (std::size_t i = 1; i < linkEnd; ++i) addUnknown(link[i]);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    if (ring > 0) {
      if (unknowns_.size() > kMostUnknowns) break;
      grow(apex);
    }
    collectSlots();
    patch_.start(unknowns_.size());
    bool isWithin = true;
    for (const auto& t : floor)
      isWithin &= addRows(t.corners, [&](const auto& visit) {
        for (const std::uint32_t s : t.samples) visit(s);
      });
    for (const std::uint32_t slot : slots_)
      isWithin &=
          addRows(mesh_.triangle(slot).corners, [&](const auto& visit) { mesh_.forSamples(slot, visit); });
    trial.isFeasible = isWithin && patch_.solve(kSolved);
    if (trial.isFeasible) break;
  }
  for (const std::uint32_t slot : slots_)
    for (const std::uint32_t v : mesh_.triangle(slot).corners) trial.read.push_back(v);
  if (!trial.isFeasible) return;
  trial.moved = unknowns_;
  trial.rise.assign(patch_.values().begin(), patch_.values().end());
}

bool FitPatches::tryTriangle(std::uint32_t slot, std::uint32_t rings) {
  begin();
  for (const std::uint32_t v : mesh_.triangle(slot).corners) addUnknown(v);
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    if (ring > 0) {
      if (unknowns_.size() > kMostUnknowns) break;
      grow(FitMesh::kNone);
    }
    collectSlots();
    patch_.start(unknowns_.size());
    bool isWithin = true;
    for (const std::uint32_t t : slots_)
      isWithin &= addRows(
          mesh_.triangle(t).corners, [&](const auto& visit) { mesh_.forSamples(t, visit); }, t != slot);
    if (!isWithin) return false;  // the triangle's corners are fixed
    if (patch_.solve(mesh_.accepted())) return true;
  }
  return false;
}

}  // namespace arete
