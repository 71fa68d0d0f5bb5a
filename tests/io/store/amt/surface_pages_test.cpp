// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces in pages: what is read whole and in part, against the model that was written. Triangles are
// compared by what a user sees of them: places, source vertices, and every value, whatever their numbers are.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/criteria/space_region.h"
#include "engine/cut/cut.h"
#include "full_run.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/store/amt/surface_file.h"
#include "io/store/packed/pages/directory_blocks.h"
#include "surface/builder/build.h"
#include "surface/displacement/find_displacement.h"
#include "surface/families.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"
#include "surface/mesh_with_everything.h"

namespace arete {
namespace {

using test::TemporaryFolder;

struct NamedSurface {
  std::string name;
  SurfaceModel model;
};

std::vector<NamedSurface> pagedSurfaces() {
  std::vector<NamedSurface> all;
  const auto add = [&](std::string name, Result<SurfaceModel> model) {
    ASSERT_TRUE(model) << name << ": " << model.error().message;
    all.push_back({std::move(name), std::move(*model)});
  };
  for (const bool hasDoubles : {false, true})
    add(hasDoubles ? "everything, doubles" : "everything, floats",
        buildSurface(shapes::everything(hasDoubles, 60)));
  all.back().model.displacement = *findDisplacement(all.back().model);
  add("errors of attributes", buildSurface(shapes::everything(false, 40), {.boundsAttributes = true}));
  // Every corner its own wedge, so that many are new in pages that do not see each other.
  SurfaceMesh split(shapes::hills(40, 9));
  Attribute normal{.name = "normal", .meaning = AttributeMeaning::normal, .components = 3};
  for (const auto& triangle : split.triangles) {
    split.wedges.push_back({});
    for (std::size_t c = 0; c < 3; ++c) {
      split.wedges.back()[c] = split.wedgeCount++;
      normal.append(std::vector<double>{double(triangle[c] % 7), double(c), 1});
    }
  }
  split.wedgeAttributes = {normal};
  add("every corner a wedge", buildSurface(split));
  // A seam, and a wedge that no corner has.
  SurfaceMesh seamed(shapes::hills(50, 2));
  const auto vertices = static_cast<std::uint32_t>(seamed.positions.size());
  Attribute texcoord{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  for (std::uint32_t w = 0; w < 2 * vertices + 1; ++w)
    texcoord.append(std::vector<double>{double(w % vertices) / vertices, double(w / vertices)});
  for (const auto& triangle : seamed.triangles) {
    const bool isLeft = seamed.positions[triangle[0]].x + seamed.positions[triangle[1]].x < 50;
    seamed.wedges.push_back(triangle);
    for (std::uint32_t& w : seamed.wedges.back()) w += isLeft ? 0 : vertices;
  }
  seamed.wedgeCount = 2 * vertices + 1;
  seamed.wedgeAttributes = {texcoord};
  add("a seam", buildSurface(seamed));
  SurfaceMesh faces(shapes::hills(50, 4));
  for (std::size_t t = 0; t < faces.triangles.size(); ++t)
    faces.faceOf.push_back(static_cast<std::uint32_t>(t / 2));
  add("numbers of faces alone", buildSurface(faces));
  for (const shapes::NamedMesh& family : shapes::families(5))
    add(family.name, buildSurface(SurfaceMesh(family.mesh)));
  return all;
}

/// What is seen of a triangle, as bytes.
std::vector<std::string> seenIn(const SurfaceModel& model, const Cut& cut) {
  const SurfaceFront front = surfaceOf(model, cut);
  const MeshAttributes& a = front.mesh;
  std::vector<std::string> all;
  const auto addBytes = [](std::string& to, std::span<const std::byte> bytes) {
    to.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  for (std::size_t t = 0; t < front.mesh.triangles.size(); ++t) {
    std::array<std::string, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = front.mesh.triangles[t][c];
      addBytes(corners[c], std::as_bytes(std::span(&front.mesh.positions[v], 1)));
      addBytes(corners[c], std::as_bytes(std::span(&front.vertexOf[v], 1)));
      for (const Attribute& attribute : a.vertexAttributes) addBytes(corners[c], attribute.element(v));
      if (a.hasWedges())
        for (const Attribute& attribute : a.wedgeAttributes)
          addBytes(corners[c], attribute.element(a.wedges[t][c]));
      if (!model.displacement.isEmpty()) {
        const Vec3 direction = model.displacement.direction(model.mt.corners(TriangleId(cut.ids[t]))[c]);
        addBytes(corners[c], std::as_bytes(std::span(&direction, 1)));
      }
    }
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    std::string one = corners[0] + corners[1] + corners[2];
    for (const Attribute& attribute : a.triangleAttributes) addBytes(one, attribute.element(t));
    for (const auto* list : {&a.objectOf, &a.groupOf, &a.materialOf, &a.faceOf})
      if (!list->empty()) addBytes(one, std::as_bytes(std::span(&(*list)[t], 1)));
    addBytes(one, std::as_bytes(std::span(&front.errors[t], 1)));
    const std::size_t ids = model.mt.triangleIdCount();
    for (const AttributeErrors& errors : model.attributeErrors)
      for (std::size_t level = 0; level <= model.attributeDistances.size(); ++level)
        addBytes(one, std::as_bytes(std::span(&errors.codes[level * ids + cut.ids[t]], 1)));
    if (!model.displacement.isEmpty())
      one.push_back(static_cast<char>(model.displacement.reaches[cut.ids[t]]));
    all.push_back(std::move(one));
  }
  std::ranges::sort(all);
  return all;
}

/// What a criterion allows over a box of space.
RequiredError requiredOver(std::shared_ptr<const BoundedCriterion> criterion, const MetricFrame& metric) {
  return [criterion = std::move(criterion), metric](const Box3& box) {
    const Vec3 low = metric.toMetric(box.low), high = metric.toMetric(box.high), middle = (low + high) / 2.0;
    return criterion->allowedError(
        {float(middle.x), float(middle.y), float(middle.z), float(norm(high - low) / 2 * 1.001 + 1e-6)});
  };
}

TEST(SurfacePages, GiveBackTheWholeModelAndTheSameBytesWhenTheyAreWrittenAgain) {
  const TemporaryFolder folder;
  RunContext oneThread;
  oneThread.threads = 1;
  for (const auto& [name, model] : pagedSurfaces()) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(writeSurfaceAmt(folder.file("a.amt"), model, {}, {.isPaged = true}));
    const Result<SurfaceModel> read = loadSurfaceAmt(folder.file("a.amt"));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_FALSE(read->finestOfWhole);
    EXPECT_TRUE(read->partFaces.empty());
    EXPECT_TRUE(validateSurface(*read)) << validateSurface(*read).error().message;
    const Cut finest = *takeCut(model.mt, UniformError(0)), coarse = *takeCut(model.mt, UniformError(0.5));
    EXPECT_TRUE(seenIn(model, finest) == seenIn(*read, *takeCut(read->mt, UniformError(0))));
    EXPECT_TRUE(seenIn(model, coarse) == seenIn(*read, *takeCut(read->mt, UniformError(0.5))));
    // Faces that no triangle stands for have their values too.
    EXPECT_TRUE(read->attributes.triangleAttributes == model.attributes.triangleAttributes);
    EXPECT_TRUE(read->attributes.objectOf == model.attributes.objectOf);
    EXPECT_TRUE(read->attributes.materialOf == model.attributes.materialOf);
    EXPECT_TRUE(read->attributes.groupOf == model.attributes.groupOf);
    EXPECT_TRUE(read->attributes.faceOf == model.attributes.faceOf);
    EXPECT_TRUE(read->attributes.pictures == model.attributes.pictures);
    EXPECT_EQ(read->attributes.wedgeCount, model.attributes.wedgeCount);
    EXPECT_TRUE(read->leftOutFaces == model.leftOutFaces);
    ASSERT_TRUE(writeSurfaceAmt(folder.file("b.amt"), *read, {}, {.isPaged = true}));
    const SurfaceModel again = *loadSurfaceAmt(folder.file("b.amt"));
    ASSERT_TRUE(writeSurfaceAmt(folder.file("c.amt"), again, oneThread, {.isPaged = true}));
    EXPECT_TRUE(test::readAll(folder.file("b.amt")) == test::readAll(folder.file("c.amt")));
  }
}

TEST(SurfacePages, APartHasTheCutOfTheWholeWithEverythingThatItsTrianglesCarry) {
  const TemporaryFolder folder;
  std::mt19937 random(63);
  int parts = 0, enough = 0;
  for (const auto& [name, model] : pagedSurfaces()) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(writeSurfaceAmt(folder.file("a.amt"), model, {}, {.isPaged = true}));
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < (test::isFull() ? 200 : 25); ++i) {
      const auto at = static_cast<std::uint32_t>(random() % model.mt.vertexCount());
      const double inside = std::pow(share(random), 4) * model.diagonal * 0.1;
      const double outside = i % 3 == 0 ? model.diagonal : inside + share(random) * model.diagonal * 0.1;
      std::shared_ptr<const BoundedCriterion> criterion;
      if (i % 4 == 0)
        criterion = std::make_shared<UniformError>(inside);
      else
        criterion = std::make_shared<SpaceRegionError>(
            std::make_shared<BallRegion>(model.mt.position(VertexId(at)),
                                         share(random) * model.diagonal * 0.2),
            model.mt.metric(), inside, outside);
      const Result<SurfaceModel> part =
          loadSurfaceAmt(folder.file("a.amt"), {.wanted = requiredOver(criterion, model.mt.metric())});
      ASSERT_TRUE(part) << part.error().message;
      EXPECT_TRUE(part->validate()) << part->validate().error().message;
      EXPECT_EQ(part->finestTriangles(), model.mt.finestTriangleCount());
      parts += part->finestOfWhole ? 1 : 0;
      const Cut ofPart = *takeCut(part->mt, *criterion);
      if (!ofPart.missing.empty()) continue;
      ++enough;
      EXPECT_TRUE(seenIn(*part, ofPart) == seenIn(model, *takeCut(model.mt, *criterion)));
    }
  }
  EXPECT_GT(parts, 100);
  EXPECT_GT(enough, 100);
}

