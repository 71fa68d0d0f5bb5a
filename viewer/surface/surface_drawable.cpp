// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles are drawn sorted by material, each as three drawn vertices: those at rest from the vertices that
// all objects of a surface share, the others from the object's own.
#include "viewer/surface/surface_drawable.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>

#include "viewer/fronts/met_triangle.h"

namespace arete {

Result<SurfaceDrawable> SurfaceDrawable::create(const SurfaceModel& model,
                                                std::shared_ptr<SurfaceSubject> subject) {
  ARETE_TRY(std::shared_ptr<SurfaceAssets> assets, SurfaceAssets::create(model, subject->upright()));
  return SurfaceDrawable(std::move(assets), std::move(subject));
}

Result<std::shared_ptr<SurfaceAssets>> SurfaceAssets::create(const SurfaceModel& model,
                                                             const ZUpFrame& upright,
                                                             std::vector<std::uint8_t> colors) {
  ARETE_TRY(SurfacePainter painter, SurfacePainter::create());
  auto drawn = std::make_shared<const DrawnVertices>(drawnVertices(model, upright, std::move(colors)));
  SurfaceOnGpu vertices = uploadSurface(*drawn);
  return std::make_shared<SurfaceAssets>(
      SurfaceAssets{std::move(drawn), std::move(vertices), MaterialsOnGpu::load(model), std::move(painter)});
}

SurfaceDrawable::SurfaceDrawable(std::shared_ptr<SurfaceAssets> assets,
                                 std::shared_ptr<SurfaceSubject> subject)
    : subject_(std::move(subject)), assets_(std::move(assets)) {
  front_ = frontOf(subject_->model(), assets_->drawn);
}

std::shared_ptr<MorphingFront> SurfaceDrawable::frontOf(const SurfaceModel& model,
                                                        std::shared_ptr<const DrawnVertices> drawn) const {
  std::vector<bool> isBlended;
  for (const DrawnMaterial& m : assets_->materials.materials())
    isBlended.push_back(m.alpha == DrawnMaterial::Alpha::blended);
  return std::make_shared<MorphingFront>(model, subject_->upright(), std::move(drawn), std::move(isBlended));
}

Result<SurfacePart> SurfaceDrawable::ready(std::shared_ptr<const SurfaceModel> model,
                                           const MorphingFront::Asked& asked,
                                           const RunContext& context) const {
  SurfacePart part{.model = std::move(model), .drawn = {}, .front = {}};
  part.drawn = std::make_shared<const DrawnVertices>(drawnVertices(*part.model, subject_->upright()));
  part.front = frontOf(*part.model, part.drawn);
  ARETE_CHECK(part.front->update(asked, context));
  return part;
}

// The indices in graphics memory are of vertices that are gone; those of the new front come with the next
// cut.
void SurfaceDrawable::replace(SurfacePart part) {
  stopWork();
  assets_->vertices = {};
  assets_->vertices = uploadSurface(*part.drawn);
  assets_->drawn = std::move(part.drawn);
  front_ = std::move(part.front);
  part_ = std::move(part.model);
  hasFront_ = isReplaced_ = true;
  ranges_.clear();
  own_ = {};
  displaced_ = {};
  ink_.reset();
}

// The model may end with the object, and the thread reads it.
SurfaceDrawable::~SurfaceDrawable() {
  stopWork();
}

void SurfaceDrawable::stopWork() {
  if (worker_ && front_) worker_->stop(front_.get());
}

Result<MorphingFront::Asked> SurfaceDrawable::askedBy(const Camera& camera,
                                                      const ViewSettings& settings) const {
  ARETE_TRY(const View view, subject_->viewOf(camera, settings));
  const View own = viewedBy(subject_->pose(settings), view);
  MorphingFront::Asked asked;
  asked.view = subject_->upright().turnedBack(own);
  asked.pixels = settings.pixels;
  if (settings.maxTriangles > 0) asked.maxTriangles = settings.maxTriangles;
  asked.level = settings.level;
  asked.moves = settings.isGeomorphed;
  return asked;
}

Result<FrameFigures> SurfaceDrawable::cut(const Camera& camera, const ViewSettings& settings,
                                          const RunContext& context) {
  ARETE_CHECK(subject_->check(settings));
  ARETE_TRY(MorphingFront::Asked asked, askedBy(camera, settings));
  if (settings.waits || !hasFront_) {
    stopWork();
    ARETE_CHECK(front_->update(asked, context));
  } else {
    asked.milliseconds = settings.cutMilliseconds;
    if (!worker_) worker_ = CutWorker::shared();
    worker_->post(front_.get(), [front = front_, asked] {
      // take() says what went wrong.
      static_cast<void>(front->update(asked));
    });
  }
  ARETE_TRY(MorphingFront::Taken taken, front_->take());
  upload(std::move(taken.changes));
  hasFront_ = true;
  pixels_ = taken.figures.pixels;
  // How far vertices are from where the last front had them is not known.
  if (std::exchange(isReplaced_, false)) taken.figures.jumpPixels = std::numeric_limits<double>::quiet_NaN();
  return taken.figures;
}

void SurfaceDrawable::upload(FrontChanges&& changes) {
  if (changes.newSize) {
    indices_ = makeBuffer(std::size_t{12} * *changes.newSize);
    errors_ = makeBuffer(std::size_t{4} * *changes.newSize);
    ids_ = makeBuffer(std::size_t{4} * *changes.newSize);
  }
  std::size_t at = 0;
  for (const FrontChanges::Run& run : changes.runs) {
    glNamedBufferSubData(indices_, GLintptr(12) * run.first, GLsizeiptr(12) * run.count,
                         &changes.corners[at]);
    glNamedBufferSubData(errors_, GLintptr(4) * run.first, GLsizeiptr(4) * run.count, &changes.errors[at]);
    glNamedBufferSubData(ids_, GLintptr(4) * run.first, GLsizeiptr(4) * run.count, &changes.triangles[at]);
    at += run.count;
  }
  if (changes.ranges) ranges_ = std::move(*changes.ranges);
  if (changes.own) {
    own_ = {};
    if (!changes.own->corners.empty()) {
      own_.vertices = makeBuffer(std::span<const OwnVertex>(changes.own->vertices));
      own_.indices = makeBuffer(std::span<const FrontChanges::Corners>(changes.own->corners));
      own_.errors = makeBuffer(std::span<const float>(changes.own->errors));
      own_.ids = makeBuffer(std::span<const std::uint32_t>(changes.own->triangles));
    }
    own_.ranges = std::move(changes.own->ranges);
    own_.blended = std::move(changes.own->blended);
  }
  if (changes.positions) displaced_ = makeBuffer(std::span<const float>(*changes.positions));
}

VertexStreams SurfaceDrawable::restingStreams() const {
  VertexStreams streams = assets_->vertices.streams();
  if (displaced_ != 0) streams.positions.buffer = displaced_;
  return streams;
}

Result<const InkOnGpu*> SurfaceDrawable::inkOf(const ViewLook& look) {
  if (look.coloring != Coloring::ink) return static_cast<const InkOnGpu*>(nullptr);
  ARETE_TRY(auto ink, subject_->ink(look.ink));
  if (ink != ink_) inkOnGpu_ = std::make_unique<InkOnGpu>(*ink);
  ink_ = std::move(ink);
  return static_cast<const InkOnGpu*>(inkOnGpu_.get());
}

// The near planes of all objects are one plane of the scene, so that their depths compare: what is written is
// the near depth over the depth, in whatever unit.
Result<FrameView> SurfaceDrawable::frameOf(const Camera& camera, const ViewSettings& settings) const {
  FrameView frame;
  ARETE_TRY(const View view, subject_->viewOf(camera, settings));
  const Similarity pose = subject_->pose(settings);
  frame.view = viewedBy(pose, view);
  frame.pixels = pixels_;
  frame.drawnNear = (settings.nearPlane > 0 ? settings.nearPlane : subject_->nearPlane()) / pose.scale();
  frame.depthReach = depthReach(view, *subject_, settings) / pose.scale();
  return frame;
}

Status SurfaceDrawable::draw(const Camera& camera, const ViewSettings& settings, std::span<const Layer>) {
  ARETE_TRY(const FrameView frame, frameOf(camera, settings));
  ARETE_TRY(const InkOnGpu* const ink, inkOf(settings.look));
  const auto solid = [&](const std::vector<FrontChanges::Range>& ranges) {
    std::vector<DrawnSurface::Range> drawn;
    for (const FrontChanges::Range& r : ranges)
      if (!SurfacePainter::isBlended(assets_->materials.materials()[r.material], settings.look))
        drawn.push_back({r.material, r.first, r.count});
    return drawn;
  };
  const std::vector<DrawnSurface::Range> resting = solid(ranges_), own = solid(own_.ranges);
  hasDrawnBlended_ = false;
  const Similarity turned(subject_->placement().turn, 1, {});
  glBeginQuery(GL_ANY_SAMPLES_PASSED, anySample_);
  assets_->painter.draw(assets_->materials, DrawnSurface{indices_, errors_, ids_, restingStreams(), resting},
                        frame, settings.look, turned, false, ink);
  if (!own.empty())
    assets_->painter.draw(
        assets_->materials,
        DrawnSurface{own_.indices, own_.errors, own_.ids, streamsOf(own_.vertices, assets_->vertices), own},
        frame, settings.look, turned, false, ink);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  return {};
}

Status SurfaceDrawable::drawBlended(const Camera& camera, const ViewSettings& settings) {
  if (settings.look.coloring != Coloring::material || own_.blended.isEmpty()) return {};
  ARETE_TRY(const FrameView frame, frameOf(camera, settings));
  own_.blended.sort(frame.view.eye, Frustum(frame.view).planes().forward);
  const auto corners = own_.blended.corners();
  const GlBuffer indices = makeBuffer(std::span<const std::array<std::uint32_t, 3>>(corners));
  std::vector<DrawnSurface::Range> runs;
  for (const BlendedOrder::Run& run : own_.blended.runs())
    runs.push_back({run.material, run.first, run.count});
  glBeginQuery(GL_ANY_SAMPLES_PASSED, anyBlended_);
  assets_->painter.draw(assets_->materials,
                        DrawnSurface{indices, 0, 0, streamsOf(own_.vertices, assets_->vertices), runs}, frame,
                        settings.look, Similarity(subject_->placement().turn, 1, {}), true);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  hasDrawnBlended_ = true;
  return {};
}

// What lies in graphics memory is what is drawn, whatever another thread is about to make of the front.
std::optional<double> SurfaceDrawable::drawnError(const Pick&, const Camera& camera, Vec2 pixel,
                                                  const ViewSettings& settings) const {
  const Result<View> view = subject_->viewOf(camera, settings);
  if (!view) return std::nullopt;
  const Similarity back = subject_->pose(settings).inverse();
  const bool isMirrored = subject_->space().isMirrored();
  const Vec3 from = back(originOfPixel(*view, isMirrored, pixel, depthReach(*view, *subject_, settings)));
  const Vec3 direction = back.direction(directionOfPixel(*view, isMirrored, pixel));
  std::optional<double> error;
  double nearest = std::numeric_limits<double>::infinity();
  const auto meet = [&](GLuint indices, GLuint errors, const std::vector<FrontChanges::Range>& ranges,
                        const std::function<Vec3(std::uint32_t)>& place) {
    for (const FrontChanges::Range& range : ranges) {
      std::vector<FrontChanges::Corners> corners(range.count);
      glGetNamedBufferSubData(indices, GLintptr(12) * range.first, GLsizeiptr(12) * range.count,
                              corners.data());
      const bool isFrontAlone = settings.look.surface.sides == SurfaceSides::front;
      const auto met = firstMet({corners, place, isFrontAlone}, from, direction);
      if (!met || met->along >= nearest) continue;
      nearest = met->along;
      float stored = 0;
      glGetNamedBufferSubData(errors, GLintptr(4) * GLintptr(range.first + met->index), 4, &stored);
      error = stored;
    }
  };
  std::vector<float> displaced(displaced_ == 0 ? 0 : assets_->drawn->positions.size());
  if (!displaced.empty())
    glGetNamedBufferSubData(displaced_, 0, GLsizeiptr(4 * displaced.size()), displaced.data());
  const std::vector<float>& resting = displaced.empty() ? assets_->drawn->positions : displaced;
  meet(indices_, errors_, ranges_, [&](std::uint32_t v) {
    return Vec3{resting[3 * v], resting[3 * v + 1], resting[3 * v + 2]};
  });
  if (own_.ranges.empty()) return error;
  GLint bytes = 0;
  glGetNamedBufferParameteriv(own_.vertices, GL_BUFFER_SIZE, &bytes);
  std::vector<OwnVertex> moving(std::size_t(bytes) / sizeof(OwnVertex));
  glGetNamedBufferSubData(own_.vertices, 0, GLsizeiptr(moving.size() * sizeof(OwnVertex)), moving.data());
  meet(own_.indices, own_.errors, own_.ranges, [&](std::uint32_t v) {
    const auto& p = moving[v].position;
    return Vec3{p[0], p[1], p[2]};
  });
  return error;
}

void SurfaceDrawable::setTurn(const Turn& turn) {
  Placement placement = subject_->placement();
  placement.turn = turn;
  subject_->place(placement);
}

bool SurfaceDrawable::isShown() const {
  GLuint any = 0;
  glGetQueryObjectuiv(anySample_, GL_QUERY_RESULT, &any);
  if (any == 0 && hasDrawnBlended_) glGetQueryObjectuiv(anyBlended_, GL_QUERY_RESULT, &any);
  return any != 0;
}

}  // namespace arete
