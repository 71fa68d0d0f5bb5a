// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weights. Texture coordinates count as far as a picture slides along the surface: a unit of them is as long
// as the root of the area that it covers, in the mean. Other attributes have no length; a whole range of a
// colour or of numbers counts as kRangeAsPart of the diagonal, a right angle between normals as
// kRightAngleAsPart.
#include "surface/error/attribute_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "surface/attributes/attribute_distance.h"
#include "surface/attributes/attribute_names.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

constexpr double kRangeAsPart = 0.08, kRightAngleAsPart = 0.02;

using Corners = std::array<std::uint32_t, 3>;

/// By wedge: its vertex.
std::vector<std::uint32_t> verticesOfWedges(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> vertexOf(mesh.wedgeCount, 0);
  for (std::size_t f = 0; f < mesh.wedges.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) vertexOf[mesh.wedges[f][c]] = mesh.triangles[f][c];
  return vertexOf;
}

double areaOf(const Vec3& a, const Vec3& b, const Vec3& c) {
  return norm(cross(b - a, c - a)) / 2;
}

}  // namespace

AttributeField::AttributeField(const SurfaceMesh& mesh, double diagonal)
    : faces_(mesh.triangles), wedges_(mesh.wedges) {
  const std::size_t drawn = mesh.hasWedges() ? mesh.wedgeCount : mesh.positions.size();
  const std::vector<std::uint32_t> vertexOf =
      mesh.hasWedges() ? verticesOfWedges(mesh) : std::vector<std::uint32_t>{};
  struct Source {
    const Attribute* attribute;
    AttributeDistance distance;
    bool ofWedges;
  };
  std::vector<Source> sources;
  const auto take = [&](const Attribute& a, bool ofWedges) {
    const AttributeDistance distance(a);
    Entry e;
    e.name = optionNameOf(a.name);
    e.inFile = a.name;
    e.ofWedges = ofWedges;
    const bool isDirection =
        (a.meaning == AttributeMeaning::normal || a.meaning == AttributeMeaning::tangent) &&
        a.components >= 3;
    e.kind = isDirection                            ? Entry::Kind::direction
             : !distance.isLinear()                 ? Entry::Kind::labels
             : a.meaning == AttributeMeaning::color ? Entry::Kind::color
                                                    : Entry::Kind::numbers;
    e.first = components_;
    e.count = isDirection ? std::min<std::size_t>(4, a.components) : a.components;
    components_ += e.count;
    entries_.push_back(e);
    sources.push_back({&a, distance, ofWedges});
  };
  for (const Attribute& a : mesh.wedgeAttributes)
    if (mesh.hasWedges()) take(a, true);
  for (const Attribute& a : mesh.vertexAttributes) {
    // Corners say more than vertices.
    const bool isHidden = mesh.hasWedges() && std::ranges::any_of(mesh.wedgeAttributes, [&](const auto& w) {
                            return w.name == a.name;
                          });
    if (!isHidden) take(a, false);
  }
  values_.resize(components_ * drawn);
  for (std::size_t i = 0; i < drawn; ++i)
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      const Source& s = sources[k];
      const std::size_t element = s.ofWedges || !mesh.hasWedges() ? i : vertexOf[i];
      const std::vector<double> numbers = s.distance.drawnValues(*s.attribute, element);
      std::copy_n(numbers.begin(), entries_[k].count,
                  values_.begin() + std::ptrdiff_t(components_ * i + entries_[k].first));
    }
  for (Entry& e : entries_) {
    if (e.kind == Entry::Kind::labels) continue;
    double squares = 0, widest = 0;
    for (std::size_t c = 0; c < e.count; ++c) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t i = 0; i < drawn; ++i) {
        const double x = values_[components_ * i + e.first + c];
        if (!std::isfinite(x)) continue;
        low = std::min(low, x);
        high = std::max(high, x);
      }
      if (!(low < high)) continue;
      squares += (high - low) * (high - low);
      widest = std::max(widest, high - low);
    }
    e.largest = e.kind == Entry::Kind::direction ? 180 : std::min(std::sqrt(squares), 1e36);
    if (e.kind == Entry::Kind::color)
      e.length = kRangeAsPart * diagonal / 255;
    else if (e.kind == Entry::Kind::direction)
      e.length = kRightAngleAsPart * diagonal / 90;
    else if (widest > 0)
      e.length = kRangeAsPart * diagonal / widest;
    const Attribute& a = *sources[std::size_t(&e - entries_.data())].attribute;
    if (a.meaning != AttributeMeaning::textureCoords || e.count < 2) continue;
    double inSpace = 0, inPicture = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Corners& t = faces_[f];
      const auto uv = [&](std::size_t i) {
        const auto v = at(cornersOf(std::uint32_t(f))[i]);
        return Vec3{v[e.first], v[e.first + 1], 0};
      };
      const double covered = areaOf(uv(0), uv(1), uv(2));
      if (!std::isfinite(covered) || !(covered > 0)) continue;
      inPicture += covered;
      inSpace += areaOf(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    }
    if (inPicture > 0) e.length = std::sqrt(inSpace / inPicture);
  }
}

void AttributeField::weigh(std::span<const AttributeWeight> weights, double diagonal) {
  for (Entry& e : entries_) {
    const auto stated = std::ranges::find(weights, e.inFile, &AttributeWeight::attribute);
    const double weight =
        stated == weights.end() || e.kind == Entry::Kind::labels ? 0 : stated->weight * diagonal;
    // Of a channel's range there are 255 units, and a direction's unit is a degree.
    e.length = e.kind == Entry::Kind::color       ? weight / 255
               : e.kind == Entry::Kind::direction ? weight * std::numbers::pi / 180
                                                  : weight;
  }
}

// The chord between two unit vectors is about their angle in radians.
double AttributeField::Entry::weight() const {
  const double unit = kind == Kind::direction ? 180 / std::numbers::pi * length : length;
  return unit * unit;
}

void AttributeField::mean(const Corners& drawn, const std::array<double, 3>& shares,
                          std::span<double> to) const {
  const auto a = at(drawn[0]), b = at(drawn[1]), c = at(drawn[2]);
  // A corner is itself, to the bit, whatever the others are.
  for (std::size_t i = 0; i < 3; ++i)
    if (shares[i] == 1) {
      std::ranges::copy(at(drawn[i]), to.begin());
      return;
    }
  for (std::size_t i = 0; i < components_; ++i)
    to[i] = shares[0] * a[i] + shares[1] * b[i] + shares[2] * c[i];
}

double AttributeField::weighedSquares(std::span<const double> a, std::span<const double> b) const {
  double sum = 0;
  for (const Entry& e : entries_) {
    if (e.length == 0) continue;
    double squares = 0;
    for (std::size_t i = e.first; i < e.first + e.measured(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
    if (std::isfinite(squares)) sum += e.weight() * squares;
  }
  return sum;
}

}  // namespace arete
