// SPDX-License-Identifier: GPL-3.0-or-later
//
// Combines the incremental cut and the geomorphed surface over it, and keeps copies of the buffers. Changed
// triangles are found by comparing ids with the last frame's: a few microseconds for 100 000 triangles.
#include "engine/morph/view_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/caught_failure.h"
#include "engine/criteria/view_error.h"
#include "engine/follow/incremental_cut.h"
#include "engine/morph/geomorphed_cut.h"
#include "engine/mt/exaggerated_mt.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kMostBetween = 8;  // unchanged triangles that do not end a range

}  // namespace

class ViewMesh::State {
 public:
  explicit State(MultiTriangulation mt) : cut_(mt), surface_(std::move(mt)), origin_(middle()) {
    takeTriangles();
    places_.assign(1, {0, static_cast<std::uint32_t>(triangles_.size())});
  }

  Result<Report> update(const View& view, const UpdateOptions& o, const RunContext& context) {
    ARETE_CHECK(view.validate());
    if (!(o.pixels > 0 && std::isfinite(o.pixels)))
      return failure(ErrorCode::usage, "the tolerance must be above 0 pixels", "view mesh");
    const MorphCamera camera({.view = view, .pixels = o.pixels, .moves = o.geomorph}, metric());
    ARETE_TRY(const auto updated,
              cut_.update(ViewError({.view = view, .pixels = camera.tolerance().cut}, metric()),
                          {.maxTriangles = o.maxTriangles, .deadline = o.deadline}, context));
    const bool budgetBinds = !updated.isComplete && o.maxTriangles.has_value();
    return withThreads(context, [&] {
      const GeomorphedTerrain::Update moved = surface_.update(camera, cut_, budgetBinds);
      takeTriangles();
      heights_.clear();
      for (const GeomorphedTerrain::Change& change : surface_.changes())
        heights_.push_back({change.vertex.index(), position(change.vertex)[2]});
      Report report;
      report.triangles = static_cast<std::uint32_t>(triangles_.size());
      report.refined = updated.refined;
      report.coarsened = updated.coarsened;
      report.moving = moved.moving;
      report.isComplete = updated.isComplete;
      report.pixels = updated.isComplete ? o.pixels : reached(camera, moved.cutPixels);
      report.jumpPixels = moved.jumpPixels;
      return report;
    });
  }

  std::array<float, 3> position(VertexId v) const {
    Vec3 p = mt().position(v);
    p.z += surface_.offset(v);
    const Vec3 q = metric().toMetric(p);
    return {static_cast<float>(q.x - origin_.x), static_cast<float>(q.y - origin_.y),
            static_cast<float>(q.z - origin_.z)};
  }

  const MultiTriangulation& mt() const { return cut_.mt(); }
  const Vec3& origin() const { return origin_; }
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
  const std::vector<std::uint32_t>& ids() const { return ids_; }
  const std::vector<Places>& places() const { return places_; }
  const std::vector<HeightChange>& heights() const { return heights_; }

 private:
  const MetricFrame& metric() const { return mt().metric(); }

  /// The middle of the box of the root's vertices, which contains the terrain in plan.
  Vec3 middle() const {
    Vec3 low{kInfinite, kInfinite, kInfinite}, high{-kInfinite, -kInfinite, -kInfinite};
    for (std::uint32_t v = 0; v < mt().rootVertexCount(); ++v) {
      const Vec3 p = metric().toMetric(mt().position(VertexId(v)));
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
  }

  void takeTriangles() {
    const auto now = cut_.triangles();
    const std::size_t common = std::min(now.size(), ids_.size());
    places_.clear();
    const auto changed = [&](std::size_t place) {
      triangles_[place] = mt().corners(TriangleId(now[place]));
      ids_[place] = now[place];
      const auto at = static_cast<std::uint32_t>(place);
      if (!places_.empty() && at - (places_.back().first + places_.back().count) <= kMostBetween)
        places_.back().count = at - places_.back().first + 1;
      else
        places_.push_back({at, 1});
    };
    ids_.resize(now.size());
    triangles_.resize(now.size());
    for (std::size_t place = 0; place < common; ++place)
      if (ids_[place] != now[place]) changed(place);
    for (std::size_t place = common; place < now.size(); ++place) changed(place);
  }

  /// The tolerance that an incomplete cut keeps.
  double reached(const MorphCamera& camera, double cutPixels) const {
    const double worst = parallelReduce(
        IndexRange<std::size_t>(0, ids_.size(), 1024), 0.0,
        [&](const auto& range, double most) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const TriangleId t(ids_[i]);
            const NodeId remover = mt().remover(t);
            if (!remover.isValid() || mt().errorCode(t) == 0) continue;
            const double pixels = camera.pixelsPerHeight(mt().sphere(remover));
            if (pixels > 0) most = std::max(most, mt().error(t) * pixels);
          }
          return most;
        },
        [](double x, double y) { return std::max(x, y); });
    const double offset = camera.tolerance().offset * cutPixels / camera.tolerance().cut;
    return camera.pixelsOf(std::max(worst, cutPixels) + offset);
  }

  // The cut and the surface go on from frame to frame; the vectors are copies of the last frame, with which
  // the next one is compared.
  IncrementalCut cut_;
  GeomorphedTerrain surface_;
  Vec3 origin_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint32_t> ids_;
  std::vector<Places> places_;
  std::vector<HeightChange> heights_;
};

// Exaggeration changes the metric and the spheres alone, so the cut and its tolerances need no other change.
Result<ViewMesh> ViewMesh::create(MultiTriangulation mt, const Options& options) try {
  if (!(options.heightScale > 0 && std::isfinite(options.heightScale)))
    return failure(ErrorCode::usage, "heights can be multiplied by a number above 0 only", "view mesh");
  if (options.heightScale != 1) mt = exaggerated(mt, options.heightScale);
  return ViewMesh(std::make_unique<State>(std::move(mt)));
} catch (...) {
  return caughtFailure();
}

ViewMesh::ViewMesh(std::unique_ptr<State> state) : state_(std::move(state)) {}
ViewMesh::~ViewMesh() = default;
ViewMesh::ViewMesh(ViewMesh&&) noexcept = default;
ViewMesh& ViewMesh::operator=(ViewMesh&&) noexcept = default;

Result<ViewMesh::Report> ViewMesh::update(const View& view, const UpdateOptions& options,
                                          const RunContext& context) try {
  return state_->update(view, options, context);
} catch (...) {
  return caughtFailure();
}

// Positions are computed for all vertices, since a front may use any of them.
std::vector<std::array<float, 3>> ViewMesh::positions() const {
  std::vector<std::array<float, 3>> all(mt().vertexCount());
  parallelFor(IndexRange<std::uint32_t>(0, mt().vertexCount(), 4096), [&](const auto& range) {
    for (std::uint32_t v = range.begin(); v < range.end(); ++v) all[v] = state_->position(VertexId(v));
  });
  return all;
}

std::span<const std::array<std::uint32_t, 3>> ViewMesh::triangles() const {
  return state_->triangles();
}

std::span<const std::uint32_t> ViewMesh::triangleIds() const {
  return state_->ids();
}

std::span<const ViewMesh::Places> ViewMesh::changedPlaces() const {
  return state_->places();
}

std::span<const ViewMesh::HeightChange> ViewMesh::heightChanges() const {
  return state_->heights();
}

const Vec3& ViewMesh::origin() const {
  return state_->origin();
}

const MultiTriangulation& ViewMesh::mt() const {
  return state_->mt();
}

}  // namespace arete
