// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vec.h"
#include "engine/base/warning.h"

namespace arete::python {

/// The triangles of a cut in the coordinates of the source, as arrays that Python sees without a copy.
struct Tin {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<float> errors;  ///< by triangle
  double error = 0;           ///< the largest of them
  bool isComplete = true;
  std::optional<double> pixels;  ///< of a camera: the worst error in its picture
  std::string crsWkt;
  Warnings warnings = {};
};

void defineTin(pybind11::module_& module);

}  // namespace arete::python
