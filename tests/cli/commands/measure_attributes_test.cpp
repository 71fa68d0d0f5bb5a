// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

/// A unit square of n x n quadrilaterals with texture coordinates, of which the second is shifted by a sine.
std::string sheet(int n, double wave, double shift = 0, const std::string& head = "") {
  std::string text = head;
  for (int r = 0; r <= n; ++r)
    for (int c = 0; c <= n; ++c) {
      const double x = double(c) / n, y = double(r) / n;
      text += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
      text += "vt " + std::to_string(x + shift) + " " + std::to_string(y + wave * std::sin(M_PI * x)) + "\n";
    }
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const auto corner = [&](int dr, int dc) {
        const std::string i = std::to_string((r + dr) * (n + 1) + c + dc + 1);
        return " " + i + "/" + i;
      };
      text += "f" + corner(0, 0) + corner(0, 1) + corner(1, 1) + corner(1, 0) + "\n";
    }
  return text;
}

class MeasureAttributes : public Cli {};

TEST_F(MeasureAttributes, AreTheSameOfAMeshAndItselfInEveryFormat) {
  write("a.obj", sheet(4, 0.1));
  for (const char* name : {"b.obj", "b.glb", "b.ply", "b.gltf"}) {
    ASSERT_EQ(run({"convert", "a.obj", "-o", name}).code, 0) << name;
    const Outcome outcome = run({"measure", name, "a.obj", "--samples", "500", "--attributes",
                                 "--expect-attribute", "uv:0", "--json"});
    EXPECT_EQ(outcome.code, 0) << name << outcome.err;
    const Json json = outcome.json();
    EXPECT_LT(json["attributes"]["uv"]["largest"], 1e-6) << name << outcome.out;
    EXPECT_EQ(json["attributesKept"], true);
  }
}

TEST_F(MeasureAttributes, OfAShiftIsTheShiftLessWhatTheDistanceAllows) {
  write("small.obj", sheet(1, 0, 0.25));
  write("scan.obj", sheet(5, 0));
  const auto largest = [&](const char* expect) {
    const Json json = run({"measure", "small.obj", "scan.obj", "--samples", "500", "--expect", expect,
                           "--attributes", "--json"})
                          .json();
    return json["attributes"]["uv"]["largest"].get<double>();
  };
  EXPECT_NEAR(largest("0"), 0.25, 1e-6);
  const Outcome text = run({"measure", "small.obj", "scan.obj", "--samples", "500", "--attributes"});
  EXPECT_NE(
      text.out.find("uv                           0.25         0.25         0.25             0.25  units"),
      std::string::npos)
      << text.out;
}

TEST_F(MeasureAttributes, APromiseThatIsBrokenNamesThePlaceAndEndsAsExpectDoes) {
  write("small.obj", sheet(1, 0));
  write("scan.obj", sheet(8, 0.1));
  const Outcome broken = run(
      {"measure", "small.obj", "scan.obj", "--samples", "500", "--expect-attribute", "uv:0.05", "--json"});
  EXPECT_EQ(broken.code, 5) << broken.err;
  EXPECT_NE(broken.err.find("the largest change of uv is 0.1"), std::string::npos) << broken.err;
  const Json json = broken.json();
  EXPECT_EQ(json["attributesKept"], false);
  EXPECT_NEAR(json["attributes"]["uv"]["largest"], 0.1, 1e-3);
  EXPECT_NEAR(json["attributes"]["uv"]["at"][0], 0.5, 1e-9);
  EXPECT_NEAR(json["attributes"]["uv"]["meanAtNearest"], 0.2 / M_PI, 2e-3);
  EXPECT_EQ(
      run({"measure", "small.obj", "scan.obj", "--samples", "500", "--expect-attribute", "uv:0.101"}).code,
      0);
}

TEST_F(MeasureAttributes, WhatTheResultHasLostIsABrokenPromise) {
  write("scan.obj", sheet(2, 0));
  ASSERT_EQ(run({"convert", "scan.obj", "-o", "bare.obj", "--drop-attributes", "texcoord"}).code, 0);
  const Outcome outcome =
      run({"measure", "bare.obj", "scan.obj", "--samples", "100", "--expect-attribute", "uv:1"});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("uv: the first mesh has none"), std::string::npos) << outcome.err;
  EXPECT_EQ(run({"measure", "bare.obj", "scan.obj", "--samples", "100", "--attributes"}).code, 0);
}

