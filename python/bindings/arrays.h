// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>

#include "engine/base/triangle_mesh.h"

namespace arete::python {

/// Arrays that Python's side has made of these types, row by row.
using Doubles = pybind11::array_t<double, pybind11::array::c_style>;
using Indices = pybind11::array_t<std::uint32_t, pybind11::array::c_style>;

/// @param vertices (n, 3)
/// @param triangles (m, 3), below n
TriangleMesh meshOf(const Doubles& vertices, const Indices& triangles);

}  // namespace arete::python