TEST(SurfacePages, OfTheRootAloneSayWhatTheWholeIs) {
  const TemporaryFolder folder;
  const SurfaceModel model = *buildSurface(shapes::everything(false, 60));
  ASSERT_TRUE(writeSurfaceAmt(folder.file("a.amt"), model, {}, {.isPaged = true}));
  const Result<SurfaceModel> outline = loadSurfaceAmt(folder.file("a.amt"), {.wanted = requiredNowhere()});
  ASSERT_TRUE(outline) << outline.error().message;
  EXPECT_EQ(outline->mt.nodeCount(), 0u);
  EXPECT_EQ(outline->mt.rootTriangleCount(), model.mt.rootTriangleCount());
  EXPECT_EQ(outline->finestTriangles(), model.mt.finestTriangleCount());
  EXPECT_EQ(outline->diagonal, model.diagonal);
  EXPECT_EQ(outline->attributes.objects, model.attributes.objects);
  ASSERT_FALSE(model.attributes.vertexAttributes.empty());
  EXPECT_EQ(outline->attributes.vertexAttributes[0].name, model.attributes.vertexAttributes[0].name);
  EXPECT_LT(outline->partFaces.size(), model.sourceFaces);
  // Of a plain and of a packed file everything is read.
  for (const bool isPacked : {false, true}) {
    ASSERT_TRUE(writeSurfaceAmt(folder.file("b.amt"), model, {}, {.isPacked = isPacked}));
    EXPECT_FALSE(loadSurfaceAmt(folder.file("b.amt"), {.wanted = requiredNowhere()})->finestOfWhole);
  }
}

