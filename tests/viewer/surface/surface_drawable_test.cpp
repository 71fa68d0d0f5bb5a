// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures are judged by their pixels: where a surface is, what colour it has there, and where it is not.
#include "viewer/surface/surface_drawable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/drawn_mesh.h"
#include "viewer/fronts/shading_normals.h"
#include "viewer/headless/headless.h"

namespace arete {
namespace {

/// A PNG of 2 x 1 pixels, red on the left and green on the right.
std::vector<std::byte> redAndGreen() {
  constexpr unsigned char kBytes[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                                      0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01,
                                      0x08, 0x02, 0x00, 0x00, 0x00, 0x7b, 0x40, 0xe8, 0xdd, 0x00, 0x00, 0x00,
                                      0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0xf8, 0xcf, 0xc0, 0xc0,
                                      0xf0, 0x9f, 0x01, 0x00, 0x07, 0xff, 0x01, 0xff, 0xb8, 0x04, 0x35, 0xe0,
                                      0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  std::vector<std::byte> bytes;
  for (const unsigned char b : kBytes) bytes.push_back(std::byte(b));
  return bytes;
}

/// A flat square of two halves: the left one of a red material, the right one of a green one.
SurfaceMesh twoColors() {
  SurfaceMesh mesh(shapes::sheet(9, 9));
  mesh.materials = {Material{.name = "red", .baseColor = {1, 0, 0, 1}},
                    Material{.name = "green", .baseColor = {0, 1, 0, 1}}};
  for (const auto& t : mesh.triangles) {
    double x = 0;
    for (const std::uint32_t v : t) x += mesh.positions[v].x / 3;
    mesh.materialOf.push_back(x < 4 ? 0 : 1);
  }
  return mesh;
}

ViewSettings byMaterial(double pixels = 1) {
  ViewSettings settings;
  settings.pixels = pixels;
  settings.look.coloring = Coloring::material;
  settings.look.isShaded = false;
  return settings;
}

Result<HeadlessView> viewOf(const SurfaceModel& model, const ViewSettings& settings = byMaterial()) {
  return HeadlessView::create(
      {.widthPixels = 200, .heightPixels = 160, .samples = 1, .settings = settings},
      [&](Scene& scene) -> Status {
        ARETE_TRY(SurfaceDrawable made,
                  SurfaceDrawable::create(model, std::make_shared<SurfaceSubject>(model, ZUpFrame(model))));
        return scene.add(std::make_unique<SurfaceDrawable>(std::move(made)));
      });
}

Camera fromAbove(const SurfaceModel& model) {
  Camera picture;
  picture.widthPixels = 200;
  picture.heightPixels = 160;
  return homeCamera(HomeView::fromAbove, CameraSpace(), uprightShape(model, ZUpFrame(model)).box, picture);
}

// Between two texels there is some of the other color.
bool isRed(Rgb c) {
  return c.r > 200 && c.g < 160 && c.b < 40;
}
bool isGreen(Rgb c) {
  return c.g > 200 && c.r < 160 && c.b < 40;
}

TEST(SurfaceDrawable, ShowsTheMaterialOfEveryFaceAtEveryTolerance) {
  ARETE_NEEDS_OPENGL(probe);
  const Result<SurfaceModel> model = buildSurface(twoColors());
  ASSERT_TRUE(model) << model.error().describe();
  std::uint32_t before = ~0u;
  for (const double pixels : {0.01, 1.0, 1000.0}) {
    Result<HeadlessView> view = viewOf(*model, byMaterial(pixels));
    ASSERT_TRUE(view) << view.error().describe();
    const auto figures = view->draw(fromAbove(*model));
    ASSERT_TRUE(figures) << figures.error().describe();
    EXPECT_TRUE(figures->isShown);
    EXPECT_LE(figures->triangles, before);
    before = figures->triangles;
    const Image image = view->image();
    EXPECT_TRUE(isRed(image.at(60, 80))) << pixels;
    EXPECT_TRUE(isGreen(image.at(140, 80))) << pixels;
    EXPECT_GT(image.at(2, 2).r, 150);  // the background
    EXPECT_EQ(image.at(2, 2).r, image.at(197, 2).r);
  }
  EXPECT_LE(before, 12u);
}

TEST(SurfaceDrawable, ShowsAPictureTheRightWayUpAndRound) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceMesh mesh(shapes::sheet(9, 9));
  Material material;
  material.textures = {{.role = "baseColor", .picture = "#0"}};
  mesh.materials = {material};
  mesh.materialOf.assign(mesh.triangles.size(), 0);
  mesh.pictures = {{.name = "p.png", .mimeType = "image/png", .bytes = redAndGreen()}};
  Attribute coords;
  coords.name = kTexcoordName;
  coords.meaning = AttributeMeaning::textureCoords;
  coords.components = 2;
  for (const Vec3& p : mesh.positions) coords.append(std::vector<double>{p.x / 8, p.y / 8});
  mesh.vertexAttributes = {coords};
  const Result<SurfaceModel> model = buildSurface(mesh);
  ASSERT_TRUE(model) << model.error().describe();
  Result<HeadlessView> view = viewOf(*model);
  ASSERT_TRUE(view) << view.error().describe();
  EXPECT_TRUE(view->warnings().empty()) << view->warnings().front().sentence;
  ASSERT_TRUE(view->draw(fromAbove(*model)));
  const Image image = view->image();
  const Rgb left = image.at(60, 80), right = image.at(140, 80);
  EXPECT_TRUE(isRed(left)) << int(left.r) << ' ' << int(left.g) << ' ' << int(left.b);
  EXPECT_TRUE(isGreen(right)) << int(right.r) << ' ' << int(right.g) << ' ' << int(right.b);
}

TEST(SurfaceDrawable, SaysWhichPictureCannotBeShown) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceMesh mesh(shapes::sheet(4, 4));
  Material material;
  material.textures = {{.role = "baseColor", .picture = "#0"}};
  mesh.materials = {material};
  mesh.materialOf.assign(mesh.triangles.size(), 0);
  mesh.pictures = {{.name = "broken.png", .mimeType = "image/png", .bytes = {std::byte{1}, std::byte{2}}}};
  const Result<SurfaceModel> model = buildSurface(mesh);
  ASSERT_TRUE(model) << model.error().describe();
  Result<HeadlessView> view = viewOf(*model);
  ASSERT_TRUE(view) << view.error().describe();
  ASSERT_EQ(view->warnings().size(), 1u);
  EXPECT_NE(view->warnings()[0].sentence.find("broken.png"), std::string::npos)
      << view->warnings()[0].sentence;
}

// A drawable sends what changed since its last cut; the other has only ever had this one.
TEST(SurfaceDrawable, AfterManyCutsItDrawsWhatANewOneDraws) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceMesh mesh(shapes::shaken(shapes::globe(60, 40), 5, 0.02));
  mesh.materials = {Material{.name = "red", .baseColor = {1, 0, 0, 1}},
                    Material{.name = "green", .baseColor = {0, 1, 0, 1}},
                    Material{.name = "blue", .baseColor = {0, 0, 1, 1}}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    mesh.materialOf.push_back(static_cast<std::uint32_t>(t * 3 / mesh.triangles.size()));
  const Result<SurfaceModel> model = buildSurface(mesh);
  ASSERT_TRUE(model) << model.error().describe();
  Result<HeadlessView> flown = viewOf(*model);
  ASSERT_TRUE(flown) << flown.error().describe();
  const Camera start = fromAbove(*model);
  std::uint32_t least = ~0u, most = 0;
  for (int frame = 0; frame < 60; ++frame) {
    Camera camera = start;
    camera.xy.x += 0.4 * std::sin(frame * 0.3);
    camera.height *= 1.5 + std::cos(frame * 0.2);
    const auto figures = flown->draw(camera);
    ASSERT_TRUE(figures) << figures.error().describe();
    least = std::min(least, figures->triangles);
    most = std::max(most, figures->triangles);
    if (frame % 10 != 9) continue;
    Result<HeadlessView> fresh = viewOf(*model);
    ASSERT_TRUE(fresh) << fresh.error().describe();
    const auto expected = fresh->draw(camera);
    ASSERT_TRUE(expected);
    EXPECT_EQ(figures->triangles, expected->triangles);
    const Image a = flown->image(), b = fresh->image();
    int unlike = 0;
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 200; ++x) {
        const Rgb p = a.at(x, y), q = b.at(x, y);
        unlike += p.r != q.r || p.g != q.g || p.b != q.b;
      }
    EXPECT_EQ(unlike, 0) << "frame " << frame;
  }
  EXPECT_LT(2 * least, most);  // the cut did change
}

