// SPDX-License-Identifier: GPL-3.0-or-later
//
// fuzz_seeds FOLDER: what Arete's own writers make, one folder per fuzz program, for the fuzzers to start
// from. What no writer of ours makes is kept in tests/fuzz/corpus.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "datasets/families.h"
#include "engine/cut/cut.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/store/amt/file.h"
#include "io/store/amt/surface_file.h"
#include "surface/builder/build.h"
#include "terrain/builder/build.h"

namespace {

using namespace arete;
namespace fs = std::filesystem;

constexpr std::uint32_t kSide = 6, kPoints = 24;

std::string fileName(std::string_view family) {
  std::string name(family);
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

void check(const Status& status) {
  if (status) return;
  fmt::print(stderr, "fuzz_seeds: {}\n", status.error().describe());
  std::exit(1);
}

void writeModel(const fs::path& folder, const std::string& name, const Result<TerrainModel>& model) {
  if (!model) return;  // a family that is degenerate at this size
  check(writeAmt(folder / "amt" / (name + ".amt"), *model, {}, {.writer = "Arete"}));
  check(writeAmt(folder / "amt" / (name + "-packed.amt"), *model, {}, {.writer = "Arete", .isPacked = true}));
  check(writeAmt(folder / "amt" / (name + "-paged.amt"), *model, {}, {.writer = "Arete", .isPaged = true}));
  const MultiTriangulation& mt = model->mt;
  const TinExport tin = exportTin(*model, frontOfPrefix(mt, mt.nodeCount() / 2)).value();
  MeshWriteOptions options;
  options.crsWkt = "LOCAL_CS[\"seed\"]";
  options.verticalUnit = "metre";
  options.triangleErrors = tin.errors;
  options.notes = {"a seed"};
  for (const MeshFormat& format : meshFormats()) {
    // A GeoPackage is a database, read by GDAL and SQLite, which have fuzzers of their own.
    if (!format.write || !format.read || format.extension == ".gpkg") continue;
    const fs::path kind = folder / format.extension.substr(1);
    fs::create_directories(kind);
    const auto written = writeMesh(tin.mesh, kind / (name + std::string(format.extension)), options);
    if (!written) check(tl::unexpected(written.error()));
  }
}

void writePoints(const fs::path& folder, const std::string& name, const PointHeightfield& points) {
  std::ofstream csv(folder / "points" / (name + ".csv"));
  csv << "x,y,z\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    csv << fmt::format("{},{},{}\n", points.positions[i].x, points.positions[i].y, points.heights[i]);
}

/// A small hill with texture coordinates that are cut apart between two materials.
void writeSurfaces(const fs::path& folder) {
  constexpr std::uint32_t kColumns = 5;
  SurfaceMesh mesh;
  Attribute texcoord{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  for (std::uint32_t v = 0; v < kColumns * kColumns; ++v) {
    const double x = v % kColumns, y = v / kColumns;
    mesh.positions.push_back({x, y, x * y * (4 - x)});
  }
  for (std::uint32_t v = 0; v + kColumns < mesh.positions.size(); ++v) {
    if (v % kColumns + 1 == kColumns) continue;
    mesh.triangles.push_back({v, v + 1, v + kColumns + 1});
    mesh.triangles.push_back({v, v + kColumns + 1, v + kColumns});
  }
  const auto plain = buildSurface(mesh);
  if (!plain) check(tl::unexpected(plain.error()));
  check(writeSurfaceAmt(folder / "plain.amt", *plain, {}, {.writer = "Arete"}));
  check(writeSurfaceAmt(folder / "packed.amt", *plain, {}, {.writer = "Arete", .isPacked = true}));
  check(writeSurfaceAmt(folder / "paged.amt", *plain, {}, {.writer = "Arete", .isPaged = true}));
  check(writeSurfaceAmt(folder / "rounded.amt", *plain, {},
                        {.writer = "Arete", .isPacked = true, .positionBits = 8}));
  mesh.materials = {{.name = "one"}, {.name = "other", .textures = {{"baseColor", "#0", 0}}}};
  mesh.pictures = {{"a.png", "image/png", {std::byte{7}, std::byte{8}}}};
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    const std::uint32_t part = t[0] % kColumns < 2 ? 0 : 1;
    mesh.materialOf.push_back(part);
    mesh.wedges.push_back({t[0] + part * vertices, t[1] + part * vertices, t[2] + part * vertices});
  }
  mesh.wedgeCount = 2 * vertices;
  for (std::uint32_t w = 0; w < mesh.wedgeCount; ++w) texcoord.append(std::vector<double>{double(w), 0.5});
  mesh.wedgeAttributes = {texcoord};
  const auto parts = buildSurface(mesh);
  if (!parts) check(tl::unexpected(parts.error()));
  check(writeSurfaceAmt(folder / "parts.amt", *parts, {}, {.writer = "Arete"}));
  check(writeSurfaceAmt(folder / "parts-packed.amt", *parts, {}, {.writer = "Arete", .isPacked = true}));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
    return 2;
  }
  const fs::path folder = argv[1];
  for (const char* const kind : {"amt", "points"}) fs::create_directories(folder / kind);
  for (const RasterFamily& family : rasterFamilies()) {
    const RasterHeightfield raster = family.make(kSide, kSide, 1);
    const std::string name = fileName(family.name);
    writeModel(folder, name, build(raster));
    writeModel(folder, name + "-fidelity", build(raster, {.shape = HoleShape::dataDependent}));
    writeModel(folder, name + "-rims", build(raster, {.rimTolerance = 1}));
  }
  // Packed in several chunks, which only long rasters are; plain it is more than a fuzzer likes.
  const auto chunked = build(rasterFamilies().front().make(150, 3, 1));
  if (!chunked) check(tl::unexpected(chunked.error()));
  check(writeAmt(folder / "amt" / "chunked-packed.amt", *chunked, {}, {.writer = "Arete", .isPacked = true}));
  RasterHeightfield odd = rasterFamilies().front().make(kSide, kSide, 1);
  odd.source = "a name that is not UTF-8: \xff";
  writeModel(folder, "odd-name", build(odd));
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield points = family.make(kPoints, 1);
    writeModel(folder, "points-" + fileName(family.name), build(points));
    writePoints(folder, fileName(family.name), points);
  }
  fs::create_directories(folder / "surface_amt");
  writeSurfaces(folder / "surface_amt");
  return 0;
}
