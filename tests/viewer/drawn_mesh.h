// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the graphics memory holds of a terrain view, read back and brought into the map's coordinates.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "viewer/gl/offscreen.h"
#include "viewer/gl/terrain_drawable.h"

namespace arete::test {

struct DrawnMesh {
  std::vector<Vec3> vertices;  ///< source coordinates and heights, of all vertices of the MT
  std::vector<Vec2> plan;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

inline DrawnMesh readDrawn(const TerrainDrawable& view) {
  const TerrainOnGpu& t = view.terrain();
  const TerrainModel& model = view.model();
  const MetricFrame& metric = model.mt.arrays().metric;
  std::vector<float> positions(3 * std::size_t(t.vertices)), rises(t.vertices);
  glGetNamedBufferSubData(t.positions, 0, GLsizeiptr(4 * positions.size()), positions.data());
  glGetNamedBufferSubData(t.rises, 0, GLsizeiptr(4 * rises.size()), rises.data());
  DrawnMesh mesh;
  for (std::size_t v = 0; v < rises.size(); ++v) {
    const Vec2 plan{positions[3 * v] / metric.scale.x + metric.origin.x,
                    positions[3 * v + 1] / metric.scale.y + metric.origin.y};
    const Vec2 xy = model.toSource(plan);
    mesh.plan.push_back(plan);
    mesh.vertices.push_back({xy.x, xy.y, positions[3 * v + 2] / metric.scale.z + metric.origin.z + rises[v]});
  }
  const DrawnFront front = view.front();
  std::array<std::uint32_t, 3> command = {3 * front.count, 1, 3 * front.first};
  if (front.indirect != 0) glGetNamedBufferSubData(front.indirect, 0, sizeof command, command.data());
  mesh.triangles.resize(command[0] / 3);
  if (!mesh.triangles.empty())
    glGetNamedBufferSubData(front.indices, GLintptr(4) * command[2], GLsizeiptr(12 * mesh.triangles.size()),
                            mesh.triangles.data());
  return mesh;
}

/// What is not conforming about the triangles, or nothing: every edge is met once each way, or once where it
/// is a border, and borders are closed; no triangle is turned over.
inline std::string whyNotConforming(const DrawnMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    const Vec2 &a = mesh.plan[t[0]], &b = mesh.plan[t[1]], &c = mesh.plan[t[2]];
    if (!((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0))
      return "a triangle is turned over or flat";
    for (std::size_t i = 0; i < 3; ++i)
      if (++edges[{t[i], t[(i + 1) % 3]}] > 1) return "an edge has two triangles on one side";
  }
  std::map<std::uint32_t, int> balance;  // of border edges that leave a vertex, and come to it
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first})) {
      ++balance[edge.first];
      --balance[edge.second];
    }
  for (const auto& [vertex, sum] : balance)
    if (sum != 0) return "a border has an end at vertex " + std::to_string(vertex);
  return {};
}

inline double planArea(const DrawnMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vec2 &a = mesh.plan[t[0]], &b = mesh.plan[t[1]], &c = mesh.plan[t[2]];
    area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  return area;
}

/// Checks that the device and the processor draw the same surface for a camera. Returns its triangles.
inline std::size_t expectBothPathsAgree(TerrainDrawable& view, const Camera& camera, ViewSettings settings) {
  const auto drawnBy = [&](CutPath path, FrameFigures& figures) {
    settings.path = path;
    const auto cut = view.cut(camera, settings);
    EXPECT_TRUE(cut) << cut.error().describe();
    if (cut) figures = *cut;
    DrawnMesh mesh = readDrawn(view);
    for (auto& t : mesh.triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(mesh.triangles.begin(), mesh.triangles.end());
    return mesh;
  };
  FrameFigures device, processor;
  const DrawnMesh a = drawnBy(CutPath::device, device), b = drawnBy(CutPath::processor, processor);
  EXPECT_EQ(device.moving, processor.moving);
  EXPECT_EQ(a.triangles, b.triangles);
  for (const auto& t : a.triangles)
    for (const std::uint32_t v : t)
      if (std::abs(a.vertices[v].z - b.vertices[v].z) > 2e-3) {
        ADD_FAILURE() << "vertex " << v << " is at " << a.vertices[v].z << " and " << b.vertices[v].z;
        return a.triangles.size();
      }
  return a.triangles.size();
}

/// A context for the test, or a reason to skip it.
#define ARETE_NEEDS_OPENGL(context)                   \
  auto context = ::arete::OffscreenContext::create(); \
  if (!context) GTEST_SKIP() << "no OpenGL here: " << context.error().describe();

}  // namespace arete::test
