// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/camera.h"
#include "terrain/model/terrain_model.h"
#include "viewer/gl/compute_front.h"
#include "viewer/gl/drape_on_gpu.h"
#include "viewer/gl/terrain_painter.h"
#include "viewer/scene/view_look.h"

namespace arete {

/// What computes the cut.
enum class CutPath { device, processor };

struct ViewSettings {
  double pixels = 1;               ///< tolerance of what is drawn, moving or not
  std::uint32_t maxTriangles = 0;  ///< 0 = any number that there is room for
  double cutMilliseconds =
      0;  ///< the processor's cut stops after this time and continues in the next frame; 0 = no limit
  CutPath path = CutPath::device;
  bool isGeomorphed = true;
  bool waits = true;      ///< draw waits for the processor's cut of this frame; else it draws the last one
  double stretch = 1;     ///< vertical exaggeration
  bool isCurved = false;  ///< the Earth curves away (viewer/scene/curved_ground.h): for DEMs with a CRS
  ViewLook look;
};

struct FrameFigures {
  std::uint32_t triangles = 0;  ///< drawn
  std::uint32_t asked = 0;      ///< of the whole cut at this tolerance
  std::uint32_t moving = 0;     ///< vertices that are being geomorphed
  double pixels = 0;            ///< tolerance of the cut
  bool isComplete = true;       ///< false: a budget, a deadline or the room ended the cut
  /// The largest jump of this frame that geomorphing leaves, by the processor's cut; NaN by the device's,
  /// which takes the same nodes and does not compute it.
  double jumpPixels = std::numeric_limits<double>::quiet_NaN();
  double cutMilliseconds = 0, drawMilliseconds = 0;
  bool showsTerrain = true;  ///< false: nothing but sky; of pictures without a window
};

/// Draws one terrain in an OpenGL context, for one camera at a time.
class TerrainView {
 public:
  struct Options {
    CutPath path = CutPath::device;
    std::uint32_t mostTriangles = 4'000'000;  ///< room on the device
  };
  /// The model stays alive as long as the view. Errors: unsupported.
  static Result<TerrainView> create(const TerrainModel& model, const Options& options,
                                    const RunContext& context = {});
  TerrainView(TerrainView&&) noexcept;
  TerrainView& operator=(TerrainView&&) noexcept;
  ~TerrainView();

  /// Takes the cut, without drawing; to freeze a cut, do not call it. Changes of the curvature, and of the
  /// exaggeration of a curved Earth, rebuild all buffers. Errors: usage, of the camera; those of
  /// CurvedGround; interrupted.
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings);
  /// Draws the last cut for the camera into the framebuffer that is bound; first takes a new cut if the
  /// settings require new buffers.
  Status draw(const Camera& camera, const ViewSettings& settings);
  /// Whether a sample of the last picture shows the terrain. Waits for the drawing.
  bool showsTerrain() const;

  /// Why the device cannot take cuts, or empty.
  const std::string& deviceRefusal() const;
  /// Triangles that the device has room for.
  std::uint32_t capacity() const;
  /// Lays a picture over the terrain; drape()->warnings() are set afterwards. Errors: those of
  /// DrapeOnGpu::load().
  Status setDrape(const std::string& path, const DrapeOptions& options = {}, const RunContext& context = {});
  /// Null without a drape.
  const DrapeOnGpu* drape() const;
  TerrainPainter& painter();
  const TerrainOnGpu& terrain() const;
  DrawnFront front() const;
  /// The frame that a camera and settings make.
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const;
  /// Where a place of the map is drawn with these settings, for TerrainPainter::drawLines().
  Result<Vec3> drawnPosition(Vec2 xy, double height, const ViewSettings& settings) const;
  /// The multitriangulation that is cut: the model's or a curved one.
  const MultiTriangulation& mt() const;
  const TerrainModel& model() const;
  /// Of the device's last cut: for tests.
  const ComputeFront* computeFront() const;

 private:
  struct State;
  explicit TerrainView(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace arete
