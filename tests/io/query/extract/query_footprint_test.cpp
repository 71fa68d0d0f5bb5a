// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is read of a model, packed or not, for a question answers it as the whole does: heights, lines of
// sight, cuts for a region or around a place.
#include "io/query/extract/query_footprint.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/cut/cut.h"
#include "engine/laws/validate.h"
#include "full_run.h"
#include "io/amt_fixture.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/reader.h"
#include "io/io_fixture.h"
#include "io/query/request/criterion.h"
#include "io/store/amt/file.h"
#include "terrain/locate/ground_height.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {
namespace {

using test::built;
using test::TemporaryFolder;

constexpr double kNothing = std::numeric_limits<double>::infinity();

const RasterFamily& fieldNamed(std::string_view name) {
  return *std::ranges::find(rasterFamilies(), name, &RasterFamily::name);
}

/// A file, its whole model, and its outline.
struct FiledTerrain {
  FiledTerrain(const TerrainModel& model, const std::string& path, bool isPacked = true) {
    const Status written = writeAmt(path, model, {}, {.isPacked = isPacked});
    if (!written) throw std::runtime_error(written.error().describe());
    file = *openAmt(path);
    whole = built(file->read());
    outline = built(file->read({.wanted = requiredNowhere()}));
    EXPECT_EQ(outline.mt.nodeCount(), 0u);
    for (std::uint32_t i = 0; i < outline.mt.rootVertexCount(); ++i) {
      const Vec2 p = outline.mt.vertices().planPosition(VertexId(i));
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  TerrainModel part(const RequiredError& wanted) const {
    TerrainModel model = built(file->read({.wanted = wanted}));
    const Status laws = validate(model.mt, {.allowsFills = whole.options.rimTolerance > 0});
    EXPECT_TRUE(laws) << laws.error().describe();
    return model;
  }
  /// A place in plan, one in eight beside the terrain.
  Vec2 placeIn(Random& random) const {
    const double beyond = random.below(8) == 0 ? 0.2 : 0;
    const auto between = [&](double from, double to) {
      return from + (random.between(0, 1) * (1 + 2 * beyond) - beyond) * (to - from);
    };
    Vec2 p{between(low.x, high.x), between(low.y, high.y)};
    if (random.below(3) == 0 && whole.isRaster) p = {std::round(p.x), std::round(p.y)};
    return p;
  }

  std::optional<AmtFile> file;
  TerrainModel whole, outline;
  Vec2 low{kNothing, kNothing}, high{-kNothing, -kNothing};
};

std::vector<TerrainModel> modelsOfAllKinds() {
  std::vector<TerrainModel> models;
  for (const char* name : {"fractal", "nodata holes", "integer", "rotated"})
    models.push_back(built(
        build(test::isBrief() ? fieldNamed(name).make(150, 140, 3) : fieldNamed(name).make(300, 280, 3))));
  if (test::isBrief()) return models;
  BuildOptions rims;
  rims.rimTolerance = 2;
  models.push_back(built(build(fieldNamed("nodata holes").make(280, 290, 4), rims)));
  models.push_back(
      built(build(fieldNamed("fractal").make(290, 270, 5), {.shape = HoleShape::dataDependent})));
  for (const PointFamily& family : pointFamilies()) models.push_back(built(build(family.make(900, 6))));
  return models;
}

/// visit(filed, random) for each of them, packed and plain.
template <class Visit>
void forAllKinds(const Visit& visit) {
  const TemporaryFolder folder;
  std::uint64_t seed = 0;
  for (const TerrainModel& model : modelsOfAllKinds()) {
    ++seed;
    for (const bool isPacked : {true, false}) {
      const FiledTerrain filed(model, folder.file("model.amt"), isPacked);
      Random random(seed);
      SCOPED_TRACE(fmt::format("seed {}, {}", seed, isPacked ? "packed" : "plain"));
      visit(filed, random);
    }
  }
}

TEST(QueryFootprint, AreWantedByEveryBoxThatHoldsOneAndByNoneFarFromAll) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(60, 40, 1))), folder.file("model.amt"));
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    QueryFootprint wanted(filed.outline);
    std::vector<Vec2> places;
    for (std::uint64_t i = random.below(4); i-- > 0;) {
      const Vec2 from{random.between(0, 59), random.between(0, 39)},
          to{random.between(0, 59), random.between(0, 39)};
      wanted.addLine(from, to);
      for (int k = 0; k <= 1000; ++k)
        places.push_back({from.x + k / 1000.0 * (to.x - from.x), from.y + k / 1000.0 * (to.y - from.y)});
    }
    for (std::uint64_t i = random.below(5); i-- > 0;) {
      places.push_back({random.between(0, 59), random.between(0, 39)});
      wanted.add(places.back());
    }
    wanted.add({std::nan(""), 3});
    wanted.addLine({1, 2}, {kNothing, 3});
    const RequiredError within = wanted.within(2.5);
    for (int i = 0; i < 50; ++i) {
      const double x = random.between(-5, 60), y = random.between(-5, 40);
      const double width = random.between(0, 12), height = random.between(0, 12);
      const auto holdsOne = [&](double margin) {
        return std::ranges::any_of(places, [&](Vec2 p) {
          return p.x >= x - margin && p.x <= x + width + margin && p.y >= y - margin &&
                 p.y <= y + height + margin;
        });
      };
      const double error = within(overPlan({x, y, x + width, y + height}));
      if (holdsOne(0)) {
        EXPECT_EQ(error, 2.5) << "seed " << seed;
      }
      // Cells are a tenth of a sample wide; a box beside the terrain counts as its rim.
      if (x >= 0 && y >= 0 && x + width <= 59 && y + height <= 39 && !holdsOne(1.5)) {
        EXPECT_EQ(error, kNothing) << "seed " << seed;
      }
    }
    EXPECT_EQ(within(overPlan({3, 3, 2, 2})), kNothing) << "an empty box";
    EXPECT_EQ(within(overPlan({std::nan(""), 0, 1, 1})), kNothing);
  }
}

