// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"
#include "viewer/fronts/cut_worker.h"
#include "viewer/fronts/morphing_front.h"
#include "viewer/scene/drawable.h"
#include "viewer/surface/surface_painter.h"
#include "viewer/surface/surface_subject.h"

namespace arete {

/// What all objects of one surface share in an OpenGL context.
struct SurfaceAssets {
  /// The model outlives it. `colors`: as drawnVertices() takes them. Errors: unsupported. O(size of the
  /// model).
  static Result<std::shared_ptr<SurfaceAssets>> create(const SurfaceModel& model, const ZUpFrame& upright,
                                                       std::vector<std::uint8_t> colors = {});

  std::shared_ptr<const DrawnVertices> drawn;
  SurfaceOnGpu vertices;
  MaterialsOnGpu materials;
  SurfacePainter painter;
};

/// A part of a surface, ready to be drawn.
struct SurfacePart {
  std::shared_ptr<const SurfaceModel> model;
  std::shared_ptr<const DrawnVertices> drawn;
  std::shared_ptr<MorphingFront> front;  ///< of the model, which is kept longer
};

/// Draws one surface in an OpenGL context, for one camera at a time, where its subject is placed. Each cut
/// starts from the last one (viewer/fronts/morphing_front.h); if a picture does not wait for it, another
/// thread takes it, and the last whole one is drawn.
class SurfaceDrawable final : public Drawable {
 public:
  /// The model stays alive as long as this. Errors: unsupported. O(size of the model).
  static Result<SurfaceDrawable> create(const SurfaceModel& model, std::shared_ptr<SurfaceSubject> subject);
  /// One more object of a surface, as create() of the same model made them.
  SurfaceDrawable(std::shared_ptr<SurfaceAssets> assets, std::shared_ptr<SurfaceSubject> subject);
  SurfaceDrawable(SurfaceDrawable&&) = default;
  ~SurfaceDrawable() override;
  /// What a picture asks of the front. Errors: as Subject::viewOf().
  Result<MorphingFront::Asked> askedBy(const Camera& camera, const ViewSettings& settings) const;
  /// Makes a part ready, its cut taken as it is asked for: without OpenGL, on any thread, but not while
  /// another one replaces. Errors: as MorphingFront::update(). O(part).
  Result<SurfacePart> ready(std::shared_ptr<const SurfaceModel> model, const MorphingFront::Asked& asked,
                            const RunContext& context = {}) const;
  /// Draws another model of the same surface from the next cut on, a part of the whole as a rule. Materials
  /// and their pictures stay on the device; vertices are sent anew. Precondition: one metric space, and no
  /// other drawable has these assets. O(vertices).
  void replace(SurfacePart part);
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
  std::optional<double> drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                   const ViewSettings& settings) const override;
  std::optional<Turn> turn() const override { return subject_->placement().turn; }
  void setTurn(const Turn& turn) override;
  bool keepsBudget(const ViewSettings&) const override { return true; }
  const std::shared_ptr<SurfaceAssets>& assets() const { return assets_; }
  /// Pictures that are not shown.
  Warnings warnings() const override { return assets_->materials.warnings(); }

 private:
  /// A front's triangles that have a vertex of the object's own, and those vertices.
  struct OwnOnGpu {
    GlBuffer vertices, indices, errors, ids;
    std::vector<FrontChanges::Range> ranges;
    BlendedOrder blended;
  };
  /// Of the look; null of looks without one. Errors: as Subject::ink().
  Result<const InkOnGpu*> inkOf(const ViewLook& look);
  /// Sends what changed.
  void upload(FrontChanges&& changes);
  void stopWork();
  std::shared_ptr<MorphingFront> frontOf(const SurfaceModel& model,
                                         std::shared_ptr<const DrawnVertices> drawn) const;
  VertexStreams restingStreams() const;

  std::shared_ptr<SurfaceSubject> subject_;
  std::shared_ptr<SurfaceAssets> assets_;
  std::shared_ptr<const SurfaceModel> part_;  // that is drawn; null: the subject's model
  std::shared_ptr<MorphingFront> front_;
  std::shared_ptr<CutWorker> worker_;           // null: none was needed yet
  bool hasFront_ = false, isReplaced_ = false;  // isReplaced_: since the last cut
  GlQuery anySample_ = makeQuery(GL_ANY_SAMPLES_PASSED), anyBlended_ = makeQuery(GL_ANY_SAMPLES_PASSED);
  bool hasDrawnBlended_ = false;     // in the last picture
  double pixels_ = 1;                // of the last cut
  GlBuffer indices_, errors_, ids_;  // of resting triangles
  std::vector<FrontChanges::Range> ranges_;
  OwnOnGpu own_;
  std::shared_ptr<const TriangleInk> ink_;  // as it lies there; null: none yet
  std::unique_ptr<InkOnGpu> inkOnGpu_;
  GlBuffer displaced_;  // positions of a displaced model
};

}  // namespace arete
