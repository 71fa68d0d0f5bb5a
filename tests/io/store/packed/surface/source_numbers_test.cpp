// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/surface/source_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/model/face_successors.h"
#include "surface/model/renumbered.h"

namespace arete::packed {
namespace {

SurfaceModel modelOf(SurfaceMesh mesh) {
  Result<SurfaceModel> model = buildSurface(std::move(mesh));
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(*model);
}

/// The same model with its wedges in the order that the coder expects.
SurfaceModel inOrder(const SurfaceModel& model) {
  std::vector<std::uint32_t> vertices(model.mt.vertexCount()), triangles(model.mt.triangleIdCount());
  std::iota(vertices.begin(), vertices.end(), 0u);
  std::iota(triangles.begin(), triangles.end(), 0u);
  return renumbered(model, model.mt, vertices, triangles);
}

void expectRoundTrip(const SurfaceModel& model) {
  const std::vector<std::byte> bytes = packSourceNumbers(model);
  SurfaceModel read = model;
  read.vertexOf = read.faceOf = {};
  read.wedgesOf = {};
  ASSERT_TRUE(unpackSourceNumbers(bytes, read));
  EXPECT_EQ(read.vertexOf, model.vertexOf);
  EXPECT_EQ(read.faceOf, model.faceOf);
  EXPECT_EQ(read.wedgesOf, model.wedgesOf);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 50)
    EXPECT_FALSE(unpackSourceNumbers(std::span(bytes).first(size), read)) << size;
}

TEST(SourceNumbers, ComeBackForEveryFamily) {
  for (const shapes::NamedMesh& family : shapes::families(3)) {
    SCOPED_TRACE(family.name);
    expectRoundTrip(inOrder(modelOf(SurfaceMesh(family.mesh))));
  }
}

TEST(SourceNumbers, ComeBackInAnyOrderOfTheSource) {
  SurfaceModel model = inOrder(modelOf(SurfaceMesh(shapes::hills(20, 2))));
  std::mt19937_64 random(7);
  std::ranges::shuffle(model.vertexOf, random);
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    model.faceOf[t] = model.mt.remover(TriangleId(t)).isValid()
                          ? 0
                          : static_cast<std::uint32_t>(random() % model.sourceFaces);
  inheritFaces(model.mt, model.faceOf);
  expectRoundTrip(model);
}

TEST(SourceNumbers, TakeFewBitsWhereTheSourceIsAGrid) {
  const SurfaceModel model = inOrder(modelOf(SurfaceMesh(shapes::hills(60, 2))));
  EXPECT_LT(8.0 * static_cast<double>(packSourceNumbers(model).size()),
            12.0 * static_cast<double>(model.mt.vertexCount()));
}

/// Parts of several wedges at a vertex, of which some return to one that was in use before.
SurfaceMesh patched(std::uint64_t seed) {
  SurfaceMesh mesh(shapes::hills(14, seed));
  Attribute texcoord{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const Vec3& p = mesh.positions[t[0]];
    const std::uint32_t part =
        (static_cast<std::uint32_t>(p.x / 4) + static_cast<std::uint32_t>(p.y / 5)) % 3;
    mesh.materialOf.push_back(part % 2);
    mesh.wedges.push_back({t[0] + part * vertices, t[1] + part * vertices, t[2] + part * vertices});
  }
  mesh.materials = {{.name = "one"}, {.name = "two"}};
  mesh.wedgeCount = 3 * vertices;
  for (std::uint32_t w = 0; w < mesh.wedgeCount; ++w) texcoord.append(std::vector<double>{double(w), 0.5});
  mesh.wedgeAttributes = {texcoord};
  return mesh;
}

TEST(SourceNumbers, ComeBackWithWedgesAndFacesOfCoarseTriangles) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const SurfaceModel model = inOrder(modelOf(patched(seed)));
    ASSERT_TRUE(model.hasWedges() && model.hasFaceAttributes());
    expectRoundTrip(model);
  }
}

TEST(SourceNumbers, ComeBackWhereAWedgeIsOfSeveralVertices) {
  SurfaceModel model = inOrder(modelOf(patched(4)));
  std::mt19937_64 random(5);
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    if (const NodeId creator = model.mt.creator(TriangleId(t));
        !creator.isValid() || model.mt.remover(TriangleId(t)) != creator)
      for (std::uint32_t& w : model.wedgesOf[t])
        if (random() % 9 == 0) w = static_cast<std::uint32_t>(random() % model.attributes.wedgeCount);
  expectRoundTrip(model);
}

TEST(SourceNumbers, AnyBytesAreReadOrRefused) {
  const SurfaceModel model = inOrder(modelOf(patched(6)));
  const std::vector<std::byte> bytes = packSourceNumbers(model);
  std::mt19937_64 random(8);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> damaged = bytes;
    for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] ^= std::byte(1 << random() % 8);
    SurfaceModel read = model;
    static_cast<void>(unpackSourceNumbers(damaged, read));
    EXPECT_EQ(read.vertexOf.size(), model.vertexOf.size());
  }
}

}  // namespace
}  // namespace arete::packed