TEST(QueryFootprint, ReachASampleBesideThemOnARaster) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(60, 40, 1))), folder.file("model.amt"));
  QueryFootprint wanted(filed.outline);
  wanted.addLine({10, 10}, {20, 10});
  const RequiredError within = wanted.within(0);
  EXPECT_EQ(within(overPlan({20.9, 9, 23, 11})), 0);
  EXPECT_EQ(within(overPlan({12, 7, 13, 9.1})), 0);
  EXPECT_EQ(within(overPlan({21.5, 9, 23, 11})), kNothing);
}

TEST(QueryFootprint, TakeLinesFarBeyondTheTerrain) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(60, 40, 1))), folder.file("model.amt"));
  QueryFootprint wanted(filed.outline);
  wanted.addLine({-1e12, 20}, {1e12, 20});
  EXPECT_EQ(wanted.within(1)(overPlan({10, 19, 12, 21})), 1);
}

TEST(QueryFootprint, HaveTheHeightsOfTheWholeWhenOnlyTheyAreRead) {
  forAllKinds([](const FiledTerrain& filed, Random& random) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{40}}) {
      std::vector<Vec2> places;
      QueryFootprint wanted(filed.outline);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec2 plan = filed.placeIn(random);
        places.push_back(filed.whole.toSource(plan));
        wanted.add(filed.outline.toPlan(places.back()));
      }
      const TerrainModel part = filed.part(wanted.within(0));
      EXPECT_LE(part.mt.nodeCount(), filed.whole.mt.nodeCount());
      const GroundHeights ofWhole(filed.whole), ofPart(part);
      for (const Vec2 place : places)
        for (const double maxError : {0.0, 0.3, 20.0}) {
          const auto x = ofWhole.at(place, maxError), y = ofPart.at(place, maxError);
          ASSERT_EQ(x.has_value(), y.has_value());
          if (!x) continue;
          EXPECT_EQ(x->height, y->height);
          EXPECT_EQ(x->below, y->below);
          EXPECT_EQ(x->above, y->above);
          EXPECT_EQ(x->nodesVisited, y->nodesVisited);
        }
    }
  });
}

TEST(QueryFootprint, HaveTheLinesOfSightOfTheWholeWhenOnlyTheyAreRead) {
  forAllKinds([](const FiledTerrain& filed, Random& random) {
    const auto earth = makePlaneEarth(filed.outline);
    for (int i = 0; i < 12; ++i) {
      const Vec2 from = filed.placeIn(random), to = filed.placeIn(random);
      const auto track = earth->track(from, to);
      ASSERT_TRUE(track);
      QueryFootprint wanted(filed.outline);
      wanted.addTrack(*track);
      const TerrainModel part = filed.part(wanted.within(0));
      const double middle = filed.whole.mt.position(VertexId(0)).z;
      const SightLine line(*track, middle + random.between(-50, 200), middle + random.between(-50, 200));
      const auto ofWhole = makeSightDescent(filed.whole), ofPart = makeSightDescent(part);
      for (const double maxError : {0.0, 5.0}) {
        const SightAnswer x = ofWhole->answer(line, {.maxError = maxError}),
                          y = ofPart->answer(line, {.maxError = maxError});
        EXPECT_EQ(x.verdict, y.verdict);
        EXPECT_EQ(x.clearance, y.clearance);
        EXPECT_EQ(x.least.distance, y.least.distance);
        EXPECT_EQ(x.gapMetres, y.gapMetres);
        EXPECT_EQ(x.visited, y.visited);
        ASSERT_EQ(x.obstruction.has_value(), y.obstruction.has_value());
        if (x.obstruction) {
          EXPECT_EQ(x.obstruction->distance, y.obstruction->distance);
        }
      }
    }
  });
}

