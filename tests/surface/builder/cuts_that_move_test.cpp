// SPDX-License-Identifier: GPL-3.0-or-later
//
// Geomorphs of surfaces (engine/morph/geomorphed_cut.h). The oracle has a projection and distances of its
// own: a point of the source in sight has a drawn point within the tolerance in pixels, and a point of a
// front one of the front before within the jump that is stated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "engine/criteria/view_error.h"
#include "engine/follow/incremental_cut.h"
#include "engine/morph/geomorphed_cut.h"
#include "surface/builder/build.h"
#include "surface/families.h"

namespace arete {
namespace {

class Eye {
 public:
  explicit Eye(const View& v) : v_(v) {
    f_ = unit(v.forward);
    r_ = unit(cross(f_, Vec3{0, 0, 1}));
    u_ = cross(r_, f_);
    focal_ = v.heightPixels / 2.0 / std::tan(v.verticalFieldOfView / 2);
  }
  double depth(const Vec3& p) const { return dot(p - v_.eye, f_); }
  Vec2 project(const Vec3& p) const {
    return {focal_ * dot(p - v_.eye, r_) / depth(p), focal_ * dot(p - v_.eye, u_) / depth(p)};
  }
  bool sees(const Vec3& p) const {
    if (!(depth(p) > v_.nearDistance)) return false;
    const Vec2 s = project(p);
    return std::abs(s.x) <= v_.widthPixels / 2.0 && std::abs(s.y) <= v_.heightPixels / 2.0;
  }
  double between(const Vec3& p, const Vec3& q) const {
    if (depth(p) <= 0 || depth(q) <= 0) return std::numeric_limits<double>::infinity();
    const Vec2 a = project(p), b = project(q);
    return std::hypot(a.x - b.x, a.y - b.y);
  }

 private:
  View v_;
  Vec3 f_, r_, u_;
  double focal_;
};

/// By Voronoi regions of a triangle [Ericson2005].
Vec3 nearest(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  const double sum = va + vb + vc;
  return a + (vb / sum) * ab + (vc / sum) * ac;
}

using Triangles = std::vector<std::array<Vec3, 3>>;

Vec3 nearest(const Vec3& p, const Triangles& triangles) {
  Vec3 best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : triangles) {
    const Vec3 q = nearest(p, t[0], t[1], t[2]);
    if (norm(q - p) < least) least = norm(q - p), best = q;
  }
  return best;
}

/// In metric space.
Triangles drawn(const MultiTriangulation& mt, std::span<const std::uint32_t> front,
                const std::vector<SpaceOffset>& offsets) {
  Triangles all;
  for (const std::uint32_t t : front) {
    std::array<Vec3, 3> corners;
    const auto ids = mt.corners(TriangleId(t));
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = mt.metric().toMetric(mt.position(VertexId(ids[i])) + offsets[ids[i]].vector());
    all.push_back(corners);
  }
  return all;
}

/// Turns around the surface in small steps, comes nearer and goes away.
View viewOf(const SurfaceModel& model, int move) {
  const double turn = 0.01 * move + move / 20,
               distance = model.diagonal * (0.9 + 0.6 * std::sin(0.09 * move));
  View view;
  view.eye = {distance * std::cos(turn), distance * std::sin(turn), 0.3 * distance};
  view.forward = -view.eye;
  view.widthPixels = 320;
  view.heightPixels = 200;
  return view;
}

Vec3 somewhereIn(const std::array<Vec3, 3>& t, std::mt19937_64& random) {
  double u = double(random() % 1001) / 1000, v = double(random() % 1001) / 1000;
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

std::vector<SpaceOffset> offsetsOf(const GeomorphedSurface& moved) {
  std::vector<SpaceOffset> all;
  for (std::uint32_t v = 0; v < moved.mt().vertexCount(); ++v) all.push_back(moved.offset(VertexId(v)));
  return all;
}

TEST(CutsThatMove, OfASurfaceHaveADrawnPointWithinTheToleranceOfEveryPointInSight) {
  const std::uint64_t seed = 71;
  std::mt19937_64 random(seed);
  double closest = 0;
  std::size_t seen = 0, moving = 0;
  for (const shapes::NamedMesh& m : shapes::families(seed)) {
    SCOPED_TRACE(m.name);
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(m.mesh));
    ASSERT_TRUE(model);
    const MultiTriangulation& mt = model->mt;
    IncrementalCut cut(mt);
    GeomorphedSurface moved(mt);
    for (int move = 0; move < 40; ++move) {
      const View view = viewOf(*model, move);
      const double pixels = std::array{1.0, 6.0, 20.0}[std::size_t(move / 20) % 3];
      const MorphCamera camera({.view = view, .pixels = pixels, .moves = move % 10 != 9}, mt.metric());
      ASSERT_TRUE(cut.update(ViewError({.view = view, .pixels = camera.tolerance().cut}, mt.metric())));
      const auto update = moved.update(camera, cut);
      moving += update.moving;
      const Triangles shown = drawn(mt, cut.triangles(), offsetsOf(moved));
      const Eye eye(view);
      for (int sample = 0; sample < 60; ++sample) {
        const auto& face = m.mesh.triangles[random() % m.mesh.triangles.size()];
        const Vec3 p = mt.metric().toMetric(somewhereIn(
            {m.mesh.positions[face[0]], m.mesh.positions[face[1]], m.mesh.positions[face[2]]}, random));
        if (!eye.sees(p)) continue;
        ++seen;
        const double worst = eye.between(p, nearest(p, shown));
        EXPECT_LE(worst, pixels * (1 + 1e-6)) << "move " << move;
        closest = std::max(closest, worst / pixels);
      }
    }
  }
  EXPECT_GT(seen, 5000u);
  EXPECT_GT(moving, 5000u);
  std::printf("%zu points in sight, at most %.3f of the tolerance\n", seen, closest);
}

TEST(CutsThatMove, OfASurfaceJumpNowhereByMoreThanTheyStateAndLessThanWithoutMotion) {
  const std::uint64_t seed = 72;
  std::mt19937_64 random(seed);
  std::array<std::vector<double>, 2> stated, found;
  for (const bool moves : {false, true})
    for (const shapes::NamedMesh& m : shapes::families(seed)) {
      SCOPED_TRACE(m.name);
      const Result<SurfaceModel> model = buildSurface(SurfaceMesh(m.mesh));
      ASSERT_TRUE(model);
      const MultiTriangulation& mt = model->mt;
      IncrementalCut cut(mt);
      GeomorphedSurface moved(mt);
      for (int move = 0; move < 60; ++move) {
        const View view = viewOf(*model, move);
        const double pixels = 3;
        const MorphCamera camera({.view = view, .pixels = pixels, .moves = moves}, mt.metric());
        const std::vector<std::uint32_t> before(cut.triangles().begin(), cut.triangles().end());
        ASSERT_TRUE(cut.update(ViewError({.view = view, .pixels = camera.tolerance().cut}, mt.metric())));
        const auto update = moved.update(camera, cut);
        // Both fronts with the offsets of this camera; a node that left starts as it would now.
        std::vector<SpaceOffset> offsets = offsetsOf(moved);
        for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
          if (cut.contains(NodeId(n))) continue;
          const SpaceMorphNode node = SpaceMotion::nodeOf(mt, NodeId(n));
          const double scale = camera.pixelsPerHeight(mt.sphere(NodeId(n)));
          offsets[mt.apex(NodeId(n)).index()] =
              SpaceMotion::offset(camera, node, mt.saturatedError(NodeId(n)) * scale, scale,
                                  offsets[node.corner[0]], offsets[node.corner[1]], offsets[node.corner[2]]);
        }
        const Triangles old = drawn(mt, before, offsets), now = drawn(mt, cut.triangles(), offsets);
        const Eye eye(view);
        double worst = 0;
        for (int sample = 0; sample < 150; ++sample) {
          const bool isOld = sample % 2 == 0;
          const Triangles &from = isOld ? old : now, &to = isOld ? now : old;
          const auto& t = from[random() % from.size()];
          const Vec3 p = sample % 6 < 2 ? t[random() % 3] : somewhereIn(t, random);
          if (eye.sees(p)) worst = std::max(worst, eye.between(p, nearest(p, to)));
        }
        EXPECT_LE(worst, update.jumpPixels * (1 + 1e-5) + 1e-4) << "move " << move;
        // The first picture, and leaps by a radian.
        if (move % 20 == 0) continue;
        stated[moves ? 1 : 0].push_back(update.jumpPixels / pixels);
        found[moves ? 1 : 0].push_back(worst / pixels);
      }
    }
  const auto mean = [](const std::vector<double>& all) {
    double sum = 0;
    for (const double x : all) sum += std::isfinite(x) ? x : 0;
    return sum / double(all.size());
  };
  std::printf("mean jump of the tolerance: %.3f stated, %.3f found; without motion %.3f, %.3f\n",
              mean(stated[1]), mean(found[1]), mean(stated[0]), mean(found[0]));
  EXPECT_LT(mean(found[1]), mean(found[0]));
}

