// SPDX-License-Identifier: GPL-3.0-or-later
//
// build DEM OUT.amt: reads a DEM, builds its multitriangulation, writes it.
#include <arete/io/geo/dem/dem_reader.h>
#include <arete/io/store/amt/file.h>
#include <arete/terrain/builder/build.h>

#include <iostream>
#include <variant>

namespace {

int fail(const arete::Error& error) {
  std::cerr << error.describe() << "\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: build DEM OUT.amt\n";
    return 2;
  }
  // A raster or scattered points: whatever GDAL reads.
  const auto dem = arete::readDem(argv[1]);
  if (!dem) return fail(dem.error());
  for (const std::string& warning : dem->warnings) std::cerr << warning << "\n";

  const auto model =
      std::visit([](const auto& heightfield) { return arete::build(heightfield); }, dem->heightfield);
  if (!model) return fail(model.error());
  if (const auto written = arete::writeAmt(argv[2], *model); !written) return fail(written.error());

  std::cout << model->mt.vertexCount() << " vertices, " << model->mt.rootTriangleCount() << " to "
            << model->mt.finestTriangleCount() << " triangles\n";
}
