// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/follow/incremental_cut.h"
#include "engine/morph/geomorph.h"

namespace arete {

/// The offsets of the vertices of a cut that follows a camera (MorphCamera), and a bound of the popping that
/// remains. Memory: 4 bytes per node of the MT, and about 70 per member of the cut. Not thread-safe; parallel
/// inside.
class GeomorphedSurface {
 public:
  /// Starts at the root. O(nodes).
  explicit GeomorphedSurface(MultiTriangulation mt);
  ~GeomorphedSurface();
  GeomorphedSurface(GeomorphedSurface&&) noexcept;
  GeomorphedSurface& operator=(GeomorphedSurface&&) noexcept;

  struct Update {
    std::uint32_t moving = 0;  ///< vertices between the surface that they refine and their own height
    /// An upper bound of the pixels by which the update of the cut moves the surface, with this camera's
    /// offsets before and after it: 0 if it changed nothing, infinity if it changed something around the eye.
    double jumpPixels = 0;
    /// The threshold of the cut: the camera's, or a larger one under a budget.
    double cutPixels = 0;
  };
  /// Applies the last update of the cut. Call it after every update of the same cut.
  /// @param budgetBinds The cut is incomplete because of its budget: the threshold is then that of the
  /// member with the smallest error in pixels. O(members + modifications).
  Update update(const MorphCamera& camera, const IncrementalCut& cut, bool budgetBinds = false);

  /// The drawn height minus the vertex's own. For a vertex that is not in the front: as it was when it left.
  double offset(VertexId v) const;

  struct Change {
    VertexId vertex;
    float offset = 0;
  };
  /// The offsets that changed in the last update, in an order that does not depend on the threads.
  std::span<const Change> changes() const;

  const MultiTriangulation& mt() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace arete
