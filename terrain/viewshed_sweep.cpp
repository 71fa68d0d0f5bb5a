// SPDX-License-Identifier: GPL-3.0-or-later
//
// Seen from the observer, through a picture plane, an edge of the terrain is a straight segment and so is the
// skyline of all terrain up to some distance: the upper envelope of its edges. A sample is seen if and only
// if it stands no lower in the picture than that skyline (De Floriani and Magillo 1994).
//
// The plan is cut into four sectors, in which one of the plan's axes leads away from the observer: that axis
// is x, the other y, u = y / x and v = (height - observer's) / x. The sweep goes outwards from one lattice
// line of x to the next (Franklin and Ray 1994). Between two of them, cells split by a diagonal have edges
// along x, diagonals, and edges along y on the farther line. First the samples of that line are asked about,
// then these edges are added. What stands lower than the skyline's lowest place around is done with by one
// comparison: that is most of the terrain.
//
// Sectors are cut into wedges that share nothing, one task each.
//
// Rounding. Edges that point at the observer have no width in the picture; near u = 0, where those along x
// do, u is exact to its last bit, and so it is for diagonals when y is sheared to y - x: u is then measured
// from the diagonal. A wedge is sheared where u >= 1/2. The axes of all sectors are turned such that
// diagonals lead from (0, 0) to (1, 1).
//
// What is decided here is outside of every doubt: the terrain that hides is at least two tolerances above
// the line, the terrain in front of what is seen is not above the line at all. The rest is decided by an
// engine's answer, cell by cell: what lies between, places less than a step away, what is beside NODATA.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/with_threads.h"
#include "terrain/viewshed_gaps.h"
#include "terrain/viewshed_horizon.h"
#include "terrain/viewshed_methods.h"

namespace arete {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// Wedges overlap by this much, in u.
constexpr double kPad = 1e-9;
/// Terrain this near to the observer (in steps) is left out where an edge comes so near.
constexpr double kNearest = 1e-6;
constexpr double kDegrees = 180 / std::numbers::pi;

/// The least and greatest height.
struct Heights {
  double least = kInfinite, greatest = -kInfinite;
};

Heights heightsOf(const SightGrid& grid) {
  Heights heights;
  for (std::uint32_t row = 0; row < grid.rows(); ++row) {
    const double* z = grid.row(row);
    for (std::uint32_t column = 0; column < grid.columns(); ++column) {
      heights.least = z[column] < heights.least ? z[column] : heights.least;
      heights.greatest = z[column] > heights.greatest ? z[column] : heights.greatest;
    }
  }
  return heights;
}

/// What is the same for all wedges.
struct Scene {
  const ViewshedTask& task;
  SightEarth::PlaneSteps steps;
  double unit, h0;
  double nearTolerance, farTolerance;  ///< of the shortest and the longest line, in the DEM's vertical unit
  double rounding;                     ///< what rounding makes of heights, at most
};

/// One sector: which of the plan's axes lead where.
struct Sector {
  bool isAlongRows;  ///< x leads along columns numbers (east, west), else along rows
  int sign;          ///< 1: with the numbers; -1: against them, y too

  int line(int x) const { return sign * x; }
};

struct Wedge {
  Sector sector;
  double first, last;  ///< of u, not sheared
  bool ownsLast;       ///< samples at u = last are its own
  bool ownsFirst;
};

class WedgeSweep {
 public:
  WedgeSweep(const Scene& scene, const Wedge& wedge, Viewshed& result);
  /// Errors: those of the earth. Stops when told to.
  Status run(const RunContext& context);
  std::uint64_t rays() const { return rays_; }

 private:
  /// A lattice line's samples as the picture shows them; by y's lattice number less `from`.
  struct Line {
    int from = 0, count = 0;
    double x = 0;  ///< distance from the observer in x
    bool hasGaps = false;
    std::vector<double> z, u, v;
    std::vector<int> bin;
    bool has(int y) const { return y >= from && y < from + count; }
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(origin_ + std::int64_t{x} * xStride_ + std::int64_t{y} * yStride_);
  }
  double height(int x, int y) const {
    return y < yLeast_ || y > yGreatest_ || x < xLeast_ || x > xGreatest_ ? kNone : heights_[index(x, y)];
  }
  double yOf(int y) const { return y - yObserver_; }
  double uOf(int x, int y) const { return ((y - shear_ * x) - off_) / (x - xObserver_); }

