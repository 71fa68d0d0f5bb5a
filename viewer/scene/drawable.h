// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/base/similarity.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "viewer/scene/subject.h"

namespace arete {

/// A model in an OpenGL context: takes its cut for a camera and draws it.
class Drawable {
 public:
  Drawable() = default;
  Drawable(Drawable&&) = default;
  Drawable& operator=(Drawable&&) = default;
  virtual ~Drawable() = default;

  /// Its geometry; outlives it.
  virtual const Subject& subject() const = 0;
  /// The frame that a camera and settings make. Errors: as Subject::viewOf().
  virtual Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const = 0;

  /// Of a model that is read in pages: reads what the picture of a camera needs, as far as the settings
  /// allow, or takes in what was read meanwhile. A cut follows. Errors: of the file; usage, of the camera;
  /// interrupted.
  virtual Status advance(const Camera& camera, const ViewSettings& settings, const RunContext& context = {}) {
    static_cast<void>(camera), static_cast<void>(settings), static_cast<void>(context);
    return {};
  }
  /// Takes the cut, without drawing; to freeze a cut, do not call it. Errors: usage, of the camera or the
  /// budget; as Subject::check(); interrupted.
  virtual Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                                   const RunContext& context = {}) = 0;
  /// Draws the last cut for the camera into the framebuffer that is bound; `layers`: of which those on the
  /// ground are painted on it. Errors: usage, of the camera, or of more layers than can be painted.
  virtual Status draw(const Camera& camera, const ViewSettings& settings,
                      std::span<const Layer> layers = {}) = 0;
  /// Draws what lets light through, over all that draw() and drawBackground() of every model have drawn.
  /// Precondition: draw() for the same frame.
  virtual Status drawBlended(const Camera& camera, const ViewSettings& settings) {
    static_cast<void>(camera), static_cast<void>(settings);
    return {};
  }
  /// Draws what is behind all models, where nothing has been drawn. Precondition: draw() for the same frame.
  virtual void drawBackground(const ViewSettings& settings) = 0;
  /// The error, as the model stores it, of the triangle of the last cut that a pixel of a camera meets first;
  /// nothing where it meets none. Waits for the drawing. O(triangles drawn).
  ///
  /// @param pick the place of the model at full resolution there
  virtual std::optional<double> drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                           const ViewSettings& settings) const = 0;
  /// Whether a sample of the last picture shows the model. Waits for the drawing.
  virtual bool isShown() const = 0;

  /// How it is turned about its pivot; nothing where it cannot be.
  virtual std::optional<Turn> turn() const { return std::nullopt; }
  /// Precondition: turn().
  virtual void setTurn(const Turn&) {}

  /// Whether cut() itself makes the error grow until a budget of triangles is kept.
  virtual bool keepsBudget(const ViewSettings& settings) const = 0;
  /// Triangles that there is room for; 0 = any number.
  virtual std::uint32_t capacity() const { return 0; }
  /// Why the device cannot take cuts, or empty.
  virtual std::string deviceRefusal() const { return {}; }
  /// What is not shown, as sentences.
  virtual Warnings warnings() const { return {}; }
};

}  // namespace arete
