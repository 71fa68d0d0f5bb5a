// SPDX-License-Identifier: GPL-3.0-or-later
//
// What formats make of objects, groups, materials, texture coordinates and names, by readers of the test's
// own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "io/formats/exchange/grouped_faces.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

constexpr std::uint32_t kNone = MeshAttributes::kNone;

class Parts : public MeshFileTest {};

/// Triangles that share no vertex, of random parts.
SurfaceMesh scattered(std::uint32_t seed, std::uint32_t triangles, std::uint32_t objects,
                      std::uint32_t groups, std::uint32_t materials) {
  std::mt19937 random(seed);
  SurfaceMesh mesh;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {0., 1.}})
      mesh.positions.push_back({x + t, y, double(t)});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const auto fill = [&](std::uint32_t count, std::vector<std::uint32_t>& of) {
    if (count == 0) return;
    for (std::uint32_t t = 0; t < triangles; ++t) {
      const std::uint32_t part = random() % (count + 1);
      of.push_back(part == count ? kNone : part);
    }
  };
  for (std::uint32_t i = 0; i < objects; ++i) mesh.objects.push_back("o" + std::to_string(i));
  for (std::uint32_t i = 0; i < groups; ++i) mesh.groups.push_back("g" + std::to_string(i));
  for (std::uint32_t i = 0; i < materials; ++i) mesh.materials.push_back({.name = "m" + std::to_string(i)});
  fill(objects, mesh.objectOf);
  fill(groups, mesh.groupOf);
  fill(materials, mesh.materialOf);
  return mesh;
}

using Named = std::tuple<std::string, std::string, std::string, double>;  // object, group, material, z

TEST_F(Parts, EachObjectOfAnObjIsOneRunWithItsGroupsAndMaterials) {
  for (std::uint32_t seed = 1; seed <= 24; ++seed) {
    const SurfaceMesh mesh = scattered(seed, 40, 1 + seed % 4, seed % 3, seed % 5);
    const Result<MeshWriteReport> report = writeMesh(mesh, folder_ / "a.obj", {.up = MeshUp::unknown});
    ASSERT_TRUE(report) << report.error().describe();
    for (const std::string& lost : report->lost)
      EXPECT_EQ(lost.find("objects whose"), std::string::npos) << "seed " << seed;
    std::istringstream file(contents(folder_ / "a.obj"));
    std::string object, group, material, line;
    std::vector<std::array<double, 3>> vertices;
    std::multiset<Named> found, wanted;
    std::map<std::string, int> statements;
    std::vector<double> heights;
    while (std::getline(file, line)) {
      std::istringstream words(line);
      std::string word, name;
      words >> word;
      if (word == "v") {
        std::array<double, 3> p{};
        words >> p[0] >> p[1] >> p[2];
        vertices.push_back(p);
      } else if (word == "f") {
        std::size_t first = 0;
        words >> first;
        heights.push_back(vertices[first - 1][2]);
        found.emplace(object, group, material, heights.back());
      } else if (word == "o" || word == "g" || word == "usemtl") {
        words >> name;
        (word == "o" ? object : word == "g" ? group : material) = name;
        if (word == "o") ++statements[name];
      }
    }
    const auto nameOf = [](const auto& of, std::size_t t, const char* letter) {
      return of.empty() || of[t] == kNone ? std::string() : letter + std::to_string(of[t]);
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      wanted.emplace(nameOf(mesh.objectOf, t, "o"), nameOf(mesh.groupOf, t, "g"),
                     nameOf(mesh.materialOf, t, "m"), double(t));
    EXPECT_EQ(found, wanted) << "seed " << seed;
    for (const auto& [name, count] : statements) EXPECT_EQ(count, 1) << name << ", seed " << seed;
    // The order that maps are told is that of the file.
    std::vector<std::uint32_t> order = trianglesOfFile(mesh, *meshFormatOf("a.obj"));
    for (std::size_t t = 0; t < heights.size(); ++t)
      EXPECT_EQ(heights[t], double(order.empty() ? t : order[t])) << "seed " << seed;
  }
}

TEST_F(Parts, EachObjectOfAnStlIsOneSolid) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const SurfaceMesh mesh = scattered(seed, 30, 2 + seed % 4, 0, 0);
    ASSERT_TRUE(writeMesh(mesh, folder_ / "a.stl", {.up = MeshUp::unknown}));
    std::istringstream file(contents(folder_ / "a.stl"));
    std::string line, solid;
    std::map<std::string, std::multiset<double>> found, wanted;
    std::set<std::string> seen;
    while (std::getline(file, line)) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "solid") {
        solid.clear();
        words >> solid;
        EXPECT_TRUE(seen.insert(solid).second) << solid << ", seed " << seed;
      }
      double x = 0, y = 0, z = 0;
      if (word == "vertex" && words >> x >> y >> z) found[solid].insert(z);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        wanted[mesh.objectOf[t] == kNone ? "" : "o" + std::to_string(mesh.objectOf[t])].insert(double(t));
    EXPECT_EQ(found, wanted) << "seed " << seed;
  }
}

