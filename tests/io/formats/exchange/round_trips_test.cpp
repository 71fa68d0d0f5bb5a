// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh with every kind of attribute goes from every format to every other one. What arrives is equal, or
// the conversion says that it is lost. The comparison works on numbers by corner and shares no code with the
// formats.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "io/formats/exchange/convert.h"
#include "io/io_fixture.h"
#include "surface/model/surface_mesh.h"
#include "surface/shapes.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::TemporaryFolder;

using Random = std::mt19937;

Attribute attribute(std::string name, AttributeMeaning meaning, ScalarType type, int components,
                    std::size_t count, Random& random, double low, double high) {
  Attribute made{
      .name = std::move(name), .meaning = meaning, .type = type, .components = std::uint8_t(components)};
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> numbers;
    for (int c = 0; c < components; ++c) {
      const double x = std::uniform_real_distribution<double>(low, high)(random);
      numbers.push_back(type == ScalarType::float64   ? x
                        : type == ScalarType::float32 ? double(float(x))
                                                      : std::floor(x));
    }
    made.append(numbers);
  }
  return made;
}

/// The smallest PNG there is, with a mark at its end that tells pictures apart.
std::vector<std::byte> png(unsigned mark) {
  static constexpr unsigned char kBytes[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0,    0, 0, 13,
                                             'I',  'H', 'D', 'R', 0,    0,    0,    1,    0,    0, 0, 1,
                                             8,    6,   0,   0,   0,    0x1f, 0x15, 0xc4, 0x89, 0, 0, 0,
                                             0,    'I', 'E', 'N', 'D',  0xae, 0x42, 0x60, 0x82};
  std::vector<std::byte> bytes;
  for (const unsigned char b : kBytes) bytes.push_back(std::byte{b});
  bytes.push_back(std::byte(mark));
  return bytes;
}

/// Two tubes with seams, labels, colours, materials with pictures. Triangles are ordered by object, then
/// material, as glTF orders them.
MeshFile everything(unsigned seed) {
  Random random(seed);
  MeshFile file;
  SurfaceMesh& mesh = file.mesh;
  mesh.shape() = shapes::sheet(6, 4, true);
  for (Vec3& p : mesh.positions) p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
  const std::size_t triangles = mesh.triangles.size(), vertices = mesh.positions.size();
  for (std::size_t t = 0; t < triangles; ++t) {
    mesh.objectOf.push_back(t < triangles / 2 ? 0 : 1);
    mesh.materialOf.push_back(t / (triangles / 4) % 2 == 0 ? 0 : 1);
    mesh.groupOf.push_back(t % 2 == 0 ? 0 : 1);
    // A wedge for each vertex, and further ones along a seam.
    auto& wedges = mesh.wedges.emplace_back(mesh.triangles[t]);
    if (t % 12 == 0)
      for (std::uint32_t& w : wedges) w += std::uint32_t(vertices);
  }
  mesh.wedgeCount = std::uint32_t(2 * vertices);
  mesh.objects = {"left tube", "right"};
  mesh.groups = {"even", "odd"};
  mesh.materials.push_back({.name = "stone",
                            .baseColor = {0.5, 0.25, 0.125, 1},
                            .textures = {{.role = "baseColor", .picture = "#0"}}});
  mesh.materials.push_back({.name = "glass",
                            .baseColor = {1, 1, 1, 0.5},
                            .isDoubleSided = true,
                            .alphaMode = "BLEND",
                            .textures = {{.role = "baseColor", .picture = "#1"}}});
  mesh.pictures = {{.name = "stone", .mimeType = "image/png", .bytes = png(1)},
                   {.name = "glass", .mimeType = "image/png", .bytes = png(2)}};

  mesh.wedgeAttributes.push_back(attribute("texcoord", AttributeMeaning::textureCoords, ScalarType::float32,
                                           2, mesh.wedgeCount, random, 0, 1));
  Attribute color =
      attribute("color", AttributeMeaning::color, ScalarType::uint8, 4, vertices, random, 0, 256);
  color.isNormalized = true;
  color.colorSpace = ColorSpace::srgb;
  mesh.vertexAttributes.push_back(color);
  Attribute normal{
      .name = "normal", .meaning = AttributeMeaning::normal, .type = ScalarType::float32, .components = 3};
  for (std::size_t v = 0; v < vertices; ++v) {
    const double a = double(random() % 1000), n[3] = {std::cos(a), std::sin(a), 0};
    normal.append(std::span(n));
  }
  mesh.vertexAttributes.push_back(normal);
  const auto other = AttributeMeaning::other;
  mesh.vertexAttributes.push_back(
      attribute("quality", other, ScalarType::float32, 1, vertices, random, -1, 1));
  mesh.vertexAttributes.push_back(
      attribute("precise", other, ScalarType::float64, 1, vertices, random, -1, 1));
  mesh.vertexAttributes.push_back(
      attribute("label", other, ScalarType::int32, 1, vertices, random, -1e9, 1e9));
  mesh.vertexAttributes.push_back(attribute("small", other, ScalarType::uint8, 1, vertices, random, 0, 256));
  mesh.triangleAttributes.push_back(
      attribute("class", other, ScalarType::uint16, 1, triangles, random, 0, 65536));
  mesh.triangleAttributes.push_back(
      attribute("score", other, ScalarType::float64, 1, triangles, random, 0, 1));
  return file;
}

