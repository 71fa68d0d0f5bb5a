// SPDX-License-Identifier: GPL-3.0-or-later
//
// The levels of [deBergDobrindt1995] with growing thresholds (engine/simplify/level_schedule.h), as on
// terrain (terrain/simplify/simplify.h).
#include "surface/simplify/simplify.h"

#include <algorithm>

#include "engine/memory/pages.h"
#include "engine/parallel/loop_threads.h"
#include "engine/parallel/shared_progress.h"
#include "engine/simplify/level_schedule.h"
#include "surface/simplify/level.h"

namespace arete {
namespace {

constexpr double kFirstThreshold = 1e-14;
/// Of vertices whose neighbours went, costs are known late. Where costs have a gap (flat parts end, and what
/// is bent begins), what became cheap goes before anything that is dearer.
constexpr double kGap = 2;

SurfaceRoot labelledRootOf(const SurfaceState& s, std::uint32_t levels) {
  SurfaceRoot root{rootOf(s.mesh, levels), {}, {}};
  for (std::uint32_t i = 0; i < s.mesh.triangles.size(); ++i) {
    if (s.mesh.triangles[SlotId(i)].isDead()) continue;
    root.labels.push_back(s.labelsOf(SlotId(i)));
    for (std::size_t a = 0; a < s.attributeErrors.perTriangle(); ++a)
      root.attributeErrors.push_back(s.attributeErrors.get(i, a));
  }
  return root;
}

void compact(SurfaceState& s) {
  const SlotMap map = s.mesh.compact(s.thresholds.vertices());
  map.forLiveInPlace([&](SlotId from, SlotId to) {
    if (from == to) return;
    s.pieces[to] = std::move(s.pieces[from]);
    s.labels.set(to.index(), s.labelsOf(from));
    s.attributeErrors.copy(from.index(), s.attributeErrors, to.index());
    if (s.acrossSides.size() > 0) s.acrossSides[to] = s.acrossSides[from];
  });
  s.pieces.resize(map.liveCount());
  s.pieces.shrink_to_fit();
  s.labels.resize(map.liveCount());
  s.attributeErrors.resize(map.liveCount());
  if (s.acrossSides.size() > 0) s.acrossSides.resize(map.liveCount());
  giveFreeHeapBack();
}

IdArray<VertexId, std::vector<VertexId>> borderNextOf(const LiveMesh& mesh) {
  IdArray<VertexId, std::vector<VertexId>> next;
  for (std::uint32_t i = 0; i < mesh.vertexCount(); ++i) {
    const VertexId v(i);
    const HalfedgeId h = mesh.vertexHalfedge[v];
    if (!h.isValid() || mesh.twinOf(h).isValid()) continue;
    if (next.size() == 0) next.assign(mesh.vertexCount(), VertexId());
    next[v] = mesh.origin(LiveMesh::nextInTriangle(h));
  }
  return next;
}

/// SurfaceState::lineNext.
IdArray<VertexId, std::vector<std::array<VertexId, 2>>> lineNextOf(const SurfaceState& s) {
  IdArray<VertexId, std::vector<std::array<VertexId, 2>>> next;
  if (!s.parts.hasLines()) return next;
  std::vector<std::uint8_t> count(s.mesh.vertexCount(), 0);
  const auto add = [&](VertexId v, VertexId to) {
    if (next.size() == 0) next.assign(s.mesh.vertexCount(), {});
    std::uint8_t& known = count[v.index()];
    if (known < 2) next[v][known] = to;
    known = std::min<std::uint8_t>(known + 1, 3);
  };
  const auto labelsFrom = [&](HalfedgeId h) {
    TriangleLabels labels = s.labelsOf(LiveMesh::slotOf(h));
    std::rotate(labels.wedges.begin(), labels.wedges.begin() + LiveMesh::sideOf(h), labels.wedges.end());
    return labels;
  };
  for (std::uint32_t t = 0; t < s.mesh.triangles.size(); ++t)
    for (std::size_t side = 0; side < 3; ++side) {
      const HalfedgeId twin = s.mesh.triangles[SlotId(t)].twin[side];
      if (!twin.isValid() || LiveMesh::slotOf(twin).index() < t) continue;
      const HalfedgeId h = s.mesh.twinOf(twin);
      const TriangleLabels a = labelsFrom(h), b = labelsFrom(twin);
      if (s.parts.areAlike(a, b) && a.wedges[0] == b.wedges[1] && a.wedges[1] == b.wedges[0]) continue;
      const VertexId from = s.mesh.origin(h), to = s.mesh.origin(twin);
      add(from, to);
      add(to, from);
    }
  for (std::uint32_t v = 0; v < next.size(); ++v)
    if (count[v] != 2) next[VertexId(v)] = {};
  return next;
}

/// Makes every vertex due whose cost may have fallen since it was found, or that was stuck.
void makeChangedDue(SurfaceState& s) {
  const std::span<const VertexId> vertices = s.thresholds.vertices();
  forRanges(LoopThreads::all, vertices.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (const VertexId v : vertices.subspan(begin, end - begin)) {
      if (!v.isValid()) continue;
      const RemovalRecord& record = s.records[v];
      if (record.state == RemovalRecord::State::fixed) continue;
      if (record.isTouched != 0 || record.state == RemovalRecord::State::stuck)
        s.thresholds.set(v, ThresholdList::kNow);
    }
  });
}

}  // namespace

