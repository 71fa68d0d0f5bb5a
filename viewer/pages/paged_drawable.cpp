// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thread that reads has the pages to itself while it makes a step; the thread that draws touches them
// only when it waits for its picture, and then no step is under way. A step is handed over behind a lock. The
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

}  // namespace

struct PagedDrawable::State {
  State(ResidentPages resident, std::shared_ptr<PagedSubject> seen, TerrainDrawable drawable)
      : pages(std::move(resident)), subject(std::move(seen)), shown(std::move(drawable)) {}
  ~State() {
    ends = true;
    worker.stop(this);
  }

  /// The demand of a picture, with what is expected after it.
  ViewDemand demandOf(const FrameView& frame) {
    ViewDemand demand{.view = frame.view, .pixels = frame.pixels, .stretch = frame.stretch};
    if (last) demand.expected = viewAhead(last->view, frame.view, kPicturesAhead);
    return demand;
  }
  void add(const ResidentPages::Step& step) {
    figures.pages += step.pages;
    figures.bytes += step.bytes;
    figures.missingPages = step.missingPages;
    figures.missingBytes = step.missingBytes;
    figures.residentBytes = step.residentBytes;
    coarseness = step.coarseness;
  }

  ResidentPages pages;
  std::shared_ptr<PagedSubject> subject;
  TerrainDrawable shown;
  std::optional<ViewDemand> last;  // of the picture before
  PageFigures figures;
  double coarseness = std::numeric_limits<double>::infinity();
  bool isDone = false;  // the last step was the end of its demand

  std::mutex mutex;
  std::optional<Result<ResidentPages::Step>> done;  // by the worker
  bool isBusy = false;                              // a step is posted and was not taken in
  std::atomic<bool> ends{false};
  CutWorker worker;  // the first to go
};

PagedDrawable::PagedDrawable(std::unique_ptr<State> state) : state_(std::move(state)) {}
PagedDrawable::PagedDrawable(PagedDrawable&&) noexcept = default;
PagedDrawable& PagedDrawable::operator=(PagedDrawable&&) noexcept = default;
PagedDrawable::~PagedDrawable() = default;

Result<PagedDrawable> PagedDrawable::create(ResidentPages pages, std::shared_ptr<PagedSubject> subject,
                                            TerrainDrawable::Options options, const RunContext& context) {
  options.heights.isOfDrawn = true;
  ARETE_TRY(TerrainDrawable shown, TerrainDrawable::create(subject->outline(), options, context));
  return PagedDrawable(std::make_unique<State>(std::move(pages), std::move(subject), std::move(shown)));
}

Status PagedDrawable::take(const ResidentPages::Step& step, const RunContext& context) {
  State& s = *state_;
  s.add(step);
  s.isDone = step.isDone;
  if (!step.isNew) return {};
  auto part = subjectOf(step.part);
  s.subject->show(part);
  s.shown.replace(std::move(part), context);
  return {};
}