  void take(int x, Line& line) const;
  Status ask(int x);
  Status askOne(int x, int y);
  void addEdges(int x);
  void addCell(int x, int y);
  void addPartialCell(int x, int y);
  void addFirst(int x);
  void addNear(Vec2 a, double za, Vec2 b, double zb);
  bool hasTriangle(int x, int y) const;
  Status exactly(std::size_t at, int x, int y);
  bool isBeyond(double x) const;

  const Scene& scene_;
  const ViewshedTask& task_;
  const Wedge& wedge_;
  Viewshed& result_;
  const double* heights_;
  std::int64_t origin_ = 0, xStride_, yStride_;
  int xLeast_, xGreatest_, yLeast_, yGreatest_;
  double xObserver_, yObserver_, off_;
  int shear_;
  double first_, last_;  ///< of u, sheared, padded
  Vec2 xStep_, yStep_;   ///< metres
  double lift_;          ///< added to the terrain's heights
  double slack_;         ///< of heights; v's is less by x
  bool hasField_, hasElevations_, wantsValue_;
  ViewshedHorizon horizon_;
  ViewshedGaps gaps_;
  Line near_, far_;  ///< the lattice lines before and at x
  std::uint64_t rays_ = 0;
};

double farthest(const Wedge& wedge, const SightGrid& grid, Vec2 observer) {
  const Sector& s = wedge.sector;
  const double at = s.isAlongRows ? observer.x : observer.y,
               count = s.isAlongRows ? grid.columns() : grid.rows();
  return s.sign > 0 ? count - 1 - at : at;
}

std::uint32_t binsOf(const Wedge& wedge, const SightGrid& grid, Vec2 observer) {
  constexpr double kBinsPerSample = 0.5;
  const double samples = (wedge.last - wedge.first) * std::max(0.0, farthest(wedge, grid, observer));
  return static_cast<std::uint32_t>(std::ceil(samples * kBinsPerSample)) + 1;
}

WedgeSweep::WedgeSweep(const Scene& scene, const Wedge& wedge, Viewshed& result)
    : scene_(scene),
      task_(scene.task),
      wedge_(wedge),
      result_(result),
      heights_(scene.task.grid.row(0)),
      shear_(wedge.first >= 0.5 ? 1 : 0),
      first_(wedge.first - shear_ - kPad),
      last_(wedge.last - shear_ + kPad),
      horizon_(first_, last_, binsOf(wedge, scene.task.grid, scene.task.observer.plan)) {
  const Sector& s = wedge.sector;
  const int columns = static_cast<int>(task_.grid.columns()), rows = static_cast<int>(task_.grid.rows());
  const int xCount = s.isAlongRows ? columns : rows, yCount = s.isAlongRows ? rows : columns;
  xStride_ = s.sign * (s.isAlongRows ? 1 : columns);
  yStride_ = s.sign * (s.isAlongRows ? columns : 1);
  xLeast_ = s.sign > 0 ? 0 : 1 - xCount;
  xGreatest_ = xLeast_ + xCount - 1;
  yLeast_ = s.sign > 0 ? 0 : 1 - yCount;
  yGreatest_ = yLeast_ + yCount - 1;
  const Vec2 o = task_.observer.plan;
  xObserver_ = s.sign * (s.isAlongRows ? o.x : o.y);
  yObserver_ = s.sign * (s.isAlongRows ? o.y : o.x);
  off_ = yObserver_ - shear_ * xObserver_;
  const auto& steps = scene.steps;
  const Vec2 x = s.isAlongRows ? steps.x : steps.y, y = s.isAlongRows ? steps.y : steps.x;
  xStep_ = {s.sign * x.x, s.sign * x.y};
  yStep_ = {s.sign * y.x, s.sign * y.y};
  lift_ = std::max(0.0, scene.rounding - scene.nearTolerance / 2);
  slack_ = 2 * scene.farTolerance + 2 * scene.rounding + lift_;
  const ViewshedField& field = task_.options.field;
  hasElevations_ = field.lowest > -90 || field.highest < 90;
  hasField_ =
      field.leastMetres > 0 || field.greatestMetres < kInfinite || field.azimuthSpan < 360 || hasElevations_;
  wantsValue_ = task_.options.value != ViewshedValue::none;
}

/// The samples of a lattice line that may matter in the wedge, with those of the lines beside it.
void WedgeSweep::take(int x, Line& line) const {
  constexpr int kMargin = 3;
  line.x = x - xObserver_;
  const double first = yObserver_ + wedge_.first * line.x, last = yObserver_ + wedge_.last * line.x;
  const int low = std::max(yLeast_, static_cast<int>(std::floor(std::max(first, -2e9))) - kMargin);
  const int high = std::min(yGreatest_, static_cast<int>(std::ceil(std::min(last, 2e9))) + kMargin);
  line.from = low;
  line.count = std::max(0, high - low + 1);
  const auto count = static_cast<std::size_t>(line.count);
  line.z.resize(count);
  line.u.resize(count);
  line.v.resize(count);
  line.bin.resize(count);
  const double* z = heights_ + static_cast<std::ptrdiff_t>(index(x, low));
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = z[static_cast<std::ptrdiff_t>(i) * yStride_];
    line.z[i] = at;
    sum += at;
  }
  const double h = scene_.h0 - lift_, per = 1 / line.x;
  const int s = low - shear_ * x;
  for (std::size_t i = 0; i < count; ++i) {
    line.u[i] = ((s + static_cast<int>(i)) - off_) / line.x;
    line.v[i] = (line.z[i] - h) * per;
  }
  for (std::size_t i = 0; i < count; ++i) line.bin[i] = horizon_.bin(line.u[i]);
  line.hasGaps = std::isnan(sum);
}