TEST(CutsThatMove, OfASurfaceStartOnTheFloorAndComeToRest) {
  const std::uint64_t seed = 73;
  std::size_t starting = 0, resting = 0;
  for (const shapes::NamedMesh& m : shapes::families(seed)) {
    SCOPED_TRACE(m.name);
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(m.mesh));
    ASSERT_TRUE(model);
    const MultiTriangulation& mt = model->mt;
    IncrementalCut cut(mt);
    GeomorphedSurface moved(mt);
    for (int move = 0; move < 20; ++move) {
      const View view = viewOf(*model, move);
      const MorphCamera camera({.view = view, .pixels = 4}, mt.metric());
      ASSERT_TRUE(cut.update(ViewError({.view = view, .pixels = camera.tolerance().cut}, mt.metric())));
      moved.update(camera, cut);
      for (const auto& moving : moved.moving()) {
        const VertexId v = mt.apex(moving.node);
        const double scale = camera.pixelsPerHeight(mt.sphere(moving.node));
        if (norm(moved.offset(v).vector()) > 0.999 * camera.mostOffset(scale)) continue;  // clamped
        std::array<Vec3, 3> floor;
        for (std::size_t i = 0; i < 3; ++i) {
          const VertexId c(moving.place->corner[i]);
          floor[i] = mt.position(c) + moved.offset(c).vector();
        }
        const Vec3 p = mt.position(v) + moved.offset(v).vector();
        EXPECT_LE(norm(nearest(p, floor[0], floor[1], floor[2]) - p),
                  (1 - moving.share) * norm(moving.place->detail) + 1e-5 * model->diagonal);
        ++starting;
      }
      for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
        if (!cut.contains(NodeId(n))) continue;
        const double rho = mt.saturatedError(NodeId(n)) * camera.pixelsPerHeight(mt.sphere(NodeId(n)));
        if (rho < 2.0001 * camera.tolerance().cut) continue;
        EXPECT_EQ(moved.offset(mt.apex(NodeId(n))), SpaceOffset{});
        ++resting;
      }
    }
  }
  EXPECT_GT(starting, 50u);
  EXPECT_GT(resting, 1000u);
}

}  // namespace
}  // namespace arete
