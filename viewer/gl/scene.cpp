// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models come first, then what is behind them, then the layers in space: they are blended over both.
#include "viewer/gl/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "viewer/scene/space_content.h"

namespace arete {

Result<Scene> Scene::create() {
  ARETE_TRY(SpacePainter painter, SpacePainter::create());
  return Scene(std::move(painter));
}

Status Scene::add(std::unique_ptr<Drawable> drawable) {
  if (!drawables_.empty() && !(subject().isTerrain() && drawable->subject().isTerrain()))
    return failure(ErrorCode::usage, "only terrain is shown beside another model, and that must be terrain",
                   "scene");
  drawables_.push_back(std::move(drawable));
  return {};
}

Result<FrameFigures> Scene::cut(const Camera& camera, const ViewSettings& settings,
                                const RunContext& context) {
  ViewSettings each = settings;
  if (settings.maxTriangles > 0)
    each.maxTriangles = std::max(1u, settings.maxTriangles / std::uint32_t(drawables_.size()));
  FrameFigures sum;
  for (const auto& drawable : drawables_) {
    ARETE_TRY(const FrameFigures figures, drawable->cut(camera, each, context));
    sum.triangles += figures.triangles;
    sum.asked += figures.asked;
    sum.moving += figures.moving;
    sum.pixels = std::max(sum.pixels, figures.pixels);
    sum.isComplete = sum.isComplete && figures.isComplete;
    sum.jumpPixels = std::fmax(sum.jumpPixels, figures.jumpPixels);
    sum.cutMilliseconds += figures.cutMilliseconds;
  }
  return sum;
}

Status Scene::draw(const Camera& camera, const ViewSettings& settings) {
  for (const auto& drawable : drawables_) {
    for (const Layer& layer : layers.list())
      if (layer.isVisible) ARETE_CHECK(drawable->subject().check(layer));
    ARETE_CHECK(drawable->draw(camera, settings, layers.list()));
  }
  drawables_.back()->drawBackground(settings);
  for (const Layer& layer : layers.list()) {
    const auto* space = std::get_if<SpaceVertices>(&layer.content);
    if (!space || !layer.isVisible) continue;
    ARETE_TRY(const FrameView frame, drawables_.front()->frameOf(camera, settings));
    SpaceVertices drawn = *space;
    for (auto& vertex : drawn.vertices) vertex.place = subject().drawn(vertex.place, settings);
    painter_.draw(drawn, frame, layer.opacity);
  }
  return drawContents(camera, settings);
}

Status Scene::drawContents(const Camera& camera, const ViewSettings& settings) {
  const auto drawsItself = [](const Layer& layer) {
    return std::holds_alternative<Layer::Drawn>(layer.content);
  };
  if (std::ranges::none_of(layers.list(), drawsItself)) return {};
  ARETE_TRY(const FrameView view, drawables_.front()->frameOf(camera, settings));
  std::vector<std::pair<SpaceContent*, SpaceFrame>> contents;
  ++pictures_;
  for (const Layer& layer : layers.list())
    if (const auto* drawn = std::get_if<Layer::Drawn>(&layer.content); drawn && *drawn && layer.isVisible)
      contents.push_back({drawn->get(), {view, subject(), settings, layer.opacity, pictures_}});
  for (const auto& [content, frame] : contents) ARETE_CHECK(content->draw(frame));
  for (auto i = contents.rbegin(); i != contents.rend(); ++i) ARETE_CHECK(i->first->drawLabels(i->second));
  return {};
}

bool Scene::isShown() const {
  return std::ranges::any_of(drawables_, [](const auto& d) { return d->isShown(); });
}

bool Scene::keepsBudget(const ViewSettings& settings) const {
  return std::ranges::all_of(drawables_, [&](const auto& d) { return d->keepsBudget(settings); });
}

std::uint32_t Scene::capacity() const {
  std::uint32_t room = 0;
  for (const auto& drawable : drawables_) room += drawable->capacity();
  return room;
}

std::string Scene::deviceRefusal() const {
  for (const auto& drawable : drawables_)
    if (std::string refusal = drawable->deviceRefusal(); !refusal.empty()) return refusal;
  return {};
}

Warnings Scene::warnings() const {
  Warnings all;
  for (const auto& drawable : drawables_)
    for (const Warning& warning : drawable->warnings()) all.push_back(warning);
  return all;
}

}  // namespace arete
