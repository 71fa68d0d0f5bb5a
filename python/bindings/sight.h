// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "python/bindings/terrain.h"

namespace arete::python {

/// Lines of sight, viewsheds, and what a mesh is off the terrain.
void defineSight(pybind11::class_<Terrain, std::shared_ptr<Terrain>>& terrain);

}  // namespace arete::python
