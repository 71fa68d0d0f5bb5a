// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/morph/view_mesh.h"
#include "viewer/gl/drawn_front.h"
#include "viewer/gl/terrain_on_gpu.h"

namespace arete {

/// Computes cuts for views on the processor, in a separate thread (engine/morph/view_mesh.h). Each frame
/// posts its view and draws the newest finished front; only changes are uploaded to the device.
class ProcessorFront {
 public:
  /// Starts with the root's triangles. `stretch`: vertical exaggeration. Errors: those of ViewMesh;
  /// unsupported: the driver cannot do it.
  static Result<ProcessorFront> create(const MultiTriangulation& mt, double stretch);
  ProcessorFront(ProcessorFront&&) noexcept;
  ProcessorFront& operator=(ProcessorFront&&) noexcept;
  ~ProcessorFront();

  struct Asked {
    View view;
    double pixels = 1;
    std::uint32_t maxTriangles = 0;   ///< 0 = any number
    double deadlineMilliseconds = 0;  ///< 0 = none
    bool geomorph = true;
  };
  struct Done {
    ViewMesh::Report report;
    double milliseconds = 0;  ///< of the update
    std::uint64_t updates = 0;
  };
  /// Posts a request. It replaces an earlier one if work on that has not begun.
  void ask(const Asked& asked);
  /// Uploads the changes since the last call.
  ///
  /// @param waits whether to wait until the last request is finished.
  /// Errors: those of the update.
  Result<Done> receive(TerrainOnGpu& terrain, bool waits);

  DrawnFront front() const;

 private:
  struct State;
  explicit ProcessorFront(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
