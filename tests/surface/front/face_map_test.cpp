// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every face of a source has a place in every cut, also where the build left it out or split it.
#include "surface/front/face_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "surface/builder/build.h"
#include "surface/front/front.h"
#include "surface/laws/validate_surface.h"
#include "surface/shapes.h"

namespace arete {
namespace {

/// A box of n x n squares a side, at whole coordinates: middles of edges are exact.
TriangleMesh block(std::uint32_t n) {
  TriangleMesh mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  const auto vertex = [&](std::array<std::uint32_t, 3> p) {
    const auto [at, isNew] = known.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) mesh.positions.push_back({64.0 * p[0], 64.0 * p[1], 64.0 * p[2]});
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::uint32_t side : {0u, n})
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k) {
          const auto at = [&](std::uint32_t a, std::uint32_t b) {
            std::array<std::uint32_t, 3> p{};
            p[axis] = side, p[(axis + 1) % 3] = a, p[(axis + 2) % 3] = b;
            return vertex(p);
          };
          std::array<std::uint32_t, 4> q{at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)};
          if (side == 0) std::ranges::reverse(q);
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
  return mesh;
}

bool isFlat(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return norm(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])) == 0;
}

/// Splits a face on one side of an edge only, at several vertices, and closes the gap with faces on that
/// line: a fan or a chain of them.
void addChain(TriangleMesh& mesh, std::size_t triangle, std::size_t side, int vertices, bool isFan) {
  const auto t = mesh.triangles[triangle];
  const std::uint32_t a = t[side], b = t[(side + 1) % 3], d = t[(side + 2) % 3];
  std::vector<std::uint32_t> line{a};
  for (int i = 1; i <= vertices; ++i) {
    line.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    const double part = vertices == 1 ? 0.5 : 0.25 * (2 * i - 1);
    mesh.positions.push_back((1 - part) * mesh.positions[a] + part * mesh.positions[b]);
  }
  line.push_back(b);
  mesh.triangles[triangle] = {line[0], line[1], d};
  for (std::size_t i = 1; i + 1 < line.size(); ++i) mesh.triangles.push_back({line[i], line[i + 1], d});
  // Between the line, from b to a, and the edge beyond it.
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    mesh.triangles.push_back(isFan ? std::array{line[i + 1], line[i], a}
                                   : std::array{b, line[i], line[i - 1]});
}

struct Case {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    TriangleMesh mesh = block(1 + static_cast<std::uint32_t>(seed % 3));
    std::set<std::array<std::uint32_t, 2>> used;  // edges that have a chain
    for (std::uint64_t i = 0; i < 1 + seed % 5; ++i) {
      const std::size_t t = random() % mesh.triangles.size(), side = random() % 3;
      const auto& corners = mesh.triangles[t];
      std::array<std::uint32_t, 2> edge{corners[side], corners[(side + 1) % 3]};
      std::ranges::sort(edge);
      if (isFlat(mesh, t) || !used.insert(edge).second) continue;
      addChain(mesh, t, side, 1 + static_cast<int>(random() % 2), random() % 2 == 0);
    }
    if (seed % 3 == 0) mesh.triangles.push_back(mesh.triangles[random() % mesh.triangles.size()]);
    if (seed % 4 == 0) mesh.triangles.push_back({0, 0, mesh.triangles[0][1]});
    all.push_back({"block of seed " + std::to_string(seed), std::move(mesh)});
  }
  return all;
}

constexpr double kRounding = 1e-9;  // of coordinates up to 192

SpaceTriangle placeOf(const TriangleMesh& mesh, std::size_t f) {
  const auto& [a, b, c] = mesh.triangles[f];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

double fromMiddle(const TriangleMesh& mesh, std::size_t f, const SpaceTriangle& to) {
  const SpaceTriangle face = placeOf(mesh, f);
  return distanceToTriangle((face[0] + face[1] + face[2]) / 3.0, to);
}

/// The first face with the same corners in the same turn.
std::size_t twinOf(const TriangleMesh& mesh, std::size_t f) {
  const auto turned = [&](std::size_t t) {
    auto corners = mesh.triangles[t];
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    return corners;
  };
  std::size_t twin = 0;
  while (turned(twin) != turned(f)) ++twin;
  return twin;
}

/// The face that holds a left-out one is, of all that the build kept, none farther from its middle.
void expectRightPlaces(const TriangleMesh& mesh, const SurfaceModel& model) {
  std::set<std::uint32_t> kept;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    if (!model.mt.remover(TriangleId(t)).isValid()) kept.insert(model.faceOf[t]);
  ASSERT_EQ(kept.size() + model.leftOutFaces.size(), mesh.triangles.size());
  for (const auto& [face, in] : model.leftOutFaces) {
    SCOPED_TRACE("left-out face " + std::to_string(face));
    ASSERT_TRUE(kept.contains(in));
    double least = fromMiddle(mesh, face, placeOf(mesh, in));
    const double there = least;
    for (const std::uint32_t other : kept)
      least = std::min(least, fromMiddle(mesh, face, placeOf(mesh, other)));
    EXPECT_LE(there, least + kRounding);
    const std::size_t twin = twinOf(mesh, face);
    if (twin != face && kept.contains(static_cast<std::uint32_t>(twin))) {
      EXPECT_EQ(in, twin);
    }
  }
}

TEST(FaceMap, HasAPlaceOfEveryFaceWhereFlatOnesWereLeftOutAndTheirNeighboursSplit) {
  std::uint64_t leftOut = 0, split = 0;
  for (const auto& [name, mesh] : cases()) {
    SCOPED_TRACE(name);
    const Result<SurfaceModel> model = buildSurface(SurfaceMesh(mesh));
    ASSERT_TRUE(model) << model.error().describe();
    const Status valid = validateSurface(*model);
    EXPECT_TRUE(valid) << valid.error().message;
    expectRightPlaces(mesh, *model);
    leftOut += model->leftOutFaces.size();
    split += model->mending.splitFaces;
    for (const std::uint32_t nodes : {model->mt.nodeCount(), model->mt.nodeCount() / 2, 0u}) {
      const Cut cut = frontOfPrefix(model->mt, nodes);
      const std::vector<std::uint32_t> faces = facesOf(*model, cut);
      ASSERT_EQ(faces.size(), mesh.triangles.size());
      for (std::size_t f = 0; f < faces.size(); ++f) {
        ASSERT_LT(faces[f], cut.triangles.size()) << "face " << f << " of " << faces.size();
        // The finest triangle that stands for a face holds its middle, also where the face was split.
        if (nodes != model->mt.nodeCount() || isFlat(mesh, f)) continue;
        SpaceTriangle place;
        for (std::size_t c = 0; c < 3; ++c)
          place[c] = model->mt.position(VertexId(cut.vertices[cut.triangles[faces[f]][c]]));
        EXPECT_LE(fromMiddle(mesh, f, place), kRounding) << "face " << f;
      }
      for (const auto& [face, in] : model->leftOutFaces) EXPECT_EQ(faces[face], faces[in]);
    }
  }
  EXPECT_GT(leftOut, 60u);
  EXPECT_GT(split, 60u);
}

}  // namespace
}  // namespace arete