Status WedgeSweep::exactly(std::size_t at, int x, int y) {
  const int a = wedge_.sector.line(x), b = wedge_.sector.line(y);
  const Vec2 plan = wedge_.sector.isAlongRows ? Vec2{double(a), double(b)} : Vec2{double(b), double(a)};
  const auto answer = task_.exact.at(plan, heights_[at]);
  if (!answer) return tl::unexpected(answer.error());
  result_.cells[at] = answer->cell;
  if (wantsValue_) result_.values[at] = answer->value;
  rays_ += answer->cell != ViewshedCell::outside;
  return {};
}

/// Whether all of the wedge from x on is farther away than is looked.
bool WedgeSweep::isBeyond(double x) const {
  const double greatest = task_.options.field.greatestMetres;
  if (greatest == kInfinite) return false;
  const double yy = yStep_.x * yStep_.x + yStep_.y * yStep_.y, xy = xStep_.x * yStep_.x + xStep_.y * yStep_.y;
  const double u = std::clamp(-xy / yy, wedge_.first, wedge_.last);
  const double nearest = x * std::hypot(xStep_.x + u * yStep_.x, xStep_.y + u * yStep_.y);
  return nearest > greatest * (1 + 1e-6);
}

Status WedgeSweep::run(const RunContext& context) {
  int x = static_cast<int>(std::floor(xObserver_)) + 1;
  if (x > xGreatest_) return {};
  const int start = x;
  for (; x <= xGreatest_; ++x) {
    if (context.cancelled()) return {};
    std::swap(near_, far_);
    take(x, far_);
    if (far_.count == 0 && x - xObserver_ > 4) return {};
    if (isBeyond(far_.x)) return {};
    if (const Status status = ask(x); !status) return status;
    if (x == start) {
      addFirst(x);
    } else {
      addEdges(x);
    }
  }
  return {};
}

Status WedgeSweep::ask(int x) {
  // Whose a sample is, the sectors and wedges that meet there must agree on: by x and y, not sheared.
  const double last = wedge_.last * far_.x, first = wedge_.first * far_.x;
  int y = far_.from;
  const int end = far_.from + far_.count;
  const auto before = [&](int at) { return wedge_.ownsFirst ? yOf(at) < first : yOf(at) <= first; };
  const auto within = [&](int at) { return wedge_.ownsLast ? yOf(at) <= last : yOf(at) < last; };
  while (y < end && before(y)) ++y;
  for (; y < end && within(y); ++y)
    if (const Status status = askOne(x, y); !status) return status;
  return {};
}