void expectSameViewshed(const Viewshed& x, const Viewshed& y) {
  EXPECT_TRUE(x.cells == y.cells);
  ASSERT_EQ(x.values.size(), y.values.size());
  for (std::size_t i = 0; i < x.values.size(); ++i)
    if (!(x.values[i] == y.values[i] || (std::isnan(x.values[i]) && std::isnan(y.values[i])))) {
      ADD_FAILURE() << "cell " << i << ": " << x.values[i] << " and " << y.values[i];
      return;
    }
  EXPECT_EQ(x.rays, y.rays);
  EXPECT_EQ(x.method, y.method);
}

/// From places in the terrain, as far as a camera sees.
void expectViewshedsOfTheWhole(const FiledTerrain& filed, const SightEarth& earth, double metres,
                               Random& random) {
  const auto ofWhole = ViewshedMaker::make(filed.whole, earth);
  ASSERT_TRUE(ofWhole);
  for (const ViewshedValue value :
       {ViewshedValue::none, ViewshedValue::leastHeight, ViewshedValue::horizon}) {
    const Vec2 place = filed.placeIn(random);
    ViewshedOptions options;
    options.field.greatestMetres = metres * random.between(0, 1);
    options.targetHeight = random.below(2) == 0 ? 0 : 3;
    options.value = value;
    QueryFootprint wanted(filed.outline);
    wanted.addDisc(earth, place, options.field.greatestMetres);
    const TerrainModel part = filed.part(wanted.within(0));
    const auto ofPart = ViewshedMaker::make(part, earth);
    ASSERT_TRUE(ofPart);
    const ViewshedObserver observer{place, filed.whole.mt.position(VertexId(0)).z + random.between(-20, 100)};
    const auto x = ofWhole->from(observer, options), y = ofPart->from(observer, options);
    ASSERT_EQ(x.has_value(), y.has_value());
    if (x) expectSameViewshed(*x, *y);
  }
}

TEST(QueryFootprint, HaveTheViewshedsOfTheWholeWhenOnlyTheirDiscIsRead) {
  forAllKinds([](const FiledTerrain& filed, Random& random) {
    if (!filed.whole.isRaster) return;
    const auto earth = makePlaneEarth(filed.outline);
    const double across = *earth->distance(filed.low, filed.high);
    expectViewshedsOfTheWhole(filed, *earth, 0.4 * across, random);
  });
}

TEST(QueryFootprint, HaveTheViewshedsOfTheWholeOnAnEllipsoidWhereAParallelIsShort) {
  const TemporaryFolder folder;
  RasterHeightfield field = fieldNamed("fractal").make(240, 200, 5);
  for (const double latitude : {0.5, 72.0}) {
    field.georeference = {};
    field.georeference.geoTransform = {7, 1.0 / 1200, 0, latitude, 0, -1.0 / 1200};
    field.georeference.hasGeoTransform = true;
    const auto crs = crsFromText("EPSG:4326");
    ASSERT_TRUE(crs && describeCrs(*crs, field.georeference));
    for (const bool isPacked : {true, false}) {
      const FiledTerrain filed(built(build(field)), folder.file("model.amt"), isPacked);
      const auto earth = makeEllipsoidEarth(filed.outline, 1.0 / 7);
      ASSERT_TRUE(earth) << earth.error().describe();
      Random random(static_cast<std::uint64_t>(latitude));
      expectViewshedsOfTheWhole(filed, **earth, 9000, random);
    }
  }
}

TEST(QueryFootprint, WantADiscAndLittleBesideIt) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(60, 40, 1))), folder.file("model.amt"));
  const auto earth = makePlaneEarth(filed.outline);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Vec2 centre = filed.placeIn(random);
    const double metres = random.between(0, 1.2) * *earth->distance({0, 0}, {20, 0});
    QueryFootprint wanted(filed.outline);
    wanted.addDisc(*earth, centre, metres);
    const RequiredError within = wanted.within(0);
    for (int i = 0; i < 400; ++i) {
      const Vec2 p{random.between(0, 59), random.between(0, 39)};
      const double distance = *earth->distance(centre, p), sample = *earth->distance({0, 0}, {1, 1});
      const double error = within(overPlan({p.x, p.y, p.x, p.y}));
      if (distance <= metres) {
        EXPECT_EQ(error, 0) << "seed " << seed;
      }
      if (distance > metres + 8 * sample) {
        EXPECT_EQ(error, kNothing) << "seed " << seed;
      }
    }
  }
}

