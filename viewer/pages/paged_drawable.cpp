// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thread that reads has the pages to itself while it makes a step, and the part that comes out is made
// ready there for the picture that asked for it; the thread that draws touches pages only when it waits for
// its picture, and then no step is under way. A step is handed over behind a lock. The
// next one is posted when the last was taken in and was not the end of its demand, or the camera has moved.
#include "viewer/pages/paged_drawable.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <utility>

#include "io/query/pages/view_demand.h"
#include "viewer/fronts/cut_worker.h"

namespace arete {
namespace {

/// How many pictures ahead the camera is expected to go on as it moves.
constexpr double kPicturesAhead = 12;
/// What a step of the thread reads at most, so that a picture of what is there so far comes soon.
constexpr std::uint64_t kBytesOfAStep = std::uint64_t{1} << 24, kFarBytesOfAStep = std::uint64_t{1} << 21;
/// A frame's tolerance is halved so often where triangles are missing though all that was expected is there.
constexpr int kHalvings = 4;

bool isSame(const View& a, const View& b) {
  const auto same = [](const Vec3& p, const Vec3& q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  return same(a.eye, b.eye) && same(a.forward, b.forward) && same(a.up, b.up) &&
         a.verticalFieldOfView == b.verticalFieldOfView && a.widthPixels == b.widthPixels &&
         a.heightPixels == b.heightPixels && a.parallelHeight == b.parallelHeight;
}

/// Whether both ask for one picture, whatever is expected after it.
bool isSame(const ViewDemand& a, const ViewDemand& b) {
  return isSame(a.view, b.view) && a.pixels == b.pixels && a.stretch == b.stretch && a.error == b.error;
}

}  // namespace

template <class Model>
struct PagedDrawable<Model>::State {
  State(ResidentPages<Model> resident, std::shared_ptr<PagedSubject> seen, Shown drawable)
      : pages(std::move(resident)),
        subject(std::move(seen)),
        shown(std::move(drawable)),
        part(pages.outline()) {}
  ~State() {
    ends = true;
    worker.stop(this);
  }

  /// The demand of a picture, with what is expected after it. Errors: as Kind::demandOf().
  Result<PictureDemand> demandOf(const Camera& camera, const ViewSettings& settings) const {
    ARETE_TRY(PictureDemand picture, Kind::demandOf(shown, camera, settings));
    if (last) picture.demand.expected = viewAhead(last->view, picture.demand.view, kPicturesAhead);
    if (const auto& level = settings.level)
      picture.demand.error = level->triangles > 0 ? pages.file().errorBeyond(level->triangles) : level->error;
    return picture;
  }
  void add(const typename ResidentPages<Model>::Step& step) {
    figures.pages += step.pages;
    figures.bytes += step.bytes;
    figures.missingPages = step.missingPages;
    figures.missingBytes = step.missingBytes;
    figures.residentBytes = step.residentBytes;
    coarseness = step.coarseness;
  }

  ResidentPages<Model> pages;
  std::shared_ptr<PagedSubject> subject;
  Shown shown;
  std::shared_ptr<const Model> part;  // that is drawn
  std::optional<ViewDemand> last;     // of the picture before
  PageFigures figures;
  double coarseness = std::numeric_limits<double>::infinity();
  bool isDone = false;  // the last step was the end of its demand

