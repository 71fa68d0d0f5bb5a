// SPDX-License-Identifier: GPL-3.0-or-later
// Every command that writes a GeoPackage adds its layer to a project and keeps the rest.
#include <ogrsf_frmts.h>

#include <algorithm>

#include "cli/arguments_fixture.h"
#include "io/geo/gdal/support.h"

namespace arete::cli_test {
namespace {

class GeoPackages : public Arguments {
 protected:
  /// The names of the layers, sorted.
  std::vector<std::string> names(const std::string& name) const {
    std::vector<std::string> found;
    const GdalDatasetPtr dataset = openGdal(path(name), GDAL_OF_VECTOR);
    for (int i = 0; dataset && i < dataset->GetLayerCount(); ++i)
      found.emplace_back(dataset->GetLayer(i)->GetName());
    std::sort(found.begin(), found.end());
    return found;
  }
};

TEST_F(GeoPackages, GetALayerMoreFromEveryCommand) {
  write("p.csv", "name,x,y\na," + middle() + "\nb," + middle() + "\n");
  ASSERT_EQ(run({"height", "dem.amt", "--points", "p.csv", "-o", "project.gpkg", "-q"}).code, 0);
  ASSERT_EQ(names("project.gpkg"), (std::vector<std::string>{"heights"}));
  const std::vector<std::vector<std::string>> commands = {
      {"extract", "dem.amt", "-o", "project.gpkg", "--max-error", "5"},
      {"convert", "tin.ply", "-o", "project.gpkg"},
      {"height", "dem.amt", "--points", "p.csv", "-o", "project.gpkg"},
      {"los", "dem.amt", "--from", middle() + ",5", "--points", "p.csv", "--target-height", "2", "-o",
       "project.gpkg"},
      {"los", "dem.amt", "--from", middle() + ",5", "--points", "p.csv", "--target-height", "2", "-o",
       "project.gpkg", "--frequency", "900"},
      {"extract", "dem.amt", "-o", "project.gpkg", "--max-error", "20"}};
  std::vector<std::string> expected = {"heights"};
  for (const std::vector<std::string>& command : commands) {
    SCOPED_TRACE(command[0]);
    const Outcome outcome = run(command);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string own = command[0] == "height" ? "heights" : command[0] == "los" ? "sight" : "triangles";
    if (std::find(expected.begin(), expected.end(), own) == expected.end()) expected.push_back(own);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(names("project.gpkg"), expected);
  }
  EXPECT_EQ(run({"measure", "project.gpkg", "dem.tif", "--expect", "20"}).code, 0)
      << "the triangles are found";
  for (std::vector<std::string> command : commands) {
    command.push_back("--overwrite");
    EXPECT_EQ(run(command).code, 0);
    EXPECT_EQ(names("project.gpkg").size(), 1u) << command[0];
  }
}

TEST_F(GeoPackages, AreAsBeforeWhenACommandFails) {
  write("notes.gpkg", "somebody's notes");
  const Outcome outcome = run({"extract", "dem.amt", "-o", "notes.gpkg", "--max-error", "5"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("notes.gpkg: exists and is not a GeoPackage"), std::string::npos) << outcome.err;
  EXPECT_EQ(read("notes.gpkg"), "somebody's notes");
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "notes.gpkg", "--max-error", "5", "--overwrite"}).code, 0);
}

}  // namespace
}  // namespace arete::cli_test
