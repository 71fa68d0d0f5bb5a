// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/camera/flight_json.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "datasets/random.h"

namespace arete {
namespace {

Georeference georeferenceOf(const std::string& crs) {
  Georeference georeference;
  georeference.crsWkt = crs;  // any text that GDAL takes
  return georeference;
}

std::string flightWith(const std::string& members, const std::string& secondFrame) {
  return "{" + members +
         R"("speed": 50, "frames": [{"x": 1, "y": 2, "height": 3, "azimuth": 4, "pitch": 5},)" + secondFrame +
         "]}";
}

const std::string kFrame = R"({"x": 10, "y": 20, "height": 30, "azimuth": 40, "pitch": -50, "fov": 33})";

TEST(FlightJson, ComesBackToTheBit) {
  const Georeference dem = georeferenceOf("EPSG:32611");
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    FlightPlan plan;
    (seed % 2 ? plan.speed : plan.duration) = random.between(0, 1e3);
    plan.easeSeconds = random.unit();
    plan.turnRate = random.between(1, 90);
    plan.isClosed = seed % 3 == 0;
    plan.framesPerSecond = random.between(1, 120);
    for (int i = 0; i < 5; ++i)
      plan.keys.push_back({.xy = {random.between(-1e7, 1e7), random.between(-1e7, 1e7)},
                           .height = random.between(-500, 9e3),
                           .azimuthDegrees = random.between(0, 360),
                           .pitchDegrees = random.between(-90, 90),
                           .verticalFieldOfViewDegrees = random.between(1, 120)});
    const auto read = readFlightText(flightText(plan, dem), "a flight", dem);
    ASSERT_TRUE(read) << "seed " << seed << ": " << read.error().describe();
    EXPECT_TRUE(read->warnings.empty());
    EXPECT_EQ(read->plan.speed, plan.speed);
    EXPECT_EQ(read->plan.duration, plan.duration);
    EXPECT_EQ(read->plan.easeSeconds, plan.easeSeconds);
    EXPECT_EQ(read->plan.turnRate, plan.turnRate);
    EXPECT_EQ(read->plan.isClosed, plan.isClosed);
    EXPECT_EQ(read->plan.framesPerSecond, plan.framesPerSecond);
    ASSERT_EQ(read->plan.keys.size(), plan.keys.size());
    for (std::size_t i = 0; i < plan.keys.size(); ++i) {
      const Camera &a = read->plan.keys[i], &b = plan.keys[i];
      EXPECT_TRUE(a.xy == b.xy && a.height == b.height && a.azimuthDegrees == b.azimuthDegrees &&
                  a.pitchDegrees == b.pitchDegrees &&
                  a.verticalFieldOfViewDegrees == b.verticalFieldOfViewDegrees)
          << "seed " << seed << ", key frame " << i + 1;
    }
  }
}

TEST(FlightJson, ReadsWhatAPersonWrites) {
  const Georeference dem = georeferenceOf("EPSG:32611");
  const auto read = readFlightText(
      flightWith(R"("crs": "EPSG:32611", "comment": "over the ridge", )", kFrame), "flight.json", dem);
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_TRUE(read->warnings.empty());
  EXPECT_EQ(read->plan.speed, 50);
  EXPECT_FALSE(read->plan.duration);
  ASSERT_EQ(read->plan.keys.size(), 2);
  EXPECT_EQ(read->plan.keys[0].verticalFieldOfViewDegrees, 60) << "the usual one";
  EXPECT_EQ(read->plan.keys[1].xy, (Vec2{10, 20}));
  EXPECT_EQ(read->plan.keys[1].height, 30);
  EXPECT_EQ(read->plan.keys[1].azimuthDegrees, 40);
  EXPECT_EQ(read->plan.keys[1].pitchDegrees, -50);
  EXPECT_EQ(read->plan.keys[1].verticalFieldOfViewDegrees, 33);
}

TEST(FlightJson, WarnsOfNamesThatItDoesNotKnowAndOfAMissingCrs) {
  const auto read = readFlightText(
      flightWith(R"("sped": 3, )", R"({"x":1,"y":2,"height":3,"azimuth":4,"pitch":5,"roll":6})"), "f",
      georeferenceOf("EPSG:32611"));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->warnings.size(), 3);
  EXPECT_NE(read->warnings[0].sentence.find("\"sped\""), std::string::npos);
  EXPECT_NE(read->warnings[1].sentence.find("no CRS"), std::string::npos);
  EXPECT_NE(read->warnings[2].sentence.find("key frame 2 knows no \"roll\""), std::string::npos);
}

TEST(FlightJson, BringsHeightsIntoTheUnitOfTheDem) {
  Georeference feet;
  feet.verticalUnitMetres = 0.3048;
  const auto read = readFlightText(flightWith(R"("heightUnitMetres": 1, )", kFrame), "f", feet);
  ASSERT_TRUE(read);
  EXPECT_NEAR(read->plan.keys[1].height, 30 / 0.3048, 1e-9);
}