TEST_F(Parts, FacesThatAreInRunsKeepTheirOrder) {
  SurfaceMesh mesh = scattered(1, 6, 2, 0, 3);
  mesh.objectOf = {1, 1, 1, 0, 0, 0};
  mesh.materialOf = {2, 2, 0, 1, 0, 0};
  EXPECT_TRUE(groupedFaces(mesh).empty());
  mesh.materialOf = {2, 0, 2, 1, 0, 0};
  EXPECT_EQ(groupedFaces(mesh), (std::vector<std::uint32_t>{4, 5, 3, 1, 0, 2}));
}

/// A square of two triangles, whose set k has (10 k + corner, k).
SurfaceMesh withSets(std::uint32_t sets, std::uint32_t first, std::uint32_t second) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t k = 0; k < sets; ++k) {
    Attribute uv{.name = k == 0 ? "texcoord" : "texcoord" + std::to_string(k),
                 .meaning = AttributeMeaning::textureCoords,
                 .components = 2};
    for (int corner = 0; corner < 4; ++corner) uv.append(std::array{10.0 * k + corner, double(k)});
    mesh.vertexAttributes.push_back(std::move(uv));
  }
  mesh.materials = {{.name = "a", .textures = {{"baseColor", "a.png", first}}},
                    {.name = "b", .textures = {{"baseColor", "b.png", second}}}};
  mesh.materialOf = {0, 1};
  return mesh;
}

TEST_F(Parts, ObjHasTheTextureCoordinatesOfTheBaseColorFaceByFace) {
  for (const std::uint32_t first : {0u, 1u, 2u})
    for (const std::uint32_t second : {0u, 1u, 2u}) {
      const SurfaceMesh mesh = withSets(3, first, second);
      ASSERT_TRUE(writeMesh(mesh, folder_ / "a.obj", {.up = MeshUp::unknown}));
      std::istringstream file(contents(folder_ / "a.obj"));
      std::string line;
      std::vector<std::array<double, 2>> coords;
      std::vector<std::array<double, 2>> corners;
      while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        std::array<double, 2> uv{};
        if (word == "vt" && words >> uv[0] >> uv[1]) coords.push_back(uv);
        if (word != "f") continue;
        for (std::string corner; words >> corner;)
          corners.push_back(coords.at(std::stoul(corner.substr(corner.find('/') + 1)) - 1));
      }
      ASSERT_EQ(corners.size(), 6u);
      const std::array<int, 6> vertices{0, 1, 2, 0, 2, 3};
      for (std::size_t c = 0; c < 6; ++c) {
        const std::uint32_t set = c < 3 ? first : second;
        EXPECT_EQ(corners[c], (std::array{10.0 * set + vertices[c], double(set)})) << first << ' ' << second;
      }
    }
}

TEST_F(Parts, OffAndPlyHaveTheCoordinatesOfTheOnlySetThatIsUsed) {
  for (const char* name : {"a.off", "a.ply"}) {
    ASSERT_TRUE(writeMesh(withSets(2, 1, 1), folder_ / name, {.up = MeshUp::unknown}));
    const Result<MeshFile> file = readMesh(folder_ / name);
    ASSERT_TRUE(file) << name;
    const auto& attributes = file->mesh.vertexAttributes;
    const auto uv = std::ranges::find(attributes, "texcoord", &Attribute::name);
    ASSERT_NE(uv, attributes.end()) << name;
    EXPECT_EQ(uv->numbers(2), (std::vector<double>{12, 1})) << name;
  }
}

