// SPDX-License-Identifier: GPL-3.0-or-later
//
// An entry of a grid stays where its triangle moves away; who finds it compares boxes, so it only costs time.
// A box that would meet more cells than a grid has entries is compared with the entries.
#include "surface/decimate/crossing_guard.h"

#include <algorithm>
#include <cmath>

#include "surface/topology/crossing.h"

namespace arete {
namespace {

bool holds(std::span<const std::uint32_t> vertices, std::uint32_t v) {
  return std::ranges::find(vertices, v) != vertices.end();
}

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

CrossingGuard::Box CrossingGuard::boxOf(std::uint32_t t) const {
  const auto& [i, j, k] = mesh_.corners(t);
  const Vec3 &a = mesh_.position(i), &b = mesh_.position(j), &c = mesh_.position(k);
  return {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
          {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}};
}

int CrossingGuard::levelOf(const Box& box) {
  const double side = std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
  return side > 0 ? std::max(std::ilogb(side) + 1, -1000) : -1000;
}

CrossingGuard::Cell CrossingGuard::cellOf(const Vec3& p, int level) {
  const auto along = [&](double x) {
    return static_cast<std::int64_t>(std::clamp(std::floor(std::ldexp(x, -level)), -0x1p60, 0x1p60));
  };
  return {along(p.x), along(p.y), along(p.z)};
}

void CrossingGuard::add(std::uint32_t t) {
  const Box box = boxOf(t);
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
bool CrossingGuard::forNear(const Box& box, const Visit& visit) const {
  for (const auto& [level, grid] : grids_) {
    const Cell low = cellOf(box.low, level), high = cellOf(box.high, level);
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) cells *= static_cast<double>(high[k] - low[k] + 1);
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
    std::uint32_t triangle;
    PlacedTriangle before, after;
  };
  std::vector<Moved> moved;
  std::vector<std::uint32_t> around;
  for (const std::uint32_t v : vertices)
    for (const std::uint32_t t : mesh_.trianglesOf(v)) {
      around.push_back(t);
      const auto& corners = mesh_.corners(t);
      int members = 0;
      for (const std::uint32_t w : corners) members += holds(vertices, w) ? 1 : 0;
      if (members > 1) continue;
      Moved one{t, {}, {}};
      for (std::size_t c = 0; c < 3; ++c) {
        one.before.vertices[c] = corners[c];
        one.before.places[c] = mesh_.position(corners[c]);
        const bool isIt = corners[c] == v;
        one.after.vertices[c] = isIt ? vertices[0] : corners[c];
        one.after.places[c] = isIt ? place : one.before.places[c];
      }
      moved.push_back(one);
    }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (isThin(moved[i].after)) return false;
    for (std::size_t j = i + 1; j < moved.size(); ++j)
      if (cross(moved[i].after, moved[j].after) &&
          (isThin(moved[i].before) || isThin(moved[j].before) || !cross(moved[i].before, moved[j].before)))
        return false;
  }
  for (const Moved& one : moved) {
    Box box{one.after.places[0], one.after.places[0]};
    for (const Vec3& p : one.after.places) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    const bool isApart = forNear(box, [&](std::uint32_t t) {
      if (!mesh_.isThere(t) || std::ranges::find(around, t) != around.end()) return true;
      const Box other = boxOf(t);
      if (other.low.x > box.high.x || other.high.x < box.low.x || other.low.y > box.high.y ||
          other.high.y < box.low.y || other.low.z > box.high.z || other.high.z < box.low.z)
        return true;
      PlacedTriangle there{mesh_.corners(t), {}};
      for (std::size_t c = 0; c < 3; ++c) there.places[c] = mesh_.position(there.vertices[c]);
      if (isThin(there) || !cross(one.after, there)) return true;
      return !isThin(one.before) && cross(one.before, there);
    });
    if (!isApart) return false;
  }
  return true;
}

}  // namespace arete
