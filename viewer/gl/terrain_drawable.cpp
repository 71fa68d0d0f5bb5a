// SPDX-License-Identifier: GPL-3.0-or-later
//
// Combines the front of the device or of the processor with the painter, and rebuilds both when the space
// that is drawn changes (curvature, exaggeration).
#include "viewer/gl/terrain_drawable.h"

#include <algorithm>

#include "engine/base/stopwatch.h"
#include "engine/morph/geomorph.h"

namespace arete {

Result<TerrainDrawable> TerrainDrawable::create(const TerrainModel& model, const Options& options,
                                                const RunContext& context) {
  return create(std::make_shared<TerrainSubject>(model), options, context);
}

Result<TerrainDrawable> TerrainDrawable::create(std::shared_ptr<const TerrainSubject> subject,
                                                const Options& options, const RunContext& context) {
  const TerrainModel& model = subject->model();
  ARETE_TRY(TerrainPainter painter, TerrainPainter::create(model, options.heights, context));
  TerrainDrawable made(std::move(subject), uploadTerrain(model.mt, nullptr, context), std::move(painter));
  made.drawn_ = options.path;
  // If the device cannot compute cuts, the processor takes over, and the refusal gives the reason.
  if (made.terrain_.refusal.empty()) {
    Result<ComputeFront> device = ComputeFront::create(made.terrain_, options.mostTriangles);
    if (device)
      made.device_ = std::move(*device);
    else
      made.terrain_.refusal = device.error().describe();
  }
  return made;
}

Status TerrainDrawable::prepare(const ViewSettings& settings) {
  if (isReadyFor(settings)) return {};
  MultiTriangulation wanted = model().mt;
  if (settings.isCurved) {
    ARETE_TRY(const CurvedGround* const ground, subject_->curvedGround());
    ARETE_TRY(wanted, ground->curvedMt(settings.stretch));
  }
  // The processor's front is of the vertices that were drawn so far, so it goes with them.
  processor_.reset();
  std::string refusal = std::move(terrain_.refusal);
  terrain_ = {};
  mt_ = std::move(wanted);
  terrain_ = uploadTerrain(mt_, settings.isCurved ? &model().mt : nullptr);
  terrain_.refusal = std::move(refusal);
  hasRises_ = false;
  isBent_ = settings.isCurved;
  bentStretch_ = settings.stretch;
  return {};
}

Result<FrameView> TerrainDrawable::frameOf(const Camera& camera, const ViewSettings& settings) const {
  FrameView frame;
  ARETE_TRY(frame.view, subject_->viewOf(camera, settings));
  if (settings.isCurved) frame.earthRadius = (*subject_->curvedGround())->radius();
  const Vec3 ground = metricPosition(camera.xy, camera.height, model());
  frame.eyeGround = {ground.x, ground.y};
  frame.isMirrored = model().isFlipped();
  if (settings.nearPlane > 0) frame.drawnNear = settings.nearPlane;
  frame.depthReach = depthReach(frame.view, *subject_, settings);
  frame.stretch = settings.stretch;
  // The tolerance holds for the exaggerated terrain, so heights have the exaggerated scale.
  MetricFrame exaggerated = model().mt.metric();
  exaggerated.scale.z *= settings.stretch;
  const MorphCamera morph({.view = frame.view, .pixels = settings.pixels, .moves = settings.isGeomorphed},
                          exaggerated);
  frame.pixels = morph.tolerance().cut;
  frame.morphPixels = morph.tolerance().offset;
  return frame;
}

Result<FrameFigures> TerrainDrawable::cut(const Camera& camera, const ViewSettings& settings,
                                          const RunContext&) {
  ARETE_CHECK(subject_->check(settings));
  ARETE_TRY(FrameView frame, frameOf(camera, settings));
  ARETE_CHECK(prepare(settings));
  FrameFigures figures;
  figures.pixels = settings.pixels;
  const Stopwatch watch;
  if (settings.path == CutPath::device && device_) {
    // Vertices that the device's cut would leave moved are put at rest before it.
    if (hasRises_ && (!settings.isGeomorphed || drawn_ == CutPath::processor)) {
      glClearNamedBufferData(terrain_.rises, GL_R32F, GL_RED, GL_FLOAT, nullptr);
      glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    }
    processor_.reset();
    painter_.setFrame(frame);
    device_->cut(terrain_, settings.isGeomorphed);
    hasRises_ = settings.isGeomorphed && terrain_.nodeCount > 0;
    const ComputeFront::Counts counts = settings.waits ? device_->counts() : device_->lateCounts();
    figures.triangles = counts.drawn;
    figures.asked = counts.triangles;
    figures.moving = counts.moving;
    figures.isComplete = counts.isComplete;
    drawn_ = CutPath::device;
  } else {
    const double stretch = isBent_ ? 1 : settings.stretch;  // a curved one is exaggerated already
    if (!processor_ || processorStretch_ != stretch) {
      processor_.reset();
      ARETE_TRY(ProcessorFront made, ProcessorFront::create(mt_, stretch));
      processor_ = std::move(made);
      processorStretch_ = stretch;
      glClearNamedBufferData(terrain_.rises, GL_R32F, GL_RED, GL_FLOAT, nullptr);
    }
    processor_->ask({.view = frame.view,
                     .pixels = settings.pixels,
                     .maxTriangles = settings.maxTriangles,
                     .deadlineMilliseconds = settings.cutMilliseconds,
                     .geomorph = settings.isGeomorphed});
    ARETE_TRY(const ProcessorFront::Done done, processor_->receive(terrain_, settings.waits));
    figures.triangles = figures.asked = done.report.triangles;
    figures.moving = done.report.moving;
    figures.isComplete = done.report.isComplete;
    figures.pixels = done.report.pixels;
    figures.jumpPixels = done.report.jumpPixels;
    figures.cutMilliseconds = done.milliseconds;
    hasRises_ = true;
    drawn_ = CutPath::processor;
    return figures;
  }
  figures.cutMilliseconds = watch.milliseconds();
  return figures;
}

DrawnFront TerrainDrawable::front() const {
  if (drawn_ == CutPath::device && device_) return device_->front();
  return processor_ ? processor_->front() : DrawnFront{};
}

Status TerrainDrawable::draw(const Camera& camera, const ViewSettings& settings,
                             std::span<const Layer> layers) {
  ARETE_TRY(FrameView frame, frameOf(camera, settings));
  // A change of the curvature makes new buffers without a front, so a whole cut is waited for.
  if (!isReadyFor(settings)) {
    ViewSettings now = settings;
    now.waits = true;
    ARETE_CHECK(cut(camera, now));
  }
  painter_.setFrame(frame);
  if (settings.look.coloring == Coloring::error && terrain_.triangleErrors == 0)
    uploadErrors(terrain_, model().mt);
  ARETE_CHECK(painter_.setLayers(layers));
  glBeginQuery(GL_ANY_SAMPLES_PASSED, anySample_);
  const Status drawn = painter_.draw(terrain_, front(), settings.look);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  return drawn;
}

bool TerrainDrawable::isShown() const {
  GLuint any = 0;
  glGetQueryObjectuiv(anySample_, GL_QUERY_RESULT, &any);
  return any != 0;
}

}  // namespace arete
