// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "viewer/gl/space_painter.h"
#include "viewer/scene/drawable.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/scene_subject.h"

namespace arete {

/// What a scene knows of one of its models beside the model.
struct ShownObject {
  std::string name = {};
  double toleranceFactor = 1;           ///< its tolerance in pixels is the scene's times this, > 0
  std::optional<HandLevel> level = {};  ///< nothing: by the view
  bool isShown = true;
  int pane = 0;                      ///< of the scene's panes, from the left: where it is drawn
  std::optional<KeptBox> kept = {};  ///< of a surface: outside it is tinted
  FrameFigures figures = {};         ///< of its last cut
};

/// Models under one camera and the layers over them, in one OpenGL context. All keep one tolerance, times
/// their factors: with a budget, what is worst is refined first.
class Scene {
 public:
  /// Errors: unsupported, by the driver.
  static Result<Scene> create();

  /// The first terrain has the layers on the ground. A surface beside another model is of a SurfaceSubject in
  /// a scene. Errors: usage: a surface that stands nowhere beside another model.
  Status add(std::unique_ptr<Drawable> drawable, ShownObject object = {});
  const std::vector<std::unique_ptr<Drawable>>& drawables() const { return drawables_; }
  /// How many parts of equal width the picture has, side by side under one camera, whose picture is one
  /// of them.
  int panes() const;
  /// By model.
  std::vector<ShownObject>& objects() { return *objects_; }
  const std::vector<ShownObject>& objects() const { return *objects_; }
  /// Of the model, where it is one; else of all. Precondition: there is one. Valid until the next add().
  const Subject& subject() const;

  /// Before the cuts of a picture: Drawable::advance() of all models that are shown.
  Status advance(const Camera& camera, const ViewSettings& settings, const RunContext& context = {});
  /// The cuts of all models that are shown; figures are added up, the worst tolerance and jump count. Errors:
  /// as Drawable::cut().
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {});
  /// Draws the last cuts and the layers into the framebuffer that is bound. Errors: as Drawable::draw()
  /// and Subject::check(), of a layer.
  Status draw(const Camera& camera, const ViewSettings& settings);
  /// The frame of the scene's space, in which the layers are. Errors: as Subject::viewOf().
  Result<FrameView> frameOf(const Camera& camera, const ViewSettings& settings) const;
  /// Whether the last picture shows any of the models. Waits for the drawing.
  bool isShown() const;
  /// What Drawable says, of all models.
  bool keepsBudget(const ViewSettings& settings) const;
  std::uint32_t capacity() const;
  std::string deviceRefusal() const;
  Warnings warnings() const;

  Layers layers;

 private:
  explicit Scene(SpacePainter painter) : painter_(std::move(painter)) {}
  /// What all models are drawn with; O(models).
  ViewSettings sharedOf(const ViewSettings& settings) const;
  /// What one model is drawn with. `shared`: sharedOf().
  ViewSettings settingsOf(std::size_t model, const ViewSettings& shared) const;
  Status drawPane(int pane, const Camera& camera, const ViewSettings& settings);
  void drawBackground(int pane, const ViewSettings& settings);
  bool isIn(int pane, std::size_t model) const {
    return objects()[model].isShown && objects()[model].pane == pane;
  }
  Status drawBlended(int pane, const Camera& camera, const ViewSettings& shared);
  /// The layers that draw themselves.
  Status drawContents(const Camera& camera, const ViewSettings& settings);
  std::vector<std::unique_ptr<Drawable>> drawables_;
  std::unique_ptr<std::vector<ShownObject>> objects_ = std::make_unique<std::vector<ShownObject>>();
  std::unique_ptr<SceneSubject> all_;  // of several
  SpacePainter painter_;
  std::uint64_t pictures_ = 0;  // that were drawn
};

/// Adds models and layers to a scene, with its context of OpenGL current.
using FillScene = std::function<Status(Scene&)>;

}  // namespace arete
