// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace arete::python {

/// Reads models of surfaces and takes their cuts.
void defineSurface(pybind11::module_& module);

}  // namespace arete::python