Status WedgeSweep::askOne(int x, int y) {
  const auto i = static_cast<std::size_t>(y - far_.from);
  const std::size_t at = index(x, y);
  const double z = far_.z[i];
  if (std::isnan(z)) return {};
  if (!(far_.x > 1)) return exactly(at, x, y);
  const ViewshedOptions& options = task_.options;
  const double per = 1 / far_.x, target = (z + options.targetHeight - scene_.h0) * per;
  const double u = far_.u[i], yy = yOf(y);
  double metres = 0;
  if (hasField_ || wantsValue_)
    metres = std::hypot(far_.x * xStep_.x + yy * yStep_.x, far_.x * xStep_.y + yy * yStep_.y);
  if (hasField_) {
    const ViewshedField& field = options.field;
    const double azimuth =
        kDegrees * std::atan2(far_.x * xStep_.x + yy * yStep_.x, far_.x * xStep_.y + yy * yStep_.y);
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
    constexpr double kDoubt = 1e-10;
    if (!isInField(shrunk(-kDoubt), metres, azimuth)) return {};
    if (!isInField(shrunk(kDoubt), metres, azimuth)) return exactly(at, x, y);
    if (hasElevations_) {
      const double elevation = kDegrees * std::atan(target * far_.x * scene_.unit / metres);
      if (elevation < field.lowest - 1e-9 || elevation > field.highest + 1e-9) return {};
      if (elevation < field.lowest + 1e-9 || elevation > field.highest - 1e-9) return exactly(at, x, y);
    }
  }
  // The cells before it, which the skyline does not know yet.
  const std::size_t n = static_cast<std::size_t>(y - near_.from);
  double diagonal = -kInfinite;
  if (far_.hasGaps || near_.hasGaps) {
    const bool isBeside =
        (yy >= 0 && std::isnan(height(x, y - 1) + height(x - 1, y - 1) + height(x - 1, y))) ||
        (yy <= 0 && std::isnan(height(x, y + 1) + height(x - 1, y + 1) + height(x - 1, y)));
    if (isBeside) return exactly(at, x, y);
  }
  if (yy < 0 && far_.has(y + 1)) {
    const double u0 = near_.u[n], u1 = far_.u[i + 1], v0 = near_.v[n], v1 = far_.v[i + 1];
    if (std::max(v0, v1) > target || wantsValue_) diagonal = v0 + (v1 - v0) * ((u - u0) / (u1 - u0));
  }
  const int bin = far_.bin[i];
  bool isSeen = false, isHidden = false;
  ViewshedHorizon::Bounds skyline{};
  if (!wantsValue_ && target < horizon_.low(bin)) {
    isHidden = true;
  } else if (!wantsValue_ && target >= horizon_.high(bin) && target >= diagonal) {
    isSeen = true;
  } else {
    skyline = horizon_.at(u);
    if (diagonal > skyline.upper) skyline.upper = diagonal;
    skyline.lower = std::max(skyline.lower, diagonal - slack_ / near_.x);
    isHidden = target < skyline.lower;
    isSeen = target >= skyline.upper;
  }
  if (!isSeen && !isHidden) return exactly(at, x, y);
  bool isUnknown = false, isCut = false;
  if (!gaps_.isEmpty() && options.nodata != NodataSight::clear && gaps_.isPossible(u)) {
    const bool isCertain = gaps_.isCertain(u);
    if (options.nodata == NodataSight::unknown) {
      if (isSeen && !isCertain) return exactly(at, x, y);
      isUnknown = isSeen;
    } else {
      if ((isSeen || wantsValue_) && !isCertain) return exactly(at, x, y);
      isCut = isCertain;
      isHidden = true;
    }
  }
  result_.cells[at] = isUnknown  ? ViewshedCell::unknown
                      : isHidden ? ViewshedCell::hidden
                                 : ViewshedCell::seen;
  if (!wantsValue_) return {};
  const double ground = (z - scene_.h0) * per;
  if (options.value == ViewshedValue::leastHeight) {
    if (isCut) {
      result_.values[at] = std::numeric_limits<float>::infinity();
      return {};
    }
    if (ground < skyline.upper && !(ground < skyline.lower)) return exactly(at, x, y);
    result_.values[at] =
        ground >= skyline.upper ? 0.0f : static_cast<float>((skyline.upper - ground) * far_.x);
  } else {
    result_.values[at] =
        isCut ? std::numeric_limits<float>::infinity()
              : static_cast<float>(std::max(skyline.upper, ground) * far_.x * scene_.unit / metres);
  }
  return {};
}

