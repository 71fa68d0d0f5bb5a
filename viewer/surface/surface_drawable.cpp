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
#include "engine/follow/incremental_cut.h"
#include "surface/displacement/displaced_places.h"
#include "viewer/surface/surface_painter.h"

namespace arete {
namespace {

/// Part of the diagonal: what is nearer to the eye is not drawn.
constexpr double kNearestPlane = 1e-4;

}  // namespace

struct SurfaceDrawable::State {
  const SurfaceModel* model = nullptr;
  std::shared_ptr<const SurfaceSubject> subject;
  ZUpFrame upright;
  IncrementalCut cut;
  SurfaceOnGpu surface;
  MaterialsOnGpu materials;
  SurfacePainter painter;
  GlQuery anySample = makeQuery(GL_ANY_SAMPLES_PASSED);
  double pixels = 1;  // of the last cut
  bool isUploaded = false;
  GlBuffer indices = {}, errors = {};
  std::vector<DrawnSurface::Range> ranges = {};
  std::vector<float> positions = {};  // of a displaced model: those in graphics memory

  std::uint32_t materialOf(std::uint32_t triangle) const {
    const auto none = static_cast<std::uint32_t>(materials.materials().size()) - 1;
    const std::vector<std::uint32_t>& of = model->attributes.materialOf;
    if (of.empty()) return none;
    const std::uint32_t m = of[model->faceOf[triangle]];
    return m == MeshAttributes::kNone ? none : m;
  }

  void upload() {
    const auto front = cut.triangles();
    const MultiTriangulation& mt = model->mt;
    std::vector<std::uint32_t> begin(materials.materials().size() + 1, 0);
    for (const std::uint32_t t : front) ++begin[materialOf(t) + 1];
    for (std::size_t m = 1; m < begin.size(); ++m) begin[m] += begin[m - 1];
    ranges.clear();
    for (std::uint32_t m = 0; m + 1 < begin.size(); ++m)
      if (begin[m + 1] > begin[m]) ranges.push_back({m, begin[m], begin[m + 1] - begin[m]});
    std::vector<std::array<std::uint32_t, 3>> corners(front.size());
    std::vector<float> worst(front.size());
    for (const std::uint32_t t : front) {
      const std::uint32_t at = begin[materialOf(t)]++;
      corners[at] = model->hasWedges() ? model->wedgesOf[t] : mt.corners(TriangleId(t));
      worst[at] = static_cast<float>(mt.error(TriangleId(t)));
    }
    indices = makeBuffer(std::span<const std::array<std::uint32_t, 3>>(corners));
    errors = makeBuffer(std::span<const float>(worst));
    isUploaded = true;
  }

  /// Draws the front where it is within what the criterion allows now.
  void displace(const BoundedCriterion& criterion) {
    const MultiTriangulation& mt = model->mt;
    const Cut front = cut.front();
    const std::vector<Vec3> places =
        displacedPlaces(mt, model->displacement, front, promisedErrors(mt, front, &criterion));
    if (positions.empty()) positions = drawnPositions(*model, upright);
    for (std::size_t t = 0; t < front.ids.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        // A drawn vertex is a wedge where there are wedges; triangles that share one write the same place.
        const std::uint32_t v = front.triangles[t][i];
        const std::size_t drawn = model->hasWedges() ? model->wedgesOf[front.ids[t]][i] : front.vertices[v];
        const Vec3 p = upright.fromFile(places[v]);
        positions[3 * drawn] = float(p.x);
        positions[3 * drawn + 1] = float(p.y);
        positions[3 * drawn + 2] = float(p.z);
      }
    surface.positions = makeBuffer(std::span<const float>(positions));
  }
};

Result<SurfaceDrawable> SurfaceDrawable::create(const SurfaceModel& model,
                                                std::shared_ptr<const SurfaceSubject> subject) {
  ARETE_TRY(SurfacePainter painter, SurfacePainter::create());
  const ZUpFrame upright = subject->upright();
  return SurfaceDrawable(std::make_unique<State>(State{.model = &model,
                                                       .subject = std::move(subject),
                                                       .upright = upright,
                                                       .cut = IncrementalCut(model.mt),
                                                       .surface = uploadSurface(model, upright),
                                                       .materials = MaterialsOnGpu::load(model),
                                                       .painter = std::move(painter)}));
}

SurfaceDrawable::SurfaceDrawable(std::unique_ptr<State> state) : state_(std::move(state)) {}
SurfaceDrawable::SurfaceDrawable(SurfaceDrawable&&) noexcept = default;
SurfaceDrawable& SurfaceDrawable::operator=(SurfaceDrawable&&) noexcept = default;
SurfaceDrawable::~SurfaceDrawable() = default;

Result<FrameFigures> SurfaceDrawable::cut(const Camera& camera, const ViewSettings& settings,
                                          const RunContext& context) {
  State& s = *state_;
  ARETE_CHECK(s.subject->check(settings));
  ARETE_TRY(const View view, s.subject->viewOf(camera));
  const Stopwatch watch;
  const MultiTriangulation& mt = s.model->mt;
  const ViewError criterion({.view = s.upright.turnedBack(view), .pixels = settings.pixels}, mt.metric());
  IncrementalOptions options;
  if (settings.maxTriangles > 0) options.maxTriangles = settings.maxTriangles;
  ARETE_TRY(const IncrementalCut::Update update, s.cut.update(criterion, options, context));
  FrameFigures figures;
  figures.triangles = figures.asked = static_cast<std::uint32_t>(s.cut.triangles().size());
  figures.isComplete = update.isComplete;
  figures.pixels = settings.pixels;
  // A budget may end the cut early: the figure is then the worst error that is drawn.
  if (!update.isComplete)
    figures.pixels = std::max(settings.pixels, worstSeverity(mt, criterion, s.cut.front()));
  s.pixels = figures.pixels;
  if (!s.isUploaded || !s.cut.lastSteps().empty()) s.upload();
  if (!s.model->displacement.isEmpty()) s.displace(criterion);
  figures.cutMilliseconds = watch.milliseconds();
  return figures;
}

Result<FrameView> SurfaceDrawable::frameOf(const Camera& camera, const ViewSettings&) const {
  FrameView frame;
  ARETE_TRY(frame.view, state_->subject->viewOf(camera));
  frame.pixels = state_->pixels;
  // A surface has no usual unit, so the near plane follows its size.
  frame.drawnNear = kNearestPlane * state_->subject->box().diagonal();
  return frame;
}

Status SurfaceDrawable::draw(const Camera& camera, const ViewSettings& settings, std::span<const Layer>) {
  State& s = *state_;
  ARETE_TRY(const FrameView frame, frameOf(camera, settings));
  glBeginQuery(GL_ANY_SAMPLES_PASSED, s.anySample);
  s.painter.draw(s.surface, s.materials, {s.indices, s.errors, s.ranges}, frame, settings.look);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  return {};
}

void SurfaceDrawable::drawBackground(const ViewSettings&) {
  state_->painter.drawBackground();
}

bool SurfaceDrawable::isShown() const {
  GLuint any = 0;
  glGetQueryObjectuiv(state_->anySample, GL_QUERY_RESULT, &any);
  return any != 0;
}

Warnings SurfaceDrawable::warnings() const {
  return state_->materials.warnings();
}
const SurfaceSubject& SurfaceDrawable::subject() const {
  return *state_->subject;
}

}  // namespace arete
