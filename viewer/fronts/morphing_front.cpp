// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle rests when none of its corners is on the move and it lets no light through. Resting triangles
// keep their places in one buffer, so few are sent from frame to frame. All others, with all of their
// corners, are listed anew whenever something moved.
#include "viewer/fronts/morphing_front.h"

#include <algorithm>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/stopwatch.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "engine/parallel/with_threads.h"
#include "surface/displacement/displaced_places.h"

namespace arete {
namespace {

/// Unchanged slots between two that changed are sent with them rather than in a call of their own.
constexpr std::uint32_t kGapThatIsSent = 16;

}  // namespace

MorphingFront::MorphingFront(const SurfaceModel& model, const ZUpFrame& upright,
                             std::shared_ptr<const DrawnVertices> drawn, std::vector<bool> isBlended)
    : model_(&model),
      upright_(upright),
      drawn_(std::move(drawn)),
      isBlended_(std::move(isBlended)),
      cut_(model.mt),
      moved_(model.mt),
      ownVertices_(model, upright, drawn_),
      slots_(static_cast<std::uint32_t>(isBlended_.size() + 1)) {}

std::uint32_t MorphingFront::materialOf(std::uint32_t triangle) const {
  const auto none = static_cast<std::uint32_t>(isBlended_.size() - 1);
  const std::vector<std::uint32_t>& of = model_->attributes.materialOf;
  if (of.empty()) return none;
  const std::uint32_t m = of[model_->faceOf[triangle]];
  return m == MeshAttributes::kNone ? none : m;
}

std::array<std::uint32_t, 3> MorphingFront::drawnCorners(std::uint32_t triangle) const {
  return model_->hasWedges() ? model_->wedgesOf[triangle] : model_->mt.corners(TriangleId(triangle));
}

Status MorphingFront::update(const Asked& asked, const RunContext& context) try {
  auto figures = follow(asked, context);
  const std::lock_guard lock(mutex_);
  error_.reset();
  if (figures) return {};
  error_ = figures.error();
  return tl::unexpected(figures.error());
} catch (...) {
  return caughtFailure();
}

Result<FrameFigures> MorphingFront::follow(const Asked& asked, const RunContext& context) {
  ARETE_CHECK(asked.view.validate());
  const Stopwatch watch;
  const MultiTriangulation& mt = model_->mt;
  const bool isChosen = asked.level.has_value(), isDisplaced = !model_->displacement.isEmpty();
  MorphCamera camera(
      {.view = asked.view, .pixels = asked.pixels, .moves = asked.moves && !isChosen && !isDisplaced},
      mt.metric());
  const ViewError seen({.view = asked.view, .pixels = camera.tolerance().cut}, mt.metric());
  const UniformError chosen(isChosen ? asked.level->error : 0);
  const BoundedCriterion& criterion = isChosen ? static_cast<const BoundedCriterion&>(chosen) : seen;
  IncrementalOptions options;
  if (const auto most = isChosen ? asked.level->triangles : asked.maxTriangles.value_or(0); most > 0)
    options.maxTriangles = most;
  if (asked.milliseconds > 0)
    options.deadline = Deadline::in(std::chrono::duration<double, std::milli>(asked.milliseconds));
  ARETE_TRY(const IncrementalCut::Update updated, cut_.update(criterion, options, context));
  return withThreads(context, [&] {
    const GeomorphedSurface::Update moved =
        moved_.update(camera, cut_, !updated.isComplete && options.maxTriangles.has_value());
    FrameFigures figures;
    figures.triangles = figures.asked = static_cast<std::uint32_t>(cut_.triangles().size());
    figures.isComplete = isChosen || updated.isComplete;
    figures.moving = moved.moving;
    figures.jumpPixels = moved.jumpPixels;
    figures.pixels = asked.pixels;
    // A budget may end the cut early, and a level is chosen: the figure is then the worst error that is
    // drawn.
    if (isChosen) {
      figures.pixels = worstSeverity(mt, seen, cut_.front());
    } else if (!updated.isComplete) {
      const double offset = camera.tolerance().offset * moved.cutPixels / camera.tolerance().cut;
      figures.pixels = std::max(
          asked.pixels,
          camera.pixelsOf(std::max(worstSeverity(mt, seen, cut_.front()), moved.cutPixels) + offset));
    }
    const bool isNew = isFirst_ || !cut_.lastSteps().empty() || !moved_.changes().empty() || isDisplaced;
    if (isNew) {
      if (isDisplaced)
        displace(criterion);
      else
        ownVertices_.begin(moved_);
    }
    const bool isOwnNew = isNew && listOwn();
    figures.cutMilliseconds = watch.milliseconds();
    publish(isNew, isOwnNew, figures);
    isFirst_ = false;
    return Result<FrameFigures>(figures);
  });
}

/// Draws the front where it is within what the criterion allows now.
void MorphingFront::displace(const BoundedCriterion& criterion) {
  const MultiTriangulation& mt = model_->mt;
  const Cut front = cut_.front();
  const std::vector<Vec3> places =
      displacedPlaces(mt, model_->displacement, front, promisedErrors(mt, front, &criterion));
  if (positions_.empty()) positions_ = drawn_->positions;
  for (std::size_t t = 0; t < front.ids.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      // A drawn vertex is a wedge where there are wedges; triangles that share one write the same place.
      const std::uint32_t v = front.triangles[t][i];
      const std::size_t drawn = model_->hasWedges() ? model_->wedgesOf[front.ids[t]][i] : front.vertices[v];
      const Vec3 p = upright_.fromFile(places[v]);
      positions_[3 * drawn] = float(p.x);
      positions_[3 * drawn + 1] = float(p.y);
      positions_[3 * drawn + 2] = float(p.z);
    }
  ownVertices_.begin(positions_);
}

/// Parts the front into resting triangles and others, of the object's own vertices. @return whether there are
/// or were any of the latter.
bool MorphingFront::listOwn() {
  const MultiTriangulation& mt = model_->mt;
  const auto front = cut_.triangles();
  const bool hadOwn = !own_.corners.empty();
  const auto materials = static_cast<std::uint32_t>(isBlended_.size());
  resting_.resize(front.size());
  struct Listed {
    std::uint32_t material, triangle;
    std::array<std::uint32_t, 3> vertices;
  };
  std::vector<Listed> listed;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const std::uint32_t t = front[i], material = materialOf(t);
    const auto vertices = mt.corners(TriangleId(t));
    const bool rests = !isBlended_[material] && std::ranges::none_of(vertices, [&](std::uint32_t v) {
      return ownVertices_.isMoving(v);
    });
    resting_[i] = rests ? t : MultiTriangulation::kNone;
    if (!rests) listed.push_back({material, t, vertices});
  }
  slots_.update(resting_,
                [&](std::uint32_t t) { return t == MultiTriangulation::kNone ? materials : materialOf(t); });
  std::ranges::stable_sort(listed, {}, &Listed::material);
  own_ = {};
  for (const Listed& l : listed) {
    const auto drawn = drawnCorners(l.triangle);
    const auto slot = static_cast<std::uint32_t>(own_.corners.size());
    if (own_.ranges.empty() || own_.ranges.back().material != l.material)
      own_.ranges.push_back({l.material, slot, 0});
    ++own_.ranges.back().count;
    FrontChanges::Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = ownVertices_.slotOf(drawn[i], l.vertices[i]);
    own_.corners.push_back(corners);
    own_.errors.push_back(static_cast<float>(mt.error(TriangleId(l.triangle))));
    own_.triangles.push_back(l.triangle);
    if (!isBlended_[l.material]) continue;
    Vec3 middle;
    for (const std::uint32_t c : corners) {
      const auto& p = ownVertices_.list()[c].position;
      middle = middle + Vec3{p[0], p[1], p[2]} / 3;
    }
    own_.blended.add({corners, l.material, middle});
  }
  own_.vertices = ownVertices_.list();
  return hadOwn || !listed.empty();
}

