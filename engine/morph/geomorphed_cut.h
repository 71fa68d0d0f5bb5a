// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/follow/incremental_cut.h"
#include "engine/morph/height_motion.h"
#include "engine/morph/space_motion.h"

namespace arete {

/// The offsets of the vertices of a cut that follows a camera (MorphCamera), and a bound of the popping that
/// remains. Memory: an offset and a byte per node of the MT, where the cut has been, and about 100 bytes per
/// member of the cut. Not thread-safe; parallel inside.
///
/// @tparam Motion HeightMotion of a heightfield, SpaceMotion of a surface.
template <class Motion>
class GeomorphedCut {
 public:
  using Offset = typename Motion::Offset;
  using Node = typename Motion::Node;

  /// Starts at the root. O(1).
  explicit GeomorphedCut(MultiTriangulation mt);
  ~GeomorphedCut();
  GeomorphedCut(GeomorphedCut&&) noexcept;
  GeomorphedCut& operator=(GeomorphedCut&&) noexcept;

  struct Update {
    std::uint32_t moving = 0;  ///< vertices between the surface that they refine and their own place
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

  /// The drawn place minus the vertex's own. For a vertex that is not in the front: as it was when it left.
  Offset offset(VertexId v) const;

  struct Change {
    VertexId vertex;
    Offset offset{};
  };
  /// The offsets that changed in the last update, in an order that does not depend on the threads.
  std::span<const Change> changes() const;

  /// A node whose vertex the last update moved, or would have moved if it were not on its way already.
  struct Moving {
    NodeId node;
    float share = 0;      ///< of its detail that is hidden, in (0, 1]
    const Node* place{};  ///< valid until the next update
  };
  /// Parents first.
  std::span<const Moving> moving() const;

  const MultiTriangulation& mt() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

extern template class GeomorphedCut<HeightMotion>;
extern template class GeomorphedCut<SpaceMotion>;

using GeomorphedTerrain = GeomorphedCut<HeightMotion>;
using GeomorphedSurface = GeomorphedCut<SpaceMotion>;

}  // namespace arete
