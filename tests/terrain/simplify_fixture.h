// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "datasets/random.h"
#include "engine/base/id_array.h"
#include "engine/ids_of.h"
#include "engine/mt/recorder.h"
#include "terrain/error/raster_error.h"
#include "terrain/simplify/state.h"
#include "terrain/triangulation/finest_raster.h"

namespace arete {

/// A small raster of hills and noise, with all that a simplification works on; nothing is removed yet.
struct SmallSimplification {
  RasterHeightfield field;
  std::vector<VertexId> pinched;
  LiveMesh mesh;
  LatticePlan plan;
  RasterError errors;
  MtRecorder recorder;
  BuildOptions options;
  SimplifyState<LatticePlan, RasterError> state;

  SmallSimplification(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed, HoleShape shape)
      : field(hills(columns, rows, seed)),
        mesh(finestMesh(field, pinched)),
        plan(columns, 1, 1),
        errors(plan, field.heights, false),
        recorder(static_cast<std::uint32_t>(mesh.triangles.size()), columns * rows, OutwardScale(kRange), {}),
        options{.shape = shape},
        state{.mesh = mesh,
              .plan = plan,
              .errors = errors,
              .recorder = recorder,
              .rim = nullptr,
              .options = options,
              .metric = {},
              .heightRange = kRange,
              .roundingSlack = 1e-12,
              .boundSlack = 1e-11} {
    state.records.assign(columns * rows, RemovalRecord{});
    state.thresholds.assign(mesh.verticesInOrder(), isFixed());
    state.liveTriangles = mesh.triangles.size();
  }

  /// All vertices of the finest triangulation.
  auto vertices() const { return test::idsBelow<VertexId>(field.size()); }
  /// The raster's corners.
  IdArray<VertexId, std::vector<std::uint8_t>> isFixed() const {
    IdArray<VertexId, std::vector<std::uint8_t>> fixed(field.size(), 0);
    for (const std::uint32_t column : {0u, field.columns - 1})
      for (const std::uint32_t row : {0u, field.rows - 1}) fixed[VertexId(field.index(column, row))] = 1;
    return fixed;
  }
  std::set<VertexId> linkOf(VertexId v) const {
    std::set<VertexId> link;
    for (const LiveMesh::Triangle& t : mesh.triangles)
      if (!t.isDead() && std::ranges::count(t.corners, v) != 0)
        for (const VertexId u : t.corners)
          if (u != v) link.insert(u);
    return link;
  }
  std::set<VertexId> verticesLeft() const {
    std::set<VertexId> left;
    for (const LiveMesh::Triangle& t : mesh.triangles)
      if (!t.isDead()) left.insert(t.corners.begin(), t.corners.end());
    return left;
  }
  /// The largest error of a triangle, by a scan of all samples.
  double plainError(VertexId a, VertexId b, VertexId c) const {
    const auto at = [&](VertexId vertex) {
      const std::uint32_t v = vertex.index();
      return Vec3{double(v % field.columns), double(v / field.columns), field.heights[v]};
    };
    const Vec3 p = at(a), q = at(b), r = at(c);
    const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    double error = 0;
    for (const VertexId v : vertices()) {
      const Vec3 s = at(v);
      const double u = (s.x - p.x) * (r.y - p.y) - (s.y - p.y) * (r.x - p.x),
                   w = (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x);
      if (u < 0 || w < 0 || u + w > area) continue;
      error = std::max(error, std::abs(p.z + u / area * (q.z - p.z) + w / area * (r.z - p.z) - s.z));
    }
    return error;
  }
  /// The live triangles cover the raster once, and every twin is the reverse edge.
  bool isWhole() const {
    double area = 0;
    std::map<std::pair<VertexId, VertexId>, SlotId> edges;
    for (const SlotId t : test::idsBelow<SlotId>(mesh.triangles.size())) {
      if (mesh.triangles[t].isDead()) continue;
      const auto& c = mesh.triangles[t].corners;
      const Vec2 p = plan.planPosition(c[0]), q = plan.planPosition(c[1]), r = plan.planPosition(c[2]);
      const double doubled = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
      if (!(doubled > 0)) return false;
      area += doubled / 2;
      for (int i = 0; i < 3; ++i) edges[{c[i], c[(i + 1) % 3]}] = t;
    }
    for (const auto& [edge, t] : edges)
      for (std::uint32_t side = 0; side < 3; ++side) {
        const HalfedgeId h = LiveMesh::halfedge(t, side);
        if (mesh.origin(h) != edge.first) continue;
        const auto reverse = edges.find({edge.second, edge.first});
        if (mesh.twinOf(h).isValid() != (reverse != edges.end())) return false;
        if (mesh.twinOf(h).isValid() && LiveMesh::slotOf(mesh.twinOf(h)) != reverse->second) return false;
      }
    return area == double(field.columns - 1) * (field.rows - 1);
  }

  static constexpr double kRange = 200;

 private:
  static RasterHeightfield hills(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
    RasterHeightfield field;
    field.columns = columns;
    field.rows = rows;
    Random random(seed);
    for (std::uint32_t i = 0; i < columns * rows; ++i)
      field.heights.push_back(50 * std::sin(0.4 * (i % columns)) * std::cos(0.3 * (i / columns)) +
                              random.between(0, 9));
    return field;
  }
};

}  // namespace arete
