// SPDX-License-Identifier: GPL-3.0-or-later
//
// From one lattice line to the next: the samples of the line are classified against the terrain before it,
// then the terrain between the two lines is added (WedgeTerrain). Three kinds of evidence, each visible,
// hidden or undecided, are combined in one place, combine():
//
//     skyline   the target's v against bounds of the skyline in its direction
//     gaps      whether the line is over places without terrain, and what these count as
//     tips      whether the line may meet the terrain in a single point
//
// An undecided sample takes an engine's answer for its line. Most samples are lower than the lowest skyline
// of their bin: one comparison hides them.
#include "terrain/viewshed/wedge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace arete {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

/// A field whose ranges are narrower by a part: distances by that part of them, directions of a circle.
ViewshedField shrunk(ViewshedField field, double by) {
  field.leastMetres *= 1 + by;
  field.greatestMetres *= 1 - by;
  if (field.azimuthSpan < 360) {
    field.fromAzimuth += 360 * by;
    field.azimuthSpan -= 720 * by;
  }
  return field;
}

}  // namespace

ViewshedWedgeSweep::ViewshedWedgeSweep(const ImagePlane& image, const ViewshedWedge& wedge, Viewshed& result)
    : image_(image),
      task_(image.task()),
      wedge_(wedge),
      result_(result),
      terrain_(image, wedge),
      wantsValue_(task_.options.value != ViewshedValue::none) {
  const ViewshedField& field = task_.options.field;
  hasField_ = field.leastMetres > 0 || field.greatestMetres < kInfinite || field.azimuthSpan < 360 ||
              field.lowest > -90 || field.highest < 90;
}

Status ViewshedWedgeSweep::run(const RunContext& context) {
  // A wedge that has left the raster does not come back to it. The first lines are swept in any case.
  constexpr double kFirstLines = 4;
  const double observerX = terrain_.observer().x;
  const int start = static_cast<int>(std::floor(observerX)) + 1;
  for (int x = start; x <= terrain_.grid().xGreatest(); ++x) {
    if (context.cancelled()) return {};
    terrain_.draw(x);
    if (terrain_.far().count == 0 && x - observerX > kFirstLines) return {};
    if (isBeyondField(terrain_.far().x)) return {};
    ARETE_CHECK(classifyLine(x));
    terrain_.add(x, x == start);
  }
  return {};
}

/// Whether all of the wedge from x on is farther away than the field reaches.
bool ViewshedWedgeSweep::isBeyondField(double x) const {
  const double greatest = task_.options.field.greatestMetres;
  if (greatest == kInfinite) return false;
  const Vec2 xStep = image_.xStep(wedge_.sector), yStep = image_.yStep(wedge_.sector);
  const double yy = yStep.x * yStep.x + yStep.y * yStep.y, xy = xStep.x * yStep.x + xStep.y * yStep.y;
  const double turn = terrain_.turn();
  const double u = std::clamp(-xy / yy, wedge_.first - turn, wedge_.last + turn);
  const double nearest = x * std::hypot(xStep.x + u * yStep.x, xStep.y + u * yStep.y);
  // The steps of a map differ from the plan's, by its turn; 1e-6 is rounding.
  return nearest > greatest * (1 + 1e-6 + 2 * turn);
}

/// Classifies the samples of the sweep line that belong to the wedge.
Status ViewshedWedgeSweep::classifyLine(int x) {
  const ImageLine& line = terrain_.far();
  const int end = line.from + line.count;
  if (image_.isMapped()) {
    for (int y = line.from; y < end; ++y) {
      const double u = line.u[line.at(y)];
      if (u < wedge_.first || (u == wedge_.first && !wedge_.ownsFirst)) continue;
      if (u > wedge_.last || (u == wedge_.last && !wedge_.ownsLast)) continue;
      ARETE_CHECK(classify(x, y));
    }
    return {};
  }
  // Sectors and wedges that meet at a sample must agree on its owner, so it is decided by x and y, not
  // sheared.
  const double last = wedge_.last * line.x, first = wedge_.first * line.x, observerY = terrain_.observer().y;
  const auto isBefore = [&](double at) { return wedge_.ownsFirst ? at < first : at <= first; };
  const auto isWithin = [&](double at) { return wedge_.ownsLast ? at <= last : at < last; };
  int y = line.from;
  while (y < end && isBefore(y - observerY)) ++y;
  for (; y < end && isWithin(y - observerY); ++y) ARETE_CHECK(classify(x, y));
  return {};
}

