// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "viewer/gl/space_painter.h"
#include "viewer/scene/drawable.h"
#include "viewer/scene/layer.h"

namespace arete {

/// Models under one camera and the layers over them, in one OpenGL context.
class Scene {
 public:
  /// Errors: unsupported, by the driver.
  static Result<Scene> create();

  /// Errors: usage: a surface beside another model: each is drawn about its own middle.
  Status add(std::unique_ptr<Drawable> drawable);
  const std::vector<std::unique_ptr<Drawable>>& drawables() const { return drawables_; }
  /// Of the first model, whose space the layers have. Precondition: there is one.
  const Subject& subject() const { return drawables_.front()->subject(); }

  /// The cuts of all models; figures are added up, the worst tolerance and jump count. A budget is shared
  /// evenly. Errors: as Drawable::cut().
  Result<FrameFigures> cut(const Camera& camera, const ViewSettings& settings,
                           const RunContext& context = {});
  /// Draws the last cuts and the layers into the framebuffer that is bound. Errors: as Drawable::draw()
  /// and Subject::check(), of a layer.
  Status draw(const Camera& camera, const ViewSettings& settings);
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
  /// The layers that draw themselves.
  Status drawContents(const Camera& camera, const ViewSettings& settings);
  std::vector<std::unique_ptr<Drawable>> drawables_;
  SpacePainter painter_;
  std::uint64_t pictures_ = 0;  // that were drawn
};

/// Adds models and layers to a scene, with its context of OpenGL current.
using FillScene = std::function<Status(Scene&)>;

}  // namespace arete
