// SPDX-License-Identifier: GPL-3.0-or-later
//
// From one lattice line of x to the next: first its samples are asked about, then the terrain between the two
// lines is added (viewshed_wedge_terrain.cpp). What stands lower than the skyline's lowest place around is
// done with by one comparison: that is most samples.
#include "terrain/viewshed/wedge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arete {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// Wedges overlap by this much, in u.
constexpr double kPad = 1e-6;
constexpr double kDegrees = 180 / std::numbers::pi;

std::uint32_t binsOf(const ViewshedWedge& wedge, double farthest) {
  constexpr double kBinsPerSample = 0.5;
  return static_cast<std::uint32_t>(
             std::ceil((wedge.last - wedge.first) * std::max(0.0, farthest) * kBinsPerSample)) +
         1;
}

int greatestX(const ViewshedSector& s, const SightGrid& grid) {
  return s.sign > 0 ? static_cast<int>(s.isAlongRows ? grid.columns() : grid.rows()) - 1 : 0;
}

}  // namespace

ViewshedWedgeSweep::ViewshedWedgeSweep(const ImagePlane& picture, const ViewshedWedge& wedge,
                                       Viewshed& result)
    : picture_(picture),
      task_(picture.task()),
      wedge_(wedge),
      result_(result),
      xGreatest_(greatestX(wedge.sector, task_.grid)),
      observer_(picture.observer(wedge.sector)),
      shear_(wedge.first >= 0.5 && !picture.isFan() ? 1 : 0),
      turn_(picture.turn()),
      first_(wedge.first - shear_ - kPad),
      last_(wedge.last - shear_ + kPad),
      horizon_(first_, last_, binsOf(wedge, xGreatest_ - observer_.x)),
      doubtful_(first_, last_, picture.isFan() ? static_cast<std::uint32_t>(horizon_.binCount()) : 1) {
  const ViewshedSector& s = wedge.sector;
  const int columns = static_cast<int>(task_.grid.columns()), rows = static_cast<int>(task_.grid.rows());
  const int xCount = s.isAlongRows ? columns : rows, yCount = s.isAlongRows ? rows : columns;
  xLeast_ = xGreatest_ - xCount + 1;
  yGreatest_ = s.sign > 0 ? yCount - 1 : 0;
  yLeast_ = yGreatest_ - yCount + 1;
  const ViewshedField& field = task_.options.field;
  hasField_ = field.leastMetres > 0 || field.greatestMetres < kInfinite || field.azimuthSpan < 360 ||
              field.lowest > -90 || field.highest < 90;
  wantsValue_ = task_.options.value != ViewshedValue::none;
  wantsGaps_ = picture.isFan() || task_.options.nodata != NodataSight::clear;
}

std::size_t ViewshedWedgeSweep::index(int x, int y) const {
  const ViewshedSector& s = wedge_.sector;
  const auto column = static_cast<std::size_t>(s.line(s.isAlongRows ? x : y)),
             row = static_cast<std::size_t>(s.line(s.isAlongRows ? y : x));
  return row * task_.grid.columns() + column;
}

double ViewshedWedgeSweep::height(int x, int y) const {
  return y < yLeast_ || y > yGreatest_ || x < xLeast_ || x > xGreatest_ ? kNone
                                                                        : task_.grid.row(0)[index(x, y)];
}

/// The samples of a lattice line that may matter in the wedge, with those of the lines beside it.
void ViewshedWedgeSweep::take(int x, PictureLine& line) const {
  constexpr int kMargin = 3;
  const double away = x - observer_.x;
  const double first = observer_.y + (wedge_.first - turn_) * away,
               last = observer_.y + (wedge_.last + turn_) * away;
  const int low = std::max(yLeast_, static_cast<int>(std::floor(std::max(first, -2e9))) - kMargin);
  const int high = std::min(yGreatest_, static_cast<int>(std::ceil(std::min(last, 2e9))) + kMargin);
  picture_.take(wedge_.sector, x, low, high, shear_, line);
  const auto count = static_cast<std::size_t>(line.count);
  for (std::size_t i = 0; i < count; ++i) line.bin[i] = horizon_.bin(line.u[i]);
}

Status ViewshedWedgeSweep::exactly(std::size_t at, int x, int y) {
  const int a = wedge_.sector.line(x), b = wedge_.sector.line(y);
  const Vec2 plan = wedge_.sector.isAlongRows ? Vec2{double(a), double(b)} : Vec2{double(b), double(a)};
  const auto answer = task_.exact.at(plan, task_.grid.row(0)[at]);
  if (!answer) return tl::unexpected(answer.error());
  result_.cells[at] = answer->cell;
  if (wantsValue_) result_.values[at] = answer->value;
  rays_ += answer->cell != ViewshedCell::outside;
  return {};
}

