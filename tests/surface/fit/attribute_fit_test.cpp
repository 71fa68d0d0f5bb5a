// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/attribute_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "engine/cut/cut.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/fit/fit.h"
#include "surface/fit/held_vertices.h"
#include "surface/front/front.h"

namespace arete {
namespace {

Attribute attributeOf(const SurfaceMesh& mesh, const char* name, AttributeMeaning meaning,
                      const std::function<std::vector<double>(const Vec3&)>& at) {
  Attribute a;
  a.name = name;
  a.meaning = meaning;
  a.type = ScalarType::float64;
  a.components = static_cast<std::uint8_t>(at(Vec3{0, 0, 0}).size());
  for (const Vec3& p : mesh.positions) a.append(at(p));
  return a;
}

struct FittedCut {
  SurfaceMesh source, cut;
  std::vector<AttributeRms> rms;
};

/// A tenth of a mesh, fitted with its attributes.
FittedCut fittedTenth(const SurfaceMesh& mesh) {
  const auto model = buildSurface(mesh);
  if (!model) throw std::runtime_error(model.error().message);
  const auto cut = takeCut(model->mt, UniformError(0),
                           {.maxTriangles = static_cast<std::uint32_t>(mesh.triangles.size() / 10)});
  if (!cut) throw std::runtime_error(cut.error().message);
  FittedCut f{finestSurfaceOf(*model).mesh, surfaceOf(*model, *cut).mesh, {}};
  const auto fit = fitSurface(f.cut.shape(), heldVertices(f.cut, false), f.source.shape());
  if (!fit) throw std::runtime_error(fit.error().message);
  const std::vector<Vec3> before = f.cut.positions;
  f.cut.positions = fit->positions;
  auto rms = fitAttributes(f.cut, before, f.source);
  if (!rms) throw std::runtime_error(rms.error().message);
  f.rms = *rms;
  return f;
}

TEST(FitAttributes, LeavesWhatIsAffineInThePositionAffine) {
  SurfaceMesh mesh(shapes::globe(60, 30));
  const auto affine = [](const Vec3& p) {
    return std::vector<double>{0.3 + 0.2 * p.x - 0.1 * p.y, 0.5 * p.z};
  };
  mesh.vertexAttributes = {attributeOf(mesh, "heat", AttributeMeaning::other, affine)};
  const FittedCut f = fittedTenth(mesh);
  for (std::size_t v = 0; v < f.cut.positions.size(); ++v) {
    const auto now = f.cut.vertexAttributes[0].numbers(v), wanted = affine(f.cut.positions[v]);
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(now[c], wanted[c], 1e-9);
  }
}

TEST(FitAttributes, MakesRoundAttributesNearerAndKeepsRangesLengthsAndLabels) {
  SurfaceMesh mesh(shapes::globe(60, 30));
  mesh.vertexAttributes = {
      attributeOf(mesh, "color", AttributeMeaning::color,
                  [](const Vec3& p) {
                    return std::vector<double>{0.5 + 0.5 * std::sin(3 * p.x), p.y * p.y, 1};
                  }),
      attributeOf(mesh, "normal", AttributeMeaning::normal,
                  [](const Vec3& p) {
                    const double n = std::max(1e-9, norm(p));
                    return std::vector<double>{p.x / n, p.y / n, p.z / n};
                  }),
      attributeOf(mesh, "class", AttributeMeaning::other,
                  [](const Vec3& p) { return std::vector<double>{p.x > 0 ? 1.0 : 7.0}; })};
  const FittedCut f = fittedTenth(mesh);
  ASSERT_EQ(f.rms.size(), 2u);
  EXPECT_LT(f.rms[0].after, 0.9 * f.rms[0].before);
  for (const AttributeRms& rms : f.rms) EXPECT_FALSE(rms.hasGrown()) << rms.name;
  for (std::size_t v = 0; v < f.cut.positions.size(); ++v) {
    for (const double x : f.cut.vertexAttributes[0].numbers(v)) EXPECT_TRUE(x >= 0 && x <= 1) << x;
    const auto n = f.cut.vertexAttributes[1].numbers(v);
    EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-9);
    const double label = f.cut.vertexAttributes[2].numbers(v)[0];
    EXPECT_TRUE(label == 1 || label == 7) << label;
  }
}

// A least squares fit of a dome passes above its top: over its own range, within the range of all.
TEST(FitAttributes, KeepsNumbersWithinTheRangeOfWhatHangsTogether) {
  const TriangleMesh low = shapes::sheet(30, 30);
  SurfaceMesh mesh(low);
  const auto count = static_cast<std::uint32_t>(low.positions.size());
  for (const Vec3& p : low.positions) mesh.positions.push_back(p + Vec3{100, 0, 0});
  for (Vec3& p : mesh.positions) p.z = 6 * std::sin(p.x / 7) * std::cos(p.y / 6);
  for (const auto& [a, b, c] : low.triangles) mesh.triangles.push_back({a + count, b + count, c + count});
  mesh.vertexAttributes = {attributeOf(mesh, "heat", AttributeMeaning::other, [](const Vec3& p) {
    const bool isSecond = p.x > 60;
    const double x = (p.x - (isSecond ? 120 : 20)) / 20, y = (p.y - 20) / 20;
    const double r = x * x + 0.7 * y * y;
    return std::vector<double>{isSecond ? 0.6 + 0.2 * r : 0.4 - 0.2 * r, 0.1 * x + 0.05 * y};
  })};
  const FittedCut f = fittedTenth(mesh);
  EXPECT_LT(f.rms[0].after, f.rms[0].before);
  for (std::size_t v = 0; v < f.cut.positions.size(); ++v) {
    const double u = f.cut.vertexAttributes[0].numbers(v)[0];
    const bool isSecond = f.cut.positions[v].x > 60;
    EXPECT_TRUE(isSecond ? u >= 0.6 : u <= 0.4) << u;
  }
}

TEST(FitAttributes, RefusesPlacesThatAreNotAsManyAsTheVertices) {
  SurfaceMesh mesh(shapes::globe(12, 7));
  EXPECT_FALSE(fitAttributes(mesh, {}, mesh));
}

}  // namespace
}  // namespace arete
