// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models come first, then what is behind them, then what of the models is seen through, then the layers
// in space, which are blended over all.
#include "viewer/gl/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "viewer/scene/space_content.h"

namespace arete {

Result<Scene> Scene::create() {
  ARETE_TRY(SpacePainter painter, SpacePainter::create());
  return Scene(std::move(painter));
}

Status Scene::add(std::unique_ptr<Drawable> drawable, ShownObject object) {
  const auto standsNowhere = [](const Subject& s) { return !s.isTerrain() && !s.isPlaced(); };
  if (!drawables_.empty() &&
      (standsNowhere(drawable->subject()) || standsNowhere(drawables_.front()->subject())))
    return failure(ErrorCode::usage, "a surface beside another model needs a place in the scene",
                   object.name.empty() ? "scene" : object.name);
  drawables_.push_back(std::move(drawable));
  objects_->push_back(std::move(object));
  if (drawables_.size() == 1) return {};
  std::vector<const Subject*> subjects;
  for (const auto& each : drawables_) subjects.push_back(&each->subject());
  all_ = std::make_unique<SceneSubject>(std::move(subjects));
  all_->isShown = [objects = objects_.get()](std::size_t i) { return (*objects)[i].isShown; };
  return {};
}

const Subject& Scene::subject() const {
  if (all_) return *all_;
  return drawables_.front()->subject();
}

ViewSettings Scene::sharedOf(const ViewSettings& settings) const {
  if (drawables_.size() == 1) return settings;
  ViewSettings shared = settings;
  shared.maxTriangles = 0;
  shared.nearPlane = subject().nearPlane();
  const Sphere all = ballAbout(subject(), settings);
  shared.contentsMiddle = {all.x, all.y, all.z};
  shared.contentsRadius = all.radius;
  // Objects on a terrain have its light.
  if (!shared.look.sun && subject().isTerrain()) shared.look.sun = Sun{};
  return shared;
}

// What a model cannot be coloured by, it shows as it usually is.
ViewSettings Scene::settingsOf(std::size_t model, const ViewSettings& shared) const {
  ViewSettings own = shared;
  const ShownObject& object = objects()[model];
  own.pixels *= object.toleranceFactor;
  own.level = object.level;
  own.look.kept = object.kept;
  if (drawables_.size() == 1) return own;
  const Subject& subject = drawables_[model]->subject();
  if (own.look.coloring == Coloring::ink && subject.ink(own.look.ink)) return own;
  if (std::ranges::find(subject.colorings(), own.look.coloring) == subject.colorings().end())
    own.look.coloring = subject.colorings().front();
  return own;
}

Status Scene::advance(const Camera& camera, const ViewSettings& settings, const RunContext& context) {
  const ViewSettings shared = sharedOf(settings);
  for (std::size_t i = 0; i < drawables_.size(); ++i)
    if (objects()[i].isShown) ARETE_CHECK(drawables_[i]->advance(camera, settingsOf(i, shared), context));
  return {};
}

Result<FrameFigures> Scene::cut(const Camera& camera, const ViewSettings& settings,
                                const RunContext& context) {
  FrameFigures sum;
  const ViewSettings shared = sharedOf(settings);
  for (std::size_t i = 0; i < drawables_.size(); ++i) {
    ShownObject& object = objects()[i];
    if (!object.isShown) continue;
    auto cut = drawables_[i]->cut(camera, settingsOf(i, shared), context);
    if (!cut && !object.name.empty() && cut.error().code != ErrorCode::interrupted)
      cut.error().culprit =
          cut.error().culprit.empty() ? object.name : object.name + ": " + cut.error().culprit;
    ARETE_TRY(object.figures, std::move(cut));
    const FrameFigures& figures = object.figures;
    sum.triangles += figures.triangles;
    sum.asked += figures.asked;
    sum.moving += figures.moving;
    if (!object.level) sum.pixels = std::max(sum.pixels, figures.pixels / object.toleranceFactor);
    sum.isComplete = sum.isComplete && figures.isComplete;
    sum.jumpPixels = std::fmax(sum.jumpPixels, figures.jumpPixels);
    sum.cutMilliseconds += figures.cutMilliseconds;
    if (figures.pages) sum.pages = figures.pages;
  }
  return sum;
}

int Scene::panes() const {
  int most = 0;
  for (const ShownObject& object : objects()) most = std::max(most, object.pane);
  return most + 1;
}

Status Scene::draw(const Camera& camera, const ViewSettings& settings) {
  for (const Layer& layer : layers.list())
    if (layer.isVisible) ARETE_CHECK(subject().check(layer));
  const int count = panes();
  if (count == 1) return drawPane(0, camera, settings);
  std::array<GLint, 4> whole{};
  glGetIntegerv(GL_VIEWPORT, whole.data());
  Status drawn;
  for (int pane = 0; pane < count && drawn; ++pane) {
    const GLint from = whole[2] * pane / count, to = whole[2] * (pane + 1) / count;
    glViewport(whole[0] + from, whole[1], to - from, whole[3]);
    drawn = drawPane(pane, camera, settings);
  }
  glViewport(whole[0], whole[1], whole[2], whole[3]);
  glEnable(GL_SCISSOR_TEST);
  glClearColor(0.2f, 0.2f, 0.2f, 1);
  for (int pane = 1; pane < count; ++pane) {
    glScissor(whole[0] + whole[2] * pane / count - 1, whole[1], 2, whole[3]);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glDisable(GL_SCISSOR_TEST);
  return drawn;
}

Status Scene::drawPane(int pane, const Camera& camera, const ViewSettings& settings) {
  const ViewSettings shared = sharedOf(settings);
  for (std::size_t i = 0; i < drawables_.size(); ++i) {
    if (!isIn(pane, i)) continue;
    const bool isGround = drawables_[i]->subject().isTerrain();
    ARETE_CHECK(
        drawables_[i]->draw(camera, settingsOf(i, shared),
                            isGround ? std::span<const Layer>(layers.list()) : std::span<const Layer>()));
  }
  drawBackground(pane, settings);
  ARETE_CHECK(drawBlended(pane, camera, shared));
  for (const Layer& layer : layers.list()) {
    const auto* space = std::get_if<SpaceVertices>(&layer.content);
    if (!space || !layer.isVisible || space->vertices.empty()) continue;
    ARETE_TRY(const FrameView frame, frameOf(camera, settings));
    SpaceVertices drawn = *space;
    for (auto& vertex : drawn.vertices) vertex.place = subject().drawn(vertex.place, settings);
    painter_.draw(drawn, frame, layer.opacity);
  }
  return drawContents(camera, settings);
}

Result<FrameView> Scene::frameOf(const Camera& camera, const ViewSettings& settings) const {
  for (std::size_t i = 0; i < drawables_.size(); ++i)
    if (drawables_[i]->subject().isTerrain())
      return drawables_[i]->frameOf(camera, settingsOf(i, sharedOf(settings)));
  FrameView frame;
  ARETE_TRY(frame.view, subject().viewOf(camera, settings));
  frame.drawnNear = subject().nearPlane();
  frame.depthReach = depthReach(frame.view, subject(), settings);
  frame.pixels = settings.pixels;
  return frame;
}

// The farthest object first, by the middle of its box.
Status Scene::drawBlended(int pane, const Camera& camera, const ViewSettings& shared) {
  ARETE_TRY(const View view, subject().viewOf(camera, shared));
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < drawables_.size(); ++i) {
    const Subject& object = drawables_[i]->subject();
    // A further terrain has a space of its own; terrain is not blended.
    if (isIn(pane, i)) order.push_back({-norm(object.drawn(object.box().centre(), shared) - view.eye), i});
  }
  std::ranges::sort(order);
  for (const auto& [distance, i] : order)
    ARETE_CHECK(drawables_[i]->drawBlended(camera, settingsOf(i, shared)));
  return {};
}

// A terrain that is hidden has set no frame, so its sky is not drawn.
void Scene::drawBackground(int pane, const ViewSettings& settings) {
  const auto shown = [&](bool isTerrain) -> Drawable* {
    for (std::size_t i = 0; i < drawables_.size(); ++i)
      if (isIn(pane, i) && drawables_[i]->subject().isTerrain() == isTerrain) return drawables_[i].get();
    return nullptr;
  };
  for (Drawable* const drawable : {shown(true), shown(false)})
    if (drawable) {
      drawable->drawBackground(settings);
      return;
    }
}

Status Scene::drawContents(const Camera& camera, const ViewSettings& settings) {
  const auto drawsItself = [](const Layer& layer) {
    return std::holds_alternative<Layer::Drawn>(layer.content);
  };
  if (std::ranges::none_of(layers.list(), drawsItself)) return {};
  ARETE_TRY(const FrameView view, frameOf(camera, settings));
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
  return drawables_.size() == 1 && drawables_.front()->keepsBudget(settingsOf(0, settings));
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
