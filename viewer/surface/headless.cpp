// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/headless.h"

#include <utility>

#include "engine/base/stopwatch.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/offscreen.h"

namespace arete {

struct HeadlessSurface::State {
  OffscreenContext context;  // the last to go
  FrameTarget target;
  SurfaceView view;
};

Result<HeadlessSurface> HeadlessSurface::create(const SurfaceModel& model, const ZUpFrame& upright,
                                                const Options& options) {
  ARETE_TRY(OffscreenContext gl, OffscreenContext::create());
  ARETE_TRY(FrameTarget target,
            FrameTarget::create(options.widthPixels, options.heightPixels, options.samples));
  ARETE_TRY(SurfaceView view, SurfaceView::create(model, upright));
  return HeadlessSurface(std::make_unique<State>(State{std::move(gl), std::move(target), std::move(view)}));
}

HeadlessSurface::HeadlessSurface(std::unique_ptr<State> state) : state_(std::move(state)) {}
HeadlessSurface::HeadlessSurface(HeadlessSurface&&) noexcept = default;
HeadlessSurface& HeadlessSurface::operator=(HeadlessSurface&&) noexcept = default;
HeadlessSurface::~HeadlessSurface() = default;

Result<SurfaceFigures> HeadlessSurface::draw(const Camera& stated, const SurfaceViewSettings& settings,
                                             const RunContext& context) {
  State& s = *state_;
  Camera camera = stated;
  camera.widthPixels = s.target.width();
  camera.heightPixels = s.target.height();
  Result<SurfaceFigures> figures = s.view.cut(camera, settings, context);
  if (!figures) return figures;
  const Stopwatch watch;
  s.target.begin();
  ARETE_CHECK(s.view.draw(camera, settings));
  figures->showsSurface = s.view.showsSurface();
  figures->drawMilliseconds = watch.milliseconds();
  return figures;
}

Image HeadlessSurface::image() const {
  return state_->target.image();
}
const SurfaceView& HeadlessSurface::view() const {
  return state_->view;
}
const std::string& HeadlessSurface::description() const {
  return state_->context.description();
}

}  // namespace arete
