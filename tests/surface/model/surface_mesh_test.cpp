// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/surface_mesh.h"

#include <gtest/gtest.h>

#include <functional>

#include "surface/shapes.h"

namespace arete {
namespace {

TEST(SurfaceMesh, ValidatesEveryIndexAndSize) {
  SurfaceMesh good;
  good.shape() = shapes::tetrahedron();
  good.wedgeCount = 4;
  good.wedges.assign(good.triangles.begin(), good.triangles.end());
  Attribute u{.name = "u", .type = ScalarType::float32};
  for (int i = 0; i < 4; ++i) u.append(std::vector<double>{1});
  good.wedgeAttributes = good.vertexAttributes = good.triangleAttributes = {u};
  good.objects = {"one"};
  good.objectOf = {0, 0, SurfaceMesh::kNone, 0};
  ASSERT_TRUE(good.validate()) << good.validate().error().message;

  struct Case {
    const char* what;
    std::function<void(SurfaceMesh&)> spoil;
  };
  for (const Case& c : {
           Case{"a corner too high", [](SurfaceMesh& m) { m.triangles[0][0] = 4; }},
           Case{"a wedge too high", [](SurfaceMesh& m) { m.wedges[3][2] = 4; }},
           Case{"a triangle without wedges", [](SurfaceMesh& m) { m.wedges.pop_back(); }},
           Case{"no wedges but attributes of them", [](SurfaceMesh& m) { m.wedges.clear(); }},
           Case{"a vertex attribute too short",
                [](SurfaceMesh& m) { m.vertexAttributes[0].values.pop_back(); }},
           Case{"a triangle attribute too long",
                [](SurfaceMesh& m) { m.triangleAttributes[0].append(std::vector<double>{1}); }},
           Case{"two attributes of a name", [&](SurfaceMesh& m) { m.vertexAttributes.push_back(u); }},
           Case{"an object too high", [](SurfaceMesh& m) { m.objectOf[1] = 1; }},
           Case{"a material of none",
                [](SurfaceMesh& m) {
                  m.materialOf = {0, 0, 0, 0};
                }},
           Case{"faces of too few", [](SurfaceMesh& m) { m.faceOf = {0}; }},
       }) {
    SurfaceMesh spoiled = good;
    c.spoil(spoiled);
    EXPECT_FALSE(spoiled.validate()) << c.what;
  }
}

}  // namespace
}  // namespace arete
