// SPDX-License-Identifier: GPL-3.0-or-later
//
// A drag solves for the bound whose handle is nearest to the mouse, by Newton steps on the projected axis: no
// ray is needed, and the numbers never leave the file's own coordinates.
#include "viewer/tools/crop_box.h"

#include <algorithm>
#include <cmath>

namespace arete {
namespace {

constexpr Rgba kEdgeInk = {255, 140, 0, 255};
constexpr int kSteps = 12;
/// The least thickness of a box, of its largest side.
constexpr double kThinnest = 1e-6;

double& coordinate(Vec3& p, std::size_t axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

double largestSide(const Box3& box) {
  const Vec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

CropBox::CropBox(const SurfaceSubject& surface) : surface_(surface) {
  whole_ = surface.fileBox();
  // A flat surface has a box all the same.
  const double least = std::max(largestSide(whole_) * 1e-3, 1e-9);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (coordinate(whole_.high, axis) - coordinate(whole_.low, axis) < least) {
      coordinate(whole_.low, axis) -= least;
      coordinate(whole_.high, axis) += least;
    }
  box = whole_;
}

Vec3 CropBox::shown(const Vec3& inFile) const {
  return surface_.pose({})(surface_.upright().fromFile(inFile));
}

double CropBox::bound(std::size_t face) const {
  Vec3 corner = face < 3 ? box.low : box.high;
  return coordinate(corner, face % 3);
}

void CropBox::setBound(std::size_t face, double value) {
  if (!std::isfinite(value)) return;
  const double apart = largestSide(whole_) * kThinnest;
  const double other = bound((face + 3) % 6);
  Vec3& corner = face < 3 ? box.low : box.high;
  coordinate(corner, face % 3) = face < 3 ? std::min(value, other - apart) : std::max(value, other + apart);
}

Vec3 CropBox::middleOf(std::size_t face, double bound) const {
  Vec3 middle = (box.low + box.high) * 0.5;
  coordinate(middle, face % 3) = bound;
  return shown(middle);
}

Vec3 CropBox::handle(std::size_t face) const {
  return middleOf(face, bound(face));
}

KeptBox CropBox::kept() const {
  Box3 upright = Box3::empty();
  for (const Vec3& corner : {box.low, box.high}) upright.include(surface_.upright().fromFile(corner));
  return {upright.low, upright.high};
}

SpaceVertices CropBox::edges() const {
  SpaceVertices lines;
  lines.isAlwaysSeen = true;
  const auto corner = [&](unsigned bits) {
    return shown({(bits & 1U) != 0 ? box.high.x : box.low.x, (bits & 2U) != 0 ? box.high.y : box.low.y,
                  (bits & 4U) != 0 ? box.high.z : box.low.z});
  };
  for (unsigned from = 0; from < 8; ++from)
    for (const unsigned bit : {1U, 2U, 4U})
      if ((from & bit) == 0) lines.addLine(corner(from), corner(from | bit), kEdgeInk);
  return lines;
}

void CropBox::grab(const Camera& camera, Vec2 mouse, const ViewSettings& settings, double reach) {
  held_.reset();
  double nearest = reach;
  for (std::size_t face = 0; face < 6; ++face) {
    const auto pixel = pixelOf(surface_, camera, handle(face), settings);
    if (!pixel) continue;
    const double away = std::hypot(pixel->x - mouse.x, pixel->y - mouse.y);
    if (away > nearest) continue;
    nearest = away;
    held_ = face;
  }
}

void CropBox::drag(const Camera& camera, Vec2 mouse, const ViewSettings& settings) {
  if (!held_) return;
  const std::size_t face = *held_;
  const double step = largestSide(whole_) * 1e-4;
  double value = bound(face);
  for (int i = 0; i < kSteps; ++i) {
    const auto here = pixelOf(surface_, camera, middleOf(face, value), settings);
    const auto there = pixelOf(surface_, camera, middleOf(face, value + step), settings);
    if (!here || !there) return;
    const Vec2 along{(there->x - here->x) / step, (there->y - here->y) / step};
    const double length = along.x * along.x + along.y * along.y;
    // Less than a tenth of a pixel for a hundredth of the box: the axis points at the eye.
    if (std::sqrt(length) * largestSide(whole_) < 10) return;
    const double by = ((mouse.x - here->x) * along.x + (mouse.y - here->y) * along.y) / length;
    value += std::clamp(by, -0.5 * largestSide(whole_), 0.5 * largestSide(whole_));
    if (std::abs(by) < 0.01 * step) break;
  }
  setBound(face, value);
}

}  // namespace arete