/// Whether all of the wedge from x on is farther away than is looked.
bool ViewshedWedgeSweep::isBeyond(double x) const {
  const double greatest = task_.options.field.greatestMetres;
  if (greatest == kInfinite) return false;
  const Vec2 xStep = picture_.xStep(wedge_.sector), yStep = picture_.yStep(wedge_.sector);
  const double yy = yStep.x * yStep.x + yStep.y * yStep.y, xy = xStep.x * yStep.x + xStep.y * yStep.y;
  const double u = std::clamp(-xy / yy, wedge_.first - turn_, wedge_.last + turn_);
  const double nearest = x * std::hypot(xStep.x + u * yStep.x, xStep.y + u * yStep.y);
  // A fan's steps are not quite the plan's.
  return nearest > greatest * (1 + 1e-6 + 2 * turn_);
}

Status ViewshedWedgeSweep::run(const RunContext& context) {
  const int start = static_cast<int>(std::floor(observer_.x)) + 1;
  for (int x = start; x <= xGreatest_; ++x) {
    if (context.cancelled()) return {};
    std::swap(near_, far_);
    take(x, far_);
    if (far_.count == 0 && x - observer_.x > 4) return {};
    if (isBeyond(far_.x)) return {};
    if (Status status = ask(x); !status) return status;
    if (!picture_.isFan() && (x == start || near_.hasGaps || far_.hasGaps)) addTips(x);
    if (x == start) {
      addFirst(x);
    } else {
      addEdges(x);
    }
  }
  return {};
}

Status ViewshedWedgeSweep::ask(int x) {
  const int end = far_.from + far_.count;
  if (picture_.isFan()) {
    for (int y = far_.from; y < end; ++y) {
      const double u = far_.u[far_.at(y)];
      if (u < wedge_.first || (u == wedge_.first && !wedge_.ownsFirst)) continue;
      if (u > wedge_.last || (u == wedge_.last && !wedge_.ownsLast)) continue;
      if (Status status = askOne(x, y); !status) return status;
    }
    return {};
  }
  // Whose a sample is, the sectors and wedges that meet there must agree on: by x and y, not sheared.
  const double last = wedge_.last * far_.x, first = wedge_.first * far_.x;
  const auto before = [&](double at) { return wedge_.ownsFirst ? at < first : at <= first; };
  const auto within = [&](double at) { return wedge_.ownsLast ? at <= last : at < last; };
  int y = far_.from;
  while (y < end && before(y - observer_.y)) ++y;
  for (; y < end && within(y - observer_.y); ++y)
    if (Status status = askOne(x, y); !status) return status;
  return {};
}

/// Whether the sample at `i` is in the field of view.
ViewshedWedgeSweep::Side ViewshedWedgeSweep::fieldAt(const PictureLine& line, std::size_t i,
                                                     double target) const {
  const ViewshedField& field = task_.options.field;
  const Vec2 ground = picture_.ground(wedge_.sector, line, i);
  const double metres = std::hypot(ground.x, ground.y);
  const double azimuth = kDegrees * std::atan2(ground.x, ground.y);
  const auto shrunk = [&](double by) {
    ViewshedField f = field;
    f.leastMetres *= 1 + by;
    f.greatestMetres *= 1 - by;
    if (f.azimuthSpan < 360) {
      f.fromAzimuth += 360 * by;
      f.azimuthSpan -= 720 * by;
    }
    return f;
  };
  const double doubt = picture_.isFan() ? 1e-5 : 1e-10;
  if (!isInField(shrunk(-doubt), metres, azimuth)) return Side::outside;
  if (!isInField(shrunk(doubt), metres, azimuth)) return Side::doubtful;
  if (field.lowest == -90 && field.highest == 90) return Side::inside;
  const double away = picture_.isFan() ? line.away[i] : line.x;
  const double elevation = kDegrees * std::atan(target * away * picture_.unit() / metres);
  const double angle = picture_.isFan() ? 1e-3 : 1e-9;
  if (elevation < field.lowest - angle || elevation > field.highest + angle) return Side::outside;
  return elevation < field.lowest + angle || elevation > field.highest - angle ? Side::doubtful
                                                                               : Side::inside;
}

/// Whether there may be no terrain in a cell that leads to the sample from the observer.
bool ViewshedWedgeSweep::isBesideGap(int x, int y) const {
  const double yy = y - observer_.y, turned = turn_ * far_.x + (picture_.isFan() ? 1e-2 : 0);
  return (yy >= -turned && std::isnan(height(x, y - 1) + height(x - 1, y - 1) + height(x - 1, y))) ||
         (yy <= turned && std::isnan(height(x, y + 1) + height(x - 1, y + 1) + height(x - 1, y)));
}

