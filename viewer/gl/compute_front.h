// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "viewer/gl/drawn_front.h"
#include "viewer/gl/frame_block.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/gl/terrain_on_gpu.h"

namespace arete {

/// Saturated cuts for a view, computed by shaders and drawn from the buffer they are written to: no list of
/// triangles leaves the device. The nodes of a cut are those of the CPU's (CutMethod::saturated, ViewError),
/// as single precision decides only where its windows allow and double precision the rest.
///
/// The front never has a gap: where a cut has more triangles than there is room for, the last one stays.
class ComputeFront {
 public:
  /// Allocates room for a number of triangles, at least those of the root. Errors: unsupported, as
  /// terrain.refusal or by the driver.
  static Result<ComputeFront> create(const TerrainOnGpu& terrain, std::uint32_t mostTriangles);

  /// Makes room for another terrain in place of the one before; the programs stay. Its front is the root's
  /// triangles until the next cut. Precondition: no refusal.
  void fit(const TerrainOnGpu& terrain, std::uint32_t mostTriangles);

  /// The frame's block lies in uniform buffer binding 0. Steps of geomorphing: as many as there may be moving
  /// nodes one under the other; more change nothing.
  void cut(const TerrainOnGpu& terrain, bool isMorphing, int morphSteps = 12);

  struct Counts {
    std::uint32_t triangles = 0;  ///< of the requested cut
    std::uint32_t drawn = 0;      ///< of the front that is drawn
    std::uint32_t moving = 0;     ///< vertices
    bool isComplete = true;       ///< false: no room for it, the last one stayed
  };
  /// The figures of the last cut. Waits for it.
  Counts counts() const;
  /// The figures of a cut some frames ago, without waiting.
  Counts lateCounts();

  DrawnFront front() const;
  std::uint32_t capacity() const { return capacity_; }
  /// The bits of the nodes in the cut, 32 a word: for tests. Waits.
  std::vector<std::uint32_t> members() const;

 private:
  ComputeFront() = default;
  GlProgram begin_, pages_, nodes_, plan_, roots_, stars_, publish_, list_, step_;
  GlBuffer state_, pageList_, blockList_, members_, indices_, ids_, moving_;
  std::uint32_t capacity_ = 0, memberWords_ = 0;
  static constexpr int kLate = 3;
  struct Copy {
    GlBuffer buffer;
    GLsync fence = nullptr;
  };
  std::array<Copy, kLate> copies_;
  int nextCopy_ = 0;
  Counts late_;
};

}  // namespace arete
