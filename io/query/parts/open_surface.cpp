// SPDX-License-Identifier: GPL-3.0-or-later
//
// As open_terrain.cpp; a cut does not say which pages it needs before it is taken, so parts are not kept.
#include "io/query/parts/open_surface.h"

#include <utility>

#include "engine/base/caught_failure.h"
#include "io/query/surface/surface_part.h"
#include "io/store/amt/surface_file.h"

namespace arete {
namespace {

/// The largest model that is read whole because its parts were read too often.
constexpr std::uint64_t kMostNodesOfWhole = 2'000'000;

}  // namespace

OpenSurface::OpenSurface(SurfaceModel whole)
    : outline_(std::make_shared<const SurfaceModel>(std::move(whole))) {
  vertices_ = outline_->mt.vertexCount();
  triangles_ = outline_->mt.triangleCount();
  nodes_ = outline_->mt.nodeCount();
  whole_->set(outline_);
}

OpenSurface::OpenSurface(LastingFile file, SurfaceModel outline)
    : file_(std::move(file)), outline_(std::make_shared<const SurfaceModel>(std::move(outline))) {}

Result<std::shared_ptr<OpenSurface>> OpenSurface::open(LastingFile file, const RunContext& context) try {
  SurfaceFacts facts;
  bool isFar = false;
  const auto readCoarsest = [&](const AmtContainer& container) -> Result<SurfaceModel> {
    isFar = container.owner()->isFar();
    ARETE_TRY(facts, surfaceFacts(container));
    if (!container.isPaged() || !facts.summary.isThere()) return loadSurfaceAmt(container, {}, context);
    ARETE_TRY(const double error, surfaceErrorBeyond(container, 1));
    return loadSurfaceAmt(
        container,
        {.wanted = error > 0 ? RequiredError([error](const Box3&) { return error; }) : requiredNowhere()},
        context);
  };
  ARETE_TRY(SurfaceModel outline, file.ask(context, readCoarsest));
  if (!outline.finestOfWhole) return std::make_shared<OpenSurface>(std::move(outline));  // all of it
  std::shared_ptr<OpenSurface> surface(new OpenSurface(std::move(file), std::move(outline)));
  surface->vertices_ = facts.vertices;
  surface->triangles_ = facts.summary.triangles;
  surface->nodes_ = facts.vertices - surface->outline().mt.rootVertexCount();
  surface->isFar_ = isFar;
  return surface;
} catch (...) {
  return caughtFailure();
}

Result<double> OpenSurface::largestError(const RunContext& context) const {
  if (outline_->mt.nodeCount() > 0 || nodes_ == 0) return outline_->mt.largestError();
  ARETE_TRY(const Shared all, whole(context));
  return all->mt.largestError();
}

// A server is not asked for more than its questions need.
Result<OpenSurface::Shared> OpenSurface::wholeIfReadOften(const RunContext& context) const {
  if (isFar_ || nodes_ > kMostNodesOfWhole) return whole_->ifThere();
  return whole_->getIfReadOften(
      nodes_, [&] { return readWhole(context); }, context);
}

Result<OpenSurface::Shared> OpenSurface::readWhole(const RunContext& context) const {
  ARETE_TRY(SurfaceModel all, file_->ask(context, [&](const AmtContainer& container) {
    return loadSurfaceAmt(container, {}, context);
  }));
  return std::make_shared<const SurfaceModel>(std::move(all));
}

Result<OpenSurface::Shared> OpenSurface::whole(const RunContext& context) const try {
  return whole_->get([&] { return readWhole(context); }, context);
} catch (...) {
  return caughtFailure();
}

Result<OpenSurface::Shared> OpenSurface::forRequest(const ExtractRequest& request,
                                                    const RunContext& context) const try {
  ARETE_TRY(Shared all, wholeIfReadOften(context));
  if (all) return all;
  ARETE_TRY(SurfaceModel read, file_->ask(context, [&](const AmtContainer& container) {
    return readForExtract(container, {&request, 1}, outline(), context);
  }));
  auto model = std::make_shared<const SurfaceModel>(std::move(read));
  whole_->countPart(model->mt.nodeCount());
  if (!model->finestOfWhole) whole_->set(model);
  return Shared(std::move(model));
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
