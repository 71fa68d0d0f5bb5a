// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/follow/incremental_cut.h"
#include "engine/morph/geomorphed_cut.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"
#include "viewer/fronts/blended_order.h"
#include "viewer/fronts/material_slots.h"
#include "viewer/fronts/own_vertices.h"
#include "viewer/scene/view_settings.h"

namespace arete {

/// What changed of the front of an object, to be sent to graphics memory. Resting triangles index the drawn
/// vertices that all objects of the surface share; the others index the object's own.
struct FrontChanges {
  using Corners = std::array<std::uint32_t, 3>;
  /// Triangles of one material, one behind the other in a buffer.
  struct Range {
    std::uint32_t material = 0, first = 0, count = 0;
  };
  struct Run {
    std::uint32_t first = 0, count = 0;
  };

  /// The buffer of resting triangles is of this size and all of it is new, as `runs` has it.
  std::optional<std::uint32_t> newSize;
  std::vector<Run> runs;         ///< slots that are to be written, in this order
  std::vector<Corners> corners;  ///< of the runs, one behind the other
  std::vector<float> errors;
  std::vector<std::uint32_t> triangles;      ///< of the MT
  std::optional<std::vector<Range>> ranges;  ///< of the buffer; nothing: as before

  struct Own {
    std::vector<OwnVertex> vertices;
    std::vector<Corners> corners;
    std::vector<float> errors;
    std::vector<std::uint32_t> triangles;
    std::vector<Range> ranges;
    BlendedOrder blended;  ///< those among them that let light through
  };
  std::optional<Own> own;                       ///< nothing: as before
  std::optional<std::vector<float>> positions;  ///< of the shared vertices, of a displaced model
};

/// The front of one object of a surface for a camera: the cut that follows it, vertices on the move, and all
/// that is drawn, sorted by material; without OpenGL. One thread at a time updates it, and another may take
/// what changed.
class MorphingFront {
 public:
  /// @param isBlended by material, the last one of triangles without any: whether it lets light through.
  /// Precondition: the model outlives this.
  MorphingFront(const SurfaceModel& model, const ZUpFrame& upright,
                std::shared_ptr<const DrawnVertices> drawn, std::vector<bool> isBlended);

  struct Asked {
    View view;  ///< in the metric space of the model's MT
    double pixels = 1;
    std::optional<std::uint32_t> maxTriangles = {};
    double milliseconds = 0;              ///< the update ends after about this time; 0: when it is done
    std::optional<HandLevel> level = {};  ///< instead of the tolerance and the budget
    bool moves = true;                    ///< vertices appear on the surface that they refine
  };
  /// Brings the front to what is asked. Of a displaced model no vertex moves between two places. Errors:
  /// usage: of the view, or of a budget below the root; interrupted.
  Status update(const Asked& asked, const RunContext& context = {});

  struct Taken {
    FrontChanges changes;  ///< since the last call
    FrameFigures figures;  ///< of the last update
  };
  /// Errors: as the last update. Thread-safe.
  Result<Taken> take();

 private:
  std::uint32_t materialOf(std::uint32_t triangle) const;
  std::array<std::uint32_t, 3> drawnCorners(std::uint32_t triangle) const;
  Result<FrameFigures> follow(const Asked& asked, const RunContext& context);
  void displace(const BoundedCriterion& criterion);
  bool listOwn();
  void publish(bool isNew, bool isOwnNew, const FrameFigures& figures);

  const SurfaceModel* model_;
  ZUpFrame upright_;
  std::shared_ptr<const DrawnVertices> drawn_;
  std::vector<bool> isBlended_;
  IncrementalCut cut_;
  GeomorphedSurface moved_;
  OwnVertices ownVertices_;
  MaterialSlots slots_;                 // of resting triangles; the last material is of the others
  std::vector<std::uint32_t> resting_;  // by triangle of the front: it, or kNone
  FrontChanges::Own own_;
  std::vector<float> positions_;  // of a displaced model
  bool isFirst_ = true;

  std::mutex mutex_;
  FrontChanges pending_;
  FrameFigures figures_;
  std::optional<Error> error_;
};

}  // namespace arete
