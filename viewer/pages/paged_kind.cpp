// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/pages/paged_kind.h"

#include <utility>

#include "engine/morph/geomorph.h"

namespace arete {

Result<PictureDemand> PagedKind<TerrainModel>::demandOf(const Shown& shown, const Camera& camera,
                                                        const ViewSettings& settings) {
  ARETE_TRY(const FrameView frame, shown.frameOf(camera, settings));
  return PictureDemand{{.view = frame.view, .pixels = frame.pixels, .stretch = frame.stretch},
                       frame.morphPixels};
}

Result<PagedKind<TerrainModel>::Ready> PagedKind<TerrainModel>::ready(
    const Shown&, std::shared_ptr<const TerrainModel> part, const PictureDemand&, const RunContext&) {
  return subjectOf(std::move(part));
}

void PagedKind<TerrainModel>::show(Ready part, PagedSubject& subject, Shown& shown,
                                   const RunContext& context) {
  subject.show(part);
  shown.replace(std::move(part), context);
}

// The tolerance is parted as the front parts it: of a displaced model no vertex moves between two places.
Result<PictureDemand> PagedKind<SurfaceModel>::demandOf(const Shown& shown, const Camera& camera,
                                                        const ViewSettings& settings) {
  ARETE_TRY(const MorphingFront::Asked asked, shown.askedBy(camera, settings));
  const SurfaceModel& model = shown.subject().model();
  const MorphCamera morph({.view = asked.view,
                           .pixels = asked.pixels,
                           .moves = asked.moves && !asked.level && model.displacement.isEmpty()},
                          model.mt.metric());
  return PictureDemand{
      {.view = asked.view, .pixels = morph.tolerance().cut}, morph.tolerance().offset, asked};
}

Result<SurfacePart> PagedKind<SurfaceModel>::ready(const Shown& shown,
                                                   std::shared_ptr<const SurfaceModel> part,
                                                   const PictureDemand& picture, const RunContext& context) {
  return shown.ready(std::move(part), *picture.front, context);
}

void PagedKind<SurfaceModel>::show(Ready part, PagedSubject& subject, Shown& shown, const RunContext&) {
  subject.show(part.model);
  shown.replace(std::move(part));
}

}  // namespace arete
