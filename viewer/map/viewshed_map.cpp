// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pixel shows the sample nearest to its centre: a viewshed is an answer for samples, and mixed answers have
// no meaning. The relief below only darkens a colour, in few steps, so that the legend can show each of them.
#include "viewer/map/viewshed_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "terrain/viewshed/many.h"
#include "viewer/color/color_map.h"
#include "viewer/color/color_tables.h"
#include "viewer/map/map_page.h"
#include "viewer/picture/hillshade.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

using Kind = ViewshedMapKind;

constexpr int kShades = 16;
constexpr double kDeepest = 0.28;  // how much of a shadow's colour the darkest shade has
constexpr Rgb kShadowInk = {20, 24, 40};
constexpr Rgb kSeen = {255, 196, 64}, kHidden = {92, 98, 112}, kUnknown = {40, 110, 235},
              kUndecided = {44, 0, 90}, kOutside = {236, 234, 230};
constexpr Rgb kFew = {120, 60, 10}, kSome = {230, 150, 40}, kMany = {255, 236, 140};
constexpr std::size_t kMostClasses = 12;  // of counts that are listed one by one

Rgb shaded(Rgb color, double light) {
  return mix(kShadowInk, color, 1 - kDeepest * (1 - light));
}

Rgb inShade(Rgb color, int shade) {
  return shaded(color, shade / (kShades - 1.0));
}

Rgb answerColor(ViewshedCell cell) {
  switch (cell) {
    case ViewshedCell::seen:
      return kSeen;
    case ViewshedCell::hidden:
      return kHidden;
    case ViewshedCell::unknown:
      return kUnknown;
    case ViewshedCell::undecided:
      return kUndecided;
    default:
      return kOutside;
  }
}

/// The part of a grid that has answers, with a margin.
struct Window {
  std::uint32_t column = 0, row = 0, columns = 0, rows = 0;
};

Window windowOf(const RasterHeightfield& ground, std::span<const ViewshedCell> cells) {
  std::uint32_t left = ground.columns, top = ground.rows, right = 0, bottom = 0;
  for (std::uint32_t r = 0; r < ground.rows; ++r)
    for (std::uint32_t c = 0; c < ground.columns; ++c) {
      if (cells[std::size_t{r} * ground.columns + c] == ViewshedCell::outside) continue;
      left = std::min(left, c), right = std::max(right, c);
      top = std::min(top, r), bottom = std::max(bottom, r);
    }
  if (left > right) return {0, 0, ground.columns, ground.rows};
  const std::uint32_t margin = 1 + std::max(right - left, bottom - top) / 20;
  const auto less = [&](std::uint32_t v) { return v > margin ? v - margin : 0; };
  left = less(left), top = less(top);
  return {left, top, std::min(ground.columns, right + margin + 1) - left,
          std::min(ground.rows, bottom + margin + 1) - top};
}

RasterHeightfield cropped(const RasterHeightfield& field, const Window& w) {
  RasterHeightfield part;
  part.columns = w.columns;
  part.rows = w.rows;
  part.georeference = field.georeference;
  auto& g = part.georeference.geoTransform;
  g[0] += g[1] * w.column + g[2] * w.row;
  g[3] += g[4] * w.column + g[5] * w.row;
  part.georeference.repeatsFirstColumn = false;
  part.heights.reserve(std::size_t{w.columns} * w.rows);
  for (std::uint32_t r = 0; r < w.rows; ++r)
    for (std::uint32_t c = 0; c < w.columns; ++c) part.heights.push_back(field.at(w.column + c, w.row + r));
  return part;
}

