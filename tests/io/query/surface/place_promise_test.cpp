// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a surface promises by place: every point of the source in the region, or in sight, has within the
// error that is allowed there a point of the result. The oracle is a sampler with geometry of its own: the
// region as a formula, the nearest point of a triangle by its Voronoi regions, the picture by a plain
// projection.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/follow/incremental_cut.h"
#include "full_run.h"
#include "io/query/request/criterion.h"
#include "io/query/surface/region.h"
#include "io/query/surface/write_model.h"
#include "io/store/amt/surface_file.h"
#include "surface/builder/build.h"
#include "surface/displacement/displaced_places.h"
#include "surface/displacement/find_displacement.h"
#include "surface/families.h"
#include "surface/region/closed_mesh_region.h"

namespace arete {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * double(engine_() % 1'000'001) / 1e6; }
  double octaves(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }
  std::size_t below(std::size_t n) { return engine_() % n; }
  Vec3 inCube() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }

 private:
  std::mt19937_64 engine_;
};

/// A plate of two sheets that nearly touch: one flat, one with bumps.
TriangleMesh plate(Random& random) {
  TriangleMesh mesh = shapes::sheet(9, 8), other = shapes::sheet(9, 8);
  const double apart = random.octaves(1e-3, 0.3);
  for (Vec3& p : other.positions) p.z = apart + (random.below(6) == 0 ? random.in(0, 1.5) : 0);
  shapes::append(mesh, other);
  return mesh;
}

/// A sheet folded to and fro, its layers close to each other.
TriangleMesh folded(Random& random) {
  TriangleMesh mesh = shapes::sheet(24, 5);
  const double width = random.in(0.05, 0.5);
  for (Vec3& p : mesh.positions) {
    const int layer = static_cast<int>(p.x) / 4, at = static_cast<int>(p.x) % 4;
    p = {layer % 2 == 0 ? double(at) : 4.0 - at, p.y, width * layer + 0.01 * random.in(-1, 1)};
  }
  return mesh;
}

/// A sheet of which some vertices stand off, alone or in rows.
TriangleMesh spiked(Random& random) {
  const auto side = static_cast<std::uint32_t>(4 + random.below(9));
  TriangleMesh mesh = shapes::sheet(side, side);
  for (Vec3& p : mesh.positions)
    if (random.below(12) == 0) p.z = random.octaves(0.05, 20) * (random.below(2) == 0 ? 1 : -1);
  if (random.below(2) == 0)
    for (Vec3& p : mesh.positions)
      if (p.x == 2) p.z += 3;
  return mesh;
}

/// A globe with spikes.
TriangleMesh mace(Random& random) {
  TriangleMesh mesh = shapes::globe(12, 9);
  for (Vec3& p : mesh.positions)
    if (random.below(10) == 0) p = random.in(1.5, 6) * p;
  return mesh;
}

/// A long tube that is thin, or flattened.
TriangleMesh tube(Random& random) {
  TriangleMesh mesh = shapes::sheet(8, 30, true);
  const double flat = random.octaves(0.01, 1), bend = random.in(0, 0.3);
  for (Vec3& p : mesh.positions) p = {p.x + 5 * std::sin(bend * p.z), flat * p.y, p.z};
  return mesh;
}

TriangleMesh randomMesh(Random& random, std::string& name) {
  const auto seed = random.below(1'000'000);
  switch (random.below(9)) {
    case 0:
      name = "plate";
      return plate(random);
    case 1:
      name = "folds";
      return folded(random);
    case 2:
    case 3:
      name = "spikes";
      return spiked(random);
    case 4:
      name = "mace";
      return mace(random);
    case 5:
      name = "tube";
      return tube(random);
    case 6:
      name = "crumpled sheet";
      return shapes::shaken(shapes::sheet(11, 10), seed, random.octaves(0.1, 3));
    case 7:
      name = "torus";
      return shapes::shaken(shapes::sheet(14, 9, true, true), seed, random.octaves(0.01, 0.4));
    default:
      name = "hills";
      return shapes::hills(14, seed);
  }
}