/// The edges between the lines x - 1 and x that are before a sample at x and do not lead to it, as far as
/// they stand higher than `target`: the skyline does not know them yet.
ViewshedHorizon::Bounds ViewshedWedgeSweep::linkBefore(int y, double target) const {
  const double u = far_.u[far_.at(y)];
  ViewshedHorizon::Bounds bounds{-kInfinite, -kInfinite};
  const auto look = [&](int yNear, int yFar) {
    if (!near_.has(yNear) || !far_.has(yFar)) return;
    const std::size_t n = near_.at(yNear), f = far_.at(yFar);
    const double v0 = near_.v[n], v1 = far_.v[f];
    if (!(std::max(v0, v1) > target)) return;
    const double u0 = near_.u[n], u1 = far_.u[f];
    if (!(std::min(u0, u1) <= u && u <= std::max(u0, u1)) || u0 == u1) return;
    const double v = v0 + (v1 - v0) * ((u - u0) / (u1 - u0));
    bounds.upper = std::max(bounds.upper, v);
    if (!picture_.isFan() || !(near_.isBesideGap[n] || far_.isBesideGap[f]))
      bounds.lower = std::max(bounds.lower, v - slack(near_, n, far_, f));
  };
  if (y < observer_.y || picture_.isFan()) look(y, y + 1);
  if (picture_.isFan()) look(y - 1, y - 1);
  return bounds;
}

/// Of the terrain before the line that is asked about.
ViewshedNearGaps::Crossing ViewshedWedgeSweep::gapsTowards(double u) const {
  ViewshedNearGaps::Crossing gap{gaps_.isPossible(u), gaps_.isCertain(u)};
  if (nearGaps_.isEmpty() || gap.isCertain) return gap;
  const ViewshedNearGaps::Crossing near = nearGaps_.towards(u + shear_);
  return {gap.isPossible || near.isPossible, near.isCertain};
}

Status ViewshedWedgeSweep::askOne(int x, int y) {
  const std::size_t i = far_.at(y), at = index(x, y);
  if (std::isnan(far_.z[i])) return {};
  if (!(far_.x > 1)) return exactly(at, x, y);
  const ViewshedOptions& options = task_.options;
  const double target = picture_.target(far_, i, options.targetHeight), u = far_.u[i];
  if (hasField_) {
    const Side side = fieldAt(far_, i, target);
    if (side == Side::outside) return {};
    if (side == Side::doubtful) return exactly(at, x, y);
  }
  const int bin = far_.bin[i];
  if (!wantsValue_ && target < horizon_.low(bin) && !isAtTip(bin, u)) {
    result_.cells[at] = ViewshedCell::hidden;
    return {};
  }
  ViewshedHorizon::Bounds skyline = horizon_.at(u);
  // What is before it hides it whatever is beside it.
  if (!wantsValue_ && target < skyline.lower && !isAtTip(bin, u)) {
    result_.cells[at] = ViewshedCell::hidden;
    return {};
  }
  const bool isAtBorder = picture_.isFan() && (y == yLeast_ || y == yGreatest_);
  if ((far_.hasGaps || near_.hasGaps || isAtBorder) && isBesideGap(x, y)) return exactly(at, x, y);
  const ViewshedHorizon::Bounds before = linkBefore(y, wantsValue_ ? -kInfinite : target);
  skyline.upper = std::max(skyline.upper, before.upper);
  skyline.lower = std::max(skyline.lower, before.lower);
  if (picture_.isFan()) skyline.upper = std::max(skyline.upper, doubtful_.at(u).upper);
  bool isHidden = target < skyline.lower, isSeen = target >= skyline.upper;
  const bool mayMeetGap = wantsGaps_ && (isSeen || wantsValue_);
  const ViewshedNearGaps::Crossing gap = mayMeetGap ? gapsTowards(u) : ViewshedNearGaps::Crossing{};
  // Over a fan the terrain beside a gap may be beside the line instead.
  if (picture_.isFan() && gap.isPossible) isSeen = false;
  if (!isSeen && !isHidden) return exactly(at, x, y);
  if ((wantsValue_ || !isSeen) && isAtTip(bin, u)) return exactly(at, x, y);
  const bool wantsHeight = options.value == ViewshedValue::leastHeight;
  bool isUnknown = false, isUnknownHeight = false, isCut = false;
  if (gap.isPossible && options.nodata != NodataSight::clear) {
    if (options.nodata == NodataSight::unknown) {
      if ((isSeen || wantsHeight) && !gap.isCertain) return exactly(at, x, y);
      isUnknown = isSeen;
      isUnknownHeight = wantsHeight;
    } else {
      if (!gap.isCertain) return exactly(at, x, y);
      isCut = isHidden = true;
    }
  }
  result_.cells[at] = isUnknown  ? ViewshedCell::unknown
                      : isHidden ? ViewshedCell::hidden
                                 : ViewshedCell::seen;
  if (!wantsValue_) return {};
  const double ground = picture_.target(far_, i, 0);
  if (isCut) {
    result_.values[at] = std::numeric_limits<float>::infinity();
  } else if (isUnknownHeight) {
    result_.values[at] = std::numeric_limits<float>::quiet_NaN();
  } else if (wantsHeight) {
    if (ground < skyline.upper && !(ground < skyline.lower)) return exactly(at, x, y);
    result_.values[at] =
        ground >= skyline.upper ? 0.0f : static_cast<float>((skyline.upper - ground) * far_.x);
  } else {
    const Vec2 place = picture_.ground(wedge_.sector, far_, i);
    result_.values[at] = static_cast<float>(std::max(skyline.upper, ground) * far_.x * picture_.unit() /
                                            std::hypot(place.x, place.y));
  }
  return {};
}

}  // namespace arete