Result<SurfaceRoot> simplifySurface(SurfaceState& s, const std::vector<std::uint8_t>& isFixed,
                                    const RunContext& context) {
  s.liveTriangles = s.mesh.triangles.size();
  s.pieces.resize(s.mesh.triangles.size());
  s.firstStarLabel.assign(s.mesh.vertexCount(), 0);
  s.borderNext = borderNextOf(s.mesh);
  s.lineNext = lineNextOf(s);
  s.starLabels.reserve(kMaxHoleCorners * s.mesh.vertexCount());
  s.starAttributeErrors.reserve(kMaxHoleCorners * s.mesh.vertexCount());
  if (s.parts.hasWedges && s.boundsAttributes) s.acrossSides.resize(s.mesh.triangles.size());
  s.attributeErrors.resize(s.mesh.triangles.size());
  for (std::size_t i = 0; i < s.mesh.triangles.size(); ++i)
    for (std::size_t a = 0; a < s.attributeErrors.perTriangle(); ++a) s.attributeErrors.set(i, a, 0);
  s.records.resize(s.mesh.vertexCount());
  forRanges(LoopThreads::all, s.records.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v != end; ++v) {
      RemovalRecord& record = s.records[VertexId(static_cast<std::uint32_t>(v))];
      record = {};
      if (isFixed[v] != 0) record.state = RemovalRecord::State::fixed;
    }
  });
  s.thresholds.assign(s.mesh.verticesInOrder(), isFixed);
  LevelSchedule schedule(s.thresholds, {.first = kFirstThreshold, .ratio = s.thresholdRatio, .gap = kGap});
  SharedProgress progress(context, "simplify", schedule.sizeAtStart());
  SurfaceLevels levels(s);
  std::uint32_t number = 0;
  while (!s.thresholds.empty() && s.liveTriangles > s.fewEnough) {
    s.thresholds.compact();
    ++number;
    progress.add(levels.level(schedule.threshold(), number, {number, 0}));
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the build was interrupted");
    const LevelSchedule::Step step = schedule.advance();
    if (step == LevelSchedule::Step::end) break;
    if (step == LevelSchedule::Step::refresh) makeChangedDue(s);
    if (s.liveTriangles < s.mesh.triangles.size() / 2) compact(s);
  }
  context.report("simplify", 1);
  return labelledRootOf(s, number);
}

}  // namespace arete
