// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/stopwatch.h"
#include "viewer/scene/drawn_within.h"

namespace arete {
namespace {

constexpr double kQuickMilliseconds = 5;

bool isSame(const Camera& a, const Camera& b) {
  return a.xy.x == b.xy.x && a.xy.y == b.xy.y && a.height == b.height &&
         a.azimuthDegrees == b.azimuthDegrees && a.pitchDegrees == b.pitchDegrees &&
         a.verticalFieldOfViewDegrees == b.verticalFieldOfViewDegrees &&
         a.parallelHeight == b.parallelHeight && a.widthPixels == b.widthPixels &&
         a.heightPixels == b.heightPixels;
}

/// Coordinates to a hundred thousandth of the model's size.
std::string coordinates(const Vec3& p, double size) {
  const int decimals = size > 0 ? std::clamp(5 - int(std::floor(std::log10(size))), 0, 9) : 3;
  return fmt::format("{:.{}f}, {:.{}f}, {:.{}f}", p.x, decimals, p.y, decimals, p.z, decimals);
}

}  // namespace

bool Cursor::Now::operator==(const Now& other) const {
  const bool isMouseSame = mouse.has_value() == other.mouse.has_value() &&
                           (!mouse || (mouse->x == other.mouse->x && mouse->y == other.mouse->y));
  return isMouseSame && isSame(camera, other.camera) && isSame(cutFor, other.cutFor) &&
         pixels == other.pixels && stretch == other.stretch && isCurved == other.isCurved &&
         isGeomorphed == other.isGeomorphed;
}

void Cursor::update(const Now& now) {
  if (answered_ && *answered_ == now) return;
  const bool isAtRest = seen_ && *seen_ == now;
  seen_ = now;
  if (!isAtRest && askedMilliseconds_ > kQuickMilliseconds && now.mouse) return;
  const Stopwatch asking;
  ask(now);
  askedMilliseconds_ = asking.milliseconds();
  answered_ = now;
}

void Cursor::ask(const Now& now) {
  pick_.reset();
  text_.clear();
  if (!now.mouse) return;
  ++asked_;
  const ViewSettings settings{
      .isGeomorphed = now.isGeomorphed, .stretch = now.stretch, .isCurved = now.isCurved};
  pick_ = subject_.pick(now.camera, *now.mouse, settings);
  if (!pick_) {
    if (subject_.isVoid(now.camera, *now.mouse, settings)) text_ = "no data";
    return;
  }
  within_ = drawnWithin(subject_, now.cutFor, settings, now.pixels, *pick_);
  text_ = textOf(*pick_);
}

std::string Cursor::textOf(const Pick& pick) const {
  // The bound has no more digits than the height.
  const double within = tools_ && within_ > 0 ? std::max(within_, 0.01) : within_;
  const std::string unit = subject_.heightUnit().empty() ? std::string() : " " + subject_.heightUnit();
  const std::string drawn = within > 0 ? fmt::format("drawn within {}{} of it", boundText(within), unit)
                                       : std::string("drawn as it is");
  if (!tools_) {
    const std::string place = coordinates(subject_.inFile(pick.metric), subject_.box().diagonal());
    return place + unit + (pick.material.empty() ? "" : "   " + pick.material) + ", " + drawn;
  }
  const PlaceText& places = tools_->places;
  const std::string lonLat = places.isLonLat() ? std::string() : places.lonLat(pick.xy);
  return places.xy(pick.xy) + (lonLat.empty() ? "" : "   " + lonLat) + "   height " +
         places.height(pick.height) + ", " + drawn;
}

}  // namespace arete
