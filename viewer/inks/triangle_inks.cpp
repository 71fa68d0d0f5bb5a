// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/inks/triangle_inks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "surface/attributes/attribute_distance.h"
#include "surface/model/charts.h"
#include "viewer/color/color_tables.h"

namespace arete {
namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
/// What has no bound is blue, which the table of errors does not have.
constexpr Rgba kUnboundedColor{70, 130, 220, 255};
constexpr Rgba kWithoutColor{150, 150, 150, 255};

tl::unexpected<Error> lacks(std::string why, std::string name) {
  return failure(ErrorCode::usage, std::move(why), std::move(name));
}

/// Texture coordinates of the corners of triangles.
struct PicturePlaces {
  const SurfaceModel* model;
  const Attribute* coords = nullptr;
  bool areOfWedges = false;

  explicit PicturePlaces(const SurfaceModel& of) : model(&of) {
    const auto isOne = [](const Attribute& a) { return a.name == kTexcoordName && a.components >= 2; };
    for (const Attribute& a : of.attributes.vertexAttributes)
      if (isOne(a)) coords = &a;
    for (const Attribute& a : of.attributes.wedgeAttributes)
      if (of.hasWedges() && isOne(a)) coords = &a, areOfWedges = true;
  }

  double area(std::uint32_t t) const {
    const auto& corners = areOfWedges ? model->wedgesOf[t] : model->mt.corners(TriangleId(t));
    std::array<std::vector<double>, 3> uv;
    for (std::size_t c = 0; c < 3; ++c) uv[c] = coords->numbers(corners[c]);
    return std::abs((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) -
                    (uv[2][0] - uv[0][0]) * (uv[1][1] - uv[0][1])) /
           2;
  }
};

double areaOnSurface(const SurfaceModel& model, std::uint32_t t) {
  const auto ids = model.mt.corners(TriangleId(t));
  const auto at = [&](std::size_t c) { return model.mt.position(VertexId(ids[c])); };
  return norm(cross(at(1) - at(0), at(2) - at(0))) / 2;
}

const AttributeErrors* errorsNamed(const SurfaceModel& model, std::string_view name) {
  for (const bool isOfFile : {false, true})
    for (const AttributeErrors& errors : model.attributeErrors)
      if ((isOfFile ? errors.inFile : errors.name) == name) return &errors;
  return nullptr;
}

std::string unitOf(const SurfaceModel& model, const AttributeErrors& errors) {
  const MeshAttributes& a = model.attributes;
  for (const Attribute& one : errors.ofWedges ? a.wedgeAttributes : a.vertexAttributes)
    if (one.name == errors.inFile)
      if (const std::string unit = AttributeDistance(one).unit(); unit != "units") return unit;
  return {};
}

}  // namespace

Result<TriangleInk> chartInk(const SurfaceModel& model) {
  const std::vector<std::uint32_t> charts = chartsOf(model);
  std::vector<std::uint32_t> partOf;
  if (charts.empty() || !partsOf(model, partOf).hasLines())
    return lacks("the surface has no seams and no edges between parts", "charts");
  const auto table = classColors();
  TriangleInk ink;
  std::vector<ColorStop> stops;
  for (std::size_t i = 0; i < table.size(); ++i) stops.push_back({double(i), Rgba(table[i])});
  ARETE_TRY(ink.colors, ColorMap::make(std::move(stops), {.between = ColorsBetween::nearest}));
  const std::uint32_t count = *std::ranges::max_element(charts) + 1;
  for (const std::uint32_t c : charts) ink.numbers.push_back(float(c % table.size()));
  ink.title = fmt::format("charts: {}", count);
  if (count > table.size())
    ink.classes.push_back(
        {Rgba(table[0]), fmt::format("and {} more colours, again and again", table.size() - 1)});
  else
    for (std::uint32_t i = 0; i < count; ++i)
      ink.classes.push_back({Rgba(table[i]), fmt::format("chart {}", i + 1)});
  return ink;
}

