// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "viewer/camera/round_flight.h"

namespace arete {
namespace {

constexpr double kFreeOnATurn = 0.02;  // of half the picture, at its edges

/// How far a camera has to step back for a place to be within so much of its picture; negative: it need not.
class StepBack {
 public:
  StepBack(const CameraSpace& space, const Camera& camera)
      : axes_(axesOf(space, lookOf(camera))),
        eye_(space.position(camera)),
        slope_(std::tan(camera.verticalFieldOfViewDegrees * std::numbers::pi / 360)),
        slopeAcross_(slope_ * camera.widthPixels / camera.heightPixels) {}

  double operator()(const Vec3& place, double part) const {
    const Vec3 way = place - eye_;
    return std::max(std::abs(dot(way, axes_.right)) / slopeAcross_, std::abs(dot(way, axes_.up)) / slope_) /
               part -
           dot(way, axes_.ahead);
  }
  Vec3 eyeAt(double step) const { return eye_ - axes_.ahead * step; }

 private:
  PictureAxes axes_;
  Vec3 eye_;
  double slope_, slopeAcross_;
};

Placement aboutTheMiddle(const Vec3& middle, const Turn& turn) {
  return {.pivot = middle, .anchor = middle, .turn = turn};
}

/// The largest error of triangles of a part that the whole model refines.
double largestMissingError(const MultiTriangulation& mt) {
  double largest = 0;
  for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t)
    if (mt.isRemoverMissing(TriangleId(t))) largest = std::max(largest, mt.error(TriangleId(t)));
  return largest;
}

void grow(MetricBox& box, double by) {
  box.low = box.low - Vec3{by, by, by};
  box.high = box.high + Vec3{by, by, by};
}

}  // namespace

// No place of the source is farther from the triangle that stands for it than the triangle's error.
SurfaceForm::SurfaceForm(const SurfaceModel& shown, const ZUpFrame& frame)
    : model(shown),
      upright(frame),
      largestError(shown.mt.largestError()),
      beyond(shown.finestOfWhole ? largestMissingError(shown.mt) : 0),
      shape(uprightShape(shown, frame)),
      picker(shown, frame) {
  largestError = std::max(largestError, beyond);
  grow(shape.box, beyond);
}

View viewedBy(const Similarity& placed, const View& view) {
  const Similarity back = placed.inverse();
  View seen = view;
  seen.eye = back(view.eye);
  seen.forward = back.direction(view.forward);
  seen.up = back.direction(view.up);
  seen.nearDistance *= back.scale();
  seen.farDistance *= back.scale();
  seen.parallelHeight *= back.scale();
  return seen;
}

SurfaceSubject::SurfaceSubject(const SurfaceModel& model, const ZUpFrame& upright)
    : SurfaceSubject(std::make_shared<const SurfaceForm>(model, upright), Turn{}) {}

SurfaceSubject::SurfaceSubject(std::shared_ptr<const SurfaceForm> form, const Turn& turn)
    : SurfaceSubject(form, aboutTheMiddle(form->shape.box.centre(), turn), nullptr) {
  isPlaced_ = false;
  place(placement_);  // its box as it is, where nothing turns it
}

SurfaceSubject::SurfaceSubject(std::shared_ptr<const SurfaceForm> form, const Placement& placement,
                               const Subject* scene)
    : Subject(scene ? scene->space() : CameraSpace(), form->shape.box),
      form_(std::move(form)),
      scene_(scene),
      isPlaced_(true),
      unit_(form_->model.verticalUnit) {
  place(placement);
}

void SurfaceSubject::place(const Placement& placement) {
  placement_ = placement;
  box_ = shape().box;
}

