// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles are drawn sorted by material, each as three drawn vertices. Of a cut that changed only the slots
// that changed are written to the device.
#include "viewer/surface/surface_drawable.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/stopwatch.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "surface/displacement/displaced_places.h"

namespace arete {
namespace {

/// Unchanged slots between two that changed are sent with them rather than in a call of their own.
constexpr std::uint32_t kGapThatIsSent = 16;

}  // namespace

std::uint32_t SurfaceDrawable::materialOf(std::uint32_t triangle) const {
  const auto none = static_cast<std::uint32_t>(assets_->materials.materials().size()) - 1;
  const std::vector<std::uint32_t>& of = model_->attributes.materialOf;
  if (of.empty()) return none;
  const std::uint32_t m = of[model_->faceOf[triangle]];
  return m == MeshAttributes::kNone ? none : m;
}

void SurfaceDrawable::upload() {
  const auto front = cut_.triangles();
  slots_.update(front, [&](std::uint32_t t) { return materialOf(t); });
  ranges_.clear();
  for (std::uint32_t m = 0; m < slots_.ranges().size(); ++m)
    if (const MaterialSlots::Range& range = slots_.ranges()[m]; range.count > 0)
      ranges_.push_back({m, range.first, range.count});
  const auto count = static_cast<std::uint32_t>(slots_.triangles().size());
  if (slots_.isPacked()) {
    indices_ = makeBuffer(std::size_t{12} * count);
    errors_ = makeBuffer(std::size_t{4} * count);
    send(0, count);
  }
  const std::span<const std::uint32_t> changed = slots_.changed();
  for (std::size_t i = 0; i < changed.size();) {
    std::size_t end = i + 1;
    while (end < changed.size() && changed[end] - changed[end - 1] <= kGapThatIsSent) ++end;
    send(changed[i], changed[end - 1] - changed[i] + 1);
    i = end;
  }
  blended_.clear();
  if (hasBlendedMaterials()) listBlended(front);
  isUploaded_ = true;
}

/// Writes slots to the device.
void SurfaceDrawable::send(std::uint32_t first, std::uint32_t count) {
  if (count == 0) return;
  const MultiTriangulation& mt = model_->mt;
  std::vector<std::array<std::uint32_t, 3>> corners(count);
  std::vector<float> worst(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t t = slots_.triangles()[first + i];
    corners[i] = model_->hasWedges() ? model_->wedgesOf[t] : mt.corners(TriangleId(t));
    worst[i] = static_cast<float>(mt.error(TriangleId(t)));
  }
  glNamedBufferSubData(indices_, GLintptr(12) * first, GLsizeiptr(12) * count, corners.data());
  glNamedBufferSubData(errors_, GLintptr(4) * first, GLsizeiptr(4) * count, worst.data());
}

void SurfaceDrawable::listBlended(std::span<const std::uint32_t> front) {
  const MultiTriangulation& mt = model_->mt;
  for (const std::uint32_t t : front) {
    const std::uint32_t material = materialOf(t);
    if (assets_->materials.materials()[material].alpha != DrawnMaterial::Alpha::blended) continue;
    Vec3 middle;
    for (const std::uint32_t v : mt.corners(TriangleId(t)))
      middle = middle + subject_->upright().fromFile(mt.position(VertexId(v))) / 3;
    blended_.add({model_->hasWedges() ? model_->wedgesOf[t] : mt.corners(TriangleId(t)), material, middle});
  }
}

/// Draws the front where it is within what the criterion allows now.
void SurfaceDrawable::displace(const BoundedCriterion& criterion) {
  const MultiTriangulation& mt = model_->mt;
  const ZUpFrame& upright = subject_->upright();
  const Cut front = cut_.front();
  const std::vector<Vec3> places =
      displacedPlaces(mt, model_->displacement, front, promisedErrors(mt, front, &criterion));
  if (positions_.empty()) positions_ = drawnPositions(*model_, upright);
  for (std::size_t t = 0; t < front.ids.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      // A drawn vertex is a wedge where there are wedges; triangles that share one write the same place.
      const std::uint32_t v = front.triangles[t][i];
      const std::size_t drawn = model_->hasWedges() ? model_->wedgesOf[front.ids[t]][i] : front.vertices[v];
      const Vec3 p = upright.fromFile(places[v]);
      positions_[3 * drawn] = float(p.x);
      positions_[3 * drawn + 1] = float(p.y);
      positions_[3 * drawn + 2] = float(p.z);
    }
  displaced_ = makeBuffer(std::span<const float>(positions_));
}

Result<SurfaceDrawable> SurfaceDrawable::create(const SurfaceModel& model,
                                                std::shared_ptr<SurfaceSubject> subject) {
  ARETE_TRY(std::shared_ptr<SurfaceAssets> assets, SurfaceAssets::create(model, subject->upright()));
  return SurfaceDrawable(std::move(assets), std::move(subject));
}

Result<std::shared_ptr<SurfaceAssets>> SurfaceAssets::create(const SurfaceModel& model,
                                                             const ZUpFrame& upright) {
  ARETE_TRY(SurfacePainter painter, SurfacePainter::create());
  return std::make_shared<SurfaceAssets>(
      SurfaceAssets{uploadSurface(model, upright), MaterialsOnGpu::load(model), std::move(painter)});
}

SurfaceDrawable::SurfaceDrawable(std::shared_ptr<SurfaceAssets> assets,
                                 std::shared_ptr<SurfaceSubject> subject)
    : model_(&subject->model()),
      subject_(std::move(subject)),
      cut_(model_->mt),
      assets_(std::move(assets)),
      slots_(static_cast<std::uint32_t>(assets_->materials.materials().size())) {}

Result<FrameFigures> SurfaceDrawable::cut(const Camera& camera, const ViewSettings& settings,
                                          const RunContext& context) {
  ARETE_CHECK(subject_->check(settings));
  ARETE_TRY(const View view, subject_->viewOf(camera, settings));
  const View own = viewedBy(subject_->pose(settings), view);
  const Stopwatch watch;
  const MultiTriangulation& mt = model_->mt;
  const ViewError seen({.view = subject_->upright().turnedBack(own), .pixels = settings.pixels}, mt.metric());
  const UniformError chosen(settings.level ? settings.level->error : 0);
  const bool isChosen = settings.level.has_value();
  const BoundedCriterion& criterion = isChosen ? static_cast<const BoundedCriterion&>(chosen) : seen;
  IncrementalOptions options;
  if (const auto most = isChosen ? settings.level->triangles : settings.maxTriangles; most > 0)
    options.maxTriangles = most;
  ARETE_TRY(const IncrementalCut::Update update, cut_.update(criterion, options, context));
  FrameFigures figures;
  figures.triangles = figures.asked = static_cast<std::uint32_t>(cut_.triangles().size());
  figures.isComplete = isChosen || update.isComplete;
  figures.pixels = settings.pixels;
  // A budget may end the cut early, and a level is chosen: the figure is then the worst error that is drawn.
  if (isChosen)
    figures.pixels = worstSeverity(mt, seen, cut_.front());
  else if (!update.isComplete)
    figures.pixels = std::max(settings.pixels, worstSeverity(mt, seen, cut_.front()));
  pixels_ = figures.pixels;
  if (!isUploaded_ || !cut_.lastSteps().empty()) upload();
  if (!model_->displacement.isEmpty()) displace(criterion);
  figures.cutMilliseconds = watch.milliseconds();
  return figures;
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

bool SurfaceDrawable::hasBlendedMaterials() const {
  return std::ranges::any_of(assets_->materials.materials(),
                             [](const DrawnMaterial& m) { return m.alpha == DrawnMaterial::Alpha::blended; });
}

Status SurfaceDrawable::draw(const Camera& camera, const ViewSettings& settings, std::span<const Layer>) {
  ARETE_TRY(const FrameView frame, frameOf(camera, settings));
  std::vector<DrawnSurface::Range> solid;
  for (const DrawnSurface::Range& range : ranges_)
    if (!SurfacePainter::isBlended(assets_->materials.materials()[range.material], settings.look))
      solid.push_back(range);
  hasDrawnBlended_ = false;
  glBeginQuery(GL_ANY_SAMPLES_PASSED, anySample_);
  assets_->painter.draw(assets_->vertices, assets_->materials,
                        DrawnSurface{indices_, errors_, displaced_, solid}, frame, settings.look,
                        Similarity(subject_->placement().turn, 1, {}));
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  return {};
}

Status SurfaceDrawable::drawBlended(const Camera& camera, const ViewSettings& settings) {
  if (settings.look.coloring != Coloring::material || blended_.isEmpty()) return {};
  ARETE_TRY(const FrameView frame, frameOf(camera, settings));
  blended_.sort(frame.view.eye, Frustum(frame.view).planes().forward);
  const auto corners = blended_.corners();
  const GlBuffer indices = makeBuffer(std::span<const std::array<std::uint32_t, 3>>(corners));
  std::vector<DrawnSurface::Range> runs;
  for (const BlendedOrder::Run& run : blended_.runs()) runs.push_back({run.material, run.first, run.count});
  glBeginQuery(GL_ANY_SAMPLES_PASSED, anyBlended_);
  assets_->painter.draw(assets_->vertices, assets_->materials, DrawnSurface{indices, 0, displaced_, runs},
                        frame, settings.look, Similarity(subject_->placement().turn, 1, {}), true);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  hasDrawnBlended_ = true;
  return {};
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
