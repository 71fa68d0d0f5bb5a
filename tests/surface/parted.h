// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "surface/model/surface_mesh.h"
#include "surface/shapes.h"

// Random surfaces of many parts, and a check of what is left of them that shares no code with what makes it.
namespace arete::parted {

/// How a mesh says which part a face belongs to.
struct Carriers {
  bool objects = false, materials = false, labels = false, charts = false;
};

inline Attribute labelsOf(const std::vector<std::uint32_t>& parts) {
  Attribute attribute{.name = "label", .type = ScalarType::int32};
  for (const std::uint32_t p : parts) attribute.append(std::array{double(p) * 3 - 5});
  return attribute;
}

/// By triangle: what hangs together across edges between triangles of equal numbers.
inline std::vector<std::uint32_t> connected(const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                            const std::vector<std::uint32_t>& parts) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      at[{std::min(a, b), std::max(a, b)}].push_back(t);
    }
  std::vector<std::vector<std::uint32_t>> beside(triangles.size());
  for (const auto& [edge, sides] : at)
    for (const std::uint32_t s : sides)
      for (const std::uint32_t t : sides)
        if (s != t && parts[s] == parts[t]) beside[s].push_back(t);
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> number(triangles.size(), kNone), open;
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (number[t] != kNone) continue;
    number[t] = count;
    open = {t};
    while (!open.empty()) {
      const std::uint32_t s = open.back();
      open.pop_back();
      for (const std::uint32_t n : beside[s])
        if (number[n] == kNone) {
          number[n] = count;
          open.push_back(n);
        }
    }
    ++count;
  }
  return number;
}

/// Says of each face the part that it has, in as many ways as asked. Charts have places in the picture that
/// are ten apart.
inline SurfaceMesh withParts(const TriangleMesh& shape, const std::vector<std::uint32_t>& parts,
                             const Carriers& carriers) {
  SurfaceMesh mesh(shape);
  if (carriers.objects) {
    // Two parts share an object.
    for (const std::uint32_t p : parts) mesh.objectOf.push_back(p / 2);
    for (std::uint32_t o = 0; o <= *std::ranges::max_element(mesh.objectOf); ++o)
      mesh.objects.push_back("o" + std::to_string(o));
  }
  if (carriers.materials) {
    mesh.materialOf = parts;
    for (std::uint32_t m = 0; m <= *std::ranges::max_element(parts); ++m)
      mesh.materials.push_back({.name = "m" + std::to_string(m)});
  }
  if (carriers.labels) mesh.triangleAttributes.push_back(labelsOf(parts));
  if (carriers.charts) {
    const std::vector<std::uint32_t> charts = connected(shape.triangles, parts);
    Attribute places{.name = "texcoord",
                     .meaning = AttributeMeaning::textureCoords,
                     .type = ScalarType::float64,
                     .components = 2};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wedges;  // vertex, chart
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
      auto& corners = mesh.wedges.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = shape.triangles[t][i];
        const auto [known, isNew] =
            wedges.try_emplace({v, charts[t]}, static_cast<std::uint32_t>(wedges.size()));
        corners[i] = known->second;
        if (isNew) places.append(std::array{10.0 * charts[t], double(v)});
      }
    }
    mesh.wedgeCount = static_cast<std::uint32_t>(wedges.size());
    mesh.wedgeAttributes.push_back(std::move(places));
  }
  return mesh;
}

/// What a mesh says of a face: object, material, label, chart; -1 what it does not say, -2 corners of several
/// charts.
using Part = std::array<double, 4>;
inline Part partAt(const SurfaceMesh& mesh, std::size_t t) {
  Part part{-1, -1, -1, -1};
  if (!mesh.objectOf.empty()) part[0] = mesh.objectOf[t];
  if (!mesh.materialOf.empty()) part[1] = mesh.materialOf[t];
  if (!mesh.triangleAttributes.empty()) part[2] = mesh.triangleAttributes[0].numbers(t)[0] + 1e6;
  // Where corners agree at all vertices, what they have is the vertices'.
  if (mesh.wedges.empty()) {
    if (!mesh.vertexAttributes.empty())
      part[3] = std::round(mesh.vertexAttributes[0].numbers(mesh.triangles[t][0])[0] / 10);
    return part;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double chart = std::round(mesh.wedgeAttributes[0].numbers(mesh.wedges[t][i])[0] / 10);
    part[3] = i == 0 || part[3] == chart ? chart : -2;
  }
  return part;
}

inline double distanceOf(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto toSegment = [&](const Vec3& u, const Vec3& v) {
    const Vec3 d = v - u;
    const double t = dot(d, d) > 0 ? std::min(1.0, std::max(0.0, dot(p - u, d) / dot(d, d))) : 0;
    return norm(p - (u + t * d));
  };
  double least = std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
  const Vec3 n = cross(b - a, c - a);
  if (!(dot(n, n) > 0)) return least;
  const Vec3 q = p - n * (dot(p - a, n) / dot(n, n));
  const auto inside = [&](const Vec3& u, const Vec3& v) { return dot(cross(v - u, q - u), n) >= 0; };
  if (inside(a, b) && inside(b, c) && inside(c, a)) least = std::min(least, norm(p - q));
  return least;
}

/// A point of the source with what its face is of.
struct Sample {
  Vec3 place;
  Part part;
};
/// Corners, middles of sides and random points of the faces.
inline std::vector<Sample> samplesOf(const SurfaceMesh& mesh, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Sample> samples;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Part part = partAt(mesh, t);
    const Vec3 &a = mesh.positions[mesh.triangles[t][0]], &b = mesh.positions[mesh.triangles[t][1]],
               &c = mesh.positions[mesh.triangles[t][2]];
    double u = share(random), v = share(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    for (const Vec3& p :
         {a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, a + (b - a) * u + (c - a) * v})
      samples.push_back({p, part});
  }
  return samples;
}