double toSrgb(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

/// What a corner has by the name of an attribute: v from below, colours in sRGB between 0 and 1. A "_" that
/// glTF puts before names is left out.
using Values = std::map<std::string, std::vector<double>>;

void take(Values& values, const std::vector<Attribute>& attributes, std::size_t element) {
  for (const Attribute& attribute : attributes) {
    std::vector<double> numbers = attribute.numbers(element);
    if (attribute.isNormalized && attribute.type == ScalarType::uint8)
      for (double& x : numbers) x /= 255;
    if (attribute.isNormalized && attribute.type == ScalarType::uint16)
      for (double& x : numbers) x /= 65535;
    if (attribute.meaning == AttributeMeaning::textureCoords && attribute.isFromTop)
      numbers[1] = 1 - numbers[1];
    if (attribute.meaning == AttributeMeaning::color && attribute.colorSpace == ColorSpace::linear)
      for (std::size_t c = 0; c < 3; ++c) numbers[c] = toSrgb(numbers[c]);
    values[attribute.name.starts_with('_') ? attribute.name.substr(1) : attribute.name] = numbers;
  }
}

Values cornerValues(const SurfaceMesh& mesh, std::size_t t, std::size_t i) {
  Values values;
  take(values, mesh.vertexAttributes, mesh.triangles[t][i]);
  if (mesh.hasWedges()) take(values, mesh.wedgeAttributes, mesh.wedges[t][i]);
  const Vec3& p = mesh.positions[mesh.triangles[t][i]];
  values["position"] = {p.x, p.y, p.z};
  return values;
}

std::string nameOf(const std::vector<std::string>& names, const std::vector<std::uint32_t>& of,
                   std::size_t t) {
  return of.empty() || of[t] == MeshAttributes::kNone ? "" : names[of[t]];
}

std::string materialNameOf(const SurfaceMesh& mesh, std::size_t t) {
  return mesh.materialOf.empty() || mesh.materialOf[t] == MeshAttributes::kNone
             ? ""
             : mesh.materials[mesh.materialOf[t]].name;
}

/// How far numbers may be apart that were not said to be lost: 1 - v in doubles, and sRGB by way of 16 bits.
double toleranceOf(const std::string& name) {
  return name == "texcoord" ? 1e-15 : name == "color" ? 0.002 : 0;
}

/// By triangle of one mesh: the triangle of another one with the same corners in the same order. Formats that
/// have parts order triangles by them.
std::vector<std::size_t> sameTriangles(const SurfaceMesh& mesh, const SurfaceMesh& other) {
  const auto keyOf = [](const SurfaceMesh& m, std::size_t t) {
    std::array<double, 9> key;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = m.positions[m.triangles[t][i]];
      key[3 * i] = p.x + 0.0, key[3 * i + 1] = p.y + 0.0, key[3 * i + 2] = p.z + 0.0;
    }
    return key;
  };
  std::map<std::array<double, 9>, std::size_t> triangleAt;
  for (std::size_t t = 0; t < other.triangles.size(); ++t) triangleAt[keyOf(other, t)] = t;
  std::vector<std::size_t> same;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto found = triangleAt.find(keyOf(mesh, t));
    if (found == triangleAt.end()) ADD_FAILURE() << "triangle " << t << " is missing";
    same.push_back(found == triangleAt.end() ? t : found->second);
  }
  return same;
}

