// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh_fixture.h"

namespace arete::cli_test {
namespace {

using MeshInfo = Meshes;

TEST_F(MeshInfo, BeginsWithAVerdict) {
  write("closed.obj", std::string(kTetrahedron));
  write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("wide.obj", plus(kTetrahedron, "v 0.5 -1 -1\nf 1 2 5\n"));
  write("turned.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n");
  write("twice.obj", plus(kTetrahedron, "f 3 2 1\nf 1 3 2\n"));
  for (const auto& [name, verdict] :
       {std::pair{"closed.obj", "closed.obj: closed manifold, 1 component, genus 0\n"},
        std::pair{"open.obj", "open.obj: manifold, 1 component, genus 0, 1 border\n"},
        std::pair{"wide.obj",
                  "wide.obj: not manifold: 1 edge of more than two faces; 1 component, 1 border\n"},
        std::pair{"turned.obj", "1 edge whose two faces are oriented against each other\n"},
        std::pair{"twice.obj", "2 duplicate faces"}}) {
    const Outcome outcome = run({"mesh", "info", name});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.substr(0, outcome.out.find('\n') + 1).find(verdict), std::string::npos)
        << outcome.out;
  }
  EXPECT_TRUE(says(run({"mesh", "info", "closed.obj"}), "volume      0.166666667\n"));
  EXPECT_FALSE(says(run({"mesh", "info", "open.obj"}), "volume"));
}

TEST_F(MeshInfo, NamesElementsByTheNumbersOfTheFile) {
  // A polygon first, so that triangles and faces have different numbers; a vertex that no face has.
  write("x.obj",
        "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 5\nv 3 0 5\nv 2.5 1 5\nf 2 3 4 5\nf 6 7 8\nf 6 7 "
        "8\n");
  const Outcome text = run({"mesh", "info", "x.obj"});
  EXPECT_TRUE(says(text, "vertices and faces count from 1")) << text.out;
  EXPECT_TRUE(says(text, "faces 2 and 3 at 2.5, 0.333333333, 5")) << text.out;
  EXPECT_TRUE(says(text, "vertex 1 at 9, 9, 9")) << text.out;
  EXPECT_TRUE(says(text, "3 (4 triangles)")) << text.out;
  const Json json = run({"mesh", "info", "x.obj", "--json"}).json();
  EXPECT_EQ(json["findings"]["duplicateFaces"]["places"][0]["faces"], (Json{2, 3}));
  EXPECT_EQ(json["countsFrom"], 1);
  write("x.ply", ply(7, 3, "9 9 9\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 5\n3 0 5\n4 1 2 3 4\n3 4 5 6\n3 4 5 6\n"));
  const Outcome fromZero = run({"mesh", "info", "x.ply"});
  EXPECT_TRUE(says(fromZero, "faces 1 and 2")) << fromZero.out;
  EXPECT_TRUE(says(fromZero, "vertex 0 at 9, 9, 9")) << fromZero.out;
}

TEST_F(MeshInfo, ListsTenPlacesAndAllInJson) {
  std::string text(kTetrahedron);
  for (int i = 0; i < 25; ++i) text += "f 1 3 2\n";
  write("many.obj", text);
  const Outcome outcome = run({"mesh", "info", "many.obj"});
  EXPECT_TRUE(says(outcome, "  25 duplicate faces\n")) << outcome.out;
  EXPECT_TRUE(says(outcome, "and 15 more")) << outcome.out;
  const Json json = run({"mesh", "info", "many.obj", "--json"}).json();
  EXPECT_EQ(json["findings"]["duplicateFaces"]["count"], 25);
  EXPECT_EQ(json["findings"]["duplicateFaces"]["places"].size(), 25u);
}

TEST_F(MeshInfo, LeavesOutSelfIntersectionsWhereToldTo) {
  write("cross.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0.5 0.5 -1\nv 0.5 0.5 1\nv 3 3 0\nf 1 2 3\nf 4 5 6\n");
  const Json with = run({"mesh", "info", "cross.obj", "--json"}).json();
  EXPECT_EQ(with["findings"]["selfIntersections"]["count"], 1);
  const Outcome without = run({"mesh", "info", "cross.obj", "--no-self-intersections"});
  EXPECT_TRUE(says(without, "not searched for")) << without.out;
  EXPECT_FALSE(says(without, "pair of faces that cross"));
  EXPECT_TRUE(run({"mesh", "info", "cross.obj", "--no-self-intersections", "--json"})
                  .json()["findings"]["selfIntersections"]
                  .is_null());
}

TEST_F(MeshInfo, CountsComponentsBordersAndEulerNumbers) {
  write("parts.obj", plus(kTetrahedron, "v 5 0 0\nv 6 0 0\nv 6 1 0\nv 5 1 0\nf 5 6 7 8\n"));
  const Json json = run({"mesh", "info", "parts.obj", "--json"}).json();
  ASSERT_EQ(json["components"].size(), 2u);
  EXPECT_EQ(json["components"][0]["eulerNumber"], 2);
  EXPECT_EQ(json["components"][0]["genus"], 0);
  EXPECT_EQ(json["components"][0]["isClosed"], true);
  EXPECT_EQ(json["components"][1]["eulerNumber"], 1);
  EXPECT_EQ(json["components"][1]["firstFace"], 5);
  ASSERT_EQ(json["borders"].size(), 1u);
  EXPECT_EQ(json["borders"][0]["edges"], 4);
  EXPECT_EQ(json["borders"][0]["length"], 4.0);
  EXPECT_TRUE(json["volume"].is_null());
  EXPECT_EQ(json["faces"], 5);
  EXPECT_EQ(json["triangles"], 6);
}

// What happened elsewhere: a mesh that is cut apart at its seams counts as open
// (mikedh/trimesh#145 and others).
TEST_F(MeshInfo, JoinsSeamsBeforeItExaminesThem) {
  // A tetrahedron whose faces have vertices of their own, with a quality that differs in one of them.
  std::string lines;
  int face = 0;
  for (const char* corners :
       {"0 0 0|0 1 0|1 0 0", "0 0 0|1 0 0|0 0 1", "1 0 0|0 1 0|0 0 1", "0 1 0|0 0 0|0 0 1"}) {
    std::string corner;
    for (const char* c = corners;; ++c)
      if (*c == '|' || *c == 0) {
        lines += corner + (face == 3 ? " 1\n" : " 0\n");
        corner.clear();
        if (*c == 0) break;
      } else {
        corner += *c;
      }
    ++face;
  }
  lines += "0 0 7 0\n3 0 1 2\n3 3 4 5\n3 6 7 8\n3 9 10 11\n";  // a vertex more, so that it is no soup
  write("seams.ply", ply(13, 4, lines, "property float quality\n"));
  const Outcome outcome = run({"mesh", "info", "seams.ply"});
  EXPECT_EQ(outcome.out.rfind("seams.ply: closed manifold, 1 component, genus 0\n", 0), 0u) << outcome.out;
  const Json json = run({"mesh", "info", "seams.ply", "--json"}).json();
  EXPECT_EQ(json["vertices"], 13);
  EXPECT_EQ(json["joinedVertices"].get<int>() + json["joinedAtSeams"].get<int>(), 8);
  EXPECT_EQ(json["seamEdges"], 3);
  EXPECT_EQ(json["findings"]["unusedVertices"]["places"][0]["vertices"], Json{12});
}

TEST_F(MeshInfo, SaysWhatIsInTheFile) {
  write("all.obj",
        "mtllib all.mtl\no first\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\no second\nf 1 2 "
        "4\n");
  write("all.mtl", "newmtl red\nmap_Kd there.png\n");
  write("there.png", "x");
  const Outcome outcome = run({"mesh", "info", "all.obj"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* text : {"format      OBJ", "vertices    4", "faces       2",
                           "box         0, 0, 0 to 1, 1, 1", "diagonal    1.73205081", "area        1\n"})
    EXPECT_TRUE(says(outcome, text)) << text << "\n" << outcome.out;
}

TEST_F(MeshInfo, RefusesWhatIsNoMesh) {
  write("empty.ply", "");
  write("bad.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n");
  EXPECT_EQ(run({"mesh", "info", "empty.ply"}).code, 4);
  EXPECT_EQ(run({"mesh", "info", "bad.obj"}).code, 4);
  EXPECT_EQ(run({"mesh", "info", "none.ply"}).code, 3);
  EXPECT_EQ(run({"mesh", "info", "x.doc"}).code, 3);
}

TEST_F(MeshInfo, IsOneOfTheCommandsOfMesh) {
  const Outcome unknown = run({"mesh", "inof", "x.ply"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(says(unknown, "no command 'inof'; the commands of mesh are info, repair, crop")) << unknown.err;
  EXPECT_EQ(run({"mesh"}).code, 2);
  EXPECT_EQ(run({"mesh", "--help"}).code, 0);
  for (const char* command : {"info", "repair", "crop"}) {
    const Outcome help = run({"mesh", command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_TRUE(says(help, std::string("arete mesh ") + command + " ")) << help.out;
  }
  EXPECT_TRUE(says(run({"mesh", "info"}), "See arete mesh info --help")) << run({"mesh", "info"}).err;
}

}  // namespace
}  // namespace arete::cli_test
