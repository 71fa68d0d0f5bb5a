// SPDX-License-Identifier: GPL-3.0-or-later
// An output as the second argument, and what is said of the files that were written.
#include <algorithm>
#include <filesystem>

#include "cli/arguments_fixture.h"

namespace arete::cli_test {
namespace {

using OutputArgument = Arguments;

TEST_F(OutputArgument, IsTheSameAsTheOption) {
  write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  struct Case {
    std::vector<std::string> command, behind;
    std::string name;
  };
  for (const Case& c :
       std::vector<Case>{{{"extract", "dem.amt"}, {"--max-error", "2"}, "cut.ply"},
                         {{"extract", "dem.amt"}, {"--max-error", "2"}, "CUT.TIF"},
                         {{"convert", "tin.ply"}, {}, "tin.glb"},
                         {{"convert", "dem.amt"}, {"--packed"}, "small.amt"},
                         {{"mesh", "repair", "mesh.obj"}, {}, "clean.ply"},
                         {{"mesh", "crop", "mesh.obj"}, {"--box", ",,,,,9"}, "part.off"},
                         {{"mesh", "decimate", "tin.ply"}, {"--max-triangles", "50%"}, "few.stl"},
                         {{"viewshed", "dem.amt"}, {"--observer", middle() + ",20"}, "seen.tif"}}) {
    SCOPED_TRACE(c.command[0] + " " + c.name);
    std::vector<std::string> position = c.command, option = c.command;
    position.push_back(c.name);
    position.insert(position.end(), c.behind.begin(), c.behind.end());
    option.insert(option.end(), c.behind.begin(), c.behind.end());
    option.insert(option.end(), {"-o", "other/" + c.name});
    std::filesystem::create_directory(path("other"));
    const Outcome first = run(position), second = run(option);
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(second.code, 0) << second.err;
    EXPECT_EQ(read(c.name), read("other/" + c.name));
    EXPECT_FALSE(read(c.name).empty());
  }
}

TEST_F(OutputArgument, TakesTheNamesOfSeveralTolerances) {
  const Outcome outcome = run({"extract", "dem.amt", "{}m.ply", "--max-error", "2,5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(exists("2m.ply") && exists("5m.ply"));
}

TEST_F(OutputArgument, IsRefusedWhereItIsNoOutput) {
  const std::string model = read("dem.amt"), tin = read("tin.ply");
  expectRefusal({"extract", "dem.amt", "out", "--max-error", "2"}, 2, "'out' does not end in .");
  expectRefusal({"extract", "dem.amt", "other.amt", "--max-error", "2"}, 2, "'other.amt' does not end in .");
  expectRefusal({"extract", "dem.amt", ".ply", "--max-error", "2"}, 2, "'.ply' does not end in .");
  expectRefusal({"convert", "tin.ply", "-", "--format", "ply"}, 2, "'-' does not end in .");
  expectRefusal({"viewshed", "dem.amt", "seen.ply", "--observer", "1,1,2"}, 2,
                "'seen.ply' does not end in .");
  expectRefusal({"convert", "tin.ply", "a.obj", "-o", "b.obj"}, 2, "two outputs, a.obj and --output b.obj");
  expectRefusal({"convert", "tin.ply", "-o", "b.obj", "a.obj"}, 2, "two outputs, a.obj and --output b.obj");
  expectRefusal({"convert", "tin.ply", "a.obj", "b.obj"}, 2, "b.obj");
  expectRefusal({"convert", "tin.ply"}, 2, "--output is required");
  // An unknown option says more than its value, which would be an output.
  expectRefusal({"extract", "dem.amt", "--tolerance", "5", "-o", "a.ply"}, 2,
                "--tolerance; similar: --max-error");
  expectRefusal({"extract", "dem.amt", "--mesh", "a.ply", "--max-error", "2", "-o", "b.ply"}, 2, "--mesh");
  // The words behind an option with an optional value.
  expectRefusal({"extract", "dem.amt", "--max-error", "2", "--certificate", "a.ply"}, 2,
                "put the output before --certificate");
  EXPECT_EQ(read("dem.amt"), model);
  EXPECT_EQ(read("tin.ply"), tin);
}

// What a shell makes of `arete convert *.ply`.
TEST_F(OutputArgument, ReplacesNoFileThatMayBeASecondInput) {
  write("second.ply", "a scan that is not to be lost");
  write("SECOND.PLY", "nor this one");
  for (const char* name : {"second.ply", "SECOND.PLY"}) {
    const std::string before = read(name);
    const Outcome outcome = run({"convert", "tin.ply", name});
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_NE(outcome.err.find("may be a second input"), std::string::npos) << outcome.err;
    EXPECT_EQ(read(name), before);
    EXPECT_EQ(run({"convert", "tin.ply", "-o", name}).code, 0);
    EXPECT_NE(read(name), before);
  }
  // What the program itself has written is written anew.
  for (const char* name : {"other.glb", "other.ply", "other.obj"})
    for (int i = 0; i < 2; ++i) EXPECT_EQ(run({"convert", "tin.ply", name}).code, 0) << name << i;
}

TEST_F(OutputArgument, IsNeverAnInputUnderAnyName) {
  std::filesystem::create_symlink("tin.ply", path("link.ply"));
  std::filesystem::create_hard_link(path("tin.ply"), path("hard.ply"));
  std::filesystem::create_symlink("dem.tif", path("source.tif"));
  const std::string tin = read("tin.ply"), dem = read("dem.tif");
  for (const char* name : {"tin.ply", "./tin.ply", "../here/tin.ply", "link.ply", "hard.ply"}) {
    const Outcome outcome = run({"convert", "tin.ply", name});
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_NE(outcome.err.find("is an input"), std::string::npos) << outcome.err;
  }
  for (const char* name : {"dem.tif", "source.tif"}) {
    const Outcome outcome = run({"extract", "dem.amt", name, "--max-error", "2"});
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_NE(outcome.err.find("is an input"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(read("tin.ply"), tin);
  EXPECT_EQ(read("dem.tif"), dem);
}

TEST_F(OutputArgument, IsNotTakenByBuildMeasureAndThoseThatAskATable) {
  const std::string tin = read("tin.ply");
  EXPECT_EQ(run({"build", "dem.tif", "x.amt"}).code, 2);
  EXPECT_NE(run({"measure", "tin.ply", "dem.tif", "x.ply"}).code, 0);
  write("places.csv", "x,y\n1,1\n");
  EXPECT_EQ(run({"height", "dem.amt", "places.csv"}).code, 2);
  EXPECT_EQ(run({"los", "dem.amt", "places.csv"}).code, 2);
  EXPECT_EQ(run({"profile", "dem.amt", "places.csv"}).code, 2);
  EXPECT_EQ(read("places.csv"), "x,y\n1,1\n");
  EXPECT_EQ(read("tin.ply"), tin);
}

TEST_F(OutputArgument, EveryFileThatIsWrittenIsNamedWithItsSize) {
  const std::vector<std::string> command = {"extract", "dem.amt",       "a.obj",          "--max-error",
                                            "2",       "--certificate", "--error-raster", "e.tif"};
  const Outcome first = run(command);
  ASSERT_EQ(first.code, 0) << first.err;
  for (const char* name : {"a.obj", "a.certificate.json", "e.tif"})
    EXPECT_NE(first.out.find(std::string("Wrote ") + name + " ("), std::string::npos) << first.out;
  EXPECT_EQ(first.err.find("Replaced"), std::string::npos) << first.err;
  const auto oldBytes = read("a.obj").size();

  std::vector<std::string> again = command;
  again[4] = "9";
  const Outcome second = run(again);
  ASSERT_EQ(second.code, 0) << second.err;
  for (const char* name : {"a.obj", "a.certificate.json", "e.tif"})
    EXPECT_NE(second.err.find(std::string("Replaced ") + name + " ("), std::string::npos) << second.err;
  EXPECT_EQ(second.out.find("Wrote"), std::string::npos) << second.out;

  std::vector<std::string> quiet = again;
  quiet.emplace_back("-q");
  EXPECT_EQ(run(quiet).err + run(quiet).out, "");

  std::vector<std::string> asked = command;
  asked.emplace_back("--json");
  asked[2] = "b.obj";
  const Outcome json = run(asked);
  ASSERT_EQ(json.code, 0) << json.err;
  const Json answer = json.json();
  ASSERT_EQ(answer["files"].size(), 3u) << json.out;
  for (const Json& file : answer["files"])
    EXPECT_EQ(file["bytes"].get<std::size_t>(), read(file["path"].get<std::string>()).size()) << file;
  ASSERT_EQ(answer["replaced"].size(), 1u) << "only e.tif was there";
  EXPECT_EQ(answer["replaced"][0]["path"], "e.tif");
  EXPECT_EQ(read("b.obj").size(), oldBytes);
}

TEST_F(OutputArgument, FilesBesideAMeshAreNamedToo) {
  write("skin.mtl", "newmtl skin\nKd 1 0 0\n");
  write("mesh.obj", "mtllib skin.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome outcome = run({"convert", "mesh.obj", "copy.obj"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string& name : files()) {
    if (before_.contains(name) || name == "mesh.obj" || name == "skin.mtl") continue;
    EXPECT_NE(outcome.out.find("Wrote " + name + " ("), std::string::npos) << name << "\n" << outcome.out;
  }
}

TEST_F(OutputArgument, AGeoPackageThatKeepsItsOtherLayersIsAddedTo) {
  write("places.csv", "x,y\n" + middle() + "\n");
  const Outcome places = run({"height", "dem.amt", "--points", "places.csv", "-o", "all.gpkg"});
  ASSERT_EQ(places.code, 0) << places.err;
  const Outcome added = run({"convert", "tin.ply", "all.gpkg"});
  EXPECT_NE(added.out.find("Added to all.gpkg ("), std::string::npos) << added.out << added.err;
  const Outcome replaced = run({"convert", "tin.ply", "all.gpkg", "--overwrite"});
  EXPECT_NE(replaced.err.find("Replaced all.gpkg ("), std::string::npos) << replaced.out << replaced.err;
}

TEST_F(OutputArgument, StdoutIsNotNamedAsAFile) {
  const Outcome stdoutOnly = run({"extract", "dem.amt", "-o", "-", "--format", "ply", "--max-error", "2"});
  EXPECT_EQ(stdoutOnly.code, 0);
  EXPECT_EQ(stdoutOnly.err.find("Wrote"), std::string::npos) << "stdout has no name";
  EXPECT_EQ(stdoutOnly.out.rfind("ply\n", 0), 0u);
  EXPECT_EQ(stdoutOnly.out.find("Wrote"), std::string::npos);
}

TEST_F(OutputArgument, AFileOfAnotherKindIsAnsweredWithTheNextStep) {
  write("my dem.tif", "II*");
  struct Case {
    std::vector<std::string> command;
    std::string sentence;
  };
  for (const Case& c : std::vector<Case>{
           {{"extract", "dem.tif", "-o", "x.ply", "--max-error", "5"}, "'arete build dem.tif -o dem.amt'"},
           {{"info", "dem.tif"}, "'arete build dem.tif -o dem.amt'"},
           {{"info", "my dem.tif"}, "arete build 'my dem.tif' -o 'my dem.amt'"},
           {{"viewshed", "dem.tif", "-o", "x.tif", "--observer", "1,1,1"},
            "'arete build dem.tif -o dem.amt'"},
           {{"info", "tin.ply"}, "'arete mesh info tin.ply' describes it"},
           {{"extract", "tin.ply", "-o", "x.ply", "--max-error", "5"}, "'arete build tin.ply -o tin.amt'"},
           {{"height", "tin.ply", "--at", "1,1"}, "asks an .amt of the DEM"},
           {{"validate", "tin.ply"}, "'arete build tin.ply -o tin.amt'"}}) {
    const Outcome outcome = run(c.command);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("is not an .amt file; "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(c.sentence), std::string::npos) << outcome.err;
  }
  const Json json = run({"info", "dem.tif", "--json"}).json();
  EXPECT_EQ(json["error"]["culprit"], "dem.tif");
  const auto answered = [&](const std::vector<std::string>& command, const std::string& sentence) {
    const Outcome outcome = run(command);
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  answered({"convert", "dem.tif", "x.glb"}, "of a DEM 'arete build dem.tif -o dem.amt' makes an .amt");
  answered({"mesh", "info", "dem.tif"}, "of a DEM 'arete build dem.tif -o dem.amt' makes an .amt");
  answered({"measure", "dem.tif", "tin.ply"}, "measure takes the mesh first");
  answered({"build", "dem.amt", "-o", "x.amt"}, "it is built: 'arete info dem.amt' describes it");
  answered({"convert", "tin.ply", "-o", "x.foo"}, ".foo is no known mesh format");
  EXPECT_EQ(run({"convert", "tin.ply", "-o", "x.foo"}).err.find("arete build"), std::string::npos);
}

}  // namespace
}  // namespace arete::cli_test
