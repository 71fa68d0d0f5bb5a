// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/criteria/criterion.h"
#include "engine/follow/incremental_cut.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"
#include "viewer/scene/drawable.h"
#include "viewer/surface/blended_order.h"
#include "viewer/surface/material_slots.h"
#include "viewer/surface/surface_painter.h"
#include "viewer/surface/surface_subject.h"

namespace arete {

/// What all objects of one surface share in an OpenGL context.
struct SurfaceAssets {
  /// The model outlives it. Errors: unsupported. O(size of the model).
  static Result<std::shared_ptr<SurfaceAssets>> create(const SurfaceModel& model, const ZUpFrame& upright);

  SurfaceOnGpu vertices;
  MaterialsOnGpu materials;
  SurfacePainter painter;
};

/// Draws one surface in an OpenGL context, for one camera at a time, where its subject is placed. Each cut
/// starts from the last one (engine/follow/incremental_cut.h).
class SurfaceDrawable final : public Drawable {
 public:
  /// The model stays alive as long as this. Errors: unsupported. O(size of the model).
  static Result<SurfaceDrawable> create(const SurfaceModel& model, std::shared_ptr<SurfaceSubject> subject);
  /// One more object of a surface, as create() of the same model made them.
  SurfaceDrawable(std::shared_ptr<SurfaceAssets> assets, std::shared_ptr<SurfaceSubject> subject);
  const SurfaceSubject& subject() const override { return *subject_; }
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const override;
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {}) override;
  Status draw(const Camera& camera, const ViewSettings& settings,
              std::span<const Layer> layers = {}) override;
  /// Its triangles from back to front.
  Status drawBlended(const Camera& camera, const ViewSettings& settings) override;
  void drawBackground(const ViewSettings&) override { assets_->painter.drawBackground(); }
  bool isShown() const override;
  std::optional<Turn> turn() const override { return subject_->placement().turn; }
  void setTurn(const Turn& turn) override;
  bool keepsBudget(const ViewSettings&) const override { return true; }
  const std::shared_ptr<SurfaceAssets>& assets() const { return assets_; }
  /// Pictures that are not shown.
  Warnings warnings() const override { return assets_->materials.warnings(); }

 private:
  std::uint32_t materialOf(std::uint32_t triangle) const;
  /// Sends what changed since the last call.
  void upload();
  void send(std::uint32_t first, std::uint32_t count);
  void listBlended(std::span<const std::uint32_t> front);
  void displace(const BoundedCriterion& criterion);

  const SurfaceModel* model_;  // the subject's
  std::shared_ptr<SurfaceSubject> subject_;
  IncrementalCut cut_;
  std::shared_ptr<SurfaceAssets> assets_;
  MaterialSlots slots_;  // what indices_ and errors_ hold
  bool hasBlendedMaterials() const;
  GlQuery anySample_ = makeQuery(GL_ANY_SAMPLES_PASSED), anyBlended_ = makeQuery(GL_ANY_SAMPLES_PASSED);
  bool hasDrawnBlended_ = false;  // in the last picture
  BlendedOrder blended_;          // of the last cut
  double pixels_ = 1;             // of the last cut
  bool isUploaded_ = false;
  GlBuffer indices_, errors_;
  std::vector<DrawnSurface::Range> ranges_;
  std::vector<float> positions_;  // of a displaced model: its own
  GlBuffer displaced_;            // the same in graphics memory
};

}  // namespace arete
