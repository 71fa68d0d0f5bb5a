// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/vec.h"
#include "terrain/model/source_reading.h"

namespace arete::python {

/// How terrain is built: the options of `arete build`, in its words.
struct BuildRequest {
  std::string shape = "delaunay";
  std::optional<double> ratio, minimumAspect, creaseAngle;
  std::uint32_t maxDegree = 14;
  double rimTolerance = 0;
  std::optional<std::size_t> features;  ///< none: the usual number
  std::string featurePersistence;       ///< a height or "5%"; empty: not stated
  std::string fixedFile;                ///< points whose samples are kept; empty: none
  std::vector<Vec2> fixed;              ///< the same in the CRS of the source
  SourceReading reading;
  std::string source;    ///< what arrays are named in the model; empty: a file's name
  bool hasPlace = true;  ///< false: warnings about the position are left out
};

/// Defines BuildRequest, and builds from files, arrays of heights and points.
void defineBuild(pybind11::module_& module);

}  // namespace arete::python
