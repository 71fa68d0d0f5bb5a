// SPDX-License-Identifier: GPL-3.0-or-later
//
// On a flat map a pixel and its depth are a place. On a curved Earth drawn space is bent: there the subject
// picks, and depths only say what is hidden.
#include "viewer/decoration/scene_ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/criteria/view.h"
#include "terrain/locate/ground_height.h"

namespace arete {
namespace {

/// A line on the ground is drawn on the model at full resolution, the picture on a cut: what is hidden by
/// less than this part of its depth is seen.
constexpr double kDepthSlack = 0.004;

/// All that a picture of a terrain is asked for. Shared by the functions of a PictureGround.
class TerrainPicture {
 public:
  TerrainPicture(const Subject& subject, const Camera& camera, const ViewSettings& settings, const View& view,
                 std::shared_ptr<const PictureDepths> depths)
      : subject_(subject),
        camera_(camera),
        settings_(settings),
        view_(view),
        frustum_(view),
        depths_(std::move(depths)) {}

  /// Whether something can be seen so far ahead.
  bool isDepth(double depth) const { return depth > 0 || view_.isParallel(); }

  std::optional<double> depthAt(Vec2 pixel) const {
    if (!depths_) {
      const auto pick = subject_.pick(camera_, pixel, settings_);
      if (!pick) return {};
      const double depth = frustum_.toView(subject_.drawn(pick->metric, settings_)).z;
      return isDepth(depth) ? std::optional(depth) : std::nullopt;
    }
    const double x = std::floor(pixel.x), y = std::floor(pixel.y);
    if (!(x >= 0 && y >= 0 && x <= depths_->width && y <= depths_->height)) return {};
    // The far ends of a picture belong to it.
    const auto column = std::min(int(x), depths_->width - 1), row = std::min(int(y), depths_->height - 1);
    const float depth = depths_->depths[std::size_t(row) * std::size_t(depths_->width) + std::size_t(column)];
    return std::isfinite(depth) && isDepth(depth) ? std::optional<double>(depth) : std::nullopt;
  }

  std::optional<Vec3> metricAt(Vec2 pixel) const {
    if (!depths_ || settings_.isCurved) {
      const auto pick = subject_.pick(camera_, pixel, settings_);
      return pick ? std::optional(pick->metric) : std::nullopt;
    }
    const auto depth = depthAt(pixel);
    if (!depth) return {};
    const bool isMirrored = subject_.space().isMirrored();
    Vec3 place =
        originOfPixel(view_, isMirrored, pixel, 0) + *depth * directionOfPixel(view_, isMirrored, pixel);
    place.z /= settings_.stretch;
    return place;
  }

  std::optional<Vec2> sourceAt(Vec2 pixel) const {
    const auto place = metricAt(pixel);
    return place ? std::optional(subject_.space().xy(*place)) : std::nullopt;
  }

  std::optional<Vec2> pixelOfPlace(const Vec3& metric, bool mayBeHidden) const {
    const Vec3 p = frustum_.toView(subject_.drawn(metric, settings_));
    const auto found = pixelOfPoint(view_, subject_.space().isMirrored(), p);
    if (!found) return {};
    const Vec2 pixel = *found;
    const bool isInside =
        pixel.x >= 0 && pixel.y >= 0 && pixel.x < view_.widthPixels && pixel.y < view_.heightPixels;
    if (mayBeHidden && isInside && depths_) {
      const auto shown = depthAt(pixel);
      if (!shown || *shown < p.z - kDepthSlack * (view_.isParallel() ? view_.parallelHeight : p.z)) return {};
    }
    return pixel;
  }

  std::optional<Vec2> pixelOf(Vec2 source) const {
    const auto ground = subject_.heights()->at(source);
    if (!ground) return {};
    return pixelOfPlace(subject_.space().position(source, ground->height), true);
  }

  /// On the level plane through the ground at the middle of the picture, or below it.
  std::optional<Vec2> levelPixelOf(Vec2 source) const {
    if (!level_) {
      for (int i = 0; i < 64 && !level_; ++i) {
        const auto place = metricAt({view_.widthPixels / 2, view_.heightPixels * (0.5 + 0.5 * i / 64)});
        if (place) level_ = subject_.space().height(*place);
      }
      if (!level_) return {};
    }
    return pixelOfPlace(subject_.space().position(source, *level_), false);
  }

