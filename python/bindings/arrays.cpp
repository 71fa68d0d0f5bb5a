// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/arrays.h"

namespace arete::python {

TriangleMesh meshOf(const Doubles& vertices, const Indices& triangles) {
  TriangleMesh mesh;
  for (pybind11::ssize_t v = 0; v < vertices.shape(0); ++v) {
    const double* const p = vertices.data() + 3 * v;
    mesh.positions.push_back({p[0], p[1], p[2]});
  }
  for (pybind11::ssize_t t = 0; t < triangles.shape(0); ++t) {
    const std::uint32_t* const c = triangles.data() + 3 * t;
    mesh.triangles.push_back({c[0], c[1], c[2]});
  }
  return mesh;
}

}  // namespace arete::python