TEST_F(Parts, GlbHasTheShiftAndScaleOfAnMtl) {
  struct Case {
    const char* options;
    std::array<double, 2> scale, offset;  // of an MTL, v from below
  };
  const std::vector<Case> cases = {
      {"-s 2 2 1 -o 0.5 0 0", {2, 2}, {0.5, 0}},
      {"-o 0.5 0.25 0 -s 2 3 1", {2, 3}, {0.5, 0.25}},
      {"-s 4", {4, 1}, {0, 0}},
      {"-s 4 5", {4, 5}, {0, 0}},
      {"-o 0.125", {1, 1}, {0.125, 0}},
      {"-o 0 0.5", {1, 1}, {0, 0.5}},
      {"-o -0.5 -0.25 0", {1, 1}, {-0.5, -0.25}},
      {"-s -1 1 1", {-1, 1}, {0, 0}},
      {"-s 1 -1 1", {1, -1}, {0, 0}},
      {"-blendu on -s 2 2 1", {2, 2}, {0, 0}},
      {"-s 0.5 0.5 0.5 -clamp off", {0.5, 0.5}, {0, 0}},
      {"-s 1e1 .5 1", {10, 0.5}, {0, 0}},
      {"-mm 0 1 -s 3 3 3", {3, 3}, {0, 0}},
      {"-s 1 1 1 -o 1 1 1", {1, 1}, {1, 1}},
  };
  put("p.png", std::string("\x89PNG\r\n\x1A\n", 8));
  for (const Case& c : cases) {
    put("a.mtl", std::string("newmtl a\nmap_Kd ") + c.options + " p.png\n");
    const fs::path obj = put("a.obj",
                             "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.1 0.2\nvt 0.9 0.3\nvt 0.4 0.8\n"
                             "usemtl a\nf 1/1 2/2 3/3\n");
    Result<MeshFile> file = readMesh(obj);
    ASSERT_TRUE(file);
    const auto report =
        writeMesh(file->mesh, folder_ / "a.gltf", {.up = MeshUp::unknown, .pictureFolder = folder_});
    ASSERT_TRUE(report) << report.error().describe();
    for (const std::string& lost : report->lost) EXPECT_EQ(lost.find("options"), std::string::npos) << lost;
    const auto json = nlohmann::json::parse(contents(folder_ / "a.gltf"));
    const auto& texture = json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    ASSERT_TRUE(texture.contains("extensions")) << c.options;
    const auto& transform = texture["extensions"]["KHR_texture_transform"];
    const std::array<double, 2> offset = transform.value("offset", std::array{0.0, 0.0}),
                                scale = transform.value("scale", std::array{1.0, 1.0});
    for (const auto& [u, v] : {std::pair{0.1, 0.2}, {0.9, 0.3}, {0.4, 0.8}}) {
      // glTF: v from above.
      EXPECT_NEAR(u * scale[0] + offset[0], u * c.scale[0] + c.offset[0], 1e-12) << c.options;
      EXPECT_NEAR(1 - ((1 - v) * scale[1] + offset[1]), v * c.scale[1] + c.offset[1], 1e-12) << c.options;
    }
    // PLY has no options: the coordinates are where they say.
    ASSERT_TRUE(writeMesh(file->mesh, folder_ / "a.ply", {.up = MeshUp::unknown, .pictureFolder = folder_}));
    const Result<MeshFile> ply = readMesh(folder_ / "a.ply");
    ASSERT_TRUE(ply && ply->mesh.vertexAttributes.size() + ply->mesh.wedgeAttributes.size() == 1)
        << c.options;
    const Attribute& uv =
        ply->mesh.hasWedges() ? ply->mesh.wedgeAttributes[0] : ply->mesh.vertexAttributes[0];
    const auto first = uv.numbers(ply->mesh.hasWedges() ? ply->mesh.wedges[0][0] : ply->mesh.triangles[0][0]);
    EXPECT_NEAR(first[0], 0.1 * c.scale[0] + c.offset[0], 1e-6) << c.options;
    EXPECT_NEAR(first[1], 0.2 * c.scale[1] + c.offset[1], 1e-6) << c.options;
  }
}

