// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh_fixture.h"

namespace arete::cli_test {
namespace {

using MeshRepair = Meshes;

/// Everything that is mended unasked: a duplicate, a face without area, a turned face, a vertex without a
/// face, two fans at one vertex, a T-junction.
constexpr std::string_view kBroken =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 9 9 9\nv -1 0 0\nv -1 -1 0\nv 0 0 2\nv 4 0 0\nv 6 0 0\nv 5 1 0\nv "
    "5 "
    "0 0\nv 5 -1 0\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\nf 1 6 7\nf 1 1 2\nf 9 10 11\nf 9 13 12\nf 12 13 10\n";

TEST_F(MeshRepair, MendsAndSaysWhatAndEndsWithADiagnosis) {
  write("broken.obj", std::string(kBroken));
  const Outcome outcome = run({"mesh", "repair", "broken.obj", "-o", "clean.obj"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* text : {"duplicate faces left out: 1", "without area left out", "T-junctions: 1", "fan",
                           "vertices without a face left out", "now: manifold, 3 components, 2 borders\n"})
    EXPECT_TRUE(says(outcome, text)) << text << "\n" << outcome.out;
  const Json json = run({"mesh", "repair", "broken.obj", "-o", "clean.obj", "--json"}).json();
  EXPECT_EQ(json["mended"]["duplicateFaces"], 1);
  EXPECT_EQ(json["mended"]["tJunctions"], 1);
  EXPECT_EQ(json["mended"]["addedVertices"], 1);
  EXPECT_EQ(json["result"]["isManifold"], true);
  EXPECT_EQ(json["result"]["components"].size(), 3u);
}

TEST_F(MeshRepair, ChangesNothingTheSecondTime) {
  write("broken.obj", std::string(kBroken));
  write("seams.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 0.6 0\nvt 1 0\n"
        "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 1/1 2/2 3/3\nf 3/3 2/5 5/6\n");
  for (const char* input : {"broken.obj", "seams.obj"})
    for (const char* extension : {"obj", "ply", "off", "stl", "glb", "gltf"}) {
      SCOPED_TRACE(std::string(input) + " to " + extension);
      const std::string first = std::string("1.") + extension, second = std::string("2.") + extension;
      ASSERT_EQ(run({"mesh", "repair", input, "-o", first}).code, 0);
      const Outcome again = run({"mesh", "repair", first, "-o", second, "--json"});
      ASSERT_EQ(again.code, 0) << again.err;
      EXPECT_EQ(read(first), read(second));
      const auto mended = again.json()["mended"];
      for (const auto& [what, count] : mended.items()) EXPECT_EQ(count, 0) << what;
    }
}

TEST_F(MeshRepair, WeldsByTheUnitOfTheFileAndByPercent) {
  // Two triangles along a gap of 0.01.
  write("gap.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.01 0 0\nv 0 1.01 0\nv 1 1 0\nf 1 2 3\nf 5 4 6\n");
  EXPECT_TRUE(says(run({"mesh", "repair", "gap.obj", "-o", "a.obj"}), "2 components"));
  const Outcome absolute = run({"mesh", "repair", "gap.obj", "-o", "a.obj", "--weld", "0.02"});
  EXPECT_EQ(absolute.code, 0) << absolute.err;
  EXPECT_TRUE(says(absolute, "2 vertices joined within 0.02 (1.40")) << absolute.out;
  EXPECT_TRUE(says(absolute, "1 component")) << absolute.out;
  const Outcome percent = run({"mesh", "repair", "gap.obj", "-o", "b.obj", "--weld", "1.5%"});
  EXPECT_TRUE(says(percent, "2 vertices joined within 0.0214")) << percent.out;
  EXPECT_EQ(read("a.obj"), read("b.obj"));
  EXPECT_TRUE(says(run({"mesh", "repair", "gap.obj", "-o", "a.obj", "--weld", "0.001"}), "2 components"));
  for (const char* wrong : {"x", "-1", "1,2", "%", "inf", "nan%"}) {
    const Outcome refused = run({"mesh", "repair", "gap.obj", "-o", "a.obj", std::string("--weld=") + wrong});
    EXPECT_EQ(refused.code, 2) << wrong;
    EXPECT_TRUE(says(refused, std::string("--weld ") + wrong)) << refused.err;
  }
}

TEST_F(MeshRepair, FillsHolesAndSplitsSheetsOnlyWhereAskedTo) {
  write("hole.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
  EXPECT_TRUE(says(run({"mesh", "repair", "hole.obj", "-o", "a.obj"}), "1 border"));
  EXPECT_TRUE(says(run({"mesh", "repair", "hole.obj", "-o", "a.obj", "--fill-holes", "2"}), "1 border"));
  const Outcome filled = run({"mesh", "repair", "hole.obj", "-o", "a.obj", "--fill-holes", "3"});
  EXPECT_TRUE(says(filled, "now: closed manifold, 1 component, genus 0\n")) << filled.out;
  // Two tetrahedra that share an edge.
  write("wide.obj", plus(kTetrahedron, "v 0.5 -1 -1\nv 0.5 -1 0\nf 1 2 5\nf 2 1 6\nf 1 5 6\nf 5 2 6\n"));
  EXPECT_TRUE(says(run({"mesh", "repair", "wide.obj", "-o", "a.obj"}), "now: not manifold: 1 edge of more"));
  const Outcome split = run({"mesh", "repair", "wide.obj", "-o", "a.obj", "--split-sheets"});
  EXPECT_TRUE(says(split, "now: closed manifold, 2 components\n")) << split.out;
}

TEST_F(MeshRepair, WritesAnyFormatAndRefusesToOverwriteItsInput) {
  write("x.obj", std::string(kTetrahedron));
  EXPECT_EQ(run({"mesh", "repair", "x.obj", "-o", "x.obj"}).code, 2);
  EXPECT_EQ(run({"mesh", "repair", "x.obj", "-o", "x.doc"}).code, 2);
  const Outcome piped = run({"mesh", "repair", "x.obj", "-o", "-", "--format", "off"});
  EXPECT_EQ(piped.code, 0);
  EXPECT_NE(piped.out.find("4 4"), std::string::npos) << piped.out;
  EXPECT_NE(piped.err.find("nothing to mend"), std::string::npos) << piped.err;
  // What an .stl cannot hold is named, as convert names it.
  write("crs.ply", ply(3, 1, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").insert(21, "comment vertical_unit m\n"));
  EXPECT_TRUE(
      says(run({"mesh", "repair", "crs.ply", "-o", "a.stl"}), "STL cannot hold the unit of the heights"));
}

TEST_F(MeshRepair, TurnsAndScalesAsStated) {
  write("x.obj", "v 0 1000 0\nv 1000 0 0\nv 0 0 1000\nf 1 2 3\n");
  ASSERT_EQ(run({"mesh", "repair", "x.obj", "-o", "y.obj", "--up", "y", "--unit", "mm"}).code, 0);
  EXPECT_NE(read("y.obj").find("v 0 0 1\nv 1 0 0\nv 0 -1 0\n"), std::string::npos) << read("y.obj");
}

TEST_F(MeshRepair, TurnsClosedPartsOutwardsAndSaysSo) {
  write("inside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  const Outcome outcome = run({"mesh", "repair", "inside.obj", "-o", "out.obj"});
  EXPECT_TRUE(says(outcome, "faces turned: 4\n  closed parts turned as a whole, outwards: 1\n"))
      << outcome.out;
  const Json json = run({"mesh", "repair", "inside.obj", "-o", "out.obj", "--json"}).json();
  EXPECT_EQ(json["mended"]["turnedSolids"], 1);
  EXPECT_EQ(json["crossingParts"], 0);
  const Json info = run({"mesh", "info", "out.obj", "--json"}).json();
  EXPECT_NEAR(info["volume"].get<double>(), 1.0 / 6, 1e-12);
}

TEST_F(MeshRepair, NamesHolesThatStayOpen) {
  write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const Outcome outcome = run({"mesh", "repair", "square.obj", "-o", "out.obj", "--fill-holes", "20"});
  EXPECT_TRUE(says(outcome, "left open: 1 hole, as its filling would")) << outcome.out;
  EXPECT_EQ(run({"mesh", "repair", "square.obj", "-o", "out.obj", "--fill-holes", "20", "--json"})
                .json()["openHoles"],
            1);
}

TEST_F(MeshRepair, JoinsBordersThatTheRoundingOfFloatsMovesApart) {
  // Two triangles whose common side was written once as it is and once an ulp of a float away.
  write("gap.ply",
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0.1000001 0.2000003 0.3000007\n9.300001 0.7000001 0.1000003\n5.100003 7.300009 0.9000001\n"
        "9.300002 0.7000001 0.1000003\n5.100004 7.300009 0.9000001\n9.900001 9.100003 0.7000003\n"
        "3 0 1 2\n3 3 5 4\n");
  const Outcome info = run({"mesh", "info", "gap.ply"});
  EXPECT_TRUE(says(info, "2 border edges that are others but for rounding")) << info.out;
  const Outcome outcome = run({"mesh", "repair", "gap.ply", "-o", "out.ply"});
  EXPECT_TRUE(says(outcome, "which rounding to the numbers of the file moves apart")) << outcome.out;
  EXPECT_TRUE(says(outcome, "now: manifold, 1 component, genus 0, 1 border\n")) << outcome.out;
  const Outcome decimated =
      run({"mesh", "decimate", "gap.ply", "-o", "o.ply", "--max-triangles", "2", "--operator", "qem"});
  EXPECT_TRUE(says(decimated, "2 border edges that are others but for rounding: the surface is open there"))
      << decimated.err;
}

TEST_F(MeshRepair, OfNumbersThatNoFaceUsesLeavesThemOut) {
  const std::string faces = "f 1 2 3\nf 1 3 5\n";
  write("nan.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv nan nan nan\nv 0 1 0\n" + faces);
  write("nan.ply", ply(5, 2, "0 0 0\n1 0 0\n1 1 0\nnan nan nan\n0 1 0\n3 0 1 2\n3 0 2 4\n"));
  write("nan.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\nnan 0 inf\n0 1 0\n3 0 1 2\n3 0 2 4\n");
  for (const char* file : {"nan.obj", "nan.ply", "nan.off"}) {
    SCOPED_TRACE(file);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"mesh", "info", file},
          {"mesh", "repair", file, "-o", "o.obj"},
          {"convert", file, "-o", "o.obj"},
          {"build", file, "-o", "o.amt"},
          {"mesh", "decimate", file, "-o", "o.obj", "--max-triangles", "2", "--operator", "qem"}}) {
      const Outcome outcome = run(command);
      EXPECT_EQ(outcome.code, 0) << command[0] << " " << command[1] << ": " << outcome.err;
      EXPECT_TRUE(says(outcome, "1 vertex without a face has a coordinate that is not finite: left out"))
          << outcome.err;
    }
    ASSERT_EQ(run({"convert", file, "-o", "o.obj"}).code, 0);
    EXPECT_NE(read("o.obj").find("v 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"), std::string::npos) << read("o.obj");
  }
  // Those of faces stay an error that names the line or the vertex, also of a face before the vertex.
  write("used.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n");
  write("before.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv nan 1 0\n");
  write("used.ply", ply(3, 1, "0 0 0\n1 0 0\nnan 1 0\n3 0 1 2\n"));
  for (const auto& [file, culprit] :
       {std::pair{"used.obj", "line 3"}, {"before.obj", "line 4"}, {"used.ply", "vertex 2"}}) {
    const Outcome outcome = run({"mesh", "info", file});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_TRUE(says(outcome, culprit)) << outcome.err;
  }
}

TEST_F(MeshRepair, IsAdvisedOnlyWhereItHelps) {
  // Two tetrahedra that share an edge: splitting helps.
  write("wide.obj", plus(kTetrahedron, "v 0.5 -1 -1\nv 0.5 -1 0\nf 1 2 5\nf 2 1 6\nf 1 5 6\nf 5 2 6\n"));
  const Outcome helps = run({"build", "wide.obj", "-o", "a.amt"});
  EXPECT_EQ(helps.code, 4);
  EXPECT_TRUE(says(helps, "--split-sheets")) << helps.err;
  ASSERT_EQ(run({"mesh", "repair", "wide.obj", "-o", "apart.obj", "--split-sheets"}).code, 0);
  EXPECT_EQ(run({"build", "apart.obj", "-o", "a.amt"}).code, 0);
}

}  // namespace
}  // namespace arete::cli_test