void WedgeSweep::addEdges(int x) {
  const int from = std::max(near_.from, far_.from),
            to = std::min(near_.from + near_.count, far_.from + far_.count) - 1;
  if (near_.hasGaps || far_.hasGaps) {
    for (int y = from; y <= to; ++y) addPartialCell(x, y);
    return;
  }
  const double* u0 = near_.u.data() + (from - near_.from);
  const double* v0 = near_.v.data() + (from - near_.from);
  const double* u1 = far_.u.data() + (from - far_.from);
  const double* v1 = far_.v.data() + (from - far_.from);
  const int* bin0 = near_.bin.data() + (from - near_.from);
  const int* bin1 = far_.bin.data() + (from - far_.from);
  const double slack = slack_ / near_.x, farSlack = slack_ / far_.x;
  const int count = to - from;
  for (int i = 0; i < count; ++i) {
    const double highest = std::max(v0[i], std::max(v1[i], v1[i + 1]));
    if (highest <= horizon_.low(std::min(bin0[i], bin1[i]), std::max(bin0[i], bin1[i + 1]))) continue;
    horizon_.add(u1[i], v1[i], u1[i + 1], v1[i + 1], farSlack);
    horizon_.add(u0[i], v0[i], u1[i], v1[i], slack);
    horizon_.add(u0[i], v0[i], u1[i + 1], v1[i + 1], slack);
  }
  if (count >= 0) horizon_.add(u0[count], v0[count], u1[count], v1[count], slack);
}

/// A sample beside an edge: whether a triangle of the two and it is there is the same as whether it is.
bool WedgeSweep::hasTriangle(int x, int y) const {
  return !std::isnan(height(x, y));
}

/// The edges of the cell from (x - 1, y) to (x, y + 1) that it adds: its own diagonal, that along x at y,
/// that along y at x; if they are there.
void WedgeSweep::addPartialCell(int x, int y) {
  const double slack = slack_ / near_.x, farSlack = slack_ / far_.x;
  const auto n = static_cast<std::size_t>(y - near_.from), f = static_cast<std::size_t>(y - far_.from);
  const double z00 = near_.z[n], z10 = far_.z[f];
  if (!std::isnan(z00 + z10) && (hasTriangle(x, y - 1) || hasTriangle(x - 1, y - 1) ||
                                 hasTriangle(x, y + 1) || hasTriangle(x - 1, y + 1)))
    horizon_.add(near_.u[n], near_.v[n], far_.u[f], far_.v[f], slack);
  if (!near_.has(y + 1) || !far_.has(y + 1)) return;
  const double z01 = near_.z[n + 1], z11 = far_.z[f + 1];
  if (!std::isnan(z10 + z11) && (hasTriangle(x - 1, y) || hasTriangle(x - 1, y + 1) ||
                                 hasTriangle(x + 1, y) || hasTriangle(x + 1, y + 1)))
    horizon_.add(far_.u[f], far_.v[f], far_.u[f + 1], far_.v[f + 1], farSlack);
  const bool has00 = !std::isnan(z00), has01 = !std::isnan(z01), has10 = !std::isnan(z10),
             has11 = !std::isnan(z11);
  const int corners = has00 + has01 + has10 + has11;
  if (corners >= 3) {
    if (has00 && has11) {
      horizon_.add(near_.u[n], near_.v[n], far_.u[f + 1], far_.v[f + 1], slack);
    } else {
      horizon_.add(near_.u[n + 1], near_.v[n + 1], far_.u[f], far_.v[f], slack);
    }
  }
  if (corners == 4) return;
  double first = kInfinite, last = -kInfinite;
  const auto reach = [&](double u) {
    first = std::min(first, u);
    last = std::max(last, u);
  };
  // Of three corners, the gap is the triangle of the fourth and its neighbours.
  if (corners < 3 || !has00 || !has11) {
    reach(near_.u[n + 1]);
    reach(far_.u[f]);
  } else {
    reach(near_.u[n]);
    reach(far_.u[f + 1]);
  }
  if (corners < 3 || !has00) reach(near_.u[n]);
  if (corners < 3 || !has11) reach(far_.u[f + 1]);
  if (corners == 3 && !has01) reach(near_.u[n + 1]);
  if (corners == 3 && !has10) reach(far_.u[f]);
  gaps_.add(first, last);
}

