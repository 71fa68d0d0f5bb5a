// SPDX-License-Identifier: GPL-3.0-or-later
// What an address may hide (the query of a signed one, a password) is neither written nor shown.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "cli/cli_fixture.h"
#include "io/http_server.h"

namespace arete::cli_test {
namespace {

constexpr const char* kSecret = "5ecret";

class AddressCommand : public Cli {
 protected:
  /// The names of files that hold the secret, in plain bytes.
  std::string filesWithSecret() const {
    std::string names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(""))) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(file), {}};
      if (bytes.find(kSecret) != bytes.npos) names += entry.path().filename().string() + ' ';
    }
    return names;
  }
  void expectNoSecret(const Outcome& outcome, const std::string& what) const {
    EXPECT_EQ(outcome.out.find(kSecret), std::string::npos) << what << ": " << outcome.out;
    EXPECT_EQ(outcome.err.find(kSecret), std::string::npos) << what << ": " << outcome.err;
  }
};

TEST_F(AddressCommand, DoesNotGoIntoFilesNorMessages) {
  makeRaster("dem.tif", "fractal", 40, 30);
  const std::string bytes = read("dem.tif");
  test::HttpServer server({{"dem.tif?X-Amz-Credential=AKIA%2F2020&X-Amz-Signature=5ecret", bytes},
                           {"dem.tif?sv=2022&sig=5ecret%3D", bytes},
                           {"points.csv?token=5ecret", "x,y,z\n0,0,1\n10,0,2\n0,10,3\n10,10,4\n5,5,9\n"},
                           {"cut.tif?sig=5ecret", bytes.substr(0, bytes.size() / 2)},
                           {"none.tif?sig=5ecret", "this is no raster"}});
  for (const char* name : {"dem.tif?X-Amz-Credential=AKIA%2F2020&X-Amz-Signature=5ecret",
                           "dem.tif?sv=2022&sig=5ecret%3D", "points.csv?token=5ecret"}) {
    const std::string address = server.address(name);
    for (const std::string& form : {address, "/vsicurl/" + address}) {
      for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--json"}, {"--packed"}}) {
        std::vector<std::string> words = {"build", form, "-o", "m.amt"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome built = run(words);
        ASSERT_EQ(built.code, 0) << built.err;
        expectNoSecret(built, form);
      }
      for (const char* output : {"t.ply", "t.obj", "t.stl", "t.glb", "t.gltf", "t.gpkg", "t.2dm", "t.off"}) {
        const Outcome extracted = run({"extract", "m.amt", "-o", output, "--max-error", "5"});
        EXPECT_EQ(extracted.code, 0) << output << extracted.err;
        expectNoSecret(extracted, output);
      }
      const Outcome certified =
          run({"extract", "m.amt", "-o", "t.ply", "--max-error", "5", "--certificate", "--json"});
      expectNoSecret(certified, "certificate");
      for (const std::vector<std::string>& words : {std::vector<std::string>{"info", "m.amt"},
                                                    {"info", "m.amt", "--json"},
                                                    {"measure", "t.ply", form},
                                                    {"measure", "t.ply", form, "--json"},
                                                    {"validate", "m.amt", form},
                                                    {"validate", "m.amt", form, "--json"}})
        expectNoSecret(run(words), words[0]);
      EXPECT_EQ(filesWithSecret(), "") << form;
    }
  }
  for (const char* name : {"cut.tif?sig=5ecret", "none.tif?sig=5ecret", "missing.tif?sig=5ecret"})
    for (const bool isJson : {false, true}) {
      std::vector<std::string> words = {"build", server.address(name), "-o", "n.amt"};
      if (isJson) words.emplace_back("--json");
      const Outcome failed = run(words);
      EXPECT_NE(failed.code, 0) << name;
      EXPECT_NE((failed.err + failed.out).find("http://127.0.0.1"), std::string::npos) << failed.err;
      expectNoSecret(failed, name);
    }
  expectNoSecret(run({"build", "https://user:5ecret@127.0.0.1:9/a.tif", "-o", "n.amt"}), "password");
  expectNoSecret(run({"build", "dem.tif", "--bad", server.address("dem.tif?sig=5ecret")}), "usage");
  EXPECT_EQ(filesWithSecret(), "");
}

}  // namespace
}  // namespace arete::cli_test
