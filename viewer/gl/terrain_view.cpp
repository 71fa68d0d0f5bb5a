// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/terrain_view.h"

#include <algorithm>
#include <chrono>

#include "engine/geomorph.h"
#include "viewer/gl/processor_front.h"

namespace arete {
namespace {

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

struct TerrainView::State {
  const TerrainModel* model = nullptr;
  TerrainOnGpu terrain;
  TerrainPainter painter;
  std::optional<ComputeFront> device;
  std::optional<ProcessorFront> processor;
  double processorStretch = 1;
  bool hasRises = false;  // of vertices that the device's cut would not put to rest
  CutPath drawn = CutPath::device;
};

Result<TerrainView> TerrainView::create(const TerrainModel& model, const Options& options,
                                        const RunContext& context) {
  Result<TerrainPainter> painter = TerrainPainter::create(model);
  if (!painter) return tl::unexpected(painter.error());
  const std::vector<MorphNode> morphs = makeMorphNodes(model.mt, context);
  auto state = std::make_unique<State>(
      State{&model, uploadTerrain(model.mt, morphs), std::move(*painter), {}, {}, 1, false, options.path});
  if (state->terrain.refusal.empty()) {
    Result<ComputeFront> device = ComputeFront::create(state->terrain, options.mostTriangles);
    if (device)
      state->device = std::move(*device);
    else
      state->terrain.refusal = device.error().describe();
  }
  return TerrainView(std::move(state));
}

TerrainView::TerrainView(std::unique_ptr<State> state) : state_(std::move(state)) {}
TerrainView::TerrainView(TerrainView&&) noexcept = default;
TerrainView& TerrainView::operator=(TerrainView&&) noexcept = default;
TerrainView::~TerrainView() = default;

Result<FrameView> TerrainView::frameOf(const Camera& camera, const ViewSettings& settings) const {
  Result<View> view = viewOf(camera, *state_->model);
  if (!view) return tl::unexpected(view.error());
  FrameView frame;
  frame.view = *view;
  frame.view.eye.z *= settings.stretch;
  frame.isMirrored = state_->model->isFlipped();
  frame.stretch = settings.stretch;
  MetricFrame stretched = state_->model->mt.arrays().metric;
  stretched.scale.z *= settings.stretch;
  const MorphCamera morph({.view = frame.view, .pixels = settings.pixels, .moves = settings.isGeomorphed},
                          stretched);
  frame.pixels = morph.tolerance().cut;
  frame.morphPixels = morph.tolerance().offset;
  return frame;
}

Result<FrameFigures> TerrainView::cut(const Camera& camera, const ViewSettings& settings) {
  State& s = *state_;
  Result<FrameView> frame = frameOf(camera, settings);
  if (!frame) return tl::unexpected(frame.error());
  FrameFigures figures;
  figures.pixels = settings.pixels;
  const Stopwatch watch;
  if (settings.path == CutPath::device && s.device) {
    if (s.hasRises && (!settings.isGeomorphed || s.drawn == CutPath::processor)) {
      glClearNamedBufferData(s.terrain.rises, GL_R32F, GL_RED, GL_FLOAT, nullptr);
      glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    }
    s.processor.reset();
    s.painter.setFrame(*frame);
    s.device->cut(s.terrain, settings.isGeomorphed);
    s.hasRises = settings.isGeomorphed && s.terrain.hasMorphs;
    const ComputeFront::Counts counts = settings.waits ? s.device->counts() : s.device->lateCounts();
    figures.triangles = counts.drawn;
    figures.asked = counts.triangles;
    figures.moving = counts.moving;
    figures.isComplete = counts.isComplete;
    s.drawn = CutPath::device;
  } else {
    if (!s.processor || s.processorStretch != settings.stretch) {
      s.processor.reset();
      Result<ProcessorFront> made = ProcessorFront::create(s.model->mt, settings.stretch);
      if (!made) return tl::unexpected(made.error());
      s.processor = std::move(*made);
      s.processorStretch = settings.stretch;
      glClearNamedBufferData(s.terrain.rises, GL_R32F, GL_RED, GL_FLOAT, nullptr);
    }
    s.processor->ask({.view = frame->view,
                      .pixels = settings.pixels,
                      .maxTriangles = settings.maxTriangles,
                      .deadlineMilliseconds = settings.cutMilliseconds,
                      .geomorph = settings.isGeomorphed});
    const Result<ProcessorFront::Done> done = s.processor->receive(s.terrain, settings.waits);
    if (!done) return tl::unexpected(done.error());
    figures.triangles = figures.asked = done->report.triangles;
    figures.moving = done->report.moving;
    figures.isComplete = done->report.isComplete;
    figures.pixels = done->report.pixels;
    figures.jumpPixels = done->report.jumpPixels;
    figures.cutMilliseconds = done->milliseconds;
    s.hasRises = true;
    s.drawn = CutPath::processor;
    return figures;
  }
  figures.cutMilliseconds = watch.milliseconds();
  return figures;
}

DrawnFront TerrainView::front() const {
  const State& s = *state_;
  if (s.drawn == CutPath::device && s.device) return s.device->front();
  return s.processor ? s.processor->front() : DrawnFront{};
}

Status TerrainView::draw(const Camera& camera, const ViewSettings& settings) {
  State& s = *state_;
  Result<FrameView> frame = frameOf(camera, settings);
  if (!frame) return tl::unexpected(frame.error());
  s.painter.setFrame(*frame);
  if (settings.look.coloring == Coloring::error && s.terrain.triangleErrors == 0)
    uploadErrors(s.terrain, s.model->mt);
  s.painter.draw(s.terrain, front(), settings.look);
  s.painter.drawSky(settings.look);
  return {};
}

const std::string& TerrainView::deviceRefusal() const {
  return state_->terrain.refusal;
}
std::uint32_t TerrainView::capacity() const {
  return state_->device ? state_->device->capacity() : 0;
}
TerrainPainter& TerrainView::painter() {
  return state_->painter;
}
const TerrainOnGpu& TerrainView::terrain() const {
  return state_->terrain;
}
const TerrainModel& TerrainView::model() const {
  return *state_->model;
}
const ComputeFront* TerrainView::computeFront() const {
  return state_->device ? &*state_->device : nullptr;
}

}  // namespace arete