TEST_F(Parts, TrianglesThatFloatsFlattenAreCounted) {
  // Of width w at x = far: a float32 at 2^24 has steps of 2.
  for (const double far : {0.0, 1e3, 16777216.0, 1e8})
    for (const double width : {1.0, 0.25, 1e-3}) {
      SurfaceMesh mesh;
      mesh.positions = {{far, 0, 0}, {far + width, 0, 0}, {far, 1, 0}, {0, 0, 0},
                        {1, 0, 0},   {0, 1, 0},           {2, 0, 0}};
      mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 4, 6}};  // the last has no area before
      const bool isFlat = static_cast<float>(far) == static_cast<float>(far + width);
      for (const char* name : {"a.stl", "a.glb"}) {
        const auto report = writeMesh(mesh, folder_ / name, {.origin = Vec3{}, .up = MeshUp::unknown});
        ASSERT_TRUE(report) << report.error().describe();
        const bool isCounted = std::ranges::any_of(report->lost, [](const std::string& lost) {
          return lost == "1 triangle, which has no area in 32-bit floats";
        });
        EXPECT_EQ(isCounted, isFlat) << name << ' ' << far << ' ' << width;
      }
    }
}

TEST_F(Parts, NamesInLatin1BecomeUtf8) {
  const std::string latin1 = "B\xE4r", utf8 = "B\xC3\xA4r";
  put("a.mtl", "newmtl " + latin1 + "\nKd 1 0 0\n");
  put("b.mtl", "newmtl " + utf8 + "\nKd 1 0 0\n");
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const std::string library : {"a.mtl", "b.mtl"})
    for (const std::string& name : {latin1, utf8}) {
      const Result<MeshFile> file =
          readMesh(put("a.obj", "mtllib " + library + "\n" + triangle + "o " + name + "\ng " + name +
                                    "\nusemtl " + name + "\nf 1 2 3\n"));
      ASSERT_TRUE(file);
      EXPECT_EQ(file->mesh.objects, std::vector<std::string>{utf8});
      EXPECT_EQ(file->mesh.groups, std::vector<std::string>{utf8});
      ASSERT_EQ(file->mesh.materials.size(), 1u);
      EXPECT_EQ(file->mesh.materials[0].name, utf8);
      EXPECT_EQ(file->mesh.materials[0].baseColor[1], 0) << "it is that of the library";
    }
  const Result<MeshFile> ply = readMesh(
      put("a.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "property float " +
              latin1 +
              "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "0 0 0 0.5\n1 0 0 0.5\n0 1 0 0.5\n3 0 1 2\n"));
  ASSERT_TRUE(ply);
  EXPECT_EQ(ply->mesh.vertexAttributes[0].name, utf8);
  const Result<MeshFile> stl =
      readMesh(put("a.stl", "solid " + latin1 +
                                "\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                "endloop\nendfacet\nendsolid\n"));
  ASSERT_TRUE(stl);
  EXPECT_EQ(stl->mesh.objects, std::vector<std::string>{utf8});
  const Result<MeshFile> gltf = readMesh(put(
      "a.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":")" +
          latin1 +
          R"( \"x\""}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
          R"("componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
          R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
          R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})"));
  ASSERT_TRUE(gltf) << gltf.error().describe();
  EXPECT_EQ(gltf->mesh.objects, std::vector<std::string>{utf8 + " \"x\""});
}

TEST_F(Parts, PlyIsOfFloatsWhereTheseAreExact) {
  for (const double odd : {0.5, 0.1}) {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, -0.0}, {0, odd, 0}};
    mesh.triangles = {{0, 1, 2}};
    ASSERT_TRUE(writeMesh(mesh, folder_ / "a.ply", {.up = MeshUp::unknown}));
    const bool isFloat = contents(folder_ / "a.ply").find("property float x") != std::string::npos;
    EXPECT_EQ(isFloat, odd == 0.5);
    const Result<MeshFile> file = readMesh(folder_ / "a.ply");
    ASSERT_TRUE(file);
    EXPECT_EQ(file->mesh.positions, mesh.positions);
    EXPECT_TRUE(std::signbit(file->mesh.positions[1].z));
  }
}

}  // namespace
}  // namespace arete