TEST(SurfaceDrawable, KeepsABudgetAndSaysWhichToleranceIsReached) {
  ARETE_NEEDS_OPENGL(probe);
  const Result<SurfaceModel> model =
      buildSurface(SurfaceMesh(shapes::shaken(shapes::globe(40, 30), 3, 0.02)));
  ASSERT_TRUE(model);
  ViewSettings settings = byMaterial(0.01);
  settings.maxTriangles = 400;
  Result<HeadlessView> view = viewOf(*model, settings);
  ASSERT_TRUE(view) << view.error().describe();
  const auto figures = view->draw(fromAbove(*model));
  ASSERT_TRUE(figures) << figures.error().describe();
  EXPECT_LE(figures->triangles, 400u);
  EXPECT_FALSE(figures->isComplete);
  EXPECT_GT(figures->pixels, 0.01);
  Camera away = fromAbove(*model);
  away.pitchDegrees = 90;
  EXPECT_FALSE(view->draw(away)->isShown);
}

TEST(ShadingNormals, AreThoseOfTheSourceAndNoneOnSharpEdges) {
  const Result<SurfaceModel> round = buildSurface(SurfaceMesh(shapes::globe(60, 40)));
  ASSERT_TRUE(round);
  const std::vector<Vec3> normals = shadingNormals(*round);
  for (std::uint32_t v = 0; v < normals.size(); ++v)
    EXPECT_GT(dot(normals[v], unit(round->mt.position(VertexId(v)))), 0.99);
  const Result<SurfaceModel> sharp = buildSurface(SurfaceMesh(shapes::tetrahedron()));
  ASSERT_TRUE(sharp);
  for (const Vec3& n : shadingNormals(*sharp)) EXPECT_EQ(norm(n), 0);
}