/// A plane that counts how often it is asked for a distance.
class CountingEarth final : public SightEarth {
 public:
  explicit CountingEarth(const TerrainModel& model) : plane_(makePlaneEarth(model)) {}
  Result<SightTrack> track(Vec2 from, Vec2 to) const override { return plane_->track(from, to); }
  std::optional<double> distance(Vec2 from, Vec2 to) const override {
    ++distances;
    return plane_->distance(from, to);
  }
  mutable int distances = 0;

 private:
  std::unique_ptr<SightEarth> plane_;
};

TEST(QueryFootprint, WantTheRectangleOfAMapAboutTheirDiscs) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(60, 40, 1))), folder.file("model.amt"));
  const auto earth = makePlaneEarth(filed.outline);
  QueryFootprint wanted(filed.outline);
  wanted.addRectangle(0.5);
  EXPECT_EQ(wanted.within(0)(overPlan({0, 0, 59, 39})), kNothing) << "about nothing is nothing";
  const double metres = *earth->distance({0, 0}, {5, 0});
  wanted.addDisc(*earth, {20, 20}, metres);
  wanted.addDisc(*earth, {30, 20}, metres);
  wanted.addRectangle(0.1);
  const RequiredError within = wanted.within(0);
  for (double x = 13.5; x < 36.5; ++x)
    for (double y = 13.5; y < 26.5; ++y) EXPECT_EQ(within(overPlan({x, y, x, y})), 0) << x << " " << y;
  for (const Vec2 far : {Vec2{2, 15}, {50, 15}, {20, 1}, {20, 37}})
    EXPECT_EQ(within(overPlan({far.x, far.y, far.x, far.y})), kNothing) << far.x << " " << far.y;
}

TEST(QueryFootprint, AskForNoDistanceWhereADiscIsWantedAlready) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(60, 40, 1))), folder.file("model.amt"));
  const CountingEarth earth(filed.outline);
  const double metres = *earth.distance({0, 0}, {20, 0});
  QueryFootprint wanted(filed.outline);
  wanted.addDisc(earth, {30, 20}, 2 * metres);
  const int first = std::exchange(earth.distances, 0);
  wanted.addDisc(earth, {31, 21}, metres);
  EXPECT_LT(earth.distances, first / 10);
  wanted.addDisc(earth, {30, 20}, 100 * metres);
  earth.distances = 0;
  wanted.addDisc(earth, {5, 7}, 100 * metres);
  EXPECT_EQ(earth.distances, 0);
}

/// The front of a cut in the order in which it is written, told without a number of the MT.
std::vector<double> frontOf(const MultiTriangulation& mt, const Cut& cut) {
  std::vector<double> front;
  for (const std::uint32_t v : cut.vertices) {
    const Vec3 p = mt.position(VertexId(v));
    front.insert(front.end(), {p.x, p.y, p.z});
  }
  for (const auto& corners : cut.triangles) front.insert(front.end(), corners.begin(), corners.end());
  for (const std::uint32_t id : cut.ids) front.push_back(mt.error(TriangleId(id)));
  return front;
}

/// Whether all of a cut's triangles satisfy the criterion.
bool isFineEnough(const MultiTriangulation& mt, const Criterion& criterion, const Cut& cut) {
  for (std::size_t i = 0; i < cut.ids.size(); ++i) {
    Criterion::Corners corners = cut.triangles[i];
    for (std::uint32_t& corner : corners) corner = cut.vertices[corner];
    if (!criterion.isFineEnough(mt, TriangleId(cut.ids[i]), corners)) return false;
  }
  return true;
}