TEST_F(MeasureAttributes, RefusesByNameWhatItCannotCompare) {
  write("a.obj", sheet(2, 0));
  for (const auto& [list, said] :
       std::vector<std::pair<std::string, std::string>>{{"color:3", "which has uv"},
                                                        {"uv", "is not a name, a colon and a number"},
                                                        {"uv:2mm", "unknown unit"},
                                                        {"uv:2px", "cannot be counted in px"}}) {
    const Outcome outcome =
        run({"measure", "a.obj", "a.obj", "--samples", "100", "--expect-attribute", list});
    EXPECT_EQ(outcome.code, 2) << list << outcome.err;
    EXPECT_NE(outcome.err.find("--expect-attribute"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  }
}

TEST_F(MeasureAttributes, MaterialsAreEqualOrNotAndKeepTextureCoordinatesApart) {
  const std::string lib = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
  write("a.mtl", lib);
  const auto painted = [&](const char* first, const char* second) {
    std::string text = "mtllib a.mtl\n" + sheet(2, 0);
    text.insert(text.find("f "), std::string("usemtl ") + first + "\n");
    text.insert(text.rfind("f "), std::string("usemtl ") + second + "\n");
    return text;
  };
  write("a.obj", painted("red", "blue"));
  write("b.obj", painted("red", "red"));
  const Outcome same =
      run({"measure", "a.obj", "a.obj", "--samples", "300", "--expect-attribute", "material:0,uv:0"});
  EXPECT_EQ(same.code, 0) << same.err << same.out;
  EXPECT_NE(same.out.find("material             equal at"), std::string::npos) << same.out;
  const Outcome other =
      run({"measure", "b.obj", "a.obj", "--samples", "300", "--expect-attribute", "material:0"});
  EXPECT_EQ(other.code, 5);
  EXPECT_NE(other.err.find("material differs"), std::string::npos) << other.err;
}

/// Two squares side by side, of n x n quadrilaterals each and one material, their coordinates (y / 10, v of
/// the side): two charts where these differ.
std::string twoSides(int n, double leftV, double rightV, double seam = 1) {
  std::string text;
  for (const int side : {0, 1})
    for (int r = 0; r <= n; ++r)
      for (int c = 0; c <= n; ++c)
        text += "v " + std::to_string(side == 0 ? seam * c / n : seam + (2 - seam) * c / n) + " " +
                std::to_string(double(r) / n) + " 0\nvt " + std::to_string(0.1 * r / n) + " " +
                std::to_string(side == 0 ? leftV : rightV) + "\n";
  for (const int side : {0, 1})
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        const auto corner = [&](int dr, int dc) {
          const std::string i = std::to_string(side * (n + 1) * (n + 1) + (r + dr) * (n + 1) + c + dc + 1);
          return " " + i + "/" + i;
        };
        text += "f" + corner(0, 0) + corner(0, 1) + corner(1, 1) + corner(1, 0) + "\n";
      }
  return text;
}

// What is right on the other side of a seam is no excuse for what is wrong on this one.
TEST_F(MeasureAttributes, ChartsOfOneMaterialAreComparedEachWithItsOwn) {
  write("scan.obj", twoSides(8, 0, 0.02));
  write("small.obj", twoSides(2, 0.5, 0.02));
  ASSERT_EQ(run({"convert", "small.obj", "-o", "small.glb"}).code, 0);
  for (const char* small : {"small.obj", "small.glb"}) {
    const Json json =
        run({"measure", small, "scan.obj", "--samples", "500", "--expect", "0.1", "--attributes", "--json"})
            .json();
    EXPECT_NEAR(json["attributes"]["uv"]["largest"], 0.5, 1e-6) << small;
    EXPECT_NEAR(json["attributes"]["uv"]["mean"], 0.25, 0.01) << small << ": the right side is right";
    EXPECT_EQ(json["charts"], 2);
    EXPECT_EQ(json["chartsApart"], 2);
  }
  const Outcome text =
      run({"measure", "small.obj", "scan.obj", "--samples", "500", "--expect", "0.1", "--attributes"});
  EXPECT_NE(text.out.find("charts               2 of 2 told from their neighbours"), std::string::npos)
      << text.out;
}

// Of a mesh whose seam lies elsewhere: a stated E is a promise for each side, and without one nothing is.
TEST_F(MeasureAttributes, APointWhoseChartIsFartherThanTheDistanceIsComparedWithItsNearestPoint) {
  write("scan.obj", twoSides(8, 0, 0.5));
  write("small.obj", twoSides(2, 0, 0.5, 0.9));
  const auto uvOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"measure", "small.obj",    "scan.obj", "--samples",
                                      "500",     "--attributes", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).json()["attributes"]["uv"];
  };
  const Json near = uvOf({}), stated = uvOf({"--expect", "0.01"}), enough = uvOf({"--expect", "0.11"});
  EXPECT_NEAR(near["largest"], 0, 1e-6) << near;
  EXPECT_GT(near["beyond"], 10);
  EXPECT_EQ(near["unequal"], 0);
  EXPECT_TRUE(stated["largest"].is_null()) << stated;
  EXPECT_GT(stated["unequal"], 10);
  EXPECT_LE(stated["unequal"], near["beyond"]);
  EXPECT_EQ(stated["beyond"], 0);
  EXPECT_NEAR(enough["largest"], 0, 1e-6) << enough;
}

// Which chart is whose is not known where they are not much wider than what the meshes may be apart by.
TEST_F(MeasureAttributes, ChartsThatAreNarrowBesideTheDistanceAreNotToldApart) {
  write("scan.obj", twoSides(8, 0, 0.02));
  write("small.obj", twoSides(2, 0.5, 0.02));
  const Json json =
      run({"measure", "small.obj", "scan.obj", "--samples", "500", "--expect", "3", "--attributes", "--json"})
          .json();
  EXPECT_EQ(json["charts"], 2);
  EXPECT_EQ(json["chartsApart"], 0);
  EXPECT_NEAR(json["attributes"]["uv"]["largest"], 0.02, 1e-6);
}

