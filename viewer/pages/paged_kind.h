// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/query/pages/view_demand.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/pages/paged_surface_subject.h"
#include "viewer/pages/paged_terrain_subject.h"
#include "viewer/surface/surface_drawable.h"

namespace arete {

/// What a picture asks of pages.
struct PictureDemand {
  ViewDemand demand;
  double morphPixels = 0;  ///< of its tolerance, beside the cut's: what vertices on the move may be off
  std::optional<MorphingFront::Asked> front = {};  ///< of a surface
};

/// What differs between the kinds of models in pages: how they are drawn, what a picture asks of them, and
/// how a part takes the place of another.
template <class Model>
struct PagedKind;

template <>
struct PagedKind<TerrainModel> {
  using PagedSubject = PagedTerrainSubject;
  using Shown = TerrainDrawable;
  using Ready = std::shared_ptr<const TerrainSubject>;

  /// Errors: usage, of the camera.
  static Result<PictureDemand> demandOf(const Shown& shown, const Camera& camera,
                                        const ViewSettings& settings);
  /// Makes a part ready for a picture, without OpenGL, on any thread but not beside show(). Errors:
  /// interrupted.
  static Result<Ready> ready(const Shown& shown, std::shared_ptr<const TerrainModel> part,
                             const PictureDemand& picture, const RunContext& context);
  /// Draws it from now on.
  static void show(Ready part, PagedSubject& subject, Shown& shown, const RunContext& context);
};

template <>
struct PagedKind<SurfaceModel> {
  using PagedSubject = PagedSurfaceSubject;
  using Shown = SurfaceDrawable;
  using Ready = SurfacePart;

  /// As of terrain.
  static Result<PictureDemand> demandOf(const Shown& shown, const Camera& camera,
                                        const ViewSettings& settings);
  static Result<Ready> ready(const Shown& shown, std::shared_ptr<const SurfaceModel> part,
                             const PictureDemand& picture, const RunContext& context);
  static void show(Ready part, PagedSubject& subject, Shown& shown, const RunContext& context);
};

}  // namespace arete