TEST(WantedBy, ReadsWhatTheCutsOfARegionOrAFocusAreMadeOf) {
  std::uint64_t nodes = 0, nodesOfParts = 0, triangles = 0, trianglesOfParts = 0;
  forAllKinds([&](const FiledTerrain& filed, Random& random) {
    const double largest = filed.whole.mt.largestError();
    for (int i = 0; i < 12; ++i) {
      const Vec2 p = filed.placeIn(random), q = filed.placeIn(random);
      CutRequest fine;
      fine.maxError = largest * std::pow(random.between(0, 1), 6);
      if (i % 4 != 0) fine.outsideError = *fine.maxError + largest * random.between(0, 1);
      std::optional<Region> region;
      if (i % 2 == 0) {
        const Vec2 step{(filed.high.x - filed.low.x) * 0.1, (filed.high.y - filed.low.y) * 0.1};
        region = i % 3 == 0 ? Region({{p, q, {p.x + step.x, q.y}}})
                            : Region::box({p.x, p.y, p.x + step.x, p.y + step.y});
      } else {
        fine.focus =
            CutRequest::Focus{.xy = filed.whole.toSource(p), .growth = largest * random.between(0, 1e-3)};
      }
      if (random.below(2) == 0) fine.method = CutMethod::saturated;
      CutRequest coarse = fine;
      coarse.maxError = std::min(2 * *fine.maxError, coarse.outsideError);
      const std::vector<CutRequest> criteria = {coarse, fine};
      const auto wanted = requiredBy(criteria, region, filed.outline);
      ASSERT_TRUE(wanted && *wanted);
      const TerrainModel part = filed.part(*wanted);
      nodes += filed.whole.mt.nodeCount();
      nodesOfParts += part.mt.nodeCount();
      for (const CutRequest& criterion : criteria) {
        const auto ofWhole = engineCriterion(criterion, region, 0, filed.whole),
                   ofPart = engineCriterion(criterion, region, 0, part);
        const CutOptions options{.method = criterion.method};
        const auto x = takeCut(filed.whole.mt, **ofWhole, options), y = takeCut(part.mt, **ofPart, options);
        ASSERT_TRUE(x && y);
        if (filed.file->isPacked() && criterion.method == CutMethod::saturated) {
          EXPECT_TRUE(isFineEnough(part.mt, **ofPart, *y)) << i;
          triangles += x->ids.size();
          trianglesOfParts += y->ids.size();
          continue;
        }
        EXPECT_TRUE(frontOf(filed.whole.mt, *x) == frontOf(part.mt, *y)) << i;
        EXPECT_EQ(x->achievedError, y->achievedError);
      }
    }
  });
  EXPECT_LT(nodesOfParts, nodes / 2);
  EXPECT_LE(trianglesOfParts, triangles) << "smaller balls, coarser cuts";
  EXPECT_GT(trianglesOfParts, triangles / 5 * 4);
}

TEST(WantedBy, IsEverythingWherePixelsFitsOrBudgetsDecide) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(30, 20, 1))), folder.file("model.amt"));
  const auto isEverything = [&](const CutRequest& criterion, const std::optional<Region>& region = {}) {
    const auto wanted = requiredBy(std::vector{criterion}, region, filed.outline);
    return wanted && !*wanted;
  };
  CutRequest c;
  c.maxError = 2;
  EXPECT_FALSE(isEverything(c));
  const Region corner = Region::box({0, 0, 3, 3});
  EXPECT_FALSE(isEverything(c, corner));
  c.method = CutMethod::saturated;
  EXPECT_FALSE(isEverything(c));
  EXPECT_FALSE(isEverything(c, corner));
  c.focus = CutRequest::Focus{};
  EXPECT_FALSE(isEverything(c));
  c.focus.reset();
  c.camera = Camera{};
  EXPECT_TRUE(isEverything(c));
  c.camera.reset();
  c.fit = CutFit::error;
  EXPECT_TRUE(isEverything(c));
  c.fit = CutFit::none;
  c.maxError.reset();
  c.maxTriangles = 100;
  EXPECT_TRUE(isEverything(c));
}

TEST(WantedBy, AsksForTheFinestOfSeveralTolerances) {
  const TemporaryFolder folder;
  const FiledTerrain filed(built(build(fieldNamed("ramp").make(30, 20, 1))), folder.file("model.amt"));
  std::vector<CutRequest> criteria(3);
  for (std::size_t i = 0; i < criteria.size(); ++i) {
    criteria[i].maxError = 4.0 - static_cast<double>(i);
    criteria[i].outsideError = 10.0 + static_cast<double>(i);
  }
  const auto everywhere = requiredBy(criteria, std::nullopt, filed.outline);
  ASSERT_TRUE(everywhere);
  EXPECT_EQ((*everywhere)({20, 10, 21, 11}), 2);
  const auto corner = requiredBy(criteria, Region::box({0, 0, 3, 3}), filed.outline);
  ASSERT_TRUE(corner);
  EXPECT_EQ((*corner)({1, 1, 2, 2}), 2);
  EXPECT_EQ((*corner)({20, 10, 21, 11}), 10);
}

}  // namespace
}  // namespace arete