/// Squares of 2 by 2 at heights 0, 1 and 2, each of a material.
SurfaceMesh stackedSquares(const std::vector<Material>& materials, const std::vector<double>& heights) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i < heights.size(); ++i) {
    for (const Vec2& p : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}})
      mesh.positions.push_back({p.x, p.y, heights[i]});
    mesh.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
    mesh.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
    mesh.materialOf.insert(mesh.materialOf.end(), {i, i});
  }
  mesh.materials = materials;
  return mesh;
}

Material glass(const char* name, double r, double g, double b, double alpha) {
  Material material{.name = name, .baseColor = {r, g, b, alpha}};
  material.alphaMode = "BLEND";
  material.isDoubleSided = true;
  return material;
}

TEST(SurfaceDrawable, WhatIsBlendedIsDrawnBackToFrontWhateverItsOrderInTheFile) {
  ARETE_NEEDS_OPENGL(probe);
  // The nearer, blue, covers half of the farther, red, which covers half of the opaque green.
  const std::vector<Material> colors = {
      glass("blue", 0, 0, 1, 0.5), glass("red", 1, 0, 0, 0.5),
      Material{.name = "green", .baseColor = {0, 1, 0, 1}, .isDoubleSided = true}};
  const Result<SurfaceModel> model = buildSurface(stackedSquares(colors, {2, 1, 0}));
  ASSERT_TRUE(model);
  auto view = viewOf(*model);
  ASSERT_TRUE(view);
  ASSERT_TRUE(view->draw(fromAbove(*model)));
  const Rgb c = view->image().at(100, 80);
  // Blended as written, in sRGB: blue over (red over green).
  EXPECT_NEAR(c.b, 127.5, 2);
  EXPECT_NEAR(c.r, 63.75, 2);
  EXPECT_NEAR(c.g, 63.75, 2);
  // From below green hides both.
  Camera below = fromAbove(*model);
  below.pitchDegrees = 90;
  below.height = -below.height;
  ASSERT_TRUE(view->draw(below));
  EXPECT_EQ(view->image().at(100, 80), (Rgb{0, 255, 0}));
}

TEST(SurfaceDrawable, GlassIsSeenAgainstTheBackgroundToo) {
  ARETE_NEEDS_OPENGL(probe);
  const Result<SurfaceModel> model = buildSurface(stackedSquares({glass("red", 1, 0, 0, 0.5)}, {0}));
  ASSERT_TRUE(model);
  auto view = viewOf(*model);
  ASSERT_TRUE(view);
  const auto figures = view->draw(fromAbove(*model));
  ASSERT_TRUE(figures);
  EXPECT_TRUE(figures->isShown);
  const Rgb glassy = view->image().at(100, 80), beside = view->image().at(2, 80);
  EXPECT_NEAR(glassy.r, (255 + beside.r) / 2.0, 8);
  EXPECT_NEAR(glassy.b, beside.b / 2.0, 8);
}

}  // namespace
}  // namespace arete