  std::mutex mutex;
  std::optional<Result<Done>> done;  // by the worker
  bool isBusy = false;               // a step is posted and was not taken in
  std::atomic<bool> ends{false};
  CutWorker worker;  // the first to go
};

template <class Model>
PagedDrawable<Model>::PagedDrawable(ResidentPages<Model> pages, std::shared_ptr<PagedSubject> subject,
                                    Shown shown)
    : state_(std::make_unique<State>(std::move(pages), std::move(subject), std::move(shown))) {}
template <class Model>
PagedDrawable<Model>::PagedDrawable(PagedDrawable&&) noexcept = default;
template <class Model>
PagedDrawable<Model>& PagedDrawable<Model>::operator=(PagedDrawable&&) noexcept = default;
template <class Model>
PagedDrawable<Model>::~PagedDrawable() = default;

template <class Model>
auto PagedDrawable<Model>::stepOf(State& s, const PageDemand& demand, std::uint64_t mostBytes,
                                  const PictureDemand& picture, const RunContext& context) -> Result<Done> {
  Done done;
  ARETE_TRY(done.step, s.pages.step(demand, mostBytes, context));
  if (done.step.isNew) {
    ARETE_TRY(done.ready, Kind::ready(s.shown, done.step.part, picture, context));
  }
  return done;
}

template <class Model>
void PagedDrawable<Model>::take(Done done, const RunContext& context) {
  State& s = *state_;
  s.add(done.step);
  s.isDone = done.step.isDone;
  if (!done.ready) return;
  s.part = done.step.part;
  Kind::show(std::move(*done.ready), *s.subject, s.shown, context);
}

template <class Model>
Status PagedDrawable<Model>::advance(const Camera& camera, const ViewSettings& settings,
                                     const RunContext& context) {
  State& s = *state_;
  ARETE_CHECK(s.subject->check(settings));
  ARETE_TRY(const PictureDemand picture, s.demandOf(camera, settings));
  s.figures = {.missingPages = s.figures.missingPages,
               .missingBytes = s.figures.missingBytes,
               .residentBytes = s.figures.residentBytes};
  const ViewDemand& demand = picture.demand;
  const bool isNew = !s.last || !isSame(*s.last, demand);
  s.last = demand;
  if (isNew) s.isDone = false;
  if (settings.waits) {
    s.worker.stop(&s);
    s.isBusy = false;
    if (auto left = std::exchange(s.done, std::nullopt)) {
      ARETE_TRY(Done done, std::move(*left));
      take(std::move(done), context);
    }
    const std::uint64_t most =
        settings.pageBytes > 0 ? settings.pageBytes : std::numeric_limits<std::uint64_t>::max();
    ViewDemand asked = demand;
    for (int i = 0; i <= kHalvings; ++i) {
      // Nothing is read ahead for a picture that takes what it needs.
      PageDemand pages = arete::demandOf(asked, *s.pages.outline());
      if (settings.pageBytes == 0) pages.ahead = {};
      ARETE_TRY(Done done, stepOf(s, pages, most, picture, context));
      take(std::move(done), context);
      if (s.coarseness > 1 || settings.pageBytes > 0) break;
      ARETE_TRY(const DrawnOfPart drawn, missingInView(s.part->mt, demand, context));
      if (drawn.missing == 0) break;
      asked.pixels /= 2;
      if (asked.error) *asked.error /= 2;
    }
    return {};
  }
  std::optional<Result<Done>> done;
  {
    const std::lock_guard lock(s.mutex);
    std::swap(done, s.done);
    if (done) s.isBusy = false;
  }
  if (done) {
    ARETE_TRY(Done taken, std::move(*done));
    take(std::move(taken), context);
    if (isNew) s.isDone = false;
  }
  if (s.isBusy || s.isDone) return {};
  s.isBusy = true;
  s.worker.post(&s, [&s, picture] {
    const RunContext background{.progress = {}, .cancel = &s.ends};
    const bool isFar = s.pages.file().container().owner()->isFar();
    auto step = stepOf(s, arete::demandOf(picture.demand, *s.pages.outline()),
                       isFar ? kFarBytesOfAStep : kBytesOfAStep, picture, background);
    const std::lock_guard lock(s.mutex);
    s.done = std::move(step);
  });
  return {};
}

template <class Model>
Result<FrameFigures> PagedDrawable<Model>::cut(const Camera& camera, const ViewSettings& settings,
                                               const RunContext& context) {
  State& s = *state_;
  ARETE_CHECK(s.subject->check(settings));
  ARETE_TRY(FrameFigures figures, s.shown.cut(camera, settings, context));
  if (settings.waits) {
    ARETE_TRY(const PictureDemand picture, s.demandOf(camera, settings));
    ARETE_TRY(const DrawnOfPart drawn, missingInView(s.part->mt, picture.demand, context));
    s.figures.missingTriangles = drawn.missing;
    if (drawn.missing > 0) figures.pixels = std::max(figures.pixels, drawn.pixels + picture.morphPixels);
  } else {
    figures.pixels *= s.coarseness;
  }
  figures.pages = s.figures;
  return figures;
}

template <class Model>
const Subject& PagedDrawable<Model>::subject() const {
  return *state_->subject;
}
template <class Model>
Result<FrameView> PagedDrawable<Model>::frameOf(const Camera& camera, const ViewSettings& settings) const {
  return state_->shown.frameOf(camera, settings);
}
template <class Model>
Status PagedDrawable<Model>::draw(const Camera& camera, const ViewSettings& settings,
                                  std::span<const Layer> layers) {
  ARETE_CHECK(state_->subject->check(settings));
  return state_->shown.draw(camera, settings, layers);
}
template <class Model>
Status PagedDrawable<Model>::drawBlended(const Camera& camera, const ViewSettings& settings) {
  return state_->shown.drawBlended(camera, settings);
}
template <class Model>
std::optional<Turn> PagedDrawable<Model>::turn() const {
  return state_->shown.turn();
}
template <class Model>
void PagedDrawable<Model>::setTurn(const Turn& turn) {
  state_->shown.setTurn(turn);
}
template <class Model>
void PagedDrawable<Model>::drawBackground(const ViewSettings& settings) {
  state_->shown.drawBackground(settings);
}
template <class Model>
bool PagedDrawable<Model>::isShown() const {
  return state_->shown.isShown();
}
template <class Model>
std::optional<double> PagedDrawable<Model>::drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                                       const ViewSettings& settings) const {
  return state_->shown.drawnError(pick, camera, pixel, settings);
}
template <class Model>
bool PagedDrawable<Model>::keepsBudget(const ViewSettings& settings) const {
  return state_->shown.keepsBudget(settings);
}
template <class Model>
std::uint32_t PagedDrawable<Model>::capacity() const {
  return state_->shown.capacity();
}
template <class Model>
std::string PagedDrawable<Model>::deviceRefusal() const {
  return state_->shown.deviceRefusal();
}
template <class Model>
Warnings PagedDrawable<Model>::warnings() const {
  return state_->shown.warnings();
}
template <class Model>
auto PagedDrawable<Model>::shown() const -> const Shown& {
  return state_->shown;
}
template <class Model>
const Model& PagedDrawable<Model>::part() const {
  return *state_->part;
}

template class PagedDrawable<TerrainModel>;
template class PagedDrawable<SurfaceModel>;

Result<PagedTerrain> drawPaged(TerrainPages pages, std::shared_ptr<PagedTerrainSubject> subject,
                               TerrainDrawable::Options options, const RunContext& context) {
  options.heights.isOfDrawn = true;
  ARETE_TRY(TerrainDrawable shown, TerrainDrawable::create(subject->outline(), options, context));
  return PagedTerrain(std::move(pages), std::move(subject), std::move(shown));
}

Result<PagedSurface> drawPaged(SurfacePages pages, std::shared_ptr<PagedSurfaceSubject> subject) {
  ARETE_TRY(SurfaceDrawable shown, SurfaceDrawable::create(subject->model(), subject));
  return PagedSurface(std::move(pages), std::move(subject), std::move(shown));
}

}  // namespace arete