/// What stands for the values and the answers: colours and the legend.
class Look {
 public:
  Look(Kind kind, std::span<const ViewshedCell> cells, std::span<const double> values, std::string unit)
      : kind_(kind), cells_(cells), values_(values), unit_(std::move(unit)) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const ViewshedCell answer = answerAt(i);
      ++count[std::size_t(answer)];
      if (kind_ == Kind::answers || !hasValue(i, answer)) continue;
      lowest_ = std::min(lowest_, values_[i]);
      highest_ = std::max(highest_, values_[i]);
    }
    if (!(lowest_ <= highest_)) lowest_ = highest_ = 0;
    if (kind_ == Kind::counts) lowest_ = 1;
    const bool isDarkHigh = kind_ == Kind::heights;  // what takes a tall target is dark
    const double high = std::max(highest_, lowest_), middle = (lowest_ + high) / 2;
    map_ = *ColorMap::make(
        {{lowest_, isDarkHigh ? kMany : kFew}, {middle, kSome}, {high, isDarkHigh ? kFew : kMany}});
  }

  ViewshedCell answerAt(std::size_t i) const {
    // No number: no height is known, whatever the answer for one target. A horizon has none at the observer.
    if (kind_ == Kind::heights && cells_[i] != ViewshedCell::outside && std::isnan(values_[i]))
      return ViewshedCell::unknown;
    if (kind_ != Kind::counts && kind_ != Kind::servers) return cells_[i];
    if (cells_[i] == ViewshedCell::outside) return cells_[i];
    const double v = values_[i];
    return v == ViewshedOfMany::kUnknown     ? ViewshedCell::unknown
           : v == ViewshedOfMany::kUndecided ? ViewshedCell::undecided
           : v > 0                           ? ViewshedCell::seen
                                             : ViewshedCell::hidden;
  }

  Rgb colorAt(std::size_t i) const {
    const ViewshedCell answer = answerAt(i);
    if (kind_ == Kind::answers || !hasValue(i, answer)) {
      const bool isNoHeight = hasQuantity() && answer != ViewshedCell::outside && values_[i] > 0;
      return isNoHeight ? kHidden : answerColor(answer);  // infinite: not seen at any height
    }
    return kind_ == Kind::servers ? serverColor(values_[i]) : map_.at(values_[i]).opaque();
  }

  ColorLegend legend() const {
    ColorLegend legend;
    const auto add = [&](Rgb color, std::string label) {
      LegendClass entry{{}, std::move(label)};
      for (int i = 0; i < kShades; ++i) entry.colors.push_back(inShade(color, i));
      legend.classes.push_back(std::move(entry));
    };
    if (hasQuantity()) {
      legend.title = kind_ == Kind::heights ? "least height seen" : "elevation of the horizon";
      legend.unit = kind_ == Kind::heights ? unit_ : "degrees";
      legend.scale = LegendScale{map_, lowest_, highest_, {}, [](Rgb color, double across) {
                                   return inShade(color, int(std::lround(across * (kShades - 1))));
                                 }};
      add(kHidden, kind_ == Kind::heights ? "at no height" : "nothing would be seen");
    } else if (kind_ == Kind::answers) {
      add(kSeen, "seen");
      add(kHidden, "hidden");
    } else {
      addNumbers(legend, add);
    }
    add(kUnknown, "unknown: no data in between");
    if (count[std::size_t(ViewshedCell::undecided)] > 0) add(kUndecided, "undecided at this tolerance");
    if (count[std::size_t(ViewshedCell::outside)] > 0) add(kOutside, "not asked, or no data");
    return legend;
  }

  std::array<std::uint64_t, 5> count = {};

 private:
  bool hasQuantity() const { return kind_ == Kind::heights || kind_ == Kind::horizon; }
  bool hasValue(std::size_t i, ViewshedCell answer) const {
    return hasQuantity() ? answer != ViewshedCell::outside && std::isfinite(values_[i])
                         : answer == ViewshedCell::seen;
  }
  static Rgb serverColor(double number) {
    // Colours that differ from the answers without an observer; they start again after the last.
    static constexpr Rgb kServers[] = {{255, 196, 64}, {120, 60, 10}, {255, 236, 140}, {214, 112, 30}};
    return kServers[(std::size_t(number) - 1) % std::size(kServers)];
  }

  template <class Add>
  void addNumbers(ColorLegend& legend, const Add& add) const {
    const bool isCount = kind_ == Kind::counts;
    const auto most = std::size_t(std::max(0.0, highest_));
    if (isCount && most > kMostClasses) {
      legend.title = "observers that see it";
      legend.scale = LegendScale{map_, lowest_, highest_, {}, [](Rgb color, double across) {
                                   return inShade(color, int(std::lround(across * (kShades - 1))));
                                 }};
    } else {
      for (std::size_t n = isCount ? most : 1; n >= 1 && n <= most; isCount ? --n : ++n)
        add(isCount ? map_.at(double(n)).opaque() : serverColor(double(n)),
            isCount ? fmt::format("seen by {}", n) : fmt::format("observer {} is nearest", n));
    }
    add(kHidden, isCount ? "seen by none" : "none sees it");
  }

  Kind kind_;
  std::span<const ViewshedCell> cells_;
  std::span<const double> values_;
  std::string unit_;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
  ColorMap map_;
};

