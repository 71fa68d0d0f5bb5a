// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/looks/space_marks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/surface/surface_subject.h"

namespace arete {
namespace {

/// The longest line of an ink.
std::pair<Vec3, Vec3> longest(const SpaceVertices& lines, auto isInk) {
  std::pair<Vec3, Vec3> most{};
  for (std::size_t i = 0; i + 1 < lines.vertices.size(); i += 2) {
    if (!isInk(lines.vertices[i].color)) continue;
    const Vec3 &a = lines.vertices[i].place, &b = lines.vertices[i + 1].place;
    if (norm(b - a) > norm(most.second - most.first)) most = {a, b};
  }
  return most;
}

TEST(SpaceMarks, AxesRunAlongTheFilesCoordinatesWhateverPointsUpAndHoweverItIsTurned) {
  TriangleMesh mesh = shapes::globe(20, 9);
  for (Vec3& p : mesh.positions) p = {2 * p.x, 3 * p.y, 5 * p.z};
  const auto model = buildSurface(SurfaceMesh(mesh));
  ASSERT_TRUE(model);
  for (const char* up : {"y", "z"})
    for (const Turn& turn : {Turn{}, Turn{90, 0, 0}}) {
      SCOPED_TRACE(up);
      const auto form = std::make_shared<const SurfaceForm>(*model, ZUpFrame(*model, up));
      const SurfaceSubject subject(form, turn);
      const SpaceVertices axes = axesOf(subject);
      const auto x = longest(axes, [](const Rgba& c) { return c.r > 200; });
      const auto y = longest(axes, [](const Rgba& c) { return c.g > 150; });
      const auto z = longest(axes, [](const Rgba& c) { return c.b > 200; });
      const Vec3 along[] = {subject.inFile(x.second) - subject.inFile(x.first),
                            subject.inFile(y.second) - subject.inFile(y.first),
                            subject.inFile(z.second) - subject.inFile(z.first)};
      const double lengths[] = {4, 6, 10};
      for (int i = 0; i < 3; ++i) {
        const double own = i == 0 ? along[i].x : i == 1 ? along[i].y : along[i].z;
        EXPECT_NEAR(own, norm(along[i]), 1e-9) << "axis " << i;
        EXPECT_NEAR(own, lengths[i], 0.3) << "axis " << i;
      }
      EXPECT_LT(norm(x.first - y.first), 1e-9);
      EXPECT_LT(norm(x.first - z.first), 1e-9);
    }
}

TEST(SpaceMarks, TheGridLiesBelowTheModelAtRoundSteps) {
  TriangleMesh mesh = shapes::globe(20, 9);
  for (Vec3& p : mesh.positions) p = 13.7 * p;
  const auto model = buildSurface(SurfaceMesh(mesh));
  ASSERT_TRUE(model);
  const SurfaceSubject subject(*model, ZUpFrame(*model, "z"));
  EXPECT_DOUBLE_EQ(markStep(subject), 2);
  const SpaceVertices grid = groundGridOf(subject);
  EXPECT_GT(grid.vertices.size(), 40u);
  for (const auto& v : grid.vertices) {
    EXPECT_DOUBLE_EQ(v.place.z, subject.box().low.z);
    EXPECT_NEAR(std::remainder(v.place.x, 2), 0, 1e-9);
    EXPECT_NEAR(std::remainder(v.place.y, 2), 0, 1e-9);
  }
}

TEST(SpaceMarks, AFlatOrTinyModelHasMarksToo) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    TriangleMesh mesh = shapes::sheet(2, 2);
    for (Vec3& p : mesh.positions) p = size * p;
    const auto model = buildSurface(SurfaceMesh(mesh));
    ASSERT_TRUE(model);
    const SurfaceSubject subject(*model, ZUpFrame(*model, "z"));
    for (const auto& lines : {axesOf(subject), groundGridOf(subject)}) {
      EXPECT_FALSE(lines.vertices.empty());
      for (const auto& v : lines.vertices) EXPECT_TRUE(isFinite(v.place));
    }
  }
}

}  // namespace
}  // namespace arete
