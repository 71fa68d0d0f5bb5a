// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cut that changed is written to the device as a whole: its triangles sorted by material, each as three
// drawn vertices.
#include "viewer/surface/surface_drawable.h"

#include <algorithm>
#include <utility>

#include "engine/base/stopwatch.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "surface/displacement/displaced_places.h"

namespace arete {
std::uint32_t SurfaceDrawable::materialOf(std::uint32_t triangle) const {
  const auto none = static_cast<std::uint32_t>(assets_->materials.materials().size()) - 1;
  const std::vector<std::uint32_t>& of = model_->attributes.materialOf;
  if (of.empty()) return none;
  const std::uint32_t m = of[model_->faceOf[triangle]];
  return m == MeshAttributes::kNone ? none : m;
}

void SurfaceDrawable::upload() {
  const auto front = cut_.triangles();
  const MultiTriangulation& mt = model_->mt;
  std::vector<std::uint32_t> begin(assets_->materials.materials().size() + 1, 0);
  for (const std::uint32_t t : front) ++begin[materialOf(t) + 1];
  for (std::size_t m = 1; m < begin.size(); ++m) begin[m] += begin[m - 1];
  ranges_.clear();
  for (std::uint32_t m = 0; m + 1 < begin.size(); ++m)
    if (begin[m + 1] > begin[m]) ranges_.push_back({m, begin[m], begin[m + 1] - begin[m]});
  std::vector<std::array<std::uint32_t, 3>> corners(front.size());
  std::vector<float> worst(front.size());
  std::vector<Vec3> middles(hasBlendedMaterials() ? front.size() : 0);
  for (const std::uint32_t t : front) {
    const std::uint32_t at = begin[materialOf(t)]++;
    corners[at] = model_->hasWedges() ? model_->wedgesOf[t] : mt.corners(TriangleId(t));
    if (!middles.empty()) {
      const auto places = mt.corners(TriangleId(t));
      for (const std::uint32_t v : places)
        middles[at] = middles[at] + subject_->upright().fromFile(mt.position(VertexId(v))) / 3;
    }
    worst[at] = static_cast<float>(mt.error(TriangleId(t)));
  }
  blended_.clear();
  for (const DrawnSurface::Range& range : ranges_) {
    if (assets_->materials.materials()[range.material].alpha != DrawnMaterial::Alpha::blended) continue;
    for (std::uint32_t t = range.first; t < range.first + range.count; ++t)
      blended_.add({corners[t], range.material, middles[t]});
  }
  indices_ = makeBuffer(std::span<const std::array<std::uint32_t, 3>>(corners));
  errors_ = makeBuffer(std::span<const float>(worst));
  isUploaded_ = true;
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
    : model_(&subject->model()), subject_(std::move(subject)), cut_(model_->mt), assets_(std::move(assets)) {}

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
