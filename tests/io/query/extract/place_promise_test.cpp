// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a terrain promises by place: every sample in the region, in sight or around a focus is within the
// error that is allowed there of the height of the TIN. The oracle is a sampler with geometry of its own:
// polygons by winding angles, heights by areas, the picture by a plain projection.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "engine/criteria/view_error.h"
#include "full_run.h"
#include "io/io_fixture.h"
#include "io/query/extract/part.h"
#include "io/query/request/criterion.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * double(engine_() % 1'000'001) / 1e6; }
  double octaves(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }
  std::size_t below(std::size_t n) { return engine_() % n; }

 private:
  std::mt19937_64 engine_;
};

/// A height of the source: the only thing that the promise is about.
struct Sample {
  double x, y, z;
};

/// One of the families, with spikes and holes.
RasterHeightfield randomRaster(Numbers& numbers, std::string& name) {
  const auto families = rasterFamilies();
  const RasterFamily& family = families[numbers.below(families.size())];
  name = family.name;
  RasterHeightfield raster =
      family.make(static_cast<std::uint32_t>(8 + numbers.below(30)),
                  static_cast<std::uint32_t>(8 + numbers.below(30)), numbers.below(1000));
  const bool hasSpikes = numbers.below(2) == 0, hasHoles = numbers.below(3) == 0;
  for (double& z : raster.heights) {
    if (hasSpikes && numbers.below(60) == 0) z += numbers.in(-500, 500);
    if (hasHoles && numbers.below(50) == 0) z = std::numeric_limits<double>::quiet_NaN();
  }
  return raster;
}

/// Valid samples of a cell with three valid corners at least: the others are in no triangle.
std::vector<Sample> samplesOf(const RasterHeightfield& raster) {
  std::vector<Sample> samples;
  const auto isValid = [&](std::int64_t c, std::int64_t r) {
    return c >= 0 && r >= 0 && c < raster.columns && r < raster.rows &&
           !std::isnan(raster.heights[std::size_t(r) * raster.columns + std::size_t(c)]);
  };
  for (std::int64_t r = 0; r < raster.rows; ++r)
    for (std::int64_t c = 0; c < raster.columns; ++c) {
      if (!isValid(c, r)) continue;
      bool isInCell = false;
      for (const std::int64_t i : {-1, 1})
        for (const std::int64_t k : {-1, 1})
          isInCell = isInCell || (isValid(c + i, r) && isValid(c, r + k)) ||
                     (isValid(c + i, r + k) && (isValid(c + i, r) || isValid(c, r + k)));
      if (isInCell)
        samples.push_back(
            {double(c), double(r), raster.heights[std::size_t(r) * raster.columns + std::size_t(c)]});
    }
  return samples;
}

std::vector<Sample> samplesOf(const PointHeightfield& points) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < points.positions.size(); ++i)
    samples.push_back({points.positions[i].x, points.positions[i].y, points.heights[i]});
  return samples;
}

struct NamedRegion {
  std::string name;
  Region region;
  std::function<bool(double, double)> holds;
};

struct Extents {
  double low[2] = {kUnbounded, kUnbounded}, high[2] = {-kUnbounded, -kUnbounded};
  explicit Extents(const std::vector<Sample>& samples) {
    for (const Sample& s : samples) {
      low[0] = std::min(low[0], s.x), low[1] = std::min(low[1], s.y);
      high[0] = std::max(high[0], s.x), high[1] = std::max(high[1], s.y);
    }
  }
  double size() const { return std::max(high[0] - low[0], high[1] - low[1]); }
  Vec2 at(Numbers& numbers) const { return {numbers.in(low[0], high[0]), numbers.in(low[1], high[1])}; }
};