/// The edges between the lattice line behind the observer, or below it, and the first before it.
void WedgeSweep::addFirst(int x) {
  const int low = static_cast<int>(std::floor(yObserver_)) - 3, high = low + 7;
  const auto plan = [&](int dx, int y) { return Vec2{x + dx - xObserver_, yOf(y)}; };
  for (int y = low; y <= high; ++y) {
    const double z0 = height(x - 1, y), z1 = height(x, y), z2 = height(x, y + 1);
    addNear(plan(-1, y), z0, plan(0, y), z1);
    addNear(plan(-1, y), z0, plan(0, y + 1), z2);
    addNear(plan(0, y), z1, plan(0, y + 1), z2);
  }
}

/// An edge that may lead behind the observer: the part of it that is in the wedge and not too near.
void WedgeSweep::addNear(Vec2 a, double za, Vec2 b, double zb) {
  if (std::isnan(za + zb)) return;
  double t0 = 0, t1 = 1;
  const auto keep = [&](double atA, double atB) {  // where it is positive
    if (atA >= 0 && atB >= 0) return;
    if (atA < 0 && atB < 0) {
      t0 = 2;
    } else if (atA < 0) {
      t0 = std::max(t0, atA / (atA - atB));
    } else {
      t1 = std::min(t1, atA / (atA - atB));
    }
  };
  // Twice as wide as the wedge needs: what is cut off here must not matter.
  constexpr double kWider = 1.0 / 64;
  keep(a.x - kNearest, b.x - kNearest);
  keep(a.y - (wedge_.first - kWider) * a.x, b.y - (wedge_.first - kWider) * b.x);
  keep((wedge_.last + kWider) * a.x - a.y, (wedge_.last + kWider) * b.x - b.y);
  if (!(t0 < t1)) return;
  const auto add = [&](double t, double& u, double& v) {
    const double x = t == 1 ? b.x : a.x + t * (b.x - a.x), y = t == 1 ? b.y : a.y + t * (b.y - a.y);
    const double z = t == 1 ? zb : za + t * (zb - za);
    u = (y - shear_ * x) / x;
    v = (z + lift_ - scene_.h0) / x;
    return x;
  };
  double u0, v0, u1, v1;
  const double x0 = add(t0, u0, v0), x1 = add(t1, u1, v1);
  if (std::fabs(u1 - u0) < 1e-12) return;  // it points at the observer
  horizon_.add(u0, v0, u1, v1, slack_ / std::min(x0, x1));
}

}  // namespace

std::optional<std::string> whyNotSweep(const ViewshedTask& task) {
  if (!task.earth.planeSteps()) return "tracks over this Earth are not straight in plan";
  const SightGrid& grid = task.grid;
  const Vec2 o = task.observer.plan;
  if (!(o.x >= 0 && o.y >= 0 && o.x <= grid.columns() - 1 && o.y <= grid.rows() - 1))
    return "the observer is outside of the DEM";
  // The sweep takes the terrain around the observer as whole.
  const int column = static_cast<int>(o.x), row = static_cast<int>(o.y);
  double greatest = 0;
  for (int r = row - 2; r <= row + 3; ++r)
    for (int c = column - 2; c <= column + 3; ++c) {
      if (c < 0 || r < 0 || c >= static_cast<int>(grid.columns()) || r >= static_cast<int>(grid.rows()))
        continue;
      const double z = grid.height(static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(r));
      if (std::isnan(z)) return "there is NODATA beside the observer";
      greatest = std::max(greatest, std::fabs(z - task.observer.height));
    }
  const double above = task.observer.height - grid.at(o), unit = task.model.georeference.verticalUnitMetres;
  if (above < -0.5e-6 / unit) return "the observer is below the ground";
  // An edge that all but meets the observer is left out where it is nearest.
  const auto isNear = [](double v) {
    const double off = std::fabs(v - std::round(v));
    return off > 0 && off < 2 * kNearest;
  };
  if ((isNear(o.x) || isNear(o.y) || isNear(o.x - o.y)) && above < 100 * kNearest * greatest)
    return "the observer is on the ground, all but on an edge";
  return std::nullopt;
}

