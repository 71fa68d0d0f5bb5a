// SPDX-License-Identifier: GPL-3.0-or-later
//
// Several observers against their own viewsheds. (viewshed_test.cpp has larger cases, with tolerances.)
#include "terrain/viewshed/many.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "datasets/random.h"

namespace arete::test {
namespace {

struct MakerPlace {
  RasterHeightfield field;
  TerrainModel model;
  std::shared_ptr<const SightGrid> grid;
  std::unique_ptr<SightEarth> earth;
  Result<ViewshedMaker> maker;

  explicit MakerPlace(RasterHeightfield made)
      : field(std::move(made)), model(), maker(tl::unexpected(Error{})) {
    model.columns = field.columns;
    model.rows = field.rows;
    model.georeference = field.georeference;
    grid = std::make_shared<SightGrid>(field.columns, field.rows, field.heights);
    earth = makePlaneEarth(model);
    maker = ViewshedMaker::make(model, *earth, grid);
  }
};

TEST(ViewshedOfMany, CombinesWhatEachObserverSeesInItsOwnField) {
  constexpr std::uint64_t kSeed = 121;
  Random random(kSeed);
  for (const std::size_t family : {3u, 6u, 9u}) {
    const MakerPlace place(rasterFamilies()[family % rasterFamilies().size()].make(31, 27, 3));
    ASSERT_TRUE(place.maker);
    std::vector<ViewshedSite> sites;
    for (int i = 0; i < 4; ++i) {
      const Vec2 plan{random.between(0, 30), random.between(0, 26)};
      const double z = place.grid->at(plan);
      ViewshedSite site{{plan, (std::isnan(z) ? 50 : z) + 5}, {}};
      if (i > 0) site.field = {.greatestMetres = 15, .fromAzimuth = 90.0 * i, .azimuthSpan = 200};
      sites.push_back(site);
    }
    const auto all = viewshedOfMany(*place.maker, place.model, *place.earth, sites, {}, true);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->columns, 31u);
    EXPECT_EQ(all->rows, 27u);
    std::vector<Viewshed> single;
    for (const ViewshedSite& site : sites)
      single.push_back(*place.maker->from(site.observer, {.field = site.field}));
    for (std::size_t c = 0; c < all->cells.size(); ++c) {
      SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", family " << family << ", cell " << c);
      int seen = 0, unknown = 0, hidden = 0;
      for (const Viewshed& one : single) {
        seen += one.cells[c] == ViewshedCell::seen;
        unknown += one.cells[c] == ViewshedCell::unknown;
        hidden += one.cells[c] == ViewshedCell::hidden;
      }
      EXPECT_EQ(all->cells[c], seen > 0      ? ViewshedCell::seen
                               : unknown > 0 ? ViewshedCell::unknown
                               : hidden > 0  ? ViewshedCell::hidden
                                             : ViewshedCell::outside);
      EXPECT_EQ(all->count[c], unknown > 0 ? ViewshedOfMany::kUnknown : seen);
      if (unknown == 0) {
        EXPECT_EQ(all->server[c] > 0, seen > 0);
        if (all->server[c] > 0) {
          EXPECT_EQ(single[all->server[c] - 1u].cells[c], ViewshedCell::seen);
        }
      }
    }
  }
}

TEST(ViewshedOfMany, RefusesNoObserversAndTooMany) {
  const MakerPlace place(rasterFamilies()[3].make(9, 9, 1));
  ASSERT_TRUE(place.maker);
  const auto none = viewshedOfMany(*place.maker, place.model, *place.earth, {}, {}, false);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::usage);
  const std::vector<ViewshedSite> crowd(65001, ViewshedSite{{{4, 4}, 100}, {}});
  const auto many = viewshedOfMany(*place.maker, place.model, *place.earth, crowd, {}, false);
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().code, ErrorCode::usage);
}

TEST(ViewshedOfMany, HasNoServersUnlessRequested) {
  const MakerPlace place(rasterFamilies()[3].make(12, 9, 1));
  ASSERT_TRUE(place.maker);
  const std::vector<ViewshedSite> sites{{{{4, 4}, 1000}, {}}};
  const auto all = viewshedOfMany(*place.maker, place.model, *place.earth, sites, {}, false);
  ASSERT_TRUE(all);
  EXPECT_TRUE(all->server.empty());
}

}  // namespace
}  // namespace arete::test