/// Of another size, elsewhere and turned.
void place(TriangleMesh& mesh, Random& random) {
  const double scale = random.octaves(1e-3, 1e3), turn = random.in(0, 6);
  const Vec3 by = random.below(3) == 0 ? scale * 1e3 * random.inCube() : Vec3{};
  for (Vec3& p : mesh.positions)
    p = scale * Vec3{std::cos(turn) * p.x - std::sin(turn) * p.z, p.y,
                     std::sin(turn) * p.x + std::cos(turn) * p.z} +
        by;
}

/// Vertices, and points of all faces.
std::vector<Vec3> samplesOf(const TriangleMesh& mesh, Random& random) {
  std::vector<Vec3> samples = mesh.positions;
  for (const auto& [a, b, c] : mesh.triangles)
    for (int i = 0; i < 2; ++i) {
      double u = random.in(0, 1), v = random.in(0, 1);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (i == 1) v = 0;  // on an edge
      samples.push_back((1 - u - v) * mesh.positions[a] + u * mesh.positions[b] + v * mesh.positions[c]);
    }
  return samples;
}

/// [Ericson2005], by the Voronoi regions of corners, sides and the inside.
double distanceTo(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return norm(ap);
  if (d3 >= 0 && d4 <= d3) return norm(bp);
  if (d6 >= 0 && d5 <= d6) return norm(cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return norm(ap - (d1 / (d1 - d3)) * ab);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return norm(ap - (d2 / (d2 - d6)) * ac);
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return norm(bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b));
  const double all = va + vb + vc;
  return norm(ap - (vb / all) * ab - (vc / all) * ac);
}

/// The result of a cut.
struct Taken {
  std::vector<Vec3> places;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  double distanceFrom(const Vec3& p, double enough) const {
    double least = kInfinity;
    for (const auto& [a, b, c] : triangles) {
      least = std::min(least, distanceTo(p, places[a], places[b], places[c]));
      if (least <= enough) break;
    }
    return least;
  }
};

struct NamedRegion {
  std::string name;
  std::shared_ptr<const SpaceRegion> region;
  std::function<bool(const Vec3&)> holds;
};