/// @param lost what the conversion says.
void expectArrived(const SurfaceMesh& before, const SurfaceMesh& after, const std::string& lost) {
  ASSERT_EQ(before.triangles.size(), after.triangles.size());
  const auto isSaid = [&](const std::string& name) {
    return contains(lost, "\"" + name + "\"") || contains(lost, "\"_" + name + "\"") ||
           (name == "position" && contains(lost, "coordinates")) ||
           (name == "texcoord" && contains(lost, "texture coordinates")) ||
           (name == "color" && contains(lost, "colo"));
  };
  std::map<std::string, int> missing;
  const std::vector<std::size_t> same = sameTriangles(before, after);
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    Values had, has;
    for (std::size_t i = 0; i < 3; ++i) {
      had = cornerValues(before, t, i);
      has = cornerValues(after, same[t], i);
      for (const auto& [name, numbers] : had) {
        if (isSaid(name)) continue;
        const auto found = has.find(name);
        if (found == has.end() || found->second.size() < numbers.size()) {
          ++missing[name];
          continue;
        }
        for (std::size_t c = 0; c < numbers.size(); ++c)
          if (std::abs(numbers[c] - found->second[c]) > toleranceOf(name))
            ++missing[name + " (other values)"];
      }
    }
    had.clear();
    has.clear();
    take(had, before.triangleAttributes, t);
    take(has, after.triangleAttributes, same[t]);
    for (const auto& [name, numbers] : had)
      if (!isSaid(name) && (!has.contains(name) || has[name] != numbers)) ++missing["face " + name];
    if (!contains(lost, "objects") &&
        nameOf(before.objects, before.objectOf, t) != nameOf(after.objects, after.objectOf, same[t]))
      ++missing["objects"];
    if (!contains(lost, "groups") &&
        nameOf(before.groups, before.groupOf, t) != nameOf(after.groups, after.groupOf, same[t]))
      ++missing["groups"];
    if (!contains(lost, "materials") && materialNameOf(before, t) != materialNameOf(after, same[t]))
      ++missing["materials"];
  }
  for (const auto& [name, count] : missing)
    ADD_FAILURE() << name << " is neither there nor said to be lost, " << count << " times";
}

constexpr const char* kFormats[] = {"ply", "obj", "off", "stl", "glb", "gltf"};

TEST(RoundTrips, WhatAMeshHasArrivesInEveryFormatOrIsNamed) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    for (const char* format : kFormats) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", to " << format);
      const TemporaryFolder folder;
      const MeshFile before = everything(seed);
      ASSERT_TRUE(before.mesh.validate());
      const auto converted = convertMesh(before, folder.file(std::string("a.") + format));
      ASSERT_TRUE(converted) << converted.error().describe();
      const auto after = readMesh(folder.file(std::string("a.") + format));
      ASSERT_TRUE(after) << after.error().describe();
      expectArrived(before.mesh, after->mesh, joined(converted->lost));
    }
}

TEST(RoundTrips, EveryFormatGoesToEveryOther) {
  for (const char* first : kFormats)
    for (const char* second : kFormats) {
      SCOPED_TRACE(testing::Message() << first << " to " << second);
      const TemporaryFolder folder;
      const std::string a = folder.file(std::string("a.") + first),
                        b = folder.file(std::string("b.") + second);
      ASSERT_TRUE(convertMesh(everything(7), a));
      const auto before = readMesh(a);
      ASSERT_TRUE(before) << before.error().describe();
      const auto converted = convertMesh(*before, b);
      ASSERT_TRUE(converted) << converted.error().describe();
      const auto after = readMesh(b);
      ASSERT_TRUE(after) << after.error().describe();
      expectArrived(before->mesh, after->mesh, joined(converted->lost));
      if (std::string_view(first) == second) {
        EXPECT_TRUE(converted->lost.empty()) << joined(converted->lost);
      }
    }
}

}  // namespace
}  // namespace arete
