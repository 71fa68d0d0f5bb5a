// SPDX-License-Identifier: GPL-3.0-or-later
//
// No exception leaves a public function: operator new fails at every allocation of a small call, and at
// allocations drawn by a printed seed of a long one. Each time the function must return an error, and
// afterwards it must give the answer that it gave before.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <new>
#include <random>
#include <string>
#include <vector>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/laws/validate.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/store/amt/file.h"
#include "measure/mesh_distance.h"
#include "terrain/builder/build.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/fit/fit.h"
#include "terrain/laws/validate_model.h"
#include "terrain/measure/measure.h"
#include "engine/cut/error_curve.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/paths.h"
#include "terrain/viewshed/viewshed.h"

namespace {

std::atomic<bool> isArmed = false;
std::atomic<std::size_t> leastBytes = 0;  // that may fail
std::atomic<long> allocationsLeft = 0, allocations = 0, failures = 0;

// Not inlined: GCC would see free() beside operator new and warn.
[[gnu::noinline]] void* allocate(std::size_t bytes, std::size_t alignment) {
  if (isArmed && bytes >= leastBytes) {
    ++allocations;
    if (--allocationsLeft == 0) {
      ++failures;
      throw std::bad_alloc();
    }
  }
  void* const memory = alignment <= alignof(std::max_align_t)
                           ? std::malloc(std::max<std::size_t>(bytes, 1))
                           : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// std::stable_sort and others ask without exceptions, and do with less where there is nothing.
[[gnu::noinline]] void* allocateOrNull(std::size_t bytes, std::size_t alignment) noexcept {
  try {
    return allocate(bytes, alignment);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

[[gnu::noinline]] void release(void* memory) noexcept {
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t bytes) {
  return allocate(bytes, 1);
}
void* operator new[](std::size_t bytes) {
  return allocate(bytes, 1);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocateOrNull(bytes, 1);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocateOrNull(bytes, 1);
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocateOrNull(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocateOrNull(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete[](void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  release(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  release(memory);
}

namespace arete {
namespace {

namespace fs = std::filesystem;

/// Runs a call with the n-th allocation failing, for every n of a short call and for 60 n of a long one.
template <class Call>
void failAllocationsOf(const std::string& name, const Call& call) {
  SCOPED_TRACE(name);
  const auto run = [&](long failing) {
    allocations = 0;
    failures = 0;
    allocationsLeft = failing;
    isArmed = true;
    ErrorCode code{};
    bool isOk = false, hasThrown = false;
    try {
      const auto result = call();
      isArmed = false;
      isOk = result.has_value();
      if (!isOk) code = result.error().code;
    } catch (...) {
      isArmed = false;
      hasThrown = true;
    }
    EXPECT_FALSE(hasThrown) << "an exception leaves it when allocation " << failing << " fails";
    // A failure that costs only speed or warmth, such as a cache, need not be an error.
    if (failures == 0) {
      EXPECT_TRUE(isOk) << "without a failing allocation: " << toString(code);
    } else if (!isOk) {
      EXPECT_EQ(code, ErrorCode::outOfMemory) << "allocation " << failing << ": " << toString(code);
    }
  };
  run(0);
  const long count = allocations;
  constexpr unsigned kSeed = 7;
  std::vector<long> failing;
  for (long n = 1; n <= std::min(count, 40L); ++n) failing.push_back(n);
  std::mt19937 random(kSeed);
  for (int i = 0; i < 60 && count > 40; ++i)
    failing.push_back(41 + static_cast<long>(random() % static_cast<unsigned long>(count - 40)));
  for (const long n : failing) {
    run(n);
    if (::testing::Test::HasFailure()) {
      ADD_FAILURE() << "of " << count << " allocations, seed " << kSeed;
      return;
    }
  }
  run(0);
}

class OutOfMemory : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "arete-memory-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    raster_ = rasterFamilies()[0].make(60, 50, 3);
    points_ = pointFamilies()[0].make(2000, 3);
    Result<TerrainModel> model = build(raster_);
    ASSERT_TRUE(model) << model.error().describe();
    model_ = std::move(*model);
    criterion_ = std::make_unique<UniformError>(1.0);
    const Result<Cut> cut = takeCut(model_.mt, *criterion_);
    ASSERT_TRUE(cut);
    tin_ = exportTin(model_, *cut)->mesh;
    ASSERT_FALSE(tin_.triangles.empty());
  }
  void TearDown() override {
    leastBytes = 0;
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  fs::path folder_;
  RasterHeightfield raster_;
  PointHeightfield points_;
  TerrainModel model_;
  std::unique_ptr<Criterion> criterion_;
  TriangleMesh tin_;
};

TEST_F(OutOfMemory, IsAnErrorOfBuilds) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
    BuildOptions options;
    options.shape = shape;
    failAllocationsOf("raster", [&] { return build(raster_, options); });
    failAllocationsOf("points", [&] { return build(points_, options); });
  }
  failAllocationsOf("fixed vertices", [&] { return chooseFixedVertices(raster_, {}); });
}

TEST_F(OutOfMemory, IsAnErrorOfCuts) {
  for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
    CutOptions options;
    options.method = method;
    failAllocationsOf("cut", [&] { return takeCut(model_.mt, *criterion_, options); });
    failAllocationsOf("nodes", [&] { return takeNodes(model_.mt, *criterion_, options); });
    options.maxTriangles = 500;
    failAllocationsOf("budget", [&] { return takeCut(model_.mt, *criterion_, options); });
  }
  const Result<Cut> cut = takeCut(model_.mt, *criterion_);
  ASSERT_TRUE(cut);
  failAllocationsOf("export", [&] { return exportTin(model_, *cut); });
  failAllocationsOf("curve", [&] { return errorCurve(model_.mt, std::array{1.0, 5.0, 20.0}); });
}

TEST_F(OutOfMemory, IsAnErrorOfValidation) {
  failAllocationsOf("validate", [&] { return validate(model_.mt); });
  failAllocationsOf("model", [&] { return validateModel(model_); });
}

TEST_F(OutOfMemory, IsAnErrorOfMeasurements) {
  failAllocationsOf("raster", [&] { return measure(tin_, raster_); });
  failAllocationsOf("distance", [&] { return measureDistance(tin_, tin_); });
}

TEST_F(OutOfMemory, IsAnErrorOfVisibility) {
  const std::unique_ptr<SightEarth> earth = makePlaneEarth(model_);
  const Profiles profiles(model_);
  const SightPath path{.from = {3, 4}, .to = {50, 40}, .fromHeight = 1e4, .toHeight = 1e4};
  for (const SightMethod method : {SightMethod::descent, SightMethod::pyramid, SightMethod::scan}) {
    failAllocationsOf("engine", [&] { return makeSightEngine(method, model_); });
    const auto engine = makeSightEngine(method, model_);
    ASSERT_TRUE(engine);
    failAllocationsOf("paths", [&] {
      return answerPaths(std::array{path, path}, *earth, **engine, profiles, {});
    });
  }
  failAllocationsOf("maker", [&] { return ViewshedMaker::make(model_, *earth); });
  const auto maker = ViewshedMaker::make(model_, *earth);
  ASSERT_TRUE(maker);
  failAllocationsOf("viewshed", [&] { return maker->from({.plan = {20, 20}, .height = 1e4}); });
}

TEST_F(OutOfMemory, IsAnErrorOfFits) {
  const Result<Cut> cut = takeCut(model_.mt, *criterion_);
  ASSERT_TRUE(cut);
  failAllocationsOf("least error", [&] { return fitLeastError(model_, *cut); });
  failAllocationsOf("unbiased", [&] { return fitUnbiased(model_, *cut, {.maxError = cut->achievedError}); });
}

// Of allocations of at least 1 KiB alone: the destructor of nlohmann's JSON values, which nothing may leave,
// allocates.
TEST_F(OutOfMemory, IsAnErrorOfFiles) {
  leastBytes = 1024;
  const std::string path = (folder_ / "model.amt").string();
  for (const bool isPacked : {false, true}) {
    AmtWriteOptions options;
    options.isPacked = isPacked;
    failAllocationsOf("write", [&] { return writeAmt(path, model_, {}, options); });
    ASSERT_TRUE(writeAmt(path, model_, {}, options));
    failAllocationsOf("load", [&] { return loadAmt(path); });
  }
  for (const std::string name : {"tin.ply", "tin.obj", "tin.stl", "tin.2dm", "tin.glb"}) {
    const fs::path tin = folder_ / name;
    failAllocationsOf("write " + name, [&] { return writeMesh(tin_, tin); });
    ASSERT_TRUE(writeMesh(tin_, tin));
    failAllocationsOf("read " + name, [&] { return readMesh(tin); });
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 6)
      << "half-written files are left";
}

}  // namespace
}  // namespace arete
