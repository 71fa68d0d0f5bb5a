// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the sweep is possible, and that its wedges, from observers at all borders, fill every cell.
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/random.h"
#include "terrain/viewshed/methods.h"

namespace arete::test {
namespace {

struct SweptPlace {
  TerrainModel model;
  std::shared_ptr<const SightGrid> grid;
  std::unique_ptr<SightEarth> earth;
  std::unique_ptr<SightEngine> scan;

  SweptPlace(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) : model() {
    model.columns = columns;
    model.rows = rows;
    Random random(seed);
    std::vector<double> heights;
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t column = 0; column < columns; ++column)
        heights.push_back(30 * std::sin(column * 0.3) * std::cos(row * 0.2) + random.between(0, 9));
    grid = std::make_shared<SightGrid>(columns, rows, heights);
    earth = makePlaneEarth(model);
    scan = makeSightScan(grid);
  }

  template <class Body>
  auto withTask(const ViewshedObserver& observer, const ViewshedOptions& options, const Body& body) const {
    const ViewshedExact exact(*scan, *earth, 1, observer, options);
    const std::vector<float> none;
    return body(ViewshedTask{model, *grid, *earth, observer, options, exact, none});
  }
  bool isPossible(const ViewshedObserver& observer) const {
    return withTask(observer, {}, [](const ViewshedTask& task) { return !whyNotSweep(task, nullptr); });
  }
};

TEST(ViewshedSweep, SaysWhereItIsNotPossible) {
  const SweptPlace place(20, 15, 1);
  const double ground = place.grid->at({5, 5});
  EXPECT_TRUE(place.isPossible({{5, 5}, ground + 2}));
  EXPECT_TRUE(place.isPossible({{5, 5}, ground}));
  EXPECT_TRUE(place.isPossible({{0, 0}, 100}));
  EXPECT_FALSE(place.isPossible({{5, 5}, ground - 1}));
  EXPECT_FALSE(place.isPossible({{-1, 5}, 100}));
  EXPECT_FALSE(place.isPossible({{5, 14.5}, 100}));
  // On the ground, very close to a lattice line.
  EXPECT_FALSE(place.isPossible({{5 + 1e-6, 5.3}, place.grid->at({5 + 1e-6, 5.3})}));
}

TEST(ViewshedSweep, FillsEveryCellAsRaysDoFromEverywhere) {
  for (const auto& size : {std::pair{2u, 2u}, {2u, 30u}, {41u, 3u}, {37u, 29u}}) {
    const auto columns = size.first, rows = size.second;
    const SweptPlace place(columns, rows, columns * 100 + rows);
    const double x = columns - 1, y = rows - 1;
    for (const Vec2 plan : {Vec2{0, 0},
                            {x, 0},
                            {0, y},
                            {x, y},
                            {x / 2, 0},
                            {x, y / 3},
                            {x / 2, y / 2},
                            {0.25, 0.75},
                            {std::floor(x / 2), std::floor(y / 2)},
                            {x - 0.5, 0.5}})
      for (const double above : {0.0, 3.0, 200.0}) {
        const ViewshedObserver observer{plan, place.grid->at(plan) + above};
        SCOPED_TRACE(testing::Message() << columns << " x " << rows << ", from " << plan.x << ", " << plan.y
                                        << ", " << above << " above the ground");
        place.withTask(observer, {}, [&](const ViewshedTask& task) {
          if (whyNotSweep(task, nullptr)) return;
          Viewshed swept, expected;
          for (Viewshed* v : {&swept, &expected}) {
            v->columns = columns;
            v->rows = rows;
            v->cells.assign(std::size_t{columns} * rows, ViewshedCell::outside);
          }
          ASSERT_TRUE(viewshedSweep(task, nullptr, {}, swept));
          ASSERT_TRUE(viewshedRays(task, {}, expected));
          EXPECT_EQ(swept.cells, expected.cells);
          EXPECT_LE(swept.rays, expected.rays);
        });
      }
  }
}

TEST(ViewshedRays, OfPlacesStayOutsideWhereThereIsNoTerrain) {
  const SweptPlace place(12, 12, 3);
  const ViewshedObserver observer{{5, 5}, 500};
  place.withTask(observer, {}, [&](const ViewshedTask& task) {
    const std::vector<Vec2> places{{2.5, 3.25}, {-4, 3}, {std::nan(""), 1}, {11, 11}};
    Viewshed result;
    result.cells.assign(places.size(), ViewshedCell::outside);
    ASSERT_TRUE(viewshedOfPlaces(task.exact, *place.grid, places, {}, result));
    EXPECT_EQ(result.cells[0], ViewshedCell::seen);
    EXPECT_EQ(result.cells[1], ViewshedCell::outside);
    EXPECT_EQ(result.cells[2], ViewshedCell::outside);
    EXPECT_EQ(result.cells[3], ViewshedCell::seen);
  });
}

}  // namespace
}  // namespace arete::test