/// The first sample that is farther than E from the faces of its part, in words.
inline std::optional<std::string> violation(const std::vector<Sample>& samples, const SurfaceMesh& result,
                                            double error) {
  std::map<Part, std::vector<std::array<Vec3, 3>>> faces;
  double largest = 0;
  for (const Vec3& p : result.positions)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const auto& [a, b, c] = result.triangles[t];
    faces[partAt(result, t)].push_back({result.positions[a], result.positions[b], result.positions[c]});
  }
  for (const Sample& sample : samples) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : faces[sample.part])
      least = std::min(least, distanceOf(sample.place, a, b, c));
    if (least <= error + 1e-13 * largest) continue;
    return "a point at " + std::to_string(sample.place.x) + ", " + std::to_string(sample.place.y) + ", " +
           std::to_string(sample.place.z) + " is " + std::to_string(least) + " from its part, not " +
           std::to_string(error);
  }
  return std::nullopt;
}

struct RandomSurface {
  std::string name;
  SurfaceMesh mesh;
};

/// Plates, folds, rough sheets, tubes, tori and balls of random parts: stripes, squares, blobs, thin bands,
/// single triangles, patches that touch at a vertex or lie along a border.
inline RandomSurface randomSurface(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  const auto below = [&](std::uint64_t n) { return static_cast<std::uint32_t>(random() % n); };
  TriangleMesh shape;
  const std::uint32_t columns = 3 + below(9), rows = 3 + below(9);
  std::string name;
  switch (below(6)) {
    case 0:
      name = "plate", shape = shapes::sheet(columns, rows);
      break;
    case 1:
      name = "rough sheet", shape = shapes::sheet(columns, rows);
      for (Vec3& p : shape.positions) p.z = 0.4 * share(random);
      break;
    case 2:
      name = "fold", shape = shapes::sheet(columns, rows);
      for (Vec3& p : shape.positions)
        if (const double over = p.x - columns / 2; over > 0)
          p = {columns / 2 - over, p.y, 0.01 + 0.02 * over};
      break;
    case 3:
      name = "tube", shape = shapes::sheet(columns, rows, true);
      break;
    case 4:
      name = "torus", shape = shapes::sheet(columns, rows, true, true);
      break;
    default:
      name = "spikes", shape = shapes::sheet(columns, rows);
      for (Vec3& p : shape.positions) p.z = below(6) == 0 ? 3 * share(random) : 0;
  }
  if (name != "torus" && name != "tube" && below(2) == 0) {
    name += ", shifted inside";
    for (std::uint32_t v = 0; v < shape.positions.size(); ++v)
      if (const std::uint32_t c = v % (columns + 1), r = v / (columns + 1);
          c > 0 && c < columns && r > 0 && r < rows) {
        shape.positions[v].x += 0.3 * (share(random) - 0.5);
        shape.positions[v].y += 0.3 * (share(random) - 0.5);
      }
  }
  if (below(3) == 0) {  // holes
    name += ", holes";
    const std::size_t before = shape.triangles.size();
    std::erase_if(shape.triangles, [&](const auto&) { return before > 12 && below(15) == 0; });
  }
  std::vector<std::uint32_t> parts(shape.triangles.size(), 0);
  const auto middle = [&](std::size_t t) {
    const auto& [a, b, c] = shape.triangles[t];
    return (shape.positions[a] + shape.positions[b] + shape.positions[c]) / 3.0;
  };
  const std::uint32_t pattern = below(8), many = 1 + below(4);
  name += ", pattern " + std::to_string(pattern);
  const double width = 0.8 + 3 * share(random);
  std::vector<Vec3> centres;
  for (std::uint32_t i = 0; i <= many; ++i) centres.push_back(middle(below(parts.size())));
  for (std::size_t t = 0; t < parts.size(); ++t) {
    const Vec3 p = middle(t);
    const auto cell = [&](double x) { return static_cast<std::uint32_t>(std::floor(x / width) + 1000); };
    switch (pattern) {
      case 0:
        parts[t] = cell(p.x + 0.3 * p.y) % (many + 1);
        break;  // stripes
      case 1:
        parts[t] = (cell(p.x) + cell(p.y)) % 2;
        break;  // squares that touch at vertices
      case 2:
        parts[t] = norm(p - centres[0]) < width ? 1 : 0;
        break;  // a blob
      case 3:
        parts[t] = std::abs(p.y - centres[0].y) < 0.6 ? 1 : 0;
        break;  // a thin band to both borders
      case 4:
        parts[t] = below(10) == 0 ? 1 + below(many) : 0;
        break;  // single triangles
      case 5:
        parts[t] = p.y < width ? 1 + cell(p.x) % many : 0;
        break;  // along a border
      case 6:
        parts[t] = below(many + 1);
        break;  // anything
      default:  // around centres
        for (std::uint32_t i = 1; i < centres.size(); ++i)
          if (norm(p - centres[i]) < norm(p - centres[parts[t]])) parts[t] = i;
    }
  }
  Carriers carriers;
  const std::uint32_t ways = 1 + below(15);
  carriers.objects = ways & 1, carriers.materials = ways & 2, carriers.labels = ways & 4,
  carriers.charts = ways & 8;
  name += ", carriers " + std::to_string(ways) + ", seed " + std::to_string(seed);
  return {name, withParts(shape, parts, carriers)};
}

}  // namespace arete::parted