  /// As the middle of the picture shows it where the camera looks down by 30 degrees or more. Level ground is
  /// a line to a level look, and all that is north would be left or right: from there to the horizon the
  /// picture's up becomes the way ahead.
  Vec2 wayOfStep(Vec2 from, Vec2 to) const {
    const Vec3 step = subject_.space().position(to, 0) - subject_.space().position(from, 0);
    const double down = std::max(0.0, -std::sin(camera_.pitchDegrees * std::numbers::pi / 180));
    return {dot(step, subject_.space().right(camera_.azimuthDegrees)),
            -dot(step, subject_.space().forward({camera_.azimuthDegrees, 0})) * std::max(down, 1 - down)};
  }

  /// In space as it is drawn, which on a curved Earth is the ground.
  std::optional<double> lengthPerPixel(Vec2 pixel) const {
    const auto depth = depthAt(pixel);
    if (!depth) return {};
    return 2 * frustum_.planes().halfWidth(*depth) / view_.widthPixels;
  }

  /// On a flat map, whose scale is not the ground's everywhere.
  std::optional<std::pair<Vec2, Vec2>> acrossPixel(Vec2 pixel) const {
    const auto place = metricAt(pixel);
    const auto perPixel = lengthPerPixel(pixel);
    if (!place || !perPixel) return {};
    const Vec3 half = subject_.space().right(camera_.azimuthDegrees) * (*perPixel / 2);
    return std::pair{subject_.space().xy(*place - half), subject_.space().xy(*place + half)};
  }

 private:
  const Subject& subject_;
  Camera camera_;
  ViewSettings settings_;
  View view_;
  Frustum frustum_;
  std::shared_ptr<const PictureDepths> depths_;
  mutable std::optional<double> level_;
};

}  // namespace

PictureGround groundInView(const Subject& subject, const Camera& camera, const ViewSettings& settings,
                           std::shared_ptr<const PictureDepths> depths) {
  PictureGround::Parts parts;
  parts.frame = {0, 0, camera.widthPixels, camera.heightPixels};
  parts.isPerspective = true;
  parts.toSource = [](Vec2) { return std::optional<Vec2>(); };
  parts.toPixel = parts.toSource;
  parts.lengthPerPixel = [](Vec2) { return std::optional<double>(); };
  const Result<View> view = subject.viewOf(camera, settings);
  if (!view) return PictureGround(std::move(parts));
  parts.isPerspective = !view->isParallel();
  parts.statesPixel = view->isParallel();
  if (!subject.heights()) {
    // A file without a CRS says no unit.
    const Frustum frustum(*view);
    const Vec3 middle = (subject.box().low + subject.box().high) * 0.5;
    const double depth = frustum.toView(subject.drawn(middle, settings)).z;
    const double perPixel = 2 * frustum.planes().halfWidth(depth) / view->widthPixels;
    if (depth > 0 || view->isParallel())
      parts.lengthPerPixel = [perPixel](Vec2) { return std::optional(perPixel); };
    return PictureGround(std::move(parts));
  }
  parts.georeference = subject.heights()->model().georeference;
  const auto picture =
      std::make_shared<const TerrainPicture>(subject, camera, settings, *view, std::move(depths));
  parts.toSource = [picture](Vec2 pixel) { return picture->sourceAt(pixel); };
  parts.toPixel = [picture](Vec2 source) { return picture->pixelOf(source); };
  parts.toLevelPixel = [picture](Vec2 source) { return picture->levelPixelOf(source); };
  parts.wayOfStep = [picture](Vec2 from, Vec2 to) { return picture->wayOfStep(from, to); };
  parts.eye = camera.xy;
  if (settings.isCurved) {
    parts.lengthPerPixel = [picture](Vec2 pixel) { return picture->lengthPerPixel(pixel); };
  } else {
    parts.lengthPerPixel = {};
    parts.acrossPixel = [picture](Vec2 pixel) { return picture->acrossPixel(pixel); };
  }
  return PictureGround(std::move(parts));
}

Result<Image> decorated(const Image& picture, const PictureGround& ground,
                        std::span<const ColorLegend> legends, const Decorations& decorations) {
  ARETE_TRY(Canvas canvas, Canvas::create(picture.width, picture.height));
  canvas.image(picture, 0, 0);
  decorate(canvas, ground, legends, decorations);
  return canvas.picture();
}

}  // namespace arete
