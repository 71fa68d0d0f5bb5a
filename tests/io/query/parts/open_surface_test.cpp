// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces that stay open: their cuts are the whole's, and an error of one question is not the next one's.
#include "io/query/parts/open_surface.h"

#include <cpl_conv.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <iterator>
#include <string>

#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/http_server.h"
#include "io/io_fixture.h"
#include "io/query/parts/parts_fixture.h"
#include "io/query/surface/take_surface.h"
#include "io/store/amt/surface_file.h"
#include "surface/builder/build.h"
#include "surface/families.h"

namespace arete {
namespace {

using test::got;
using test::HttpFault;
using test::HttpServer;
using test::TemporaryFolder;

class OpenSurfaceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", "0");
    path_ = folder_.file("globe.amt");
    ASSERT_TRUE(writeSurfaceAmt(path_, got(buildSurface(SurfaceMesh(shapes::globe(150, 90)))), {},
                                {.isPaged = true}));
    whole_ = got(loadSurfaceAmt(path_));
  }
  void TearDown() override { CPLSetConfigOption("GDAL_HTTP_MAX_RETRY", nullptr); }
  static std::shared_ptr<OpenSurface> opened(const std::string& path) {
    return got(OpenSurface::open(got(LastingFile::open(path))));
  }
  static ExtractRequest within(double error) {
    ExtractRequest request;
    request.criterion.maxError = error;
    return request;
  }

  TemporaryFolder folder_;
  std::string path_;
  SurfaceModel whole_;
};

TEST_F(OpenSurfaceTest, SaysOfTheWholeWhatTheWholeIs) {
  const auto surface = opened(path_);
  EXPECT_TRUE(surface->isInParts());
  EXPECT_LT(surface->outline().mt.nodeCount(), whole_.mt.nodeCount() / 4);
  EXPECT_EQ(surface->vertexCount(), whole_.mt.vertexCount());
  EXPECT_EQ(surface->triangleCount(), whole_.mt.triangleCount());
  EXPECT_EQ(surface->finestTriangleCount(), whole_.mt.finestTriangleCount());
  EXPECT_EQ(got(surface->largestError()), whole_.mt.largestError());
}

TEST_F(OpenSurfaceTest, TakesTheCutsOfTheWholeOfItsParts) {
  for (const double error : {0.1, 0.01, 0.0}) {
    const ExtractRequest request = within(error);
    const auto part = got(opened(path_)->forRequest(request));
    const TakenSurface mine = got(takeSurface(*part, request.criterion)),
                       its = got(takeSurface(whole_, request.criterion));
    EXPECT_EQ(mine.front.mesh.triangles, its.front.mesh.triangles);
    EXPECT_EQ(mine.front.mesh.positions, its.front.mesh.positions);
    EXPECT_EQ(mine.front.vertexOf, its.front.vertexOf);
    EXPECT_EQ(mine.error, its.error);
  }
}

TEST_F(OpenSurfaceTest, KeepsTheWholeThatAQuestionNeeded) {
  const auto surface = opened(path_);
  ExtractRequest fit = within(0.1);
  fit.criterion.fit = CutFit::rms;
  const auto all = got(surface->forRequest(fit));
  EXPECT_FALSE(all->finestOfWhole);
  EXPECT_EQ(got(surface->whole()), all);
  EXPECT_EQ(got(surface->forRequest(within(0.1))), all);
}

TEST_F(OpenSurfaceTest, AServerThatFailedIsAskedAgainByTheNextQuestion) {
  std::ifstream file(path_, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  std::atomic<bool> isDown = false;
  const HttpServer server({{"g.amt", bytes}}, [&](const std::string&, int) {
    HttpFault fault;
    if (isDown) fault.status = 503;
    return fault;
  });
  const auto surface = opened(server.address("g.amt"));
  isDown = true;
  const auto refused = surface->forRequest(within(0));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().describe().find(server.address("g.amt")), std::string::npos);
  isDown = false;
  EXPECT_EQ(got(surface->forRequest(within(0)))->mt.nodeCount(), whole_.mt.nodeCount());
}

}  // namespace
}  // namespace arete
