// SPDX-License-Identifier: GPL-3.0-or-later
//
// Combines the front of the device or of the processor with the painter, and rebuilds both when the space
// that is drawn changes (curvature, exaggeration).
#include "viewer/gl/terrain_drawable.h"

#include <algorithm>

#include "engine/base/stopwatch.h"
#include "engine/morph/geomorph.h"
#include "viewer/gl/processor_front.h"

namespace arete {
struct TerrainDrawable::State {
  std::shared_ptr<const TerrainSubject> subject;
  const TerrainModel* model = nullptr;
  MultiTriangulation mt;  // what is drawn, the model's or a curved one
  TerrainOnGpu terrain;
  TerrainPainter painter;
  std::optional<ComputeFront> device = {};
  std::optional<ProcessorFront> processor = {};
  double processorStretch = 1;
  bool hasRises = false;  // of vertices that the device's cut would not put to rest
  CutPath drawn = CutPath::device;
  GlQuery anySample = makeQuery(GL_ANY_SAMPLES_PASSED);  // of the terrain, when it was drawn last
  bool isBent = false;
  double bentStretch = 1;

  bool isReadyFor(const ViewSettings& settings) const {
    return settings.isCurved == isBent && (!isBent || settings.stretch == bentStretch);
  }
  /// Makes the buffers that the settings need.
  Status prepare(const ViewSettings& settings) {
    if (isReadyFor(settings)) return {};
    MultiTriangulation wanted = model->mt;
    if (settings.isCurved) {
      ARETE_TRY(const CurvedGround* const made, subject->curvedGround());
      ARETE_TRY(MultiTriangulation curved, made->curvedMt(settings.stretch));
      wanted = std::move(curved);
    }
    // The processor's front is of the vertices that were drawn so far, so it goes with them.
    processor.reset();
    std::string refusal = std::move(terrain.refusal);
    terrain = {};
    mt = std::move(wanted);
    terrain = uploadTerrain(mt, settings.isCurved ? &model->mt : nullptr);
    terrain.refusal = std::move(refusal);
    hasRises = false;
    isBent = settings.isCurved;
    bentStretch = settings.stretch;
    return {};
  }
};

Result<TerrainDrawable> TerrainDrawable::create(const TerrainModel& model, const Options& options,
                                                const RunContext& context) {
  return create(std::make_shared<TerrainSubject>(model), options, context);
}

Result<TerrainDrawable> TerrainDrawable::create(std::shared_ptr<const TerrainSubject> subject,
                                                const Options& options, const RunContext& context) {
  const TerrainModel& model = subject->model();
  ARETE_TRY(TerrainPainter painter, TerrainPainter::create(model));
  auto state = std::make_unique<State>(State{.subject = std::move(subject),
                                             .model = &model,
                                             .mt = model.mt,
                                             .terrain = uploadTerrain(model.mt, nullptr, context),
                                             .painter = std::move(painter)});
  state->drawn = options.path;
  // If the device cannot compute cuts, the processor takes over, and the refusal gives the reason.
  if (state->terrain.refusal.empty()) {
    Result<ComputeFront> device = ComputeFront::create(state->terrain, options.mostTriangles);
    if (device)
      state->device = std::move(*device);
    else
      state->terrain.refusal = device.error().describe();
  }
  return TerrainDrawable(std::move(state));
}

TerrainDrawable::TerrainDrawable(std::unique_ptr<State> state) : state_(std::move(state)) {}
TerrainDrawable::TerrainDrawable(TerrainDrawable&&) noexcept = default;
TerrainDrawable& TerrainDrawable::operator=(TerrainDrawable&&) noexcept = default;
TerrainDrawable::~TerrainDrawable() = default;

Result<FrameView> TerrainDrawable::frameOf(const Camera& camera, const ViewSettings& settings) const {
  FrameView frame;
  ARETE_TRY(frame.view, state_->subject->viewOf(camera, settings));
  if (settings.isCurved) frame.earthRadius = (*state_->subject->curvedGround())->radius();
  const Vec3 ground = metricPosition(camera.xy, camera.height, *state_->model);
  frame.eyeGround = {ground.x, ground.y};
  frame.isMirrored = state_->model->isFlipped();
  frame.stretch = settings.stretch;
  // The tolerance holds for the exaggerated terrain, so heights have the exaggerated scale.
  MetricFrame exaggerated = state_->model->mt.metric();
  exaggerated.scale.z *= settings.stretch;
  const MorphCamera morph({.view = frame.view, .pixels = settings.pixels, .moves = settings.isGeomorphed},
                          exaggerated);
  frame.pixels = morph.tolerance().cut;
  frame.morphPixels = morph.tolerance().offset;
  return frame;
}

Result<FrameFigures> TerrainDrawable::cut(const Camera& camera, const ViewSettings& settings,
                                          const RunContext&) {
  State& s = *state_;
  ARETE_CHECK(s.subject->check(settings));
  ARETE_TRY(FrameView frame, frameOf(camera, settings));
  ARETE_CHECK(s.prepare(settings));
  FrameFigures figures;
  figures.pixels = settings.pixels;
  const Stopwatch watch;
  if (settings.path == CutPath::device && s.device) {
    // Vertices that the device's cut would leave moved are put at rest before it.
    if (s.hasRises && (!settings.isGeomorphed || s.drawn == CutPath::processor)) {
      glClearNamedBufferData(s.terrain.rises, GL_R32F, GL_RED, GL_FLOAT, nullptr);
      glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    }
    s.processor.reset();
    s.painter.setFrame(frame);
    s.device->cut(s.terrain, settings.isGeomorphed);
    s.hasRises = settings.isGeomorphed && s.terrain.nodeCount > 0;
    const ComputeFront::Counts counts = settings.waits ? s.device->counts() : s.device->lateCounts();
    figures.triangles = counts.drawn;
    figures.asked = counts.triangles;
    figures.moving = counts.moving;
    figures.isComplete = counts.isComplete;
    s.drawn = CutPath::device;
  } else {
    const double stretch = s.isBent ? 1 : settings.stretch;  // a curved one is exaggerated already
    if (!s.processor || s.processorStretch != stretch) {
      s.processor.reset();
      ARETE_TRY(ProcessorFront made, ProcessorFront::create(s.mt, stretch));
      s.processor = std::move(made);
      s.processorStretch = stretch;
      glClearNamedBufferData(s.terrain.rises, GL_R32F, GL_RED, GL_FLOAT, nullptr);
    }
    s.processor->ask({.view = frame.view,
                      .pixels = settings.pixels,
                      .maxTriangles = settings.maxTriangles,
                      .deadlineMilliseconds = settings.cutMilliseconds,
                      .geomorph = settings.isGeomorphed});
    ARETE_TRY(const ProcessorFront::Done done, s.processor->receive(s.terrain, settings.waits));
    figures.triangles = figures.asked = done.report.triangles;
    figures.moving = done.report.moving;
    figures.isComplete = done.report.isComplete;
    figures.pixels = done.report.pixels;
    figures.jumpPixels = done.report.jumpPixels;
    figures.cutMilliseconds = done.milliseconds;
    s.hasRises = true;
    s.drawn = CutPath::processor;
    return figures;
  }
  figures.cutMilliseconds = watch.milliseconds();
  return figures;
}

DrawnFront TerrainDrawable::front() const {
  const State& s = *state_;
  if (s.drawn == CutPath::device && s.device) return s.device->front();
  return s.processor ? s.processor->front() : DrawnFront{};
}

Status TerrainDrawable::draw(const Camera& camera, const ViewSettings& settings,
                             std::span<const Layer> layers) {
  State& s = *state_;
  ARETE_TRY(FrameView frame, frameOf(camera, settings));
  // A change of the curvature makes new buffers without a front, so a whole cut is waited for.
  if (!s.isReadyFor(settings)) {
    ViewSettings now = settings;
    now.waits = true;
    ARETE_CHECK(cut(camera, now));
  }
  s.painter.setFrame(frame);
  if (settings.look.coloring == Coloring::error && s.terrain.triangleErrors == 0)
    uploadErrors(s.terrain, s.model->mt);
  ARETE_CHECK(s.painter.setLayers(layers));
  glBeginQuery(GL_ANY_SAMPLES_PASSED, s.anySample);
  s.painter.draw(s.terrain, front(), settings.look);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  return {};
}

void TerrainDrawable::drawBackground(const ViewSettings& settings) {
  state_->painter.drawSky(settings.look);
}

bool TerrainDrawable::isShown() const {
  GLuint any = 0;
  glGetQueryObjectuiv(state_->anySample, GL_QUERY_RESULT, &any);
  return any != 0;
}

std::string TerrainDrawable::deviceRefusal() const {
  return state_->terrain.refusal;
}
std::uint32_t TerrainDrawable::capacity() const {
  return state_->device ? state_->device->capacity() : 0;
}
bool TerrainDrawable::keepsBudget(const ViewSettings& settings) const {
  return settings.path == CutPath::processor;
}

const TerrainSubject& TerrainDrawable::subject() const {
  return *state_->subject;
}
TerrainPainter& TerrainDrawable::painter() {
  return state_->painter;
}
const TerrainOnGpu& TerrainDrawable::terrain() const {
  return state_->terrain;
}
const TerrainModel& TerrainDrawable::model() const {
  return *state_->model;
}
const MultiTriangulation& TerrainDrawable::mt() const {
  return state_->mt;
}
const ComputeFront* TerrainDrawable::computeFront() const {
  return state_->device ? &*state_->device : nullptr;
}

}  // namespace arete
