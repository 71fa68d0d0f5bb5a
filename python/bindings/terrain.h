// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace arete::python {

/// Builds, reads, writes and asks models of terrain.
void defineTerrain(pybind11::module_& module);

}  // namespace arete::python