TEST_F(MeasureAttributes, AChartThatIsPartedInTheOtherMeshIsComparedWithAllItsParts) {
  write("scan.obj", twoSides(8, 0, 0));
  write("small.obj", twoSides(4, 0, 0.001));
  for (const auto& [first, second] :
       {std::pair("small.obj", "scan.obj"), std::pair("scan.obj", "small.obj")}) {
    const Json json =
        run({"measure", first, second, "--samples", "500", "--expect", "0", "--attributes", "--json"}).json();
    EXPECT_NEAR(json["attributes"]["uv"]["largest"], 0.001, 1e-6) << first;
  }
}

TEST_F(MeasureAttributes, PixelsAreThoseOfTheMaterialsPicture) {
  // A picture of 4 x 2 pixels, grey.
  const std::string head = "newmtl paint\nmap_Kd paint.bmp\n";
  std::string bmp = std::string("BM\x4e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\4\0\0\0\2\0\0\0\1\0\x18\0", 30);
  bmp += std::string(24, '\0') + std::string(24, '\x80');
  write("paint.bmp", bmp);
  write("a.mtl", head);
  write("scan.obj", sheet(3, 0, 0, "mtllib a.mtl\nusemtl paint\n"));
  write("small.obj", sheet(1, 0, 0.5, "mtllib a.mtl\nusemtl paint\n"));
  const Outcome outcome = run({"measure", "small.obj", "scan.obj", "--samples", "300", "--expect", "0",
                               "--expect-attribute", "uv:2px", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NEAR(outcome.json()["attributes"]["uv"]["largest"], 2, 1e-5) << outcome.out;
  EXPECT_EQ(outcome.json()["attributes"]["uv"]["unit"], "pixels");
  EXPECT_EQ(run({"measure", "small.obj", "scan.obj", "--samples", "300", "--expect", "0",
                 "--expect-attribute", "uv:1.9px"})
                .code,
            5);
}

// A glTF has normals of length 1; an OBJ may have longer ones, which count no more than others.
TEST_F(MeasureAttributes, NormalsOfAnyLengthAreTheSameAsThoseOfLengthOne) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 5 0 5\nvn 0 0.1 0.1\nf 1//1 2//2 3//3\n");
  ASSERT_EQ(run({"convert", "a.obj", "-o", "b.glb"}).code, 0);
  const Outcome outcome = run({"measure", "b.glb", "a.obj", "--samples", "500", "--attributes", "--expect",
                               "1e-6", "--expect-attribute", "normal:0.01", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LT(outcome.json()["attributes"]["normal"]["largest"], 0.001);
  EXPECT_LT(outcome.json()["attributes"]["normal"]["meanAtNearest"], 0.001);
}

TEST_F(MeasureAttributes, AgainstADemAreRefused) {
  write("a.obj", sheet(1, 0));
  ASSERT_TRUE(writeGeoTiff(path("dem.tif"), 2, 2, std::vector<double>(4, 0.0), {}));
  for (const char* option : {"--attributes", "--expect-attribute"}) {
    std::vector<std::string> words = {"measure", "a.obj", "dem.tif", option};
    if (std::string(option) == "--expect-attribute") words.push_back("uv:1");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
  }
}

TEST_F(MeasureAttributes, ExtractAndDecimateSayTheLargestChangeOfEach) {
  write("scan.obj", sheet(12, 0.1));
  ASSERT_EQ(run({"build", "scan.obj", "-o", "scan.amt"}).code, 0);
  const Outcome cut = run({"extract", "scan.amt", "-o", "small.obj", "--max-error", "1%"});
  EXPECT_NE(cut.out.find("  uv         changes by up to "), std::string::npos) << cut.out;
  const Json json = run({"extract", "scan.amt", "-o", "small.obj", "--max-error", "1%", "--json"}).json();
  const Json measured =
      run({"measure", "small.obj", "scan.obj", "--samples", "2000", "--attributes", "--json"}).json();
  const double said = json["exports"][0]["attributeChanges"][0]["largest"];
  EXPECT_GT(said, 0.01) << json;
  // At the nearest points, and not at the best within some distance.
  EXPECT_GE(said, 0.9 * double(measured["attributes"]["uv"]["largest"])) << json << measured;
  for (const char* method : {"measured", "qem", "half-edge"}) {
    const Outcome outcome = run(
        {"mesh", "decimate", "scan.obj", "-o", "less.obj", "--max-triangles", "20", "--operator", method});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("  uv         changes by up to "), std::string::npos) << method << outcome.out;
  }
  const Json finest = run({"extract", "scan.amt", "-o", "all.obj", "--max-error", "0", "--json"}).json();
  EXPECT_EQ(finest["exports"][0]["attributeChanges"][0]["compared"], 288);
  EXPECT_LT(finest["exports"][0]["attributeChanges"][0]["largest"], 1e-12);
}

}  // namespace
}  // namespace arete::cli_test
