// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is read of a surface in pages for a request, and that the mesh does not differ from what the whole
// file gives.
#include "io/query/surface/surface_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "engine/criteria/space_region.h"
#include "io/files/network/network_use.h"
#include "io/http_server.h"
#include "io/io_fixture.h"
#include "io/query/extract/model_file.h"
#include "io/query/surface/extractor.h"
#include "io/query/surface/take_surface.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/mesh_with_everything.h"

namespace arete {
namespace {

using test::TemporaryFolder;

std::string bytesOfFile(const std::string& path) {
  std::ifstream from(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(from), {}};
}

using Facet = std::array<std::tuple<double, double, double>, 3>;
std::vector<Facet> facetsOf(const SurfaceMesh& mesh) {
  std::vector<Facet> facets;
  for (const auto& triangle : mesh.triangles) {
    Facet facet;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = mesh.positions[triangle[c]];
      facet[c] = {p.x, p.y, p.z};
    }
    std::rotate(facet.begin(), std::ranges::min_element(facet), facet.end());
    facets.push_back(facet);
  }
  std::ranges::sort(facets);
  return facets;
}

ExtractRequest requestFor(const std::function<void(CutRequest&)>& ask) {
  ExtractRequest request;
  request.output = "a.ply";
  ask(request.criterion);
  return request;
}

/// A hilly sheet of 40 000 vertices in pages.
class SurfacePart : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    model = new SurfaceModel(*buildSurface(SurfaceMesh(shapes::shaken(shapes::hills(200, 3), 5, 0.02))));
    ASSERT_TRUE(writeSurfaceAmt(path(), *model, {}, {.isPaged = true}));
  }
  static void TearDownTestSuite() {
    delete model;
    delete folder;
  }
  static std::string path() { return folder->file("a.amt"); }

  static std::shared_ptr<const SpaceRegion> ball(double share) {
    return std::make_shared<BallRegion>(model->mt.position(VertexId(1000)), share * model->diagonal);
  }

  static TemporaryFolder* folder;
  static SurfaceModel* model;
};
TemporaryFolder* SurfacePart::folder = nullptr;
SurfaceModel* SurfacePart::model = nullptr;

TEST_F(SurfacePart, HasTheMeshOfTheWholeForEveryKindOfRequest) {
  const AmtContainer file = *AmtContainer::open(path());
  const SurfaceModel whole = *loadSurfaceAmt(file);
  const double d = model->diagonal;
  int parts = 0;
  const std::function<void(CutRequest&)> kinds[] = {
      [&](CutRequest& c) { c.maxError = 0.01 * d; },
      [&](CutRequest& c) { c.maxError = 0.001 * d; },
      [&](CutRequest& c) { c.maxError = 0; },
      [&](CutRequest& c) {
        c.maxError = 0.005 * d;
        c.method = CutMethod::saturated;
      },
      [&](CutRequest& c) { c.maxTriangles = 300; },
      [&](CutRequest& c) { c.maxTriangles = 5000; },
      [&](CutRequest& c) {
        c.maxTriangles = 900;
        c.maxError = 0.0005 * d;
      },
      [&](CutRequest& c) {
        c.spaceRegion = ball(0.02);
        c.maxError = 0;
      },
      [&](CutRequest& c) {
        c.spaceRegion = ball(0.1);
        c.maxError = 0.0005 * d;
        c.outsideError = 0.02 * d;
      },
      [&](CutRequest& c) {
        c.focus = CutRequest::Focus{.xy = {20, 20}, .growth = 0.05, .z = 0};
        c.maxError = 0.0001 * d;
      }};
  for (const auto& ask : kinds) {
    SCOPED_TRACE(&ask - kinds);
    const ExtractRequest request = requestFor(ask);
    const Result<SurfaceModel> part = readForExtract(file, {{request}}, *readOutline(file));
    ASSERT_TRUE(part) << part.error().message;
    parts += part->finestOfWhole ? 1 : 0;
    const auto ofPart = takeSurface(*part, request.criterion),
               ofWhole = takeSurface(whole, request.criterion);
    ASSERT_TRUE(ofPart && ofWhole);
    EXPECT_TRUE(ofPart->whole.missing.empty());
    if (request.criterion.spaceRegion || request.criterion.focus) {
      // The balls of a part are larger.
      EXPECT_LE(ofPart->front.mesh.triangles.size(), 1.02 * double(ofWhole->front.mesh.triangles.size()) + 4);
      EXPECT_GE(ofPart->front.mesh.triangles.size(), ofWhole->front.mesh.triangles.size());
      continue;
    }
    EXPECT_EQ(ofPart->error, ofWhole->error);
    // A budget may spend itself otherwise where triangles are equally bad.
    if (request.criterion.maxTriangles) {
      EXPECT_EQ(ofPart->front.mesh.triangles.size(), ofWhole->front.mesh.triangles.size());
    } else {
      EXPECT_TRUE(facetsOf(ofPart->front.mesh) == facetsOf(ofWhole->front.mesh));
    }
  }
  EXPECT_GE(parts, 6);
}