TEST(FlightJson, HoldsTheCrsAgainstTheDems) {
  const auto dem = georeferenceOf("EPSG:32611");
  const struct {
    std::string crs;
    const Georeference& dem;
    std::string words;
  } cases[] = {
      {"EPSG:4326", dem, "the DEM in WGS 84 / UTM zone 11N"},
      {"EPSG:32612", dem, "the DEM in WGS 84 / UTM zone 11N"},
      {"nonsense", dem, "its crs is unknown"},
      {"/etc/passwd", dem, "its crs is unknown"},
      {"EPSG:32611", {}, "the DEM has none"},
  };
  for (const auto& c : cases) {
    const auto read =
        readFlightText(flightWith("\"crs\": \"" + c.crs + "\", ", kFrame), "flight.json", c.dem);
    ASSERT_FALSE(read) << c.crs;
    EXPECT_EQ(read.error().culprit, "flight.json");
    EXPECT_NE(read.error().message.find(c.words), std::string::npos) << read.error().describe();
  }
}

TEST(FlightJson, RefusesWhatMakesNoSenseWithTheNumberOfTheFrame) {
  const struct {
    std::string text, words;
  } cases[] = {
      {"", "not JSON"},
      {"{", "not JSON"},
      {"\xff\xfe", "not JSON"},
      {std::string(100000, '['), "not JSON"},
      {flightWith("", R"({"x": NaN})"), "not JSON"},
      {flightWith("", R"({"x":1e999,"y":2,"height":3,"azimuth":4,"pitch":5})"), "too large"},
      {"[]", "no flight"},
      {"3", "no flight"},
      {"{}", "frames"},
      {R"({"frames": {}})", "frames"},
      {flightWith("", "7"), "key frame 2: it is number, not an object"},
      {flightWith("", "null"), "key frame 2: it is null, not an object"},
      {flightWith("", R"({"y":2,"height":3,"azimuth":4,"pitch":5})"), "key frame 2: its x is missing"},
      {flightWith("", R"({"x":1,"y":"2","height":3,"azimuth":4,"pitch":5})"), "key frame 2: its y is string"},
      {flightWith("", R"({"x":1,"y":2,"height":null,"azimuth":4,"pitch":5})"),
       "key frame 2: its height is null"},
      {flightWith("", R"({"x":1,"y":2,"height":3,"azimuth":[4],"pitch":5})"),
       "key frame 2: its azimuth is array"},
      {flightWith("", R"({"x":1,"y":2,"height":3,"azimuth":4,"pitch":true})"),
       "key frame 2: its pitch is boolean"},
      {flightWith("", R"({"x":1,"y":2,"height":3,"azimuth":4,"pitch":5,"fov":"wide"})"),
       "key frame 2: its fov is string"},
      {flightWith(R"("duration": "long", )", kFrame), "its duration is string"},
      {flightWith(R"("turnRate": null, )", kFrame), "its turnRate is null"},
      {flightWith(R"("closed": 1, )", kFrame), "closed"},
      {flightWith(R"("crs": 32611, )", kFrame), "crs is not a text"},
      {flightWith(R"("heightUnitMetres": 0, )", kFrame), "heightUnitMetres"},
  };
  for (const auto& c : cases) {
    const auto read = readFlightText(c.text, "flight.json", {});
    ASSERT_FALSE(read) << c.text.substr(0, 200);
    EXPECT_EQ(read.error().culprit, "flight.json");
    EXPECT_NE(read.error().message.find(c.words), std::string::npos) << c.text.substr(0, 200) << "\n"
                                                                     << read.error().describe();
  }
}

TEST(FlightJson, WritesAFileWholeAndReadsIt) {
  const auto path = std::filesystem::temp_directory_path() / "arete-flight-json-test.json";
  FlightPlan plan{.keys = {{.xy = {1, 2}}, {.xy = {3, 4}}}, .speed = 5};
  ASSERT_TRUE(writeFlight(path, plan, {}));
  const auto read = readFlight(path, {});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->plan.keys[1].xy, (Vec2{3, 4}));
  std::filesystem::remove(path);
  const auto missing = readFlight(path, {});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::notFound);
  EXPECT_FALSE(writeFlight("/no/such/folder/flight.json", plan, {}));
}

TEST(FlightJson, BringsKeyFramesOntoTheDemByWholeTurns) {
  Georeference dem;
  dem.isGeographic = true;
  dem.geoTransform = {179, 0.02, 0, -16, 0, -0.02};
  const auto frame = [](double x) {
    return R"({"x": )" + std::to_string(x) + R"(, "y": -16.5, "height": 900, "azimuth": 0, "pitch": 0})";
  };
  const std::string text =
      R"({"speed": 100, "frames": [)" + frame(179.5) + "," + frame(-179.5) + "," + frame(540) + "]}";
  const auto read = readFlightText(text, "f", dem, LongitudeTurns(dem, 100, 50));
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(read->plan.keys.at(0).xy.x, 179.5);
  EXPECT_EQ(read->plan.keys.at(1).xy.x, 180.5);
  EXPECT_EQ(read->plan.keys.at(2).xy.x, 180);
}

}  // namespace
}  // namespace arete