void MorphingFront::publish(bool isNew, bool isOwnNew, const FrameFigures& figures) {
  const MultiTriangulation& mt = model_->mt;
  const std::lock_guard lock(mutex_);
  const auto add = [&](std::uint32_t first, std::uint32_t count) {
    if (count == 0) return;
    pending_.runs.push_back({first, count});
    for (std::uint32_t slot = first; slot < first + count; ++slot) {
      const std::uint32_t t = slots_.triangles()[slot];
      const bool isDrawn = t != MultiTriangulation::kNone;
      pending_.corners.push_back(isDrawn ? drawnCorners(t) : FrontChanges::Corners{});
      pending_.errors.push_back(isDrawn ? static_cast<float>(mt.error(TriangleId(t))) : 0);
      pending_.triangles.push_back(isDrawn ? t : 0);
    }
  };
  figures_ = figures;
  if (!isNew) return;
  if (slots_.isPacked()) {
    const auto size = static_cast<std::uint32_t>(slots_.triangles().size());
    pending_.newSize = size;
    pending_.runs.clear();
    pending_.corners.clear();
    pending_.errors.clear();
    pending_.triangles.clear();
    add(0, size);
  }
  const std::span<const std::uint32_t> changed = slots_.changed();
  for (std::size_t i = 0; i < changed.size();) {
    std::size_t end = i + 1;
    while (end < changed.size() && changed[end] - changed[end - 1] <= kGapThatIsSent) ++end;
    add(changed[i], changed[end - 1] - changed[i] + 1);
    i = end;
  }
  std::vector<FrontChanges::Range> ranges;
  for (std::uint32_t m = 0; m < isBlended_.size(); ++m)
    if (const MaterialSlots::Range& range = slots_.ranges()[m]; range.count > 0)
      ranges.push_back({m, range.first, range.count});
  pending_.ranges = std::move(ranges);
  if (isOwnNew) pending_.own = own_;
  if (!positions_.empty()) pending_.positions = positions_;
}

Result<MorphingFront::Taken> MorphingFront::take() {
  const std::lock_guard lock(mutex_);
  if (error_) return tl::unexpected(*error_);
  return Taken{std::exchange(pending_, {}), figures_};
}

}  // namespace arete
