// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "io/query/parts/open_surface.h"
#include "python/bindings/terrain.h"

namespace arete::python {

/// What is in a model, how many triangles which error takes, which laws hold.
void defineQuestions(pybind11::class_<Terrain, std::shared_ptr<Terrain>>& terrain);
void defineQuestions(pybind11::class_<OpenSurface, std::shared_ptr<OpenSurface>>& surface);

}  // namespace arete::python
