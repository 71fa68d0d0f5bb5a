// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cut that changed is written to the device as a whole: its triangles sorted by material, each as three
// drawn vertices.
#include "viewer/surface/surface_view.h"

#include <algorithm>
#include <utility>

#include "engine/base/stopwatch.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "engine/follow/incremental_cut.h"
#include "surface/displacement/displaced_places.h"

namespace arete {
namespace {

/// Part of the diagonal: what is nearer to the eye is not drawn.
constexpr double kNearestPlane = 1e-4;

}  // namespace

struct SurfaceView::State {
  const SurfaceModel* model = nullptr;
  ZUpFrame upright;
  ZUpShape shape;
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

Result<SurfaceView> SurfaceView::create(const SurfaceModel& model, const ZUpFrame& upright) {
  ARETE_TRY(SurfacePainter painter, SurfacePainter::create());
  return SurfaceView(std::make_unique<State>(State{.model = &model,
                                                   .upright = upright,
                                                   .shape = uprightShape(model, upright),
                                                   .cut = IncrementalCut(model.mt),
                                                   .surface = uploadSurface(model, upright),
                                                   .materials = MaterialsOnGpu::load(model),
                                                   .painter = std::move(painter)}));
}

SurfaceView::SurfaceView(std::unique_ptr<State> state) : state_(std::move(state)) {}
SurfaceView::SurfaceView(SurfaceView&&) noexcept = default;
SurfaceView& SurfaceView::operator=(SurfaceView&&) noexcept = default;
SurfaceView::~SurfaceView() = default;

Result<SurfaceFigures> SurfaceView::cut(const Camera& camera, const SurfaceViewSettings& settings,
                                        const RunContext& context) {
  State& s = *state_;
  ARETE_TRY(const View view, uprightView(camera));
  const Stopwatch watch;
  const MultiTriangulation& mt = s.model->mt;
  const ViewError criterion({.view = s.upright.turnedBack(view), .pixels = settings.pixels}, mt.metric());
  IncrementalOptions options;
  if (settings.maxTriangles > 0) options.maxTriangles = settings.maxTriangles;
  ARETE_TRY(const IncrementalCut::Update update, s.cut.update(criterion, options, context));
  SurfaceFigures figures;
  figures.triangles = static_cast<std::uint32_t>(s.cut.triangles().size());
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

Status SurfaceView::draw(const Camera& camera, const SurfaceViewSettings& settings) {
  State& s = *state_;
  ARETE_TRY(const View view, uprightView(camera));
  FrameView frame;
  frame.view = view;
  frame.pixels = s.pixels;
  // A surface has no usual unit, so the near plane follows its size.
  frame.drawnNear = kNearestPlane * s.shape.box.diagonal();
  glBeginQuery(GL_ANY_SAMPLES_PASSED, s.anySample);
  s.painter.draw(s.surface, s.materials, {s.indices, s.errors, s.ranges}, frame, settings.look);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  s.painter.drawBackground();
  return {};
}

bool SurfaceView::showsSurface() const {
  GLuint any = 0;
  glGetQueryObjectuiv(state_->anySample, GL_QUERY_RESULT, &any);
  return any != 0;
}

const Warnings& SurfaceView::warnings() const {
  return state_->materials.warnings();
}
const ZUpFrame& SurfaceView::upright() const {
  return state_->upright;
}
const ZUpShape& SurfaceView::shape() const {
  return state_->shape;
}

}  // namespace arete
