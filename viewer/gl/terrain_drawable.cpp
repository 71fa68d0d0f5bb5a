// SPDX-License-Identifier: GPL-3.0-or-later
//
// Combines the front of the device or of the processor with the painter, and rebuilds both when the space
// that is drawn changes (curvature, exaggeration).
#include "viewer/gl/terrain_drawable.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

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
  made.mostTriangles_ = options.mostTriangles;
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

// The processor's front and the rises are of vertices that are gone. Moving vertices begin anew at rest.
void TerrainDrawable::replace(std::shared_ptr<const TerrainSubject> subject, const RunContext& context) {
  processor_.reset();
  subject_ = std::move(subject);
  mt_ = model().mt;
  terrain_ = {};
  terrain_ = uploadTerrain(mt_, nullptr, context);
  if (device_ && terrain_.refusal.empty()) device_->fit(terrain_, mostTriangles_);
  hasRises_ = false;
  isBent_ = false;
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
  if (settings.path == CutPath::device && device_ && terrain_.refusal.empty() && !settings.level) {
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
    return cutByProcessor(frame, settings);
  }
  figures.cutMilliseconds = watch.milliseconds();
  return figures;
}

Result<FrameFigures> TerrainDrawable::cutByProcessor(const FrameView& frame, const ViewSettings& settings) {
  FrameFigures figures;
  const double stretch = isBent_ ? 1 : settings.stretch;  // a curved one is exaggerated already
  if (!processor_ || processorStretch_ != stretch) {
    processor_.reset();
    ARETE_TRY(ProcessorFront made, ProcessorFront::create(mt_, stretch));
    processor_ = std::move(made);
    processorStretch_ = stretch;
    glClearNamedBufferData(terrain_.rises, GL_R32F, GL_RED, GL_FLOAT, nullptr);
  }
  const ProcessorFront::Asked asked =
      settings.level ? askedBy(*settings.level, settings)
                     : ProcessorFront::Asked{.view = frame.view,
                                             .pixels = settings.pixels,
                                             .maxTriangles = settings.maxTriangles,
                                             .deadlineMilliseconds = settings.cutMilliseconds,
                                             .geomorph = settings.isGeomorphed};
  processor_->ask(asked);
  ARETE_TRY(const ProcessorFront::Done done, processor_->receive(terrain_, settings.waits));
  figures.triangles = figures.asked = done.report.triangles;
  figures.moving = done.report.moving;
  figures.isComplete = settings.level || done.report.isComplete;
  figures.pixels = done.report.pixels;
  figures.jumpPixels = done.report.jumpPixels;
  if (settings.level) {
    // The error of the level as the camera sees it, at the nearest place that it may see.
    const double error = done.report.pixels / Frustum(asked.view).pixelsPerUnit();
    const Frustum seen(frame.view);
    const Sphere all = ballAbout(*subject_, settings);
    const Vec3 middle = seen.toView({all.x, all.y, all.z});
    const double reach = seen.reach(middle, all.radius, std::max(middle.z - double(all.radius), 0.0));
    figures.pixels = error > 0 ? error * seen.pixelsPerUnit() / reach : 0;
    figures.jumpPixels = std::numeric_limits<double>::quiet_NaN();
  }
  figures.cutMilliseconds = done.milliseconds;
  hasRises_ = true;
  drawn_ = CutPath::processor;
  return figures;
}

// In parallel projection every error has the same size in the picture, wherever it is: a tolerance in pixels
// is one in the unit of heights.
ProcessorFront::Asked TerrainDrawable::askedBy(const HandLevel& level, const ViewSettings& settings) const {
  const Sphere all = ballAbout(*subject_, settings);
  ProcessorFront::Asked asked;
  asked.view.eye = {all.x, all.y, all.z};
  asked.view.forward = {0, 0, -1};
  asked.view.up = {0, 1, 0};
  asked.view.widthPixels = asked.view.heightPixels = 1000;
  asked.view.nearDistance = -std::numeric_limits<double>::infinity();
  asked.view.parallelHeight = 4 * std::max(double(all.radius), 1e-3);
  asked.geomorph = false;
  // What is not simplified at all has an error of 0; a tolerance is above it.
  const double least = 1e-9 * std::max(model().mt.largestError(), 1e-9);
  const double error = level.triangles > 0 ? least : std::max(level.error, least);
  asked.pixels = error * model().mt.metric().scale.z * settings.stretch * Frustum(asked.view).pixelsPerUnit();
  if (level.triangles > 0) asked.maxTriangles = std::max(level.triangles, model().mt.rootTriangleCount());
  return asked;
}

// Triangles do not overlap in the plan, so the one over the place is the one that is seen there, though
// heights of the cut may hide it from the eye.
std::optional<double> TerrainDrawable::drawnError(const Pick& pick, const Camera&, Vec2,
                                                  const ViewSettings&) const {
  const DrawnFront drawn = front();
  if (drawn.ids == 0) return std::nullopt;
  std::uint32_t count = drawn.count;
  if (drawn.indirect != 0) {
    std::uint32_t corners = 0;
    glGetNamedBufferSubData(drawn.indirect, 0, 4, &corners);
    count = corners / 3;
  }
  std::vector<std::uint32_t> ids(count);
  if (count > 0)
    glGetNamedBufferSubData(drawn.ids, GLintptr(4) * drawn.first, GLsizeiptr(4) * count, ids.data());
  const MultiTriangulation& mt = model().mt;
  for (const std::uint32_t id : ids) {
    std::array<Vec2, 3> corners;
    const auto vertices = mt.corners(TriangleId(id));
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = mt.position(VertexId(vertices[i]));
      corners[i] = {p.x, p.y};
    }
    const auto side = [&](std::size_t i) {
      const Vec2 &a = corners[i], &b = corners[(i + 1) % 3];
      return (b.x - a.x) * (pick.plan.y - a.y) - (b.y - a.y) * (pick.plan.x - a.x);
    };
    if (side(0) >= 0 && side(1) >= 0 && side(2) >= 0) return mt.error(TriangleId(id));
  }
  return std::nullopt;
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