TEST_F(SurfacePart, OfSeveralRequestsDoesForAllOfThem) {
  const AmtContainer file = *AmtContainer::open(path());
  const std::vector<ExtractRequest> requests = {
      requestFor([](CutRequest& c) { c.maxError = 0.02 * model->diagonal; }),
      requestFor([](CutRequest& c) { c.maxTriangles = 700; }),
      requestFor([](CutRequest& c) { c.maxError = 0.003 * model->diagonal; })};
  const Result<SurfaceModel> part = readForExtract(file, requests, *readOutline(file));
  ASSERT_TRUE(part) << part.error().message;
  for (const ExtractRequest& request : requests) {
    const auto ofPart = takeSurface(*part, request.criterion),
               ofWhole = takeSurface(*model, request.criterion);
    ASSERT_TRUE(ofPart && ofWhole);
    EXPECT_EQ(facetsOf(ofPart->front.mesh).size(), facetsOf(ofWhole->front.mesh).size());
    EXPECT_TRUE(ofPart->whole.missing.empty());
  }
}

TEST_F(SurfacePart, IsEverythingWhereTheSourceIsNeeded) {
  const AmtContainer file = *AmtContainer::open(path());
  ExtractRequest request = requestFor([](CutRequest& c) { c.maxError = 0.01 * model->diagonal; });
  const auto isWhole = [&](const std::function<void(ExtractRequest&)>& change) {
    ExtractRequest changed = request;
    change(changed);
    const Result<SurfaceModel> read = readForExtract(file, {{changed}}, *readOutline(file));
    return read && !read->finestOfWhole;
  };
  EXPECT_FALSE(isWhole([](ExtractRequest&) {}));
  EXPECT_TRUE(isWhole([](ExtractRequest& r) { r.certificate = "c.json"; }));
  EXPECT_TRUE(isWhole([](ExtractRequest& r) { r.map = "m.csv"; }));
  EXPECT_TRUE(isWhole([](ExtractRequest& r) { r.measuresBothWays = true; }));
  EXPECT_TRUE(isWhole([](ExtractRequest& r) { r.criterion.fit = CutFit::rms; }));
  EXPECT_TRUE(isWhole([](ExtractRequest& r) { r.criterion.dropParts = 0.1; }));
  EXPECT_TRUE(isWhole([](ExtractRequest& r) { r.criterion.importance = "quality"; }));
  EXPECT_TRUE(isWhole([](ExtractRequest& r) {
    r.criterion.spaceRegion = ball(0.1);
    r.criterion.method = CutMethod::saturated;
  }));
  // A deadline ends the cut wherever it is.
  EXPECT_TRUE(isWhole([](ExtractRequest& r) { r.criterion.deadlineMilliseconds = 1000; }));
}

TEST_F(SurfacePart, OnAServerIsFetchedByFewRequests) {
  const std::string bytes = bytesOfFile(path());
  const test::HttpServer server({{"a.amt", bytes}}, {});
  const auto fetchedFor = [&](const std::function<void(CutRequest&)>& ask) {
    const NetworkUse before = networkUse();
    const AmtContainer file = *openModelFile(server.address("a.amt"), {});
    const Result<SurfaceModel> part = readForExtract(file, {{requestFor(ask)}}, *readOutline(file));
    EXPECT_TRUE(part && part->finestOfWhole);
    return NetworkUse{networkUse().requests - before.requests, networkUse().bytes - before.bytes};
  };
  const NetworkUse coarse = fetchedFor([](CutRequest& c) { c.maxError = 0.02 * model->diagonal; });
  EXPECT_LE(coarse.requests, 6u);
  EXPECT_LT(coarse.bytes, bytes.size() / 3);
  const NetworkUse near = fetchedFor([](CutRequest& c) {
    c.spaceRegion = ball(0.01);
    c.maxError = 0;
  });
  EXPECT_LE(near.requests, 12u);
  EXPECT_LT(near.bytes, bytes.size() / 2);
}

TEST_F(SurfacePart, ReadsTheSourceOnceForWhatCrossesInIt) {
  // The sheet is laid over itself, so that cuts of it cross.
  SurfaceMesh folded(shapes::hills(60, 3));
  const std::size_t half = folded.positions.size() / 2;
  for (std::size_t v = half; v < folded.positions.size(); ++v) {
    Vec3& p = folded.positions[v];
    p.y = folded.positions[half].y - (p.y - folded.positions[half].y) + 0.01 * p.x;
  }
  const SurfaceModel crossed = *buildSurface(folded);
  const std::string name = folder->file("crossed.amt");
  ASSERT_TRUE(writeSurfaceAmt(name, crossed, {}, {.isPaged = true}));
  const AmtContainer file = *AmtContainer::open(name);
  ExtractRequest request = requestFor([&](CutRequest& c) { c.maxError = 0.01 * crossed.diagonal; });
  request.output = folder->file("crossed.ply");
  const SurfaceModel part = *readForExtract(file, {{request}}, *readOutline(file));
  ASSERT_TRUE(part.finestOfWhole);
  int reads = 0;
  SurfaceExtractor ofPart(part, name, {}, [&] {
    ++reads;
    return loadSurfaceAmt(file);
  });
  SurfaceExtractor ofWhole(crossed, name);
  const auto one = ofPart.extract(request);
  request.output = folder->file("whole.ply");
  const auto other = ofWhole.extract(request);
  ASSERT_TRUE(one) << one.error().message;
  ASSERT_TRUE(other) << other.error().message;
  ASSERT_GT(other->crossings, 0u);
  EXPECT_EQ(one->crossings, other->crossings);
  EXPECT_EQ(one->sourceCrossings, other->sourceCrossings);
  EXPECT_EQ(one->finestTriangles, other->finestTriangles);
  EXPECT_EQ(reads, 1);
}

}  // namespace
}  // namespace arete