Status viewshedSweep(const ViewshedTask& task, const RunContext& context, Viewshed& result) {
  const SightGrid& grid = task.grid;
  const Heights heights = heightsOf(grid);
  const double unit = task.model.georeference.verticalUnitMetres, h0 = task.observer.height;
  const auto steps = *task.earth.planeSteps();
  const double length =
      std::hypot(steps.x.x, steps.x.y) * grid.columns() + std::hypot(steps.y.x, steps.y.y) * grid.rows();
  const double range = std::max({heights.greatest, h0, task.options.targetHeight + heights.greatest}) -
                       std::min(heights.least, h0);
  // A coordinate in the picture is rounded by a few parts in 2^53; the steepest edges there are as many
  // times steeper than on the ground as samples lie before them.
  const double largest = std::max(std::fabs(heights.least), std::fabs(heights.greatest)) + range;
  const double rounding = 2e-15 * (double(grid.columns()) + grid.rows()) * range + 2e-15 * largest;
  const Scene scene{task, steps, unit, h0, 1e-6 / unit, (1e-6 + 1e-12 * length) / unit, rounding};

  std::vector<Wedge> wedges;
  constexpr double kWedgeSamples = 512;
  for (const Sector& sector : {Sector{true, 1}, Sector{false, 1}, Sector{true, -1}, Sector{false, -1}}) {
    const double far = farthest({sector, 0, 0, false, false}, grid, task.observer.plan);
    if (!(far > 0)) continue;
    // East and west take the samples on the diagonals.
    const int parts = 4 * std::max(1, static_cast<int>(far / 2 / kWedgeSamples));
    for (int i = 0; i < parts; ++i) {
      const double first = -1 + 2.0 * i / parts, last = -1 + 2.0 * (i + 1) / parts;
      wedges.push_back(
          {sector, first, last, i + 1 == parts && sector.isAlongRows, i > 0 || sector.isAlongRows});
    }
  }
  const std::size_t own = static_cast<std::size_t>(task.observer.plan.y) * grid.columns() +
                          static_cast<std::size_t>(task.observer.plan.x);
  if (task.observer.plan.x == std::floor(task.observer.plan.x) &&
      task.observer.plan.y == std::floor(task.observer.plan.y)) {
    const auto answer = task.exact.at(task.observer.plan, grid.row(0)[own]);
    if (!answer) return tl::unexpected(answer.error());
    result.cells[own] = answer->cell;
    if (!result.values.empty()) result.values[own] = answer->value;
    result.rays += answer->cell != ViewshedCell::outside;
  }

  std::vector<std::uint64_t> rays(wedges.size());
  std::vector<Status> statuses(wedges.size());
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> isReporting = false;
  withThreads(context, [&] {
    tbb::parallel_for(std::size_t{0}, wedges.size(), [&](std::size_t i) {
      if (context.cancelled()) return;
      WedgeSweep sweep(scene, wedges[i], result);
      statuses[i] = sweep.run(context);
      rays[i] = sweep.rays();
      const std::size_t count = ++done;
      if (!isReporting.exchange(true)) {
        context.report("viewshed", double(count) / double(wedges.size()));
        isReporting = false;
      }
    });
  });
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the viewshed was stopped");
  for (const Status& status : statuses)
    if (!status) return status;
  for (const std::uint64_t count : rays) result.rays += count;
  return {};
}

}  // namespace arete
