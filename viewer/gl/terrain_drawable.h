// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/camera.h"
#include "terrain/model/terrain_model.h"
#include "viewer/gl/compute_front.h"
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
  };
  /// The subject's model stays alive as long as this. Errors: unsupported.
  static Result<TerrainDrawable> create(std::shared_ptr<const TerrainSubject> subject, const Options& options,
                                        const RunContext& context = {});
  /// With a subject of its own.
  static Result<TerrainDrawable> create(const TerrainModel& model, const Options& options,
                                        const RunContext& context = {});
  TerrainDrawable(TerrainDrawable&&) noexcept;
  TerrainDrawable& operator=(TerrainDrawable&&) noexcept;
  ~TerrainDrawable() override;

  const TerrainSubject& subject() const override;
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const override;
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {}) override;
  Status draw(const Camera& camera, const ViewSettings& settings,
              std::span<const Layer> layers = {}) override;
  void drawBackground(const ViewSettings& settings) override;
  bool isShown() const override;
  bool keepsBudget(const ViewSettings& settings) const override;
  std::uint32_t capacity() const override;
  std::string deviceRefusal() const override;

  TerrainPainter& painter();
  const TerrainOnGpu& terrain() const;
  DrawnFront front() const;
  /// The multitriangulation that is cut: the model's or a curved one.
  const MultiTriangulation& mt() const;
  const TerrainModel& model() const;
  /// Of the device's last cut: for tests.
  const ComputeFront* computeFront() const;

 private:
  struct State;
  explicit TerrainDrawable(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
