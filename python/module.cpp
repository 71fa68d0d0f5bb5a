// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include "python/bindings/build.h"
#include "python/bindings/meshes.h"
#include "python/bindings/surface.h"
#include "python/bindings/terrain.h"
#include "python/bindings/tin.h"

PYBIND11_MODULE(_arete, module) {
  module.doc() = "What arete/ is made of; import arete.";
  arete::python::defineTin(module);
  arete::python::defineBuild(module);
  arete::python::defineTerrain(module);
  arete::python::defineSurface(module);
  arete::python::defineMeshes(module);
}