Result<TriangleInk> stretchInk(const SurfaceModel& model) {
  const PicturePlaces places(model);
  if (!places.coords) return lacks("the surface has no texture coordinates", "stretch");
  double onSurface = 0, inPicture = 0;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
    if (model.mt.remover(TriangleId(t)).isValid()) continue;
    const double picture = places.area(t);
    if (!std::isfinite(picture)) continue;
    onSurface += areaOnSurface(model, t);
    inPicture += picture;
  }
  if (!(inPicture > 0)) return lacks("the texture coordinates cover nothing", "stretch");
  constexpr double kOctaves = 3;
  TriangleInk ink;
  ink.colors = colorTable("difference").over(-kOctaves, kOctaves).withNodata(kWithoutColor);
  bool hasNone = false;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
    const double picture = places.area(t), surface = areaOnSurface(model, t);
    const double octaves = std::log2(surface / picture * (inPicture / onSurface));
    const bool isNone = !std::isfinite(picture) || std::isnan(octaves);
    hasNone = hasNone || !std::isfinite(picture);
    ink.numbers.push_back(isNone ? kNoNumber : float(std::clamp(octaves, -kOctaves, kOctaves)));
  }
  ink.title = "stretch of the picture";
  for (const double octave : {-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0})
    ink.ticks.emplace_back(octave, fmt::format("{:.3g} times", std::exp2(octave)));
  if (hasNone) ink.classes.push_back({kWithoutColor, "no area"});
  return ink;
}

// Coarse triangles have many times the errors of fine ones, and every cut is to show differences.
Result<TriangleInk> attributeErrorInk(const SurfaceModel& model, std::string_view name) {
  const std::string culprit = std::string(kErrorInk) + std::string(name);
  if (!model.displacement.isEmpty())
    return lacks(
        "a displaced surface states no errors of attributes: its vertices have left what was bounded",
        culprit);
  const AttributeErrors* const errors = errorsNamed(model, name);
  if (!errors) {
    std::string known;
    for (const AttributeErrors& one : model.attributeErrors)
      known += (known.empty() ? "" : ", ") + std::string(kErrorInk) + one.name;
    return lacks(known.empty() ? "the model states no errors of attributes: build it with its attributes "
                                 "(`boundsAttributes`)"
                               : fmt::format("the model states no such errors; it has {}", known),
                 culprit);
  }
  const std::uint32_t count = model.mt.triangleIdCount();
  double most = 0;
  bool hasUnbounded = false;
  for (std::uint32_t t = 0; t < count; ++t) {
    const double e = errors->of(t);
    if (std::isfinite(e)) most = std::max(most, e);
    hasUnbounded = hasUnbounded || !std::isfinite(e);
  }
  constexpr double kOctaves = 10;
  // Where nothing is off by anything all triangles have the coldest colour.
  const double high = most > 0 ? std::log2(most) : 0, low = high - kOctaves;
  TriangleInk ink;
  ink.colors = colorTable("error").over(low, high).withNodata(kUnboundedColor);
  for (std::uint32_t t = 0; t < count; ++t) {
    const double e = errors->of(t);
    ink.numbers.push_back(!std::isfinite(e)   ? kNoNumber
                          : e > 0 && most > 0 ? float(std::clamp(std::log2(e), low, high))
                                              : float(low));
  }
  ink.title = fmt::format("error of {}, at most", errors->name);
  ink.unit = unitOf(model, *errors);
  if (most > 0) {
    for (int octave = 0; octave <= int(kOctaves); octave += 2)
      ink.ticks.emplace_back(low + octave,
                             fmt::format("{}{:.3g}", octave == 0 ? "0 to " : "", std::exp2(low + octave)));
  } else {
    ink.classes.push_back({ink.colors.at(low), "0"});
  }
  if (hasUnbounded) ink.classes.push_back({kUnboundedColor, "no bound"});
  return ink;
}

std::vector<std::string> inkNames(const SurfaceModel& model) {
  std::vector<std::string> names;
  std::vector<std::uint32_t> partOf;
  if (model.boundsLines && partsOf(model, partOf).hasLines()) names.emplace_back("charts");
  if (PicturePlaces(model).coords) names.emplace_back("stretch");
  if (model.displacement.isEmpty())
    for (const AttributeErrors& errors : model.attributeErrors)
      names.push_back(std::string(kErrorInk) + errors.name);
  return names;
}

Result<TriangleInk> inkNamed(const SurfaceModel& model, std::string_view name) {
  if (name == "charts") return chartInk(model);
  if (name == "stretch") return stretchInk(model);
  if (name.starts_with(kErrorInk)) return attributeErrorInk(model, name.substr(kErrorInk.size()));
  return lacks("is not a colour of surfaces", std::string(name));
}

}  // namespace arete
