// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/laws/validate_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "engine/cut/cut.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/laws/errors_law.h"
#include "surface/parted.h"

namespace arete {
namespace {

TEST(ValidateSurface, NamesTheLawThatABrokenModelBreaks) {
  const Result<SurfaceModel> built = buildSurface(SurfaceMesh(shapes::globe(16, 9)));
  ASSERT_TRUE(built);
  ASSERT_TRUE(validateSurface(*built));
  const auto broken = [&](const auto& breakIt) {
    SurfaceModel model = *built;
    auto owner = std::make_shared<std::vector<std::uint32_t>>();
    MtArrays arrays = model.mt.arrays();
    breakIt(model, arrays, *owner);
    model.mt = MultiTriangulation(
        arrays, std::make_shared<std::pair<MultiTriangulation, decltype(owner)>>(built->mt, owner));
    const Status valid = validateSurface(model);
    return valid ? std::string("holds") : valid.error().message;
  };
  using Owner = std::vector<std::uint32_t>;
  EXPECT_NE(broken([](SurfaceModel&, MtArrays& a, Owner& link) {
              link.assign(a.link.begin(), a.link.end());
              std::swap(link[0], link[1]);
              a.link = link;
            }).find("law 2"),
            std::string::npos);
  EXPECT_NE(broken([](SurfaceModel& m, MtArrays&, Owner&) { m.sourceFaces += 1; }).find("law 8"),
            std::string::npos);
  EXPECT_NE(broken([](SurfaceModel& m, MtArrays&, Owner&) { m.vertexOf.pop_back(); }).find("numbers"),
            std::string::npos);
}

TEST(ValidateSurface, FindsErrorsThatAreTooSmall) {
  const std::uint64_t seed = 11;
  for (const shapes::NamedMesh& m : shapes::families(seed)) {
    SCOPED_TRACE(m.name);
    const Result<SurfaceModel> built = buildSurface(SurfaceMesh(m.mesh));
    ASSERT_TRUE(built) << built.error().describe();
    for (const bool everySample : {false, true})
      ASSERT_TRUE(validateSurface(*built, {.everySample = everySample}))
          << validateSurface(*built, {.everySample = everySample}).error().describe();
    const MultiTriangulation& mt = built->mt;
    const Cut root = frontOfPrefix(mt, 0);
    const SourceSamples samples = samplesOfSource(*built, true);
    std::vector<OutwardScale::Code> codes(mt.arrays().error.begin(), mt.arrays().error.end());
    std::fill(codes.begin(), codes.end(), OutwardScale::Code{0});
    MtArrays arrays = mt.arrays();
    arrays.error = codes;
    const MultiTriangulation flat(arrays, nullptr);
    if (root.achievedError > 1e-6 * built->diagonal)
      EXPECT_FALSE(checkErrors(flat, root, samples));
    else
      EXPECT_TRUE(checkErrors(flat, root, samples));
  }
}

TEST(SurfaceTopology, RefusesAFrontOfAnotherTopology) {
  const Result<SurfaceModel> built = buildSurface(SurfaceMesh(shapes::globe(16, 9)));
  ASSERT_TRUE(built);
  const Result<SurfaceTopology> topology = SurfaceTopology::of(built->mt);
  ASSERT_TRUE(topology);
  Cut cut = frontOfPrefix(built->mt, 20);
  EXPECT_TRUE(topology->check(cut));
  Cut holed = cut;
  holed.triangles.pop_back();
  holed.ids.pop_back();
  EXPECT_FALSE(topology->check(holed));
  Cut doubled = cut;
  doubled.triangles.push_back(doubled.triangles[0]);
  doubled.ids.push_back(doubled.ids[0]);
  EXPECT_FALSE(topology->check(doubled));
  Cut turned = cut;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_FALSE(topology->check(turned));
}

TEST(ValidateSurface, HoldsErrorsOfLinesAgainstTheSamePart) {
  // A flat plate: only its line can be off.
  const TriangleMesh plate = shapes::sheet(16, 16);
  std::vector<std::uint32_t> parts;
  for (const auto& [a, b, c] : plate.triangles) {
    const Vec3 p = (plate.positions[a] + plate.positions[b] + plate.positions[c]) / 3.0;
    parts.push_back(norm(p - Vec3{8, 8, 0}) < 5 ? 1 : 0);
  }
  for (const parted::Carriers& carriers :
       {parted::Carriers{.materials = true}, parted::Carriers{.labels = true},
        parted::Carriers{.charts = true}}) {
    Result<SurfaceModel> model = buildSurface(parted::withParts(plate, parts, carriers));
    ASSERT_TRUE(model);
    ASSERT_TRUE(validateSurface(*model, {.everySample = true}));
    const MultiTriangulation& mt = model->mt;
    EXPECT_GT(mt.largestError(), 0.1);
    std::vector<OutwardScale::Code> codes(mt.arrays().error.size(), mt.arrays().scale.encode(1e-6));
    MtArrays arrays = mt.arrays();
    arrays.error = codes;
    const MultiTriangulation flat(arrays, nullptr);
    const SourceSamples samples = samplesOfSource(*model, true);
    const Cut root = frontOfPrefix(mt, 0);
    EXPECT_TRUE(checkErrors(mt, root, samples));
    EXPECT_FALSE(checkErrors(flat, root, samples)) << "the line is not where it was";
    // A model of an earlier version promises less, and is not held against more.
    model->boundsLines = false;
    EXPECT_TRUE(checkErrors(flat, root, samplesOfSource(*model, true)));
  }
}

}  // namespace
}  // namespace arete
