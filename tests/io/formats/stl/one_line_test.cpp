// SPDX-License-Identifier: GPL-3.0-or-later
//
// ASCII STL whose lines are not where the format has them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/formats/stl/stl.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

class StlLines : public MeshFileTest {};

std::string facet(int x, const std::string& normal = "normal 0 0 1 ") {
  const std::string at = std::to_string(x);
  return "facet " + normal + "outer loop vertex " + at + " 0 0 vertex " + at + ".5 0 0 vertex " + at +
         " 1 0 endloop endfacet ";
}

TEST_F(StlLines, AWholeFileMayBeOneLine) {
  struct Case {
    std::string text;
    std::vector<std::string> objects;
    std::vector<std::uint32_t> objectOf;
  };
  const std::string f = facet(1), g = facet(2);
  const std::vector<Case> cases = {
      {"solid part " + f + g + "endsolid part", {"part"}, {0, 0}},
      {"solid " + f + "endsolid", {}, {}},
      {"solid " + f + g + "endsolid\n", {}, {}},
      {"solid two words " + f + "endsolid two words", {"two words"}, {0}},
      {"solid a " + f + "endsolid a solid b " + g + "endsolid b", {"a", "b"}, {0, 1}},
      {"solid a " + f + "endsolid solid b " + g + "endsolid", {"a", "b"}, {0, 1}},
      {"solid a " + f + "end solid a solid b " + g + "end solid b", {"a", "b"}, {0, 1}},
      {"solid a " + f + "endsolid a solid b\n" + g + "\nendsolid b", {"a", "b"}, {0, 1}},
      {"SOLID A " + f + "ENDSOLID A", {"A"}, {0}},
      {"solid a " + facet(1, "") + "endsolid a", {"a"}, {0}},
      {"solid a " + facet(1, "normal nan nan nan ") + "endsolid a", {"a"}, {0}},
      {"solid a " + facet(1, "normal 0 0 -nan(ind) ") + "endsolid a", {"a"}, {0}},
      {"solid a endsolid a solid b " + f + "endsolid b", {"a", "b"}, {1}},
      {"solid a\t" + f + "endsolid a", {"a"}, {0}},
      // Names that have words of the format, on lines of their own.
      {"solid facet\n" + f + "endsolid facet\n", {"facet"}, {0}},
      {"solid my solid\n" + f + "\nendsolid my solid\n", {"my solid"}, {0}},
      {"solid facet normal\n" + f + "\nendsolid facet normal\n", {"facet normal"}, {0}},
      {"solid a\n" + f + "\nendsolid a\nsolid b\n" + g + "\nendsolid b\n", {"a", "b"}, {0, 1}},
      {"solid a\nfacet normal 0 0 1 outer loop\nvertex 1 0 0 vertex 1.5 0 0\nvertex 1 1 0 endloop "
       "endfacet\nendsolid",
       {"a"},
       {0}},
      {"solid a\nfacet\nouter loop\nvertex 1 0 0\nvertex 1.5 0 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid "
       "a\n",
       {"a"},
       {0}},
  };
  for (const Case& c : cases) {
    const Result<MeshFile> file = readStl(put("a.stl", c.text));
    ASSERT_TRUE(file) << c.text << '\n' << file.error().describe();
    EXPECT_EQ(file->mesh.objects, c.objects) << c.text;
    EXPECT_EQ(file->mesh.objectOf, c.objectOf) << c.text;
    const auto& p = file->mesh.positions;
    ASSERT_GE(p.size(), 3u) << c.text;
    EXPECT_TRUE(p[1].x == 1.5 || p[1].x == 2.5) << c.text;
  }
}

TEST_F(StlLines, AMillionCharactersOfOneLineTakeNoTimeSquared) {
  std::string text = "solid a ";
  for (int i = 0; i < 10'000; ++i) text += facet(i);
  const Result<MeshFile> file = readStl(put("a.stl", text + "endsolid a"));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->mesh.triangles.size(), 10'000u);
}

TEST_F(StlLines, WhatIsCutOffIsRefused) {
  const std::string text = "solid a " + facet(1) + "endsolid a";
  for (const std::size_t size : {20u, 40u, 60u, 80u, 100u})
    EXPECT_FALSE(readStl(put("a.stl", text.substr(0, size)))) << size;
}

}  // namespace
}  // namespace arete
