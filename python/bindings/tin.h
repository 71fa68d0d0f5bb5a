// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <utility>
#include <vector>

#include "io/query/face/arete.h"

namespace arete::python {

/// The triangles of a cut in the coordinates of the source, as arrays that Python sees without a copy.
struct CutTin {
  /// A fit knows the error of the whole alone: each triangle has that here.
  explicit CutTin(Tin taken);

  Tin tin;
  std::vector<float> errors;  ///< by triangle
};

/// Defines CutRequest and Tin.
void defineTin(pybind11::module_& module);

}  // namespace arete::python