Status ViewshedWedgeSweep::classify(int x, int y) {
  const ImageLine& line = terrain_.far();
  const std::size_t i = line.at(y), at = terrain_.grid().index(x, y);
  if (std::isnan(line.z[i])) return {};
  if (!(line.x > 1)) return askEngine(at, x, y);
  const double target = image_.target(line, i, task_.options.targetHeight), u = line.u[i];
  if (hasField_) {
    const Verdict field = fieldVerdict(line, i, target);
    if (field == Verdict::hidden) return {};  // stays ViewshedCell::outside
    if (field == Verdict::undecided) return askEngine(at, x, y);
  }
  // Hidden by terrain up to the line before: nothing beside the sample or behind that terrain matters.
  const int bin = line.bin[i];
  const auto isHiddenBy = [&](double v) { return !wantsValue_ && target < v && !terrain_.isAtTip(bin, u); };
  if (isHiddenBy(terrain_.low(bin))) {
    result_.cells[at] = ViewshedCell::hidden;
    return {};
  }
  ViewshedHorizon::Bounds skyline = terrain_.skyline(u);
  if (isHiddenBy(skyline.lower)) {
    result_.cells[at] = ViewshedCell::hidden;
    return {};
  }
  if (terrain_.isBesideGap(x, y)) return askEngine(at, x, y);
  terrain_.raiseByPending(y, wantsValue_ ? -kInfinite : target, skyline);
  Evidence evidence{skylineVerdict(target, skyline), Verdict::visible, Verdict::visible};
  if (evidence.skyline == Verdict::visible || wantsValue_) {
    const ViewshedNearGaps::Crossing gap = terrain_.gapsTowards(u);
    // Mapped, the terrain beside a gap may be beside the line.
    if (image_.isMapped() && gap.isPossible && evidence.skyline == Verdict::visible)
      evidence.skyline = Verdict::undecided;
    evidence.gaps = gapVerdict(gap, evidence.skyline);
  }
  evidence.tips = tipVerdict(bin, u, evidence.skyline);
  const std::optional<ViewshedCell> cell = combine(evidence);
  if (!cell) return askEngine(at, x, y);
  if (wantsValue_) {
    const std::optional<float> value = valueOf(line, i, evidence, skyline);
    if (!value) return askEngine(at, x, y);
    result_.values[at] = *value;
  }
  result_.cells[at] = *cell;
  return {};
}

/// `hidden` if the sample is outside of the field of view.
ViewshedWedgeSweep::Verdict ViewshedWedgeSweep::fieldVerdict(const ImageLine& line, std::size_t i,
                                                             double target) const {
  // Parts of distances and of the circle; degrees of elevation. Far above what rounding, or the map, does.
  const double part = image_.isMapped() ? 1e-5 : 1e-10, degrees = image_.isMapped() ? 1e-3 : 1e-9;
  const ViewshedField& field = task_.options.field;
  const Vec2 ground = image_.ground(wedge_.sector, line, i);
  const double metres = std::hypot(ground.x, ground.y);
  const double azimuth = kDegreesPerRadian * std::atan2(ground.x, ground.y);
  if (!isInField(shrunk(field, -part), metres, azimuth)) return Verdict::hidden;
  if (!isInField(shrunk(field, part), metres, azimuth)) return Verdict::undecided;
  if (field.lowest == -90 && field.highest == 90) return Verdict::visible;
  const double away = image_.isMapped() ? line.away[i] : line.x;
  const double elevation = kDegreesPerRadian * std::atan(target * away * image_.unit() / metres);
  if (elevation < field.lowest - degrees || elevation > field.highest + degrees) return Verdict::hidden;
  return elevation < field.lowest + degrees || elevation > field.highest - degrees ? Verdict::undecided
                                                                                   : Verdict::visible;
}