/// A box, a polygon that may cross itself nowhere, or what is within a distance of a line.
NamedRegion randomRegion(const Extents& extents, Numbers& numbers, const MetricFrame& metric) {
  const Vec2 at = extents.at(numbers);
  const double size = extents.size() * numbers.octaves(0.01, 0.5);
  switch (numbers.below(3)) {
    case 0: {
      // Samples often lie on its sides.
      const Box2 box{std::floor(at.x - size), std::floor(at.y - size),
                     std::ceil(at.x + size * numbers.in(0, 1)), std::ceil(at.y + size)};
      return {"box", Region::box(box), [box](double x, double y) {
                return x >= box.xMin && x <= box.xMax && y >= box.yMin && y <= box.yMax;
              }};
    }
    case 1: {
      std::vector<Vec2> ring;
      const std::size_t corners = 3 + numbers.below(9);
      for (std::size_t i = 0; i < corners; ++i) {
        const double turn = 2 * std::numbers::pi * (double(i) + numbers.in(0, 0.6)) / double(corners);
        const double radius = size * numbers.in(0.1, 1);
        ring.push_back({at.x + radius * std::cos(turn), at.y + radius * std::sin(turn)});
      }
      return {"polygon", Region({ring}), [ring](double x, double y) {
                double angle = 0;
                for (std::size_t i = 0; i < ring.size(); ++i) {
                  const Vec2 p = ring[i], q = ring[(i + 1) % ring.size()];
                  const double px = p.x - x, py = p.y - y, qx = q.x - x, qy = q.y - y;
                  angle += std::atan2(px * qy - py * qx, px * qx + py * qy);
                }
                return std::abs(angle) > std::numbers::pi;
              }};
    }
    default: {
      const Vec2 to = extents.at(numbers);
      const double distance = size / 2 * std::abs(metric.scale.x);
      return {"line", Region({.lines = {{at, to}}, .distance = distance}, metric), [=](double x, double y) {
                // In metric space.
                const double sx = metric.scale.x, sy = metric.scale.y, dx = (to.x - at.x) * sx,
                             dy = (to.y - at.y) * sy, px = (x - at.x) * sx, py = (y - at.y) * sy;
                const double squared = dx * dx + dy * dy;
                const double t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
                return std::hypot(px - t * dx, py - t * dy) <= distance * (1 - 1e-9);
              }};
    }
  }
}

class TerrainPlaces : public ::testing::Test {
 protected:
  void TearDown() override {
    std::printf(
        "%llu terrains, %llu samples held against a bound, %llu broken; triangles: %.3g of the finest\n",
        static_cast<unsigned long long>(terrains_), static_cast<unsigned long long>(held_),
        static_cast<unsigned long long>(broken_), taken_ / std::max(finest_, 1.0));
  }

  static std::uint64_t count() { return test::isFull() ? 2000 : test::isBrief() ? 10 : 80; }

  /// A random terrain, written and opened.
  void make(std::uint64_t seed, Numbers& numbers) {
    std::string kind;
    const BuildOptions options{.shape =
                                   numbers.below(2) == 0 ? HoleShape::delaunay : HoleShape::dataDependent};
    std::optional<Result<TerrainModel>> built;
    if (numbers.below(4) == 0) {
      const auto families = pointFamilies();
      const PointFamily& family = families[numbers.below(families.size())];
      kind = family.name;
      const PointHeightfield points =
          family.make(static_cast<std::uint32_t>(60 + numbers.below(500)), numbers.below(1000));
      samples_ = samplesOf(points);
      built.emplace(build(points, options));
    } else {
      const RasterHeightfield raster = randomRaster(numbers, kind);
      samples_ = samplesOf(raster);
      built.emplace(build(raster, options));
    }
    const bool isPacked = numbers.below(2) == 0;
    name_ = fmt::format("seed {}, {}{}", seed, kind, isPacked ? ", packed" : "");
    ASSERT_TRUE(*built) << name_ << ": " << built->error().describe();
    const std::string path = folder_.file("m.amt");
    ASSERT_TRUE(writeAmt(path, **built, {}, {.isPacked = isPacked}));
    file_ = std::move(*openAmt(path));
    whole_ = std::move(*file_->read());
    largest_ = 1;
    for (const Sample& s : samples_) largest_ = std::max(largest_, std::abs(s.z));
    ++terrains_;
  }

