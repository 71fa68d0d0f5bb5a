// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/follow/incremental_cut.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"
#include "viewer/scene/drawable.h"
#include "viewer/surface/surface_painter.h"
#include "viewer/surface/surface_subject.h"

namespace arete {

/// Draws one surface in an OpenGL context, for one camera of upright space at a time. Each cut starts from
/// the last one (engine/follow/incremental_cut.h).
class SurfaceDrawable final : public Drawable {
 public:
  /// The model stays alive as long as this. Errors: unsupported. O(size of the model).
  static Result<SurfaceDrawable> create(const SurfaceModel& model,
                                        std::shared_ptr<const SurfaceSubject> subject);
  const SurfaceSubject& subject() const override { return *subject_; }
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const override;
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {}) override;
  Status draw(const Camera& camera, const ViewSettings& settings,
              std::span<const Layer> layers = {}) override;
  void drawBackground(const ViewSettings&) override { painter_.drawBackground(); }
  bool isShown() const override;
  bool keepsBudget(const ViewSettings&) const override { return true; }
  /// Pictures that are not shown.
  Warnings warnings() const override { return materials_.warnings(); }

 private:
  SurfaceDrawable(const SurfaceModel& model, std::shared_ptr<const SurfaceSubject> subject,
                  SurfacePainter painter);
  std::uint32_t materialOf(std::uint32_t triangle) const;
  void upload();
  void displace(const BoundedCriterion& criterion);

  const SurfaceModel* model_;
  std::shared_ptr<const SurfaceSubject> subject_;
  IncrementalCut cut_;
  SurfaceOnGpu surface_;
  MaterialsOnGpu materials_;
  SurfacePainter painter_;
  GlQuery anySample_ = makeQuery(GL_ANY_SAMPLES_PASSED);
  double pixels_ = 1;  // of the last cut
  bool isUploaded_ = false;
  GlBuffer indices_, errors_;
  std::vector<DrawnSurface::Range> ranges_;
  std::vector<float> positions_;  // of a displaced model: those in graphics memory
};

}  // namespace arete