ViewshedWedgeSweep::Verdict ViewshedWedgeSweep::skylineVerdict(double target,
                                                               const ViewshedHorizon::Bounds& skyline) {
  return target < skyline.lower    ? Verdict::hidden
         : target >= skyline.upper ? Verdict::visible
                                   : Verdict::undecided;
}

/// `hidden` if NODATA is in the way for sure and counts.
ViewshedWedgeSweep::Verdict ViewshedWedgeSweep::gapVerdict(const ViewshedNearGaps::Crossing& gap,
                                                           Verdict skyline) const {
  const ViewshedOptions& options = task_.options;
  if (!gap.isPossible || options.nodata == NodataSight::clear) return Verdict::visible;
  if (gap.isCertain) return Verdict::hidden;
  // Where NODATA leaves things unknown, it changes neither a hidden cell nor a horizon.
  const bool matters = options.nodata == NodataSight::blocked || skyline == Verdict::visible ||
                       options.value == ViewshedValue::leastHeight;
  return matters ? Verdict::undecided : Verdict::visible;
}

/// Never `hidden`: whether a single point of terrain is in the way is for an engine to say. It does not
/// matter for what is seen over the skyline, tips included.
ViewshedWedgeSweep::Verdict ViewshedWedgeSweep::tipVerdict(int bin, double u, Verdict skyline) const {
  const bool matters = wantsValue_ || skyline != Verdict::visible;
  return matters && terrain_.isAtTip(bin, u) ? Verdict::undecided : Verdict::visible;
}

/// The cell that the evidence gives; nothing where it is undecided.
std::optional<ViewshedCell> ViewshedWedgeSweep::combine(const Evidence& evidence) const {
  if (evidence.skyline == Verdict::undecided || evidence.gaps == Verdict::undecided ||
      evidence.tips == Verdict::undecided)
    return std::nullopt;
  if (evidence.gaps == Verdict::hidden && task_.options.nodata == NodataSight::blocked)
    return ViewshedCell::hidden;
  if (evidence.skyline == Verdict::hidden) return ViewshedCell::hidden;
  return evidence.gaps == Verdict::hidden ? ViewshedCell::unknown : ViewshedCell::seen;
}

/// The value of a sample whose cell is decided (ViewshedValue); nothing where it takes an engine's answer.
std::optional<float> ViewshedWedgeSweep::valueOf(const ImageLine& line, std::size_t i,
                                                 const Evidence& evidence,
                                                 const ViewshedHorizon::Bounds& skyline) const {
  const ViewshedOptions& options = task_.options;
  const bool wantsHeight = options.value == ViewshedValue::leastHeight;
  if (evidence.gaps == Verdict::hidden) {
    if (options.nodata == NodataSight::blocked) return std::numeric_limits<float>::infinity();
    if (wantsHeight) return std::numeric_limits<float>::quiet_NaN();
  }
  const double ground = image_.target(line, i, 0);
  if (!wantsHeight) {
    const Vec2 place = image_.ground(wedge_.sector, line, i);
    return static_cast<float>(std::max(skyline.upper, ground) * line.x * image_.unit() /
                              std::hypot(place.x, place.y));
  }
  switch (skylineVerdict(ground, skyline)) {
    case Verdict::visible:
      return 0.0f;
    case Verdict::hidden:
      return static_cast<float>((skyline.upper - ground) * line.x);
    default:
      return std::nullopt;
  }
}

/// The engine's answer for the line to one sample.
Status ViewshedWedgeSweep::askEngine(std::size_t at, int x, int y) {
  const int a = wedge_.sector.line(x), b = wedge_.sector.line(y);
  const Vec2 plan = wedge_.sector.isAlongRows ? Vec2{double(a), double(b)} : Vec2{double(b), double(a)};
  ARETE_TRY(const auto answer, task_.exact.at(plan, task_.grid.row(0)[at]));
  result_.cells[at] = answer.cell;
  if (wantsValue_) result_.values[at] = answer.value;
  rays_ += answer.cell != ViewshedCell::outside;
  return {};
}

}  // namespace arete
