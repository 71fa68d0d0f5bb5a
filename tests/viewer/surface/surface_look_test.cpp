// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a surface shows and under what light, each by itself, judged by the pixels of pictures of a flat
// square that is seen from above. Expected colours are worked out here, in doubles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/color/color_tables.h"
#include "viewer/drawn_mesh.h"
#include "viewer/headless/headless.h"
#include "viewer/surface/surface_drawable.h"
#include "viewer/tiny_png.h"

namespace arete {
namespace {

using test::tinyPng;

double toSrgb(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

double toLinear(double c) {
  c /= 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

ViewSettings shown(bool isShaded) {
  ViewSettings settings;
  settings.look.coloring = Coloring::material;
  settings.look.isShaded = isShaded;
  settings.look.sun = Sun{0, 90};
  return settings;
}

/// A square from (0, 0) to (8, 8), all of it one material.
SurfaceMesh square(const Material& material = {}, double height = 0) {
  SurfaceMesh mesh(shapes::sheet(9, 9));
  for (Vec3& p : mesh.positions) p.z = height;
  mesh.materials = {material};
  mesh.materialOf.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// u to the east and v to the north, from 0 to `times`.
void addCoords(SurfaceMesh& mesh, double times = 1) {
  Attribute coords;
  coords.name = kTexcoordName;
  coords.meaning = AttributeMeaning::textureCoords;
  coords.components = 2;
  for (const Vec3& p : mesh.positions) coords.append(std::vector<double>{times * p.x / 8, times * p.y / 8});
  mesh.vertexAttributes.push_back(coords);
}

void addPicture(SurfaceMesh& mesh, const std::string& role, const std::vector<std::byte>& png) {
  mesh.materials[0].textures.push_back({.role = role, .picture = "#" + std::to_string(mesh.pictures.size())});
  mesh.pictures.push_back({.name = role + ".png", .mimeType = "image/png", .bytes = png});
}

std::vector<std::byte> oneColor(std::array<int, 4> color) {
  return tinyPng(1, {color});
}

class SurfaceLooks : public ::testing::Test {
 protected:
  /// The picture of 160 x 160 pixels from above, the square in its middle.
  void draw(const SurfaceMesh& mesh, const ViewSettings& settings, bool isFromBelow = false) {
    const Result<SurfaceModel> model = buildSurface(mesh);
    ASSERT_TRUE(model) << model.error().describe();
    Result<HeadlessView> view = HeadlessView::create(
        {.widthPixels = 160, .heightPixels = 160, .samples = 1, .settings = settings},
        [&](Scene& scene) -> Status {
          ARETE_TRY(SurfaceDrawable made, SurfaceDrawable::create(*model, std::make_shared<SurfaceSubject>(
                                                                              *model, ZUpFrame(*model))));
          return scene.add(std::make_unique<SurfaceDrawable>(std::move(made)));
        });
    ASSERT_TRUE(view) << view.error().describe();
    EXPECT_TRUE(view->warnings().empty()) << view->warnings().front().sentence;
    Camera camera;
    camera.widthPixels = camera.heightPixels = 160;
    camera =
        homeCamera(HomeView::fromAbove, CameraSpace(), uprightShape(*model, ZUpFrame(*model)).box, camera);
    if (isFromBelow) {
      camera.height = -camera.height;
      camera.pitchDegrees = -camera.pitchDegrees;
    }
    const auto figures = view->draw(camera);
    ASSERT_TRUE(figures) << figures.error().describe();
    isShown = figures->isShown;
    image = view->image();
  }
  Rgb middle() const { return image.at(80, 80); }
  void expect(Rgb c, double r, double g, double b, double within = 2.5) const {
    EXPECT_NEAR(c.r, r, within);
    EXPECT_NEAR(c.g, g, within);
    EXPECT_NEAR(c.b, b, within);
  }

  Image image;
  bool isShown = false;
};

TEST_F(SurfaceLooks, TexturesMaterialsAndColoursOfVerticesAreMultipliedAndEachIsLeftOutByItself) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceMesh mesh = square(Material{.name = "m", .baseColor = {0.5, 1, 1, 1}});
  addCoords(mesh);
  addPicture(mesh, "baseColor", oneColor({255, 128, 255, 255}));
  Attribute colors;
  colors.name = kColorName;
  colors.meaning = AttributeMeaning::color;
  colors.type = ScalarType::uint8;
  colors.isNormalized = true;
  colors.components = 3;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) colors.append(std::vector<double>{255, 255, 128});
  mesh.vertexAttributes.push_back(colors);
  const double half = toSrgb(0.5);
  for (int without = 0; without < 7; ++without) {
    SCOPED_TRACE(without);
    ViewSettings settings = shown(false);
    settings.look.surface.hasMaterialColors = !(without & 1);
    settings.look.surface.hasTextures = !(without & 2);
    settings.look.surface.hasVertexColors = !(without & 4);
    draw(mesh, settings);
    expect(middle(), without & 1 ? 255 : half, without & 2 ? 255 : 128, without & 4 ? 255 : 128);
  }
  ViewSettings settings = shown(false);
  settings.look.surface = {.hasTextures = false, .hasMaterialColors = false, .hasVertexColors = false};
  draw(mesh, settings);
  expect(middle(), toSrgb(0.72), toSrgb(0.71), toSrgb(0.69));
}

TEST_F(SurfaceLooks, PartsOfTheLightAddUp) {
  ARETE_NEEDS_OPENGL(probe);
  const auto level = [&](bool sun, bool sky, bool head) {
    ViewSettings settings = shown(true);
    settings.look.surface.hasSun = sun;
    settings.look.surface.hasSky = sky;
    settings.look.surface.hasHeadlight = head;
    draw(square(Material{.name = "m", .baseColor = {0.8, 0.8, 0.8, 1}}), settings);
    return toLinear(middle().g);
  };
  const double sun = level(true, false, false), sky = level(false, true, false),
               head = level(false, false, true), all = level(true, true, true);
  EXPECT_GT(sun, 0.5);
  EXPECT_GT(sky, 0.05);
  EXPECT_GT(head, 0.05);
  EXPECT_NEAR(sun + sky + head, all, 0.01);
  EXPECT_EQ(level(false, false, false), 0);
}

TEST_F(SurfaceLooks, FlatShadingTakesTheTrianglesAndStatedNormalsThoseOfTheFile) {
  ARETE_NEEDS_OPENGL(probe);
  // The file says that the flat square faces the south-east of the sky.
  SurfaceMesh mesh = square(Material{.name = "m", .baseColor = {0.8, 0.8, 0.8, 1}});
  Attribute normals;
  normals.name = kNormalName;
  normals.meaning = AttributeMeaning::normal;
  normals.components = 3;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) normals.append(std::vector<double>{0.6, 0, 0.8});
  mesh.vertexAttributes.push_back(normals);
  ViewSettings settings = shown(true);
  settings.look.surface.hasSky = settings.look.surface.hasHeadlight = false;
  draw(mesh, settings);
  EXPECT_NEAR(middle().g, toSrgb(0.8 * 0.74 * 0.8), 3);
  for (const SurfaceShading shading : {SurfaceShading::smooth, SurfaceShading::flat}) {
    settings.look.surface.shading = shading;
    draw(mesh, settings);
    EXPECT_NEAR(middle().g, toSrgb(0.8 * 0.74), 3);
  }
}

TEST_F(SurfaceLooks, TheInsideIsDarkOrAsTheOutsideOrNotThere) {
  ARETE_NEEDS_OPENGL(probe);
  const SurfaceMesh mesh = square(Material{.name = "m", .baseColor = {1, 0, 0, 1}});
  ViewSettings settings = shown(false);
  draw(mesh, settings, true);
  EXPECT_TRUE(isShown);
  EXPECT_LT(middle().r, 180);
  settings.look.surface.sides = SurfaceSides::both;
  draw(mesh, settings, true);
  expect(middle(), 255, 0, 0);
  settings.look.surface.sides = SurfaceSides::front;
  draw(mesh, settings, true);
  EXPECT_FALSE(isShown);
  EXPECT_GT(middle().b, 150);
  draw(mesh, settings);
  expect(middle(), 255, 0, 0);
}

TEST_F(SurfaceLooks, WhatIsBlendedIsSeenThroughEachOtherFromBackToFront) {
  ARETE_NEEDS_OPENGL(probe);
  // Panes of two materials one over the other; their colours stand in one order in the file, and the other
  // way round in space, and nothing solid is behind them.
  for (const bool isRedAbove : {false, true}) {
    SurfaceMesh mesh =
        square(Material{.name = "m", .baseColor = {1, 0, 0, 0.5}, .alphaMode = "BLEND"}, isRedAbove ? 1 : 0);
    const SurfaceMesh other = square({}, isRedAbove ? 0 : 1);
    const auto shift = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (auto t : other.triangles) {
      for (std::uint32_t& v : t) v += shift;
      mesh.triangles.push_back(t);
      mesh.materialOf.push_back(1);
    }
    mesh.materials.push_back(Material{.name = "m", .baseColor = {0, 0, 1, 0.5}, .alphaMode = "BLEND"});
    draw(mesh, shown(false));
    EXPECT_TRUE(isShown);
    const Rgb behind = image.at(2, 80);
    const double red = 0.25 * behind.r, blue = 0.25 * behind.b;
    expect(middle(), red + (isRedAbove ? 127.5 : 63.75), 0.25 * behind.g, blue + (isRedAbove ? 63.75 : 127.5),
           4);
  }
}

TEST_F(SurfaceLooks, ABlendedPictureHasNoDarkBorder) {
  ARETE_NEEDS_OPENGL(probe);
  // White beside black that is not seen: half-way there is half of white, and never grey.
  SurfaceMesh mesh = square(Material{.name = "m", .alphaMode = "BLEND"});
  addCoords(mesh);
  addPicture(mesh, "baseColor", tinyPng(2, {{255, 255, 255, 255}, {0, 0, 0, 0}}));
  draw(mesh, shown(false));
  const Rgb behind = image.at(2, 80);
  for (int x = 40; x < 120; ++x) EXPECT_GE(int(image.at(x, 80).r), int(behind.r) - 3) << x;
}

/// The highlight of a surface that is seen straight (GGX, Smith's shadows with the height, Schlick), and what
/// all directions together throw back of it, by a sum.
struct Highlight {
  double a2 = 1;
  explicit Highlight(double roughness) : a2(std::pow(roughness, 4)) {}
  double of(double lightAngle) const {  // without Fresnel, times the cosine
    const double nl = std::cos(lightAngle), nh = std::cos(lightAngle / 2), d = nh * nh * (a2 - 1) + 1;
    return a2 / (std::numbers::pi * d * d) * 0.5 / (nl + std::sqrt(nl * nl * (1 - a2) + a2)) * nl;
  }
  double all() const {
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double angle = (i + 0.5) / kSteps * std::numbers::pi / 2;
      sum += of(angle) * std::sin(angle) * std::numbers::pi / 2 / kSteps;
    }
    return 2 * std::numbers::pi * sum;
  }
};

TEST_F(SurfaceLooks, MetalAndRoughnessAreInBlueAndGreen) {
  ARETE_NEEDS_OPENGL(probe);
  const double base = 0.6, elevation = 50;
  const auto level = [&](std::array<int, 4> color) {
    SurfaceMesh mesh =
        square(Material{.name = "m", .baseColor = {base, base, base, 1}, .verbatim = {{"gltf", "{}"}}});
    addCoords(mesh);
    addPicture(mesh, "metallicRoughness", oneColor(color));
    ViewSettings settings = shown(true);
    settings.look.surface.hasSky = settings.look.surface.hasHeadlight = false;
    settings.look.sun = Sun{90, elevation};
    draw(mesh, settings);
    return toLinear(middle().g);
  };
  const double angle = (90 - elevation) * std::numbers::pi / 180;
  for (const int green : {102, 153, 255}) {
    SCOPED_TRACE(green);
    const Highlight bright(green / 255.0);
    const double mirrored = base + (1 - base) * std::pow(1 - std::cos(angle / 2), 5);
    const double again = 1 + base * (1 / bright.all() - 1);
    EXPECT_NEAR(level({0, green, 255, 255}), 0.74 * std::numbers::pi * bright.of(angle) * mirrored * again,
                0.02);
  }
  // Anything but metal has nearly all of its matt colour, whatever red says.
  EXPECT_NEAR(level({255, 255, 0, 255}), 0.74 * std::cos(angle) * base, 0.03);
}

TEST_F(SurfaceLooks, AWhiteMetalThrowsBackAllLightThatFallsOnIt) {
  ARETE_NEEDS_OPENGL(probe);
  // What the eye sees of a light that moves over the whole sky adds up to the light (a white furnace).
  for (const double roughness : {0.8, 1.0}) {
    double sum = 0;
    constexpr int kSteps = 9;
    for (int i = 0; i < kSteps; ++i) {
      const double elevation = (i + 0.5) * 90 / kSteps;
      ViewSettings settings = shown(true);
      settings.look.surface.hasSky = settings.look.surface.hasHeadlight = false;
      settings.look.sun = Sun{0, elevation};
      draw(square(Material{.name = "m",
                           .verbatim = {{"gltf", R"({"pbrMetallicRoughness":{"roughnessFactor":)" +
                                                     std::to_string(roughness) + "}}"}}}),
           settings);
      sum += toLinear(middle().g) * std::cos(elevation * std::numbers::pi / 180);
    }
    const double thrown =
        2 * std::numbers::pi * sum * std::numbers::pi / 2 / kSteps / (std::numbers::pi * 0.74);
    EXPECT_NEAR(thrown, 1, 0.06) << roughness;
  }
}

TEST_F(SurfaceLooks, APictureOfNormalsRunsAlongUAndAgainstV) {
  ARETE_NEEDS_OPENGL(probe);
  // Slopes of 3 : 4 that face the east (red), the north (green), the west and the south.
  const std::array<std::array<int, 4>, 4> slopes{
      {{204, 128, 230, 255}, {128, 204, 230, 255}, {51, 128, 230, 255}, {128, 51, 230, 255}}};
  for (std::size_t slope = 0; slope < 4; ++slope)
    for (const bool isMirrored : {false, true}) {
      SurfaceMesh mesh = square(Material{.name = "m", .baseColor = {0.8, 0.8, 0.8, 1}});
      addCoords(mesh, isMirrored ? -1 : 1);
      addPicture(mesh, "normal", oneColor(slopes[slope]));
      ViewSettings settings = shown(true);
      settings.look.surface.hasSky = settings.look.surface.hasHeadlight = false;
      for (std::size_t side = 0; side < 4; ++side) {
        SCOPED_TRACE(std::to_string(slope) + (isMirrored ? " mirrored " : " ") + std::to_string(side));
        const double azimuth = 90 - 90.0 * double(side);
        settings.look.sun = Sun{azimuth, 45};
        draw(mesh, settings);
        const std::size_t faces = isMirrored ? (slope + 2) % 4 : slope;
        const double along = faces == side ? 1 : (faces + 2) % 4 == side ? -1 : 0;
        const double cosine = (0.6 * along + 0.8) * std::numbers::sqrt2 / 2;
        EXPECT_NEAR(middle().g, toSrgb(0.8 * 0.74 * cosine), 6);
      }
    }
}

TEST_F(SurfaceLooks, WhatGlowsDoesSoWithoutLightAndByItsStrength) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceMesh mesh = square(
      Material{.name = "m",
               .baseColor = {0, 0, 0, 1},
               .verbatim = {{"gltf", R"({"emissiveFactor":[0.1,0.2,0],"extensions":{)"
                                     R"("KHR_materials_emissive_strength":{"emissiveStrength":2.5}}})"}}});
  ViewSettings settings = shown(true);
  settings.look.surface.hasSun = settings.look.surface.hasSky = settings.look.surface.hasHeadlight = false;
  draw(mesh, settings);
  expect(middle(), toSrgb(0.25), toSrgb(0.5), 0);
  addCoords(mesh);
  addPicture(mesh, "emissive", oneColor({255, 128, 255, 255}));
  draw(mesh, settings);
  expect(middle(), toSrgb(0.25), toSrgb(0.5 * toLinear(128)), 0);
  settings.look.surface.hasTextures = false;
  draw(mesh, settings);
  expect(middle(), 0, 0, 0);
}