TEST(SurfacePages, NameThePageWhoseBytesWereAlteredAndLeaveTheOthersReadable) {
  const TemporaryFolder folder;
  const SurfaceModel model = *buildSurface(shapes::everything(false, 60));
  ASSERT_TRUE(writeSurfaceAmt(folder.file("a.amt"), model, {}, {.isPaged = true}));
  const AmtContainer file = *AmtContainer::open(folder.file("a.amt"));
  const AmtChunk nodes = *file.find(amt_tag::kPackedNodes);
  std::string bytes = test::readAll(folder.file("a.amt"));
  bytes[nodes.offset + nodes.bytes - 3] ^= 4;
  test::writeAll(folder.file("b.amt"), bytes);
  const Result<SurfaceModel> whole = loadSurfaceAmt(folder.file("b.amt"));
  ASSERT_FALSE(whole);
  EXPECT_EQ(whole.error().code, ErrorCode::corrupt);
  EXPECT_NE(whole.error().message.find("page "), std::string::npos) << whole.error().message;
  EXPECT_TRUE(loadSurfaceAmt(folder.file("b.amt"), {.wanted = requiredNowhere()}));
}

/// Makes the checksums of segments and of a directory of one level anew.
void sealPages(test::AmtBytes& file) {
  const auto root = file.array<std::byte>(amt_tag::kPageRoot),
             blocks = file.array<std::byte>(amt_tag::kPageBlocks),
             nodes = file.array<std::byte>(amt_tag::kPackedNodes);
  const auto replace = [](std::span<std::byte> in, std::uint64_t old, std::span<const std::byte> of) {
    const std::uint64_t sum = XXH3_64bits(of.data(), of.size());
    // Where the checksum lies is found by its old value.
    const auto found = std::ranges::search(in, std::as_bytes(std::span(&old, 1))).begin();
    if (found != in.end()) std::ranges::copy(std::as_bytes(std::span(&sum, 1)), found);
  };
  std::string ignored;
  const auto directory = packed::pageRootOf(root, ignored);
  if (!directory || directory->levels != 1) return;
  for (const packed::BlockEntry& entry : directory->entries) {
    if (entry.offset > blocks.size() || entry.bytes > blocks.size() - entry.offset) continue;
    const auto block = blocks.subspan(entry.offset, entry.bytes);
    const auto first =
        static_cast<std::uint32_t>(&entry - directory->entries.data()) * packed::kPagesPerBlock;
    const auto pages = packed::pagesOf(block, entry, first);
    if (!pages) continue;
    for (const packed::Packet& page : *pages)
      for (const packed::Segment& segment : page.segments)
        if (segment.begin() <= nodes.size() && segment.bytes() <= nodes.size() - segment.begin())
          replace(block, segment.checksum, nodes.subspan(segment.begin(), segment.bytes()));
    replace(root, entry.checksum, block);
  }
  file.seal();
}