// Made anew where it is wanted: a thousand objects of one surface do not keep its points a thousand times.
HomeShape SurfaceSubject::shape() const {
  const bool isAsItIs = placement_.turn == Turn{} && placement_.scale == 1 && !isPlaced_;
  if (isAsItIs) return form_->shape;
  const Similarity there = placed(placement_, scene_);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  HomeShape shape{{{kInfinite, kInfinite, kInfinite}, {-kInfinite, -kInfinite, -kInfinite}}, {}};
  MetricBox& box = shape.box;
  for (const Vec3& point : form_->shape.points) {
    const Vec3 p = there(point);
    shape.points.push_back(p);
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  grow(box, form_->beyond * there.scale());
  return shape;
}

Result<View> SurfaceSubject::viewOf(const Camera& camera, const ViewSettings& settings) const {
  return scene_ ? scene_->viewOf(camera, settings) : arete::viewOf(camera, space_);
}

// Of a part the triangle of a cut there may be its finest one, whatever is allowed.
double SurfaceSubject::boundAt(const Pick& pick, double allowed) const {
  return std::min(std::max(allowed, pick.finestError * placement_.scale),
                  form_->largestError * placement_.scale);
}

SubjectFacts SurfaceSubject::facts() const {
  const SurfaceModel& m = model();
  return {m.mt.vertexCount(), m.finestTriangles(), m.attributes.materials.size(), form_->largestError};
}

Vec3 SurfaceSubject::inFile(const Vec3& metric) const {
  return upright().toFile(placed(placement_, scene_).inverse()(metric));
}

// Upright space has the file's axes, perhaps in another order.
Box3 SurfaceSubject::fileBox() const {
  Box3 all = Box3::empty();
  for (const Vec3& corner : {uprightBox().low, uprightBox().high}) all.include(upright().toFile(corner));
  return all;
}

Camera SurfaceSubject::home(HomeView view, const Camera& picture, const ViewSettings&,
                            const CoveredEdges& covered) const {
  const HomeShape shape = this->shape();
  Look look = view == HomeView::overview ? Look{325, -20} : homeLook(view);
  if (view == HomeView::overview)
    look = filling(
        look, shape.points, [&](Look at) { return axesOf(space_, at); }, picture, covered);
  return cameraOnAll(space_, shape, look, picture, covered);
}

std::optional<Pick> SurfaceSubject::pick(const Camera& camera, Vec2 pixel,
                                         const ViewSettings& settings) const {
  const Result<View> view = viewOf(camera, settings);
  if (!view) return std::nullopt;
  const Similarity pose = this->pose(settings), back = pose.inverse();
  const Vec3 direction = directionOfPixel(*view, space_.isMirrored(), pixel);
  const Vec3 origin = originOfPixel(*view, space_.isMirrored(), pixel, depthReach(*view, *this, settings));
  const auto found = picker().along(back(origin), back.direction(direction));
  if (!found) return std::nullopt;
  const Vec3 inFile = upright().toFile(found->place), metric = placed(placement_, scene_)(found->place);
  Pick pick;
  pick.metric = metric;
  const Vec3 way = origin + found->length * pose.scale() * unit(direction) - view->eye;
  pick.metres = norm(way);
  pick.depth = dot(way, view->forward);
  pick.material = picker().materialOf(found->triangle);
  pick.parts = picker().partsOf(found->triangle);
  pick.finestError = picker().missingErrorOf(found->triangle);
  pick.inObject = inFile;
  if (isPlaced_) {
    pick.xy = space_.xy(metric);
    pick.height = space_.height(metric);
  } else {
    // Of the three coordinates of the file, the one that counts upwards is the height.
    const bool isYUp = upright().turned({0, 1, 0}).z > 0.5;
    pick.xy = {inFile.x, inFile.y};
    pick.height = isYUp ? inFile.y : inFile.z;
  }
  pick.plan = pick.xy;
  return pick;
}

Result<FlightPlan> SurfaceSubject::round(const Camera& from) const {
  const StepBack stepBack(space_, from);
  const Vec3 middle = box_.centre();
  const double slack = 1e-6 * box_.diagonal();
  double step = 0;
  const HomeShape shape = this->shape();
  for (const Vec3& p : shape.points) {
    // A camera that leaves something out at its start is one that was chosen.
    if (stepBack(p, 1) > slack) return turnAround(space_, middle, from);
    const double radius = std::hypot(p.x - middle.x, p.y - middle.y);
    constexpr int kPlaces = 72;
    for (int i = 0; i < kPlaces; ++i) {
      const double turn = 2 * std::numbers::pi * i / kPlaces;
      const Vec3 there{middle.x + radius * std::cos(turn), middle.y + radius * std::sin(turn), p.z};
      step = std::max(step, stepBack(there, 1 - kFreeOnATurn));
    }
  }
  return turnAround(space_, middle, space_.at(from, stepBack.eyeAt(step)));
}

std::span<const Coloring> SurfaceSubject::colorings() const {
  static constexpr std::array kColorings = {Coloring::material, Coloring::plain, Coloring::error};
  return kColorings;
}

Result<std::shared_ptr<const TriangleInk>> SurfaceSubject::ink(const std::string& name) const {
  if (ink_ && inkName_ == name) return ink_;
  ARETE_TRY(TriangleInk made, inkNamed(model(), name));
  ink_ = std::make_shared<const TriangleInk>(std::move(made));
  inkName_ = name;
  return ink_;
}

Status SurfaceSubject::check(const ViewSettings& settings) const {
  const ViewLook& look = settings.look;
  if (look.coloring == Coloring::ink) {
    ARETE_CHECK(ink(look.ink));
  } else if (scene_) {
    return checkColoring(look.coloring);
  }
  if (scene_) return {};
  const auto isForTerrain = [](const char* what) {
    return failure(ErrorCode::usage, "is for terrain", what);
  };
  if (settings.isCurved) return isForTerrain("the Earth's curvature");
  if (settings.stretch != 1) return isForTerrain("exaggeration");
  if (look.hazeKilometres > 0) return isForTerrain("haze");
  return look.coloring == Coloring::ink ? Status() : checkColoring(look.coloring);
}

}  // namespace arete
