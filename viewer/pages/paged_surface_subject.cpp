// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/pages/paged_surface_subject.h"

#include <utility>

namespace arete {
namespace {

/// A form that keeps its model.
std::shared_ptr<const SurfaceForm> formOf(std::shared_ptr<const SurfaceModel> model,
                                          const ZUpFrame& upright) {
  struct Kept {
    Kept(std::shared_ptr<const SurfaceModel> m, const ZUpFrame& frame)
        : model(std::move(m)), form(*model, frame) {}
    std::shared_ptr<const SurfaceModel> model;
    SurfaceForm form;
  };
  auto kept = std::make_shared<const Kept>(std::move(model), upright);
  const SurfaceForm* const form = &kept->form;
  return {std::move(kept), form};
}

}  // namespace

PagedSurfaceSubject::PagedSurfaceSubject(std::shared_ptr<const SurfaceModel> outline, const ZUpFrame& upright,
                                         const Turn& turn, std::uint64_t vertices)
    : SurfaceSubject(formOf(std::move(outline), upright), turn), vertices_(vertices) {}

void PagedSurfaceSubject::show(std::shared_ptr<const SurfaceModel> part) {
  picker_.emplace(*part, upright());
  part_ = std::move(part);
}

SubjectFacts PagedSurfaceSubject::facts() const {
  SubjectFacts facts = SurfaceSubject::facts();
  facts.vertices = vertices_;
  return facts;
}

Result<std::shared_ptr<const TriangleInk>> PagedSurfaceSubject::ink(const std::string& name) const {
  return failure(ErrorCode::usage, "is for a model that is read whole", name);
}

}  // namespace arete
