// SPDX-License-Identifier: GPL-3.0-or-later
//
// An entry of a grid stays where its triangle moves away; who finds it compares boxes, so it only costs time.
// A box that would meet more cells than a grid has entries is compared with the entries.
#include "surface/decimate/crossing_guard.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

bool isThin(const PlacedTriangle& t) {
  const Vec3 n = arete::cross(t.places[1] - t.places[0], t.places[2] - t.places[0]);
  return !(dot(n, n) > 0);
}

}  // namespace

std::size_t CrossingGuard::CellHash::operator()(const Cell& c) const {
  std::uint64_t h = 0;
  for (const std::int64_t i : c) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15u + (h >> 29);
  return h;
}

CrossingGuard::CrossingGuard(const ContractionMesh& mesh) : mesh_(mesh) {
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v)
    for (const std::uint32_t t : mesh.trianglesOf(v)) count = std::max(count, t + 1);
  for (std::uint32_t t = 0; t < count; ++t)
    if (mesh.isThere(t)) add(t);
}

PlacedTriangle CrossingGuard::placed(std::uint32_t t) const {
  const auto& [i, j, k] = mesh_.corners(t);
  return {mesh_.corners(t), {mesh_.position(i), mesh_.position(j), mesh_.position(k)}};
}

Box3 CrossingGuard::boxOf(std::uint32_t t) const {
  Box3 box = Box3::empty();
  for (const std::uint32_t v : mesh_.corners(t)) box.include(mesh_.position(v));
  return box;
}

int CrossingGuard::levelOf(const Box3& box) {
  // Cells are wider than the box, so a triangle is in at most two of them along each axis.
  const double side = box.longestSide();
  return side > 0 ? std::max(std::ilogb(side) + 1, -1000) : -1000;
}

CrossingGuard::Cell CrossingGuard::cellOf(const Vec3& p, int level) {
  const auto along = [&](double x) {
    // The clamp lets far places share a cell, which costs time but loses no triangle.
    return static_cast<std::int64_t>(std::clamp(std::floor(std::ldexp(x, -level)), -0x1p60, 0x1p60));
  };
  return {along(p.x), along(p.y), along(p.z)};
}

void CrossingGuard::add(std::uint32_t t) {
  const Box3 box = boxOf(t);
  const int level = levelOf(box);
  const Cell low = cellOf(box.low, level), high = cellOf(box.high, level);
  Grid& grid = grids_[level];
  for (std::int64_t x = low[0]; x <= high[0]; ++x)
    for (std::int64_t y = low[1]; y <= high[1]; ++y)
      for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        grid.cells[{x, y, z}].push_back(t);
        ++grid.entries;
      }
}

void CrossingGuard::moved(std::uint32_t vertex) {
  for (const std::uint32_t t : mesh_.trianglesOf(vertex)) add(t);
}

template <class Visit>
bool CrossingGuard::forNear(const Box3& box, const Visit& visit) const {
  for (const auto& [level, grid] : grids_) {
    const Cell low = cellOf(box.low, level), high = cellOf(box.high, level);
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) cells *= static_cast<double>(high[k] - low[k] + 1);
    // If the box has more cells than the grid, it is cheaper to go through the grid's.
    if (cells > static_cast<double>(grid.cells.size())) {
      for (const auto& [cell, triangles] : grid.cells) {
        if (cell[0] < low[0] || cell[0] > high[0] || cell[1] < low[1] || cell[1] > high[1] ||
            cell[2] < low[2] || cell[2] > high[2])
          continue;
        for (const std::uint32_t t : triangles)
          if (!visit(t)) return false;
      }
      continue;
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto found = grid.cells.find({x, y, z});
          if (found == grid.cells.end()) continue;
          for (const std::uint32_t t : found->second)
            if (!visit(t)) return false;
        }
  }
  return true;
}

bool CrossingGuard::keepsApart(std::span<const std::uint32_t> vertices, const Vec3& place) const {
  // Those that are left at the vertices, as they are and as they would be.
  struct Moved {
    PlacedTriangle before, after;
  };
  std::vector<Moved> moved;
  std::vector<std::uint32_t> around;
  for (const std::uint32_t v : vertices)
    around.insert(around.end(), mesh_.trianglesOf(v).begin(), mesh_.trianglesOf(v).end());
  mesh_.forLeft(vertices, [&](std::uint32_t t, std::size_t at) {
    const PlacedTriangle before = placed(t);
    PlacedTriangle after = before;
    after.vertices[at] = vertices[0];
    after.places[at] = place;
    moved.push_back({before, after});
  });
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (isThin(moved[i].after)) return false;
    for (std::size_t j = i + 1; j < moved.size(); ++j)
      if (cross(moved[i].after, moved[j].after) &&
          (isThin(moved[i].before) || isThin(moved[j].before) || !cross(moved[i].before, moved[j].before)))
        return false;
  }
  for (const Moved& one : moved) {
    Box3 box = Box3::empty();
    for (const Vec3& p : one.after.places) box.include(p);
    const bool isApart = forNear(box, [&](std::uint32_t t) {
      if (!mesh_.isThere(t) || std::ranges::find(around, t) != around.end()) return true;
      if (!boxOf(t).meets(box)) return true;
      const PlacedTriangle there = placed(t);
      if (isThin(there) || !cross(one.after, there)) return true;
      return !isThin(one.before) && cross(one.before, there);
    });
    if (!isApart) return false;
  }
  return true;
}

}  // namespace arete