TriangleMesh cubeOf(const Vec3& at, const std::array<Vec3, 3>& sides) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    Vec3 p = at;
    for (int k = 0; k < 3; ++k) p = p + ((i >> k & 1) != 0 ? 1.0 : -1.0) * sides[static_cast<std::size_t>(k)];
    mesh.positions.push_back(p);
  }
  for (const auto& q : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

NamedRegion randomRegion(const std::vector<Vec3>& samples, double diagonal, Random& random) {
  const double size = diagonal * random.octaves(0.005, 0.6);
  const Vec3 at = samples[random.below(samples.size())] + size * random.inCube();
  switch (random.below(3)) {
    case 0: {
      const Vec3 half{size * random.in(0.1, 1), size * random.in(0.1, 1), size * random.in(0.1, 1)};
      const Vec3 low = at - half, high = at + half;
      return {"box", *regionOfNumbers(std::array{low.x, low.y, low.z, high.x, high.y, high.z}),
              [=](const Vec3& p) {
                return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
                       p.z <= high.z;
              }};
    }
    case 1:
      return {"ball", *regionOfNumbers(std::array{at.x, at.y, at.z, size}),
              [=](const Vec3& p) { return norm(p - at) <= size; }};
    default: {
      // A turned box, at times with a smaller one inside it as a hole.
      const double u = random.in(0, 6), v = random.in(0, 6);
      const std::array<Vec3, 3> axes{{{std::cos(u), std::sin(u), 0},
                                      {-std::sin(u) * std::cos(v), std::cos(u) * std::cos(v), std::sin(v)},
                                      {std::sin(u) * std::sin(v), -std::cos(u) * std::sin(v), std::cos(v)}}};
      const std::array<double, 3> half{size * random.in(0.1, 1), size * random.in(0.1, 1),
                                       size * random.in(0.1, 1)};
      const bool isHollow = random.below(2) == 0;
      const auto sides = [&](double part) {
        return std::array<Vec3, 3>{part * half[0] * axes[0], part * half[1] * axes[1],
                                   part * half[2] * axes[2]};
      };
      TriangleMesh mesh = cubeOf(at, sides(1));
      if (isHollow) shapes::append(mesh, cubeOf(at, sides(0.5)));
      const auto region = ClosedMeshRegion::create(mesh);
      if (!region) throw std::runtime_error(region.error().describe());
      return {isHollow ? "hollow mesh" : "closed mesh", *region, [=](const Vec3& p) {
                double most = 0;
                for (std::size_t k = 0; k < 3; ++k)
                  most = std::max(most, std::abs(dot(p - at, axes[k])) / half[k]);
                return most <= 1 - 1e-9 && (!isHollow || most >= 0.5 + 1e-9);
              }};
    }
  }
}

class SurfacePlaces : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "arete-places-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  void TearDown() override {
    std::printf(
        "%llu meshes, %llu samples held against a bound, %llu broken; triangles: %.3g of the finest\n",
        static_cast<unsigned long long>(meshes_), static_cast<unsigned long long>(held_),
        static_cast<unsigned long long>(broken_), taken_ / std::max(finest_, 1.0));
    std::filesystem::remove_all(folder_);
  }

  static std::uint64_t count(std::uint64_t ordinary) {
    return test::isFull() ? 2000 : test::isBrief() ? 8 : ordinary;
  }

  /// A random mesh as a model: built, or written with rounded places and read, displaced or not.
  void make(std::uint64_t seed, Random& random) {
    name_ = fmt::format("seed {}", seed);
    std::string kind;
    source_ = randomMesh(random, kind);
    place(source_, random);
    name_ += ", " + kind;
    Result<SurfaceModel> built = buildSurface(SurfaceMesh(source_));
    ASSERT_TRUE(built) << name_ << ": " << built.error().describe();
    model_ = std::move(*built);
    ++meshes_;
    if (random.below(4) == 0) {
      model_.displacement = *findDisplacement(model_);
      name_ += ", displaced";
    }
    if (random.below(3) == 0) {
      const int bits = random.below(2) == 0 ? 8 : 12;
      const std::string path = (folder_ / "m.amt").string();
      ASSERT_TRUE(writeSurfaceModel(path, model_, {}, {.isPacked = true, .positionBits = bits}));
      Result<SurfaceModel> read = loadSurfaceAmt(path);
      ASSERT_TRUE(read) << read.error().describe();
      model_ = std::move(*read);
      name_ += fmt::format(", {} bits", bits);
    }
    samples_ = samplesOf(source_, random);
    largest_ = 0;
    for (const Vec3& p : samples_)
      largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }

  Taken taken(const Cut& cut, const BoundedCriterion& criterion) {
    Taken result;
    result.triangles = cut.triangles;
    if (model_.displacement.isEmpty())
      for (const std::uint32_t v : cut.vertices) result.places.push_back(model_.mt.position(VertexId(v)));
    else
      result.places =
          displacedPlaces(model_.mt, model_.displacement, cut, promisedErrors(model_.mt, cut, &criterion));
    taken_ += double(cut.triangles.size());
    finest_ += double(model_.mt.finestTriangleCount());
    return result;
  }

  /// One cut by each method, and by following from the last.
  void forCuts(const BoundedCriterion& criterion, const std::function<void(const Cut&, const char*)>& visit) {
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      const Result<Cut> cut = takeCut(model_.mt, criterion, {.method = method});
      ASSERT_TRUE(cut) << cut.error().describe();
      EXPECT_TRUE(cut->isComplete);
      visit(*cut, method == CutMethod::minimal ? "minimal" : "saturated");
    }
    IncrementalCut follows(model_.mt);
    ASSERT_TRUE(follows.update(UniformError(model_.diagonal / 50)));
    ASSERT_TRUE(follows.update(criterion));
    visit(follows.front(), "followed");
    const Result<Cut> budget =
        takeCut(model_.mt, criterion,
                {.maxTriangles = model_.mt.finestTriangleCount() + model_.mt.rootTriangleCount()});
    ASSERT_TRUE(budget);
    if (budget->isComplete) visit(*budget, "budget");
  }

  /// @param allowedAt the error that is allowed at a point of the source; infinite where none is
  void expectKept(const BoundedCriterion& criterion, const std::string& what,
                  const std::function<double(const Vec3&)>& allowedAt) {
    forCuts(criterion, [&](const Cut& cut, const char* method) {
      const Taken result = taken(cut, criterion);
      // Where rounding leaves more than is asked for, that is said, and is the bound.
      const double left = errorLeftByRounding(model_, criterion, cut);
      for (const Vec3& p : samples_) {
        const double allowed = std::max(allowedAt(p), left);
        if (!(allowed < kInfinity)) continue;
        ++held_;
        const double bound = allowed * (1 + 1e-6) + 1e-12 * largest_;
        const double distance = result.distanceFrom(p, bound);
        if (distance <= bound) continue;
        ++broken_;
        if (broken_ < 20)
          ADD_FAILURE() << name_ << ", " << what << ", " << method << ": the point " << p.x << " " << p.y
                        << " " << p.z << " is " << distance << " from the result, " << allowed
                        << " are allowed";
      }
    });
  }

  std::filesystem::path folder_;
  std::string name_;
  TriangleMesh source_;
  SurfaceModel model_;
  std::vector<Vec3> samples_;
  double largest_ = 0, taken_ = 0, finest_ = 0;
  std::uint64_t meshes_ = 0, held_ = 0, broken_ = 0;
};

