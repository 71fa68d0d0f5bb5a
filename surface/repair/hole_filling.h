// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/triangle_mesh.h"

namespace arete::repair_passes {

/// A hole: its corners in the order in which the triangles around it have them, at different positions, and
/// by side the corner opposite to it of the triangle there.
struct HoleOutline {
  std::vector<Vec3> corners;
  std::vector<std::uint32_t> places;  ///< by corner: a number that equal positions have in common
  std::vector<Vec3> apexes;           ///< of the triangle at the side from the corner to the next one
};

/// Fills holes of a surface with triangles between their corners.
class HoleFilling {
 public:
  using Corners = std::array<std::uint32_t, 3>;  ///< of an outline

  /// @param placeOf by vertex: a number that equal positions have in common
  HoleFilling(const TriangleMesh& mesh, std::span<const std::uint32_t> placeOf);
  ~HoleFilling();

  /// The triangles that fill a hole, turned as those around it; none where there is no filling whose edges
  /// are new, that has an area everywhere, that neither crosses the surface nor lies upon it. The filling has
  /// the least area and dihedral angles [BarequetSharir1995] as CGAL finds it, else, of at most 32 corners,
  /// the least area of those that may be. What is found becomes a part of the surface.
  std::vector<Corners> fill(const HoleOutline& hole);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace arete::repair_passes