Status PagedDrawable::advance(const Camera& camera, const ViewSettings& settings, const RunContext& context) {
  State& s = *state_;
  ARETE_CHECK(s.subject->check(settings));
  ARETE_TRY(const FrameView frame, frameOf(camera, settings));
  s.figures = {.missingPages = s.figures.missingPages,
               .missingBytes = s.figures.missingBytes,
               .residentBytes = s.figures.residentBytes};
  const ViewDemand demand = s.demandOf(frame);
  const bool isNew = !s.last || !isSame(s.last->view, demand.view) || s.last->pixels != demand.pixels ||
                     s.last->stretch != demand.stretch;
  s.last = demand;
  if (isNew) s.isDone = false;
  if (settings.waits) {
    s.worker.stop(&s);
    s.isBusy = false;
    if (auto left = std::exchange(s.done, std::nullopt)) {
      ARETE_TRY(const ResidentPages::Step step, std::move(*left));
      ARETE_CHECK(take(step, context));
    }
    const std::uint64_t most =
        settings.pageBytes > 0 ? settings.pageBytes : std::numeric_limits<std::uint64_t>::max();
    ViewDemand asked = demand;
    for (int i = 0; i <= kHalvings; ++i, asked.pixels /= 2) {
      // Nothing is read ahead for a picture that takes what it needs.
      PageDemand pages = arete::demandOf(asked, *s.pages.outline());
      if (settings.pageBytes == 0) pages.ahead = {};
      ARETE_TRY(const ResidentPages::Step step, s.pages.step(pages, most, context));
      ARETE_CHECK(take(step, context));
      if (step.coarseness > 1 || settings.pageBytes > 0) break;
      ARETE_TRY(const DrawnOfPart drawn, missingInView(*step.part, demand, context));
      if (drawn.missing == 0) break;
    }
    return {};
  }
  std::optional<Result<ResidentPages::Step>> done;
  {
    const std::lock_guard lock(s.mutex);
    std::swap(done, s.done);
    if (done) s.isBusy = false;
  }
  if (done) {
    ARETE_TRY(const ResidentPages::Step step, std::move(*done));
    ARETE_CHECK(take(step, context));
    if (isNew) s.isDone = false;
  }
  if (s.isBusy || s.isDone) return {};
  s.isBusy = true;
  s.worker.post(&s, [&s, demand] {
    const RunContext background{.progress = {}, .cancel = &s.ends};
    const bool isFar = s.pages.file().container().owner()->isFar();
    auto step = s.pages.step(arete::demandOf(demand, *s.pages.outline()),
                             isFar ? kFarBytesOfAStep : kBytesOfAStep, background);
    const std::lock_guard lock(s.mutex);
    s.done = std::move(step);
  });
  return {};
}

Result<FrameFigures> PagedDrawable::cut(const Camera& camera, const ViewSettings& settings,
                                        const RunContext& context) {
  State& s = *state_;
  ARETE_CHECK(s.subject->check(settings));
  ARETE_TRY(FrameFigures figures, s.shown.cut(camera, settings, context));
  if (settings.waits) {
    ARETE_TRY(const FrameView frame, frameOf(camera, settings));
    ARETE_TRY(const DrawnOfPart drawn,
              missingInView(s.shown.model(),
                            {.view = frame.view, .pixels = frame.pixels, .stretch = frame.stretch}, context));
    s.figures.missingTriangles = drawn.missing;
    if (drawn.missing > 0) figures.pixels = std::max(figures.pixels, drawn.pixels + frame.morphPixels);
  } else {
    figures.pixels *= s.coarseness;
  }
  figures.pages = s.figures;
  return figures;
}

const Subject& PagedDrawable::subject() const {
  return *state_->subject;
}
Result<FrameView> PagedDrawable::frameOf(const Camera& camera, const ViewSettings& settings) const {
  return state_->shown.frameOf(camera, settings);
}
Status PagedDrawable::draw(const Camera& camera, const ViewSettings& settings,
                           std::span<const Layer> layers) {
  ARETE_CHECK(state_->subject->check(settings));
  return state_->shown.draw(camera, settings, layers);
}
void PagedDrawable::drawBackground(const ViewSettings& settings) {
  state_->shown.drawBackground(settings);
}
bool PagedDrawable::isShown() const {
  return state_->shown.isShown();
}
std::optional<double> PagedDrawable::drawnError(const Pick& pick, const Camera& camera, Vec2 pixel,
                                                const ViewSettings& settings) const {
  return state_->shown.drawnError(pick, camera, pixel, settings);
}
bool PagedDrawable::keepsBudget(const ViewSettings& settings) const {
  return state_->shown.keepsBudget(settings);
}
std::uint32_t PagedDrawable::capacity() const {
  return state_->shown.capacity();
}
std::string PagedDrawable::deviceRefusal() const {
  return state_->shown.deviceRefusal();
}
Warnings PagedDrawable::warnings() const {
  return state_->shown.warnings();
}
const TerrainDrawable& PagedDrawable::shown() const {
  return state_->shown;
}

}  // namespace arete
