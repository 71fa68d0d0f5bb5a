// SPDX-License-Identifier: GPL-3.0-or-later
//
// cut FILE.amt E OUT.ply: the least cut of a multitriangulation that is within E of every sample, as a TIN.
#include <arete/engine/cut/cut.h>
#include <arete/io/formats/exchange/export_tin.h>
#include <arete/io/formats/exchange/mesh_formats.h>
#include <arete/io/store/amt/file.h>

#include <cstdlib>
#include <iostream>

namespace {

int fail(const arete::Error& error) {
  std::cerr << error.describe() << "\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: cut FILE.amt E OUT.ply\n";
    return 2;
  }
  const double maxError = std::atof(argv[2]);
  const auto model = arete::loadAmt(argv[1]);  // mapped: what no question touches is not read into memory
  if (!model) return fail(model.error());

  // Any criterion will do, also your own: derive from arete::Criterion and say when a triangle is fine
  // enough.
  const auto cut = arete::takeCut(model->mt, arete::UniformError(maxError));
  if (!cut) return fail(cut.error());

  const auto tin = arete::exportTin(*model, *cut);
  if (!tin) return fail(tin.error());
  arete::MeshWriteOptions options;
  options.crsWkt = model->georeference.crsWkt;
  options.triangleErrors = tin->errors;
  if (const auto written = arete::writeMesh(tin->mesh, argv[3], options); !written)
    return fail(written.error());

  std::cout << tin->mesh.triangles.size() << " triangles within " << cut->achievedError << "\n";
}
