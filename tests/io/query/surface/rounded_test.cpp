// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is stated of a model whose places were rounded, against the source as it was. The oracle samples the
// source and searches all triangles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/query/request/criterion.h"
#include "io/query/surface/distance_by_chart.h"
#include "io/query/surface/fit_front.h"
#include "io/query/surface/write_model.h"
#include "io/store/amt/surface_file.h"
#include "measure/mesh_distance.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/front/front.h"

namespace arete {
namespace {

double toSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length = dot(b - a, b - a);
  const double t = length > 0 ? std::clamp(dot(p - a, b - a) / length, 0.0, 1.0) : 0;
  return norm(p - a - t * (b - a));
}

/// By the plane where the foot is inside, else by the sides.
double toTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double area = norm(n);
  if (area > 0 && dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
      dot(cross(a - c, p - c), n) >= 0)
    return std::abs(dot(n, p - a)) / area;
  return std::min({toSegment(p, a, b), toSegment(p, b, c), toSegment(p, c, a)});
}

/// The largest distance of corners, middles of sides and middles of faces of a mesh from another.
double farthestSample(const TriangleMesh& from, const TriangleMesh& to) {
  double farthest = 0;
  const auto take = [&](const Vec3& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : to.triangles)
      nearest = std::min(nearest, toTriangle(p, to.positions[a], to.positions[b], to.positions[c]));
    farthest = std::max(farthest, nearest);
  };
  for (const auto& t : from.triangles) {
    const Vec3 &a = from.positions[t[0]], &b = from.positions[t[1]], &c = from.positions[t[2]];
    for (const Vec3& p : {a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3}) take(p);
  }
  return farthest;
}

class RoundedSurfaces : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "arete-rounded-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  SurfaceModel rounded(const SurfaceModel& model, int bits) const {
    const std::string path = (folder_ / "m.amt").string();
    const Status written = writeSurfaceModel(path, model, {}, {.isPacked = true, .positionBits = bits});
    EXPECT_TRUE(written) << written.error().describe();
    Result<SurfaceModel> read = loadSurfaceAmt(path);
    EXPECT_TRUE(read) << read.error().describe();
    return std::move(*read);
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(RoundedSurfaces, StateNoLessThanIsTrueOfTheSourceFittedAndBothWays) {
  const std::uint64_t seed = 5;
  for (shapes::NamedMesh& m : shapes::families(seed)) {
    // Off every grid.
    for (Vec3& p : m.mesh.positions) p = 1.0371 * p + Vec3{0.0123, 0.0456, 0.0789};
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(m.mesh));
    ASSERT_TRUE(model) << model.error().describe();
    for (const int bits : {8, 12}) {
      SCOPED_TRACE(fmt::format("{}, {} bits", m.name, bits));
      const SurfaceModel read = rounded(*model, bits);
      ASSERT_GT(read.positionError, 0);
      const TriangleMesh finest = finestSurfaceOf(read).mesh.shape();
      const double slack = 1e-9 * read.diagonal;
      for (const double error : {0.5 * read.positionError, 0.02 * read.diagonal}) {
        const UniformError criterion(error);
        const Result<Cut> cut = takeCut(read.mt, criterion);
        ASSERT_TRUE(cut);
        SurfaceFront front = surfaceOf(read, *cut);
        EXPECT_GE(cut->achievedError + slack, farthestSample(m.mesh, front.mesh.shape()));
        EXPECT_EQ(errorLeftByRounding(read, criterion, *cut) > 0, cut->achievedError > error)
            << "a tolerance is kept, or it is said that it is not";

        // Fits take long.
        if (bits != 8 || error < read.positionError || m.mesh.triangles.size() > 500) continue;
        const auto fit = fitFront(front, finestSurfaceOf(read).mesh,
                                  chartsOfCut(read, frontOfPrefix(read.mt, read.mt.nodeCount()), *cut), false,
                                  cut->achievedError, std::nullopt, {}, read.positionError);
        ASSERT_TRUE(fit) << fit.error().describe();
        const TriangleMesh fitted = front.mesh.shape();
        EXPECT_GE(fit->distance + slack, farthestSample(m.mesh, fitted));
        EXPECT_GE(fit->rmsAfter, read.positionError);

        auto apart = measureDistance(finest, fitted, {.samples = 2000});
        ASSERT_TRUE(apart);
        apart->raise(read.positionError);
        EXPECT_GE(apart->forward.maximum + slack, farthestSample(m.mesh, fitted));
        EXPECT_GE(apart->backward.atMost + slack, farthestSample(fitted, m.mesh));
        EXPECT_GE(apart->hausdorffAtMost(), apart->hausdorff());
      }
    }
  }
}

TEST_F(RoundedSurfaces, HaveBallsThatHoldTheSourceAsItWas) {
  const Result<SurfaceModel> model = buildSurface(SurfaceMesh(shapes::hills(12, 4)));
  ASSERT_TRUE(model);
  const SurfaceModel exact = rounded(*model, 0), read = rounded(*model, 8);
  EXPECT_EQ(exact.positionError, 0);
  const MtArrays& a = read.mt.arrays();
  for (std::uint32_t n = 0; n < read.mt.nodeCount(); ++n) {
    const Sphere& s = a.sphere[n];
    for (const std::uint32_t v : read.mt.link(NodeId(n))) {
      const Vec3 p = a.metric.toMetric(read.mt.position(VertexId(v)));
      EXPECT_GE(s.radius, norm(p - Vec3{s.x, s.y, s.z}) + read.positionError);
    }
  }
}

}  // namespace
}  // namespace arete
