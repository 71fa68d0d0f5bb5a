// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/follow/incremental_cut.h"
#include "engine/morph/geomorph.h"

namespace arete {

/// The heights of the vertices of a cut that follows a camera, on their way (engine/morph/geomorph.h), and
/// the jumps that remain. Holds 4 bytes per node of the MT, and some 70 per member of the cut. Not
/// thread-safe; works in parallel inside.
class GeomorphedSurface {
 public:
  /// Starts at the root. O(nodes).
  explicit GeomorphedSurface(MultiTriangulation mt);
  ~GeomorphedSurface();
  GeomorphedSurface(GeomorphedSurface&&) noexcept;
  GeomorphedSurface& operator=(GeomorphedSurface&&) noexcept;

  struct Update {
    std::uint32_t moving = 0;  ///< vertices between the surface that they refine and their own height
    /// What the update of the cut, this camera's offsets given before as well as after, moves on the screen
    /// at most: 0 when it changed nothing. Infinite when it changed something around the eye.
    double jumpPixels = 0;
    /// The cut's threshold as it was taken: that of the camera, or the larger one that a budget led to.
    double cutPixels = 0;
  };
  /// Follows the last update of the cut, which is always the same one and skips none. `budgetBinds`: the cut
  /// is incomplete for its budget. Then vertices move by the threshold that was reached, that of the member
  /// which mattered least. O(members), little of it for those that rest, and O(modifications).
  Update update(const MorphCamera& camera, const IncrementalCut& cut, bool budgetBinds = false);

  /// Of a vertex of the front: its drawn height minus its own. Of others: as it was when they were last in.
  double offset(VertexId v) const;

  struct Change {
    VertexId vertex;
    float offset = 0;
  };
  /// What differs since the last update, in no particular order, but always the same.
  std::span<const Change> changes() const;

  const MultiTriangulation& mt() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace arete