/// What comes back is refused, or is a model that can be written, cut and shown.
TEST(SurfacePages, AreRefusedOrSurviveWhateverTheirBytesAre) {
  const TemporaryFolder folder;
  std::mt19937 random(11);
  for (const bool hasErrors : {false, true}) {
    SurfaceModel model = *buildSurface(shapes::everything(false, 8), {.boundsAttributes = hasErrors});
    if (!hasErrors) model.displacement = *findDisplacement(model);
    ASSERT_TRUE(writeSurfaceAmt(folder.file("a.amt"), model, {}, {.isPaged = true}));
    const test::AmtBytes original = test::AmtBytes::of(folder.file("a.amt"));
    int survived = 0, tried = 0;
    for (const AmtTag& tag : {amt_tag::kPackedNumbers, amt_tag::kAttributes, amt_tag::kLooks,
                              amt_tag::kPageRoot, amt_tag::kPageBlocks, amt_tag::kPackedNodes}) {
      const std::size_t size = test::AmtBytes(original).array<std::byte>(tag).size();
      for (std::size_t at = 0; at < size; at += test::isFull() ? 1 : 1 + random() % 97) {
        test::AmtBytes changed = original;
        changed.array<std::byte>(tag)[at] ^= std::byte(1u << random() % 8);
        sealPages(changed);
        changed.save(folder.file("b.amt"));
        for (const RequiredError& wanted :
             {RequiredError(), requiredNowhere(), RequiredError([](const Box3& b) { return b.low.x; })}) {
          ++tried;
          const Result<SurfaceModel> read = loadSurfaceAmt(folder.file("b.amt"), {.wanted = wanted});
          if (!read) {
            EXPECT_FALSE(read.error().message.empty());
            continue;
          }
          ++survived;
          const Result<Cut> cut = takeCut(read->mt, UniformError(0));
          ASSERT_TRUE(cut);
          surfaceOf(*read, *cut);
          if (!read->finestOfWhole) {
            ASSERT_TRUE(writeSurfaceAmt(folder.file("c.amt"), *read));
            const Result<SurfaceModel> plain = loadSurfaceAmt(folder.file("c.amt"));
            ASSERT_TRUE(plain) << plain.error().describe();
          }
        }
      }
    }
    RecordProperty("survived", survived);
    EXPECT_GT(tried, 200);
  }
}

}  // namespace
}  // namespace arete
