// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// Triangles that follow each other and belong to one object.
struct ObjectRun {
  std::uint32_t object;    ///< kNone: to none
  std::size_t first, end;  ///< triangles; of an object without any, first == end
};

/// The triangles of a mesh in their order, as formats write them that state an object once for the faces that
/// follow. Objects without triangles keep their place among the others.
struct ObjectRuns {
  std::vector<ObjectRun> runs;
  bool areDivided = false;   ///< an object has several runs
  bool isAnyBehind = false;  ///< triangles of no object follow those of one

  explicit ObjectRuns(MeshRef mesh);  ///< O(triangles + objects)
};

/// A name as one line can hold it: without line breaks, and without blanks at its ends.
std::string nameOnOneLine(const std::string& name);

}  // namespace arete
