// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace arete::python {

/// Examines, mends, decimates and compares meshes of files and arrays.
void defineMeshes(pybind11::module_& module);

}  // namespace arete::python