  /// @param allowedAt the error that is allowed at a sample; infinite where none is
  void expectKept(const MultiTriangulation& mt, const Cut& cut, const std::string& what,
                  const std::function<double(const Sample&)>& allowedAt) {
    taken_ += double(cut.triangles.size());
    finest_ += double(whole_.mt.finestTriangleCount());
    for (const Sample& s : samples_) {
      const double allowed = allowedAt(s);
      if (!(allowed < kUnbounded)) continue;
      ++held_;
      double least = kUnbounded;
      for (const auto& triangle : cut.triangles) {
        std::array<Vec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = mt.position(VertexId(cut.vertices[triangle[i]]));
        const auto area = [&](const Vec3& a, const Vec3& b) {
          return (a.x - s.x) * (b.y - s.y) - (a.y - s.y) * (b.x - s.x);
        };
        const double a = area(p[1], p[2]), b = area(p[2], p[0]), c = area(p[0], p[1]), all = a + b + c;
        const double slack = -1e-9 * std::abs(all);
        if (all == 0 || a / all * std::abs(all) < slack || b / all * std::abs(all) < slack ||
            c / all * std::abs(all) < slack)
          continue;
        least = std::min(least, std::abs((a * p[0].z + b * p[1].z + c * p[2].z) / all - s.z));
      }
      if (least <= allowed * (1 + 1e-6) + 1e-9 * largest_) continue;
      if (++broken_ < 20)
        ADD_FAILURE() << name_ << ", " << what << ": the sample at " << s.x << " " << s.y << " is " << least
                      << " off, " << allowed << " are allowed";
    }
  }

  void expectKept(const BoundedCriterion& criterion, const std::string& what,
                  const std::function<double(const Sample&)>& allowedAt) {
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      const Result<Cut> cut = takeCut(whole_.mt, criterion, {.method = method});
      ASSERT_TRUE(cut) << cut.error().describe();
      expectKept(whole_.mt, *cut, what, allowedAt);
    }
  }

  double relief() const {
    const auto [low, high] = std::ranges::minmax_element(samples_, {}, &Sample::z);
    return std::max(high->z - low->z, 1e-3);
  }

  test::TemporaryFolder folder_;
  std::string name_;
  std::vector<Sample> samples_;
  std::optional<AmtFile> file_;
  TerrainModel whole_;
  double largest_ = 1, taken_ = 0, finest_ = 0;
  std::uint64_t terrains_ = 0, held_ = 0, broken_ = 0;
};

TEST_F(TerrainPlaces, InARegionAreWithinItsErrorInTheWholeFileAndInThePartThatIsRead) {
  for (std::uint64_t seed = 1; seed <= count(); ++seed) {
    Numbers numbers(seed);
    ASSERT_NO_FATAL_FAILURE(make(seed, numbers));
    const NamedRegion region = randomRegion(Extents(samples_), numbers, whole_.mt.arrays().metric);
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      ExtractRequest request;
      request.criterion.maxError = relief() * numbers.octaves(1e-5, 0.3);
      if (numbers.below(2) == 0)
        request.criterion.outsideError = *request.criterion.maxError * numbers.octaves(1, 50);
      request.criterion.method = method;
      request.region = region.region;
      request.output = "tin.ply";
      const auto part = readForExtract(*file_, std::array{request}, whole_);
      ASSERT_TRUE(part) << part.error().describe();
      for (const TerrainModel* model : std::array<const TerrainModel*, 2>{&part->model, &whole_}) {
        const auto criterion = engineCriterion(request.criterion, request.region, 0, *model);
        ASSERT_TRUE(criterion);
        const Result<Cut> cut = takeCut(model->mt, **criterion, *engineOptions(request.criterion, *model));
        ASSERT_TRUE(cut) << cut.error().describe();
        expectKept(model->mt, *cut, region.name, [&](const Sample& s) {
          return region.holds(s.x, s.y) ? *request.criterion.maxError : request.criterion.outsideError;
        });
      }
    }
  }
  EXPECT_GT(held_, 100 * terrains_);
  EXPECT_LT(taken_, 0.8 * finest_);
}

