// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "surface/model/surface_model.h"
#include "viewer/surface/surface_subject.h"

namespace arete {

/// A surface that is read in pages, by itself. Its space and home views come from an outline, and its box is
/// as much larger as the model may reach beyond that; picks meet the part that is drawn, and boundAt() says
/// how far that may be from the model. Inks compare with the whole model and are refused. One thread at a
/// time.
class PagedSurfaceSubject final : public SurfaceSubject {
 public:
  /// Keeps the outline.
  ///
  /// @param vertices of the whole model
  PagedSurfaceSubject(std::shared_ptr<const SurfaceModel> outline, const ZUpFrame& upright, const Turn& turn,
                      std::uint64_t vertices);

  /// From now on picks meet this part.
  void show(std::shared_ptr<const SurfaceModel> part);

  SubjectFacts facts() const override;
  std::vector<std::string> inks() const override { return {}; }
  Result<std::shared_ptr<const TriangleInk>> ink(const std::string& name) const override;

 protected:
  const SurfacePicker& picker() const override { return picker_ ? *picker_ : SurfaceSubject::picker(); }

 private:
  std::uint64_t vertices_;
  std::shared_ptr<const SurfaceModel> part_;
  std::optional<SurfacePicker> picker_;  // of the part; nothing: picks meet the outline
};

}  // namespace arete