std::string countsText(const std::array<std::uint64_t, 5>& count) {
  const auto of = [&](ViewshedCell cell) { return count[std::size_t(cell)]; };
  const std::uint64_t all = of(ViewshedCell::seen) + of(ViewshedCell::hidden) + of(ViewshedCell::unknown) +
                            of(ViewshedCell::undecided);
  std::string text =
      fmt::format("{} of {} samples are seen, {:.1f} %", countText(of(ViewshedCell::seen)), countText(all),
                  100.0 * double(of(ViewshedCell::seen)) / double(std::max<std::uint64_t>(1, all)));
  if (of(ViewshedCell::unknown) > 0)
    text += fmt::format("   \u00b7   {} are unknown", countText(of(ViewshedCell::unknown)));
  if (of(ViewshedCell::undecided) > 0)
    text += fmt::format("   \u00b7   {} are undecided", countText(of(ViewshedCell::undecided)));
  return text;
}

/// The light on level ground is well below the brightest, so that slopes towards the light stand out.
int shadeOf(Rgb relief) {
  const double light = (0.3 * relief.r + 0.59 * relief.g + 0.11 * relief.b) / 255;
  return int(std::lround(std::clamp((light - 0.45) / 0.53, 0.0, 1.0) * (kShades - 1)));
}

std::uint32_t nearest(double v, std::uint32_t count) {
  return static_cast<std::uint32_t>(std::clamp(std::round(v), 0.0, count - 1.0));
}

}  // namespace

Rgb viewshedColor(ViewshedCell cell, int shade) {
  return inShade(answerColor(cell), shade);
}

std::string earthWords(const Georeference& georeference, bool isOnEllipsoid, double refraction) {
  if (!isOnEllipsoid) return "over a plane Earth, without refraction";
  const double radius = georeference.semiMajorAxisMetres / 1000;
  const std::string text = fmt::format("over the ellipsoid of radius {:.0f} km", radius);
  if (refraction == 0) return text + ", without refraction";
  return text + fmt::format(", refraction {:.4g}: as over {:.0f} km", refraction, radius / (1 - refraction));
}

Result<Canvas> drawViewshedMap(const RasterHeightfield& ground, std::span<const ViewshedCell> cells,
                               std::span<const double> values, std::span<const Vec2> observers,
                               const ViewshedMapOptions& options) {
  const Look look(options.kind, cells, values, ground.georeference.verticalUnit);
  const Window window = windowOf(ground, cells);
  const RasterHeightfield part = cropped(ground, window);
  std::vector<std::string> caption = options.caption;
  if (options.kind == Kind::answers || options.kind == Kind::counts)
    caption.push_back(countsText(look.count));
  ARETE_TRY(auto page, makeMapPage(part.columns, part.rows, part.georeference,
                                   {.width = options.width,
                                    .title = options.title,
                                    .caption = caption,
                                    .legends = {look.legend()},
                                    .isDecorated = options.isDecorated}));
  const MapView& view = page.view;
  const Image relief = drawHillshade(part, view, {.tint = 0});
  Image image(view.width, view.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vec2 at = view.toGrid(x + 0.5, y + 0.5);
      const std::size_t sample = (std::size_t{window.row} + nearest(at.y, part.rows)) * ground.columns +
                                 window.column + nearest(at.x, part.columns);
      image.at(x, y) = inShade(look.colorAt(sample), shadeOf(relief.at(x, y)));
    }
  page.canvas.image(image, int(page.map.left), int(page.map.top));
  page.finish();
  page.canvas.clip(page.map);
  for (std::size_t i = 0; i < observers.size(); ++i) {
    const Vec2 dot = page.toPage(observers[i].x - window.column, observers[i].y - window.row);
    if (!std::isfinite(dot.x + dot.y)) continue;
    page.canvas.fillCircle(dot, 9, {255, 255, 255});
    page.canvas.fillCircle(dot, 6, {200, 30, 40});
    if (observers.size() == 1) continue;
    // The number stands on the side where the map has room.
    const bool isRight = dot.x < page.map.left + page.map.width / 2;
    page.canvas.text(fmt::format("{}", i + 1), {dot.x + (isRight ? 12 : -12), dot.y},
                     {.size = 18,
                      .bold = true,
                      .horizontal = isRight ? Align::start : Align::end,
                      .vertical = Align::center,
                      .halo = 3});
  }
  page.canvas.unclip();
  return std::move(page.canvas);
}

}  // namespace arete