TEST_F(TerrainPlaces, InSightAreWithinThePixelsOfTheirPlace) {
  for (std::uint64_t seed = 1; seed <= count(); ++seed) {
    Numbers numbers(seed + 10'000);
    ASSERT_NO_FATAL_FAILURE(make(seed + 10'000, numbers));
    const MetricFrame& metric = whole_.mt.arrays().metric;
    const auto metricOf = [&](const Sample& s) {
      return Vec3{(s.x - metric.origin.x) * metric.scale.x, (s.y - metric.origin.y) * metric.scale.y,
                  (s.z - metric.origin.z) * metric.scale.z};
    };
    const Sample& target = samples_[numbers.below(samples_.size())];
    const double away = Extents(samples_).size() * std::abs(metric.scale.x) * numbers.octaves(0.05, 2);
    View view;
    view.eye = metricOf(target) + away * Vec3{numbers.in(-1, 1), numbers.in(-1, 1), numbers.in(-0.3, 1)};
    view.forward = metricOf(target) - view.eye;
    view.verticalFieldOfView = numbers.in(0.2, 1.8);
    view.widthPixels = numbers.in(100, 1000);
    view.heightPixels = numbers.in(100, 1000);
    if (!view.validate()) continue;
    ViewError::Options options{.view = view, .pixels = numbers.octaves(0.3, 20)};
    if (numbers.below(3) == 0) options.outsideError = relief() * numbers.octaves(0.01, 1);
    const double length = std::sqrt(view.forward.x * view.forward.x + view.forward.y * view.forward.y +
                                    view.forward.z * view.forward.z);
    const Vec3 forward = view.forward / length;
    const double slope = std::tan(view.verticalFieldOfView / 2), focal = view.heightPixels / (2 * slope);
    const double inSight = slope * std::min(1.0, view.widthPixels / view.heightPixels) * (1 - 1e-9);
    expectKept(ViewError(options, metric), "camera", [&](const Sample& s) {
      const Vec3 d = metricOf(s) - view.eye;
      const double depth = d.x * forward.x + d.y * forward.y + d.z * forward.z;
      const double distance = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      const double fromAxis = std::sqrt(std::max(0.0, distance * distance - depth * depth));
      if (!(depth > 0) || fromAxis > inSight * depth) return options.outsideError;
      return std::min(options.outsideError,
                      options.pixels * depth * depth / (distance * focal) / std::abs(metric.scale.z));
    });
  }
  EXPECT_GT(held_, 50 * terrains_);
}

TEST_F(TerrainPlaces, AroundAFocusAreWithinTheErrorThatGrowsWithTheirDistance) {
  for (std::uint64_t seed = 1; seed <= count(); ++seed) {
    Numbers numbers(seed + 20'000);
    ASSERT_NO_FATAL_FAILURE(make(seed + 20'000, numbers));
    const MetricFrame& metric = whole_.mt.arrays().metric;
    const Vec2 at = Extents(samples_).at(numbers);
    const double z = samples_[numbers.below(samples_.size())].z;
    for (const bool inPlan : {true, false}) {
      const DistanceError::Options options{
          .place = metric.toMetric({at.x, at.y, z}),
          .inPlan = inPlan,
          .nearError = relief() * numbers.octaves(1e-5, 1e-2),
          .growth = relief() / Extents(samples_).size() * numbers.octaves(0.01, 1),
          .farError = numbers.below(2) == 0 ? relief() * 0.2 : kUnbounded};
      expectKept(DistanceError(options), inPlan ? "focus in the plan" : "focus", [&](const Sample& s) {
        const double dx = (s.x - at.x) * metric.scale.x, dy = (s.y - at.y) * metric.scale.y,
                     dz = inPlan ? 0 : (s.z - z) * metric.scale.z;
        return std::min(options.nearError + options.growth * std::sqrt(dx * dx + dy * dy + dz * dz),
                        options.farError);
      });
    }
  }
  EXPECT_GT(held_, 100 * terrains_);
}

}  // namespace
}  // namespace arete
