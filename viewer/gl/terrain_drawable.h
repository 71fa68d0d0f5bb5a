// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/camera.h"
#include "terrain/model/terrain_model.h"
#include "viewer/gl/compute_front.h"
#include "viewer/gl/processor_front.h"
#include "viewer/gl/terrain_painter.h"
#include "viewer/scene/drawable.h"
#include "viewer/scene/terrain_subject.h"

namespace arete {

/// Draws one terrain in an OpenGL context, for one camera at a time. Changes of the curvature, and of the
/// exaggeration of a curved Earth, rebuild all buffers: with the next cut, or a picture that comes first.
class TerrainDrawable final : public Drawable {
 public:
  struct Options {
    CutPath path = CutPath::device;
    std::uint32_t mostTriangles = 4'000'000;  ///< room on the device
    HeightsOptions heights = {};              ///< what is painted on the ground
  };
  /// The subject's model stays alive as long as this. Errors: unsupported.
  static Result<TerrainDrawable> create(std::shared_ptr<const TerrainSubject> subject, const Options& options,
                                        const RunContext& context = {});
  /// With a subject of its own.
  static Result<TerrainDrawable> create(const TerrainModel& model, const Options& options,
                                        const RunContext& context = {});
  /// Draws another model of the same map, a part of the whole as a rule, from the next cut on, with the same
  /// programs and colours. What is painted on the ground stays. Precondition: as create(); one metric space.
  void replace(std::shared_ptr<const TerrainSubject> subject, const RunContext& context = {});
  const TerrainSubject& subject() const override { return *subject_; }
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const override;
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {}) override;
  Status draw(const Camera& camera, const ViewSettings& settings,
              std::span<const Layer> layers = {}) override;
  void drawBackground(const ViewSettings& settings) override { painter_.drawSky(settings.look); }
  bool isShown() const override;
  std::optional<double> drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                   const ViewSettings& settings) const override;
  bool keepsBudget(const ViewSettings& settings) const override {
    return settings.path == CutPath::processor || settings.level.has_value();
  }
  std::uint32_t capacity() const override { return device_ ? device_->capacity() : 0; }
  std::string deviceRefusal() const override { return terrain_.refusal; }
  Warnings warnings() const override { return painter_.heights().warnings(); }

  TerrainPainter& painter() { return painter_; }
  const TerrainOnGpu& terrain() const { return terrain_; }
  DrawnFront front() const;
  /// The multitriangulation that is cut: the model's or a curved one.
  const MultiTriangulation& mt() const { return mt_; }
  const TerrainModel& model() const { return subject_->model(); }
  /// Of the device's last cut: for tests.
  const ComputeFront* computeFront() const { return device_ ? &*device_ : nullptr; }

 private:
  TerrainDrawable(std::shared_ptr<const TerrainSubject> subject, TerrainOnGpu terrain, TerrainPainter painter)
      : subject_(std::move(subject)),
        mt_(subject_->model().mt),
        terrain_(std::move(terrain)),
        painter_(std::move(painter)) {}
  bool isReadyFor(const ViewSettings& settings) const {
    return settings.isCurved == isBent_ && (!isBent_ || settings.stretch == bentStretch_);
  }
  /// The processor's cut for a frame, or of a level that is chosen.
  Result<FrameFigures> cutByProcessor(const FrameView& frame, const ViewSettings& settings);
  /// What a level of detail asks of a cut for views: a parallel one from above that sees all of the terrain.
  ProcessorFront::Asked askedBy(const HandLevel& level, const ViewSettings& settings) const;
  /// Makes the buffers that the settings need.
  Status prepare(const ViewSettings& settings);

  std::shared_ptr<const TerrainSubject> subject_;
  MultiTriangulation mt_;  // what is drawn, the model's or a curved one
  TerrainOnGpu terrain_;
  TerrainPainter painter_;
  std::optional<ComputeFront> device_;
  std::optional<ProcessorFront> processor_;
  double processorStretch_ = 1;
  bool hasRises_ = false;  // of vertices that the device's cut would not put to rest
  CutPath drawn_ = CutPath::device;
  std::uint32_t mostTriangles_ = 0;
  GlQuery anySample_ = makeQuery(GL_ANY_SAMPLES_PASSED);  // of the terrain, when it was drawn last
  bool isBent_ = false;
  double bentStretch_ = 1;
};

}  // namespace arete