TEST_F(SurfaceLooks, OcclusionIsInRedAndDarkensTheSkyAlone) {
  ARETE_NEEDS_OPENGL(probe);
  const auto level = [&](bool hasPicture, bool hasSky) {
    SurfaceMesh mesh = square(Material{.name = "m", .baseColor = {0.8, 0.8, 0.8, 1}});
    addCoords(mesh);
    if (hasPicture) addPicture(mesh, "occlusion", oneColor({128, 255, 255, 255}));
    ViewSettings settings = shown(true);
    settings.look.surface.hasSky = hasSky;
    settings.look.surface.hasSun = !hasSky;
    settings.look.surface.hasHeadlight = false;
    draw(mesh, settings);
    return toLinear(middle().g);
  };
  EXPECT_NEAR(level(true, true), 128.0 / 255 * level(false, true), 0.005);
  EXPECT_NEAR(level(true, false), level(false, false), 0.001);
}

TEST_F(SurfaceLooks, ASamplerWrapsMirrorsOrClampsAndATransformPlacesThePicture) {
  ARETE_NEEDS_OPENGL(probe);
  // Coordinates from 0 to 2, so that the right half of the square is beyond the picture of red and green.
  const auto right = [&](const std::string& use) {
    SurfaceMesh mesh = square(Material{.name = "m", .verbatim = {{"gltf:baseColor", use}}});
    addCoords(mesh, 2);
    addPicture(mesh, "baseColor", tinyPng(2, {{255, 0, 0, 255}, {0, 255, 0, 255}}));
    draw(mesh, shown(false));
    return image.at(92, 80).g > 128;  // u is somewhat above 1
  };
  EXPECT_FALSE(right(R"({"sampler":{"magFilter":9728}})"));
  EXPECT_TRUE(right(R"({"sampler":{"magFilter":9728,"wrapS":33648}})"));
  EXPECT_TRUE(right(R"({"sampler":{"magFilter":9728,"wrapS":33071}})"));
  EXPECT_FALSE(right(R"({"sampler":{"magFilter":9728,"wrapS":33071,"wrapT":33071},)"
                     R"("extensions":{"KHR_texture_transform":{"scale":[0.3,1]}}})"));
  EXPECT_TRUE(right(R"({"sampler":{"magFilter":9728},)"
                    R"("extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}})"));
}

