// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "python/bindings/terrain.h"

namespace arete::python {

/// What one observer or several see of a grid.
void defineViewshed(pybind11::class_<Terrain, std::shared_ptr<Terrain>>& terrain);

}  // namespace arete::python
