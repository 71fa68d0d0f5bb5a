// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"
#include "viewer/scene/drawable.h"
#include "viewer/surface/surface_subject.h"

namespace arete {

/// Draws one surface in an OpenGL context, for one camera of upright space at a time. Each cut starts from
/// the last one (engine/follow/incremental_cut.h).
class SurfaceDrawable final : public Drawable {
 public:
  /// The model stays alive as long as this. Errors: unsupported. O(size of the model).
  static Result<SurfaceDrawable> create(const SurfaceModel& model,
                                        std::shared_ptr<const SurfaceSubject> subject);
  SurfaceDrawable(SurfaceDrawable&&) noexcept;
  SurfaceDrawable& operator=(SurfaceDrawable&&) noexcept;
  ~SurfaceDrawable() override;

  const SurfaceSubject& subject() const override;
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const override;
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {}) override;
  Status draw(const Camera& camera, const ViewSettings& settings,
              std::span<const Layer> layers = {}) override;
  void drawBackground(const ViewSettings& settings) override;
  bool isShown() const override;
  bool keepsBudget(const ViewSettings&) const override { return true; }
  /// Pictures that are not shown.
  Warnings warnings() const override;

 private:
  struct State;
  explicit SurfaceDrawable(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
