// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include "io/query/parts/open_terrain.h"

namespace arete::python {

/// A model of terrain as Python has it: several of its threads may ask at once.
using Terrain = OpenTerrain;

/// What a question to terrain reads as a whole, and keeps. Raises errors.
OpenTerrain::Located wholeOf(const Terrain& terrain, const pybind11::object& progress);

/// Builds, reads, writes and asks models of terrain.
void defineTerrain(pybind11::module_& module);

}  // namespace arete::python
