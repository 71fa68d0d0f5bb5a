// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same faces through every format that has polygons.
#include "io/formats/common/faces.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using MeshFacesTest = MeshFileTest;

struct Faces {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces;  // from 0
};

/// A tower: triangles, quadrangles that are not convex, an L, and a wall with a window joined by a bridge.
const Faces kTower = {
    {{0, 0, 0},
     {2, 0, 0},
     {2, 1, 0},
     {1, 1, 0},
     {1, 2, 0},
     {0, 2, 0},  // an L
     {0, 0, 5},
     {3, 1, 5},
     {6, 0, 5},
     {3, 5, 5},  // an arrowhead
     {0, 9, 0},
     {4, 9, 0},
     {4, 9, 4},
     {0, 9, 4},  // a wall
     {1, 9, 1},
     {1, 9, 2},
     {2, 9, 2},
     {2, 9, 1}},  // its window
    {{1, 2, 3, 4, 5, 0}, {7, 8, 9, 6}, {10, 14, 15, 16, 17, 14, 10, 11, 12, 13}, {0, 1, 2}}};
constexpr double kAreas[] = {3, 12, 15, 1};
constexpr std::size_t kTriangles[] = {4, 2, 8, 1};

std::string ply(const Faces& faces, bool facesFirst) {
  std::string head = "ply\nformat ascii 1.0\n", vertices, list;
  const std::string vertexElement = fmt::format(
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", faces.vertices.size());
  const std::string faceElement = fmt::format(
      "element face {}\nproperty float error\nproperty list uchar int vertex_indices\n", faces.faces.size());
  for (const Vec3& p : faces.vertices) vertices += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (std::size_t f = 0; f < faces.faces.size(); ++f)
    list += fmt::format("{} {} {}\n", f, faces.faces[f].size(), fmt::join(faces.faces[f], " "));
  return head + (facesFirst ? faceElement + vertexElement : vertexElement + faceElement) + "end_header\n" +
         (facesFirst ? list + vertices : vertices + list);
}

std::string obj(const Faces& faces) {
  std::string vertices, list;
  for (const Vec3& p : faces.vertices) vertices += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& face : faces.faces) {
    list += "f";
    for (const int v : face) list += fmt::format(" {}//1", v + 1);
    list += "\n";
  }
  return list + vertices + "vn 0 0 1\n";  // faces may come first
}

double areaOf(const TriangleMesh& mesh, std::size_t from, std::size_t count) {
  double sum = 0;
  for (std::size_t t = from; t < from + count; ++t) {
    const Vec3 &a = mesh.positions[mesh.triangles[t][0]], &b = mesh.positions[mesh.triangles[t][1]],
               &c = mesh.positions[mesh.triangles[t][2]];
    const Vec3 p{b.x - a.x, b.y - a.y, b.z - a.z}, q{c.x - a.x, c.y - a.y, c.z - a.z};
    sum += std::hypot(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x) / 2;
  }
  return sum;
}

TEST_F(MeshFacesTest, HaveTheirAreaInEveryFormat) {
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.ply", ply(kTower, false)},
                                   {"b.ply", ply(kTower, true)},
                                   {"c.obj", obj(kTower)}}) {
    SCOPED_TRACE(name);
    const Result<MeshFile> file = readMesh(put(name, text));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_TRUE(file->warnings.empty());
    EXPECT_EQ(file->mesh.positions, kTower.vertices);
    std::size_t at = 0;
    for (std::size_t f = 0; f < kTower.faces.size(); at += kTriangles[f++]) {
      ASSERT_LE(at + kTriangles[f], file->mesh.triangles.size());
      EXPECT_NEAR(areaOf(file->mesh, at, kTriangles[f]), kAreas[f], 1e-12) << f;
      for (std::size_t t = at; t < at + kTriangles[f] && !file->triangleErrors.empty(); ++t)
        EXPECT_EQ(file->triangleErrors[t], float(f));
    }
    EXPECT_EQ(at, file->mesh.triangles.size());
  }
  const std::string quads = "MESH2D\nE4Q 1 2 3 4 1 1\nND 1 0 0 5\nND 2 3 1 5\nND 3 6 0 5\nND 4 3 5 5\n";
  const Result<MeshFile> file = readMesh(put("a.2dm", quads));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_NEAR(areaOf(file->mesh, 0, 2), 12, 1e-12);
}

TEST_F(MeshFacesTest, KeepTheirPlaceAndErrorWhereTheirTrianglesAreFewerOrMore) {
  Faces faces = kTower;
  faces.faces = {{0, 1, 2}, {0, 1, 1, 2, 3, 4, 4, 5}, {10, 11, 12, 13}, {0, 1, 2, 1}, {6, 7, 8}};
  const Result<MeshFile> file = readMesh(put("a.ply", ply(faces, false)));
  ASSERT_TRUE(file) << file.error().describe();
  // The face that names vertices twice has no triangle for that; the spike has none at all.
  EXPECT_EQ(file->triangleErrors, (std::vector<float>{0, 1, 1, 1, 1, 2, 2, 4}));
  EXPECT_NEAR(areaOf(file->mesh, 1, 4), 3, 1e-12);
  EXPECT_EQ(file->mesh.triangles.back(), (std::array<std::uint32_t, 3>{6, 7, 8}));
}

TEST_F(MeshFacesTest, AreNamedWhereTheyCrossThemselves) {
  Faces faces = kTower;
  faces.faces = {{0, 1, 2}, {10, 12, 11, 13}, {10, 12, 11, 13}};
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.ply", ply(faces, false)}, {"a.obj", obj(faces)}}) {
    const Result<MeshFile> file = readMesh(put(name, text));
    ASSERT_TRUE(file) << file.error().describe();
    ASSERT_EQ(file->warnings.size(), 1u);
    EXPECT_NE(file->warnings[0].sentence.find("2 of its 3 faces"), std::string::npos)
        << file->warnings[0].sentence;
    EXPECT_NE(file->warnings[0].sentence.find("face 2"), std::string::npos) << file->warnings[0].sentence;
  }
}

}  // namespace
}  // namespace arete