TEST_F(SurfacePlaces, InARegionAreWithinItsErrorAndElsewhereWithinTheOther) {
  for (std::uint64_t seed = 1; seed <= count(60); ++seed) {
    Random random(seed);
    ASSERT_NO_FATAL_FAILURE(make(seed, random));
    for (int i = 0; i < 2; ++i) {
      const NamedRegion region = randomRegion(samples_, model_.diagonal, random);
      CutRequest asked;
      asked.spaceRegion = region.region;
      asked.maxError = model_.diagonal * random.octaves(1e-6, 0.2);
      if (random.below(2) == 0) asked.outsideError = *asked.maxError * random.octaves(1, 100);
      const auto criterion = engineCriterion(asked, model_);
      ASSERT_TRUE(criterion);
      expectKept(**criterion, region.name,
                 [&](const Vec3& p) { return region.holds(p) ? *asked.maxError : asked.outsideError; });
    }
  }
  EXPECT_GT(held_, 100 * meshes_);
  EXPECT_LT(taken_, 0.7 * finest_) << "that all is refined is no answer";
}

TEST_F(SurfacePlaces, InSightAreWithinThePixelsOfTheirPlace) {
  for (std::uint64_t seed = 1; seed <= count(60); ++seed) {
    Random random(seed + 10'000);
    ASSERT_NO_FATAL_FAILURE(make(seed + 10'000, random));
    for (int i = 0; i < 2; ++i) {
      SurfaceCamera camera;
      camera.target = samples_[random.below(samples_.size())];
      camera.eye = camera.target + model_.diagonal * random.octaves(0.02, 2) * random.inCube();
      camera.verticalFieldOfViewDegrees = random.in(10, 100);
      camera.widthPixels = random.in(100, 1000);
      camera.heightPixels = random.in(100, 1000);
      CutRequest asked;
      asked.spaceCamera = camera;
      asked.pixelError = random.octaves(0.3, 30);
      if (random.below(3) == 0) asked.outsideError = model_.diagonal * random.octaves(0.01, 1);
      const auto criterion = engineCriterion(asked, model_);
      ASSERT_TRUE(criterion);
      const Vec3 away = camera.target - camera.eye, forward = away / norm(away);
      const double slope = std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360);
      const double focal = camera.heightPixels / (2 * slope);
      // Within the circle in the picture's middle, whichever way up is.
      const double inSight = slope * std::min(1.0, camera.widthPixels / camera.heightPixels) * (1 - 1e-9);
      expectKept(**criterion, "camera", [&](const Vec3& p) {
        const Vec3 d = p - camera.eye;
        const double depth = dot(d, forward), distance = norm(d);
        const double fromAxis = std::sqrt(std::max(0.0, distance * distance - depth * depth));
        const bool isSeen = depth > 0 && fromAxis <= inSight * depth;
        if (!isSeen) return asked.outsideError;
        return std::min(asked.outsideError, *asked.pixelError * depth * depth / (distance * focal));
      });
    }
  }
  EXPECT_GT(held_, 100 * meshes_);
}

TEST_F(SurfacePlaces, AroundAFocusAreWithinTheErrorThatGrowsWithTheirDistance) {
  for (std::uint64_t seed = 1; seed <= count(40); ++seed) {
    Random random(seed + 20'000);
    ASSERT_NO_FATAL_FAILURE(make(seed + 20'000, random));
    const MetricFrame& metric = model_.mt.arrays().metric;
    for (const bool inPlan : {false, true}) {
      const Vec3 place = samples_[random.below(samples_.size())] +
                         model_.diagonal * random.octaves(1e-3, 0.3) * random.inCube();
      const DistanceError::Options options{
          .place = metric.toMetric(place),
          .inPlan = inPlan,
          .nearError = model_.diagonal * random.octaves(1e-6, 1e-2),
          .growth = random.octaves(1e-3, 0.5),
          .farError = random.below(2) == 0 ? model_.diagonal * 0.1 : kInfinity};
      const DistanceError criterion(options);
      // What rounding moved the source by is its distance too.
      const double moved = options.growth * model_.positionError;
      expectKept(criterion, "focus", [&](const Vec3& p) {
        const Vec3 d = p - place;
        const double distance = inPlan ? std::hypot(d.x, d.y) : norm(d);
        return std::min(options.nearError + options.growth * distance + moved, options.farError);
      });
    }
  }
}

TEST_F(SurfacePlaces, AroundAFocusThatIsAskedForAreWithinItsErrorWithoutAnAllowanceForRounding) {
  for (std::uint64_t seed = 1; seed <= count(40); ++seed) {
    Random random(seed + 30'000);
    ASSERT_NO_FATAL_FAILURE(make(seed + 30'000, random));
    const Vec3 place = samples_[random.below(samples_.size())] +
                       model_.diagonal * random.octaves(1e-3, 0.3) * random.inCube();
    CutRequest asked;
    asked.maxError = model_.diagonal * random.octaves(1e-6, 1e-2);
    asked.focus = {.xy = {place.x, place.y}, .growth = random.octaves(1e-3, 0.5), .z = place.z};
    if (random.below(2) == 0) asked.outsideError = model_.diagonal * 0.1;
    const auto criterion = engineCriterion(asked, model_);
    ASSERT_TRUE(criterion) << criterion.error().describe();
    expectKept(**criterion, "asked focus", [&](const Vec3& p) {
      return std::min(*asked.maxError + asked.focus->growth * norm(p - place), asked.outsideError);
    });
  }
  EXPECT_GT(held_, 50 * meshes_);
}

}  // namespace
}  // namespace arete
