// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/certificate/certificate.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/io_fixture.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

TerrainModel someModel(bool isRaster = true) {
  TerrainModel model;
  model.isRaster = isRaster;
  model.columns = isRaster ? 30 : 0;
  model.rows = isRaster ? 20 : 0;
  model.source = "dem.tif";
  model.sourceChecksum = "xxh3-128:00";
  model.georeference.verticalUnit = "metre";
  return model;
}

Certificate someCertificate() {
  Certificate certificate;
  certificate.file = "tin.ply";
  certificate.model = "dem.amt";
  certificate.format.name = "PLY";
  certificate.criterion.maxError = 5;
  certificate.promisedError = 5;
  certificate.storedError = 4.5;
  certificate.isKept = true;
  certificate.checkCommand = "arete measure tin.ply dem.tif --expect 5";
  certificate.measured.worst = MeasuredSample{.sample = 3, .column = 3};
  return certificate;
}

TEST(Certificate, StatesThePromiseAndHowToCheckIt) {
  const json j = json::parse(certificateJson(someCertificate(), someModel()));
  EXPECT_EQ(j["areteCertificate"], 1);
  EXPECT_EQ(j["file"], "tin.ply");
  EXPECT_EQ(j["model"]["path"], "dem.amt");
  EXPECT_EQ(j["criterion"]["maxError"], 5);
  EXPECT_EQ(j["criterion"]["method"], "minimal");
  EXPECT_EQ(j["promise"]["maxError"], 5);
  EXPECT_EQ(j["promise"]["storedError"], 4.5);
  EXPECT_EQ(j["promise"]["kept"], true);
  EXPECT_EQ(j["complete"], true);
  EXPECT_EQ(j["check"], "arete measure tin.ply dem.tif --expect 5");
  EXPECT_EQ(j["source"]["columns"], 30);
  for (const char* absent : {"fit", "measuredInside"}) EXPECT_FALSE(j.contains(absent)) << absent;
  for (const char* absent : {"region", "focus", "camera", "outsideError", "fit"})
    EXPECT_FALSE(j["criterion"].contains(absent)) << absent;
}

TEST(Certificate, HasNullWhereThereIsNoLimit) {
  Certificate certificate = someCertificate();
  certificate.criterion.region = "1,2,3,4";
  certificate.promisedError = std::numeric_limits<double>::infinity();
  const json j = json::parse(certificateJson(certificate, someModel()));
  EXPECT_TRUE(j["promise"]["maxError"].is_null());
  EXPECT_TRUE(j["criterion"]["outsideError"].is_null());
}

TEST(Certificate, SaysWhatTheFormatHoldsAndWhatIsMissingInIt) {
  Certificate certificate = someCertificate();
  certificate.format.saysErrors = true;
  const json format = json::parse(certificateJson(certificate, someModel()))["format"];
  EXPECT_EQ(format["says"], json::array({"errors"}));
  EXPECT_EQ(format["doesNotSay"]["verticalUnit"], "metre");
  EXPECT_FALSE(format.contains("origin"));
  EXPECT_FALSE(format.contains("planTolerancePixels"));
}

TEST(Certificate, StatesTheFitAndTheCriterionsPlaces) {
  Certificate certificate = someCertificate();
  certificate.fit = FitFigures{100, 5};
  certificate.criterion.fit = CutFit::triangles;
  certificate.criterion.focus = {.xy = {1, 2}, .growth = 0.25};
  certificate.criterion.camera = Camera();
  certificate.criterion.camera->azimuthDegrees = 45;
  certificate.criterion.deadlineMilliseconds = 7;
  const json j = json::parse(certificateJson(certificate, someModel()));
  EXPECT_EQ(j["fit"]["trianglesBefore"], 100);
  EXPECT_EQ(j["criterion"]["fit"], "triangles");
  EXPECT_EQ(j["criterion"]["focus"]["errorGrowth"], 0.25);
  EXPECT_EQ(j["criterion"]["camera"]["azimuth"], 45);
  EXPECT_TRUE(j["criterion"]["pixelError"].is_null());
  EXPECT_EQ(j["criterion"]["deadlineMilliseconds"], 7);
}

TEST(Certificate, NumbersNoScatteredPoint) {
  const json j = json::parse(certificateJson(someCertificate(), someModel(false)));
  EXPECT_FALSE(j["measured"]["error"]["worst"].contains("point"));
  EXPECT_FALSE(j["source"].contains("columns"));
  EXPECT_EQ(j["source"]["kind"], "points");
}

TEST(Certificate, IsJsonWhateverBytesAPathHas) {
  Certificate certificate = someCertificate();
  certificate.file = "caf\xe9.ply";
  const json j = json::parse(certificateJson(certificate, someModel()), nullptr, false);
  EXPECT_TRUE(j.is_object());
}

TEST(Certificate, IsWrittenWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string path = folder.file("c.json");
  ASSERT_TRUE(writeCertificate(path, someCertificate(), someModel()));
  EXPECT_EQ(test::bytesOf(path), certificateJson(someCertificate(), someModel()));
  EXPECT_FALSE(writeCertificate(folder.file("none/c.json"), someCertificate(), someModel()));
}

}  // namespace
}  // namespace arete