// Two charts beside each other, the one white and the other black in the file.
TEST_F(SurfaceLooks, AnInkColoursTheDrawnTrianglesWhateverTheirMaterials) {
  ARETE_NEEDS_OPENGL(probe);
  SurfaceMesh mesh = square(Material{.name = "left"});
  mesh.materials.push_back(Material{.name = "right"});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double x = 0;
    for (const std::uint32_t v : mesh.triangles[t]) x += mesh.positions[v].x / 3;
    mesh.materialOf[t] = x > 4 ? 1 : 0;
  }
  addPicture(mesh, "baseColor", oneColor({255, 0, 0, 255}));
  ViewSettings settings = shown(false);
  settings.look.coloring = Coloring::ink;
  settings.look.ink = "charts";
  draw(mesh, settings);
  const Rgb left = image.at(60, 80), right = image.at(100, 80);
  const auto table = classColors();
  EXPECT_TRUE((left == table[0] && right == table[1]) || (left == table[1] && right == table[0]));
}

TEST_F(SurfaceLooks, AMaskCutsAndTheAlphaOfWhatIsOpaqueDoesNotCount) {
  ARETE_NEEDS_OPENGL(probe);
  for (const auto& [mode, alpha, isThere] :
       {std::tuple{"MASK", 120, false}, std::tuple{"MASK", 135, true}, std::tuple{"OPAQUE", 0, true}}) {
    SCOPED_TRACE(std::string(mode) + " " + std::to_string(alpha));
    SurfaceMesh mesh = square(Material{.name = "m", .alphaMode = mode});
    addCoords(mesh);
    addPicture(mesh, "baseColor", oneColor({255, 0, 0, alpha}));
    draw(mesh, shown(false));
    EXPECT_EQ(isShown, isThere);
    if (isThere) expect(middle(), 255, 0, 0);
  }
}

}  // namespace
}  // namespace arete
