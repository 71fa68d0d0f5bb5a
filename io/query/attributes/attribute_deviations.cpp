// SPDX-License-Identifier: GPL-3.0-or-later
//
// Attributes become numbers at the corners of triangles, whatever elements the files give them to: a GLB
// repeats vertices where an OBJ has corners.
#include "io/query/attributes/attribute_deviations.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/counted.h"
#include "io/query/attributes/attribute_parts.h"
#include "io/query/attributes/chart_parts.h"
#include "io/query/attributes/picture_sizes.h"
#include "surface/attributes/attribute_distance.h"

namespace arete {
namespace {

using Of = NamedAttribute::Of;

bool isName(Of of) {
  return of == Of::materials || of == Of::objects || of == Of::groups;
}

const Attribute& attributeOf(const MeshAttributes& mesh, const NamedAttribute& named) {
  return named.of == Of::vertices ? mesh.vertexAttributes[named.index]
         : named.of == Of::wedges ? mesh.wedgeAttributes[named.index]
                                  : mesh.triangleAttributes[named.index];
}

std::size_t elementOf(const SurfaceMesh& mesh, Of of, std::size_t triangle, std::size_t corner) {
  return of == Of::vertices ? mesh.triangles[triangle][corner]
         : of == Of::wedges ? mesh.wedges[triangle][corner]
                            : triangle;
}

double srgbOf(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// An attribute as numbers at the corners: in its unit, texture coordinates counted from below.
/// @param isToSrgb  linear colours become sRGB; alpha stays
std::vector<double> cornerNumbers(const SurfaceMesh& mesh, const NamedAttribute& named,
                                  std::size_t components, bool isToSrgb) {
  const Attribute& attribute = attributeOf(mesh, named);
  const AttributeDistance distance(attribute);
  std::vector<double> numbers;
  numbers.reserve(3 * components * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<double> values = distance.drawnValues(attribute, elementOf(mesh, named.of, t, i));
      if (attribute.isFromTop && values.size() > 1) values[1] = 1 - values[1];
      if (isToSrgb)
        for (std::size_t c = 0; c < std::min<std::size_t>(3, values.size()); ++c)
          values[c] = 255 * srgbOf(values[c] / 255);
      values.resize(components, 255);  // an alpha that is not stated
      numbers.insert(numbers.end(), values.begin(), values.end());
    }
  return numbers;
}

std::vector<double> nameNumbers(const std::vector<std::uint32_t>& ofTriangle) {
  std::vector<double> numbers;
  for (const std::uint32_t number : ofTriangle) numbers.insert(numbers.end(), 3, number);
  return numbers;
}

NumbersNorm normOf(const AttributeDistance& distance) {
  if (!distance.isLinear()) return NumbersNorm::equality;
  const std::string unit = distance.unit();
  return unit == "255ths"    ? NumbersNorm::largest
         : unit == "degrees" ? NumbersNorm::angle
                             : NumbersNorm::length;
}

/// That of the same elements, else of any.
const NamedAttribute* sameNamed(const std::vector<NamedAttribute>& all, const NamedAttribute& wanted) {
  const NamedAttribute* any = nullptr;
  for (const NamedAttribute& a : all) {
    if (a.name != wanted.name || isName(a.of) != isName(wanted.of)) continue;
    if (a.of == wanted.of) return &a;
    if (!any) any = &a;
  }
  return any;
}

/// Of "texcoord1" 1.
std::uint32_t setOf(std::string_view inFile) {
  std::uint32_t set = 0;
  const std::string_view behind = inFile.substr(std::min(kTexcoordName.size(), inFile.size()));
  std::from_chars(behind.data(), behind.data() + behind.size(), set);
  return set;
}

class Comparison {
 public:
  Comparison(const AttributeSubject& other, const AttributeSubject& source, const AttributeOptions& options)
      : other_(other), source_(source), options_(options), ofOther_(namedAttributes(other.mesh)) {}

  Result<AttributeReport> measure(const RunContext& context) {
    report_.within = options_.within;
    for (const AttributeNumber& asked : options_.expected)
      if (const auto found = findAttributes(source_.mesh, asked.name); !found)
        return failure(found.error().code, found.error().message, "expectAttribute " + found.error().culprit);
    parts_ = partsByName(source_.mesh, other_.mesh);
    ARETE_CHECK(findCharts(context));
    for (const NamedAttribute& named : namedAttributes(source_.mesh)) ARETE_CHECK(add(named));
    if (compared_.empty()) return finish();
    ARETE_TRY(const std::vector<NumbersFound> found,
              measureNearNumbers(shapeOf(other_), shapeOf(source_), compared_,
                                 {.within = options_.within,
                                  .reachesOwn = !options_.isStated,
                                  .samples = options_.samples,
                                  .seed = options_.seed},
                                 context));
    for (std::size_t k = 0; k < found.size(); ++k) report_.attributes[ofCompared_[k]].found = found[k];
    return finish();
  }

 private:
  static const TriangleMesh& shapeOf(const AttributeSubject& s) {
    return s.shape ? *s.shape : s.mesh.shape();
  }

  /// Matches charts, where both meshes have texture coordinates.
  Status findCharts(const RunContext& context) {
    const NamedAttribute* here = nullptr;
    const std::vector<NamedAttribute> all = namedAttributes(source_.mesh);
    for (const NamedAttribute& named : all)
      if (!isName(named.of) && named.of != Of::triangles &&
          attributeOf(source_.mesh, named).name == kTexcoordName)
        here = &named;
    if (!here || source_.mesh.triangles.empty() || other_.mesh.triangles.empty()) return {};
    const NamedAttribute* const there = sameNamed(ofOther_, *here);
    if (!there || attributeOf(source_.mesh, *here).components < 2 ||
        attributeOf(other_.mesh, *there).components < 2 || there->of == Of::triangles)
      return {};
    const auto coordsOf = [](const SurfaceMesh& mesh, const NamedAttribute& named) {
      const std::size_t components = attributeOf(mesh, named).components;
      std::vector<double> numbers = cornerNumbers(mesh, named, components, false), coords;
      for (std::size_t i = 0; i < numbers.size(); i += components)
        coords.insert(coords.end(), {numbers[i], numbers[i + 1]});
      return coords;
    };
    const std::vector<double> coordsHere = coordsOf(source_.mesh, *here),
                              coordsThere = coordsOf(other_.mesh, *there);
    ARETE_TRY(charts_, matchCharts({shapeOf(source_), coordsHere}, {shapeOf(other_), coordsThere}, parts_,
                                   options_.within, context));
    report_.charts = charts_.charts;
    report_.chartsApart = charts_.apart;
    return {};
  }

  const AttributeNumber* expectedOf(const NamedAttribute& named) const {
    for (const AttributeNumber& asked : options_.expected)
      if (asked.name == named.name || asked.name == named.inFile) return &asked;
    return nullptr;
  }

  Status add(const NamedAttribute& named) {
    AttributeDeviation deviation;
    deviation.name = named.name;
    deviation.isEquality = isName(named.of);
    const AttributeNumber* const expected = expectedOf(named);
    if (expected) deviation.expected = expected->number;
    const bool isInPixels = expected && expected->unit == "px";
    const auto refusePixels = [&](std::string message) {
      return failure(ErrorCode::usage, std::move(message), "expectAttribute " + named.name);
    };
    if (isInPixels &&
        (isName(named.of) || attributeOf(source_.mesh, named).meaning != AttributeMeaning::textureCoords))
      return refusePixels("has no pixels: only texture coordinates are counted in px");
    ComparedNumbers numbers;
    const NamedAttribute* const there = sameNamed(ofOther_, named);
    if (isName(named.of)) {
      NumbersForNames names;
      numbers.norm = NumbersNorm::equality;
      numbers.ofSource = nameNumbers(names.of(source_.mesh, named.of));
      if (there) numbers.ofMesh = nameNumbers(names.of(other_.mesh, named.of));
    } else {
      const Attribute& attribute = attributeOf(source_.mesh, named);
      const AttributeDistance distance(attribute);
      numbers.norm = normOf(distance);
      deviation.isEquality = numbers.norm == NumbersNorm::equality;
      deviation.unit = isInPixels ? "pixels" : distance.unit();
      if (there) {
        deviation.notComparable = whyNot(attribute, attributeOf(other_.mesh, *there));
        if (deviation.notComparable.empty()) ARETE_CHECK(fill(numbers, named, *there, isInPixels));
      }
    }
    if (!there) deviation.notComparable = "the first mesh has none";
    if (deviation.notComparable.empty()) {
      if (deviation.expected) numbers.expected = *deviation.expected;
      compared_.push_back(std::move(numbers));
      ofCompared_.push_back(report_.attributes.size());
    }
    report_.attributes.push_back(std::move(deviation));
    return {};
  }

  static std::string whyNot(const Attribute& source, const Attribute& other) {
    const bool isColor = source.meaning == AttributeMeaning::color;
    if (source.meaning != other.meaning) return "has another meaning in the first mesh";
    if (source.components == other.components || isColor) return {};
    return fmt::format("has {} numbers in the first mesh, not {}", other.components, source.components);
  }

  Status fill(ComparedNumbers& numbers, const NamedAttribute& named, const NamedAttribute& there,
              bool isInPixels) {
    const Attribute &from = attributeOf(source_.mesh, named), &to = attributeOf(other_.mesh, there);
    const bool mixesSpaces = from.colorSpace != to.colorSpace && from.meaning == AttributeMeaning::color;
    numbers.components = std::max(from.components, to.components);
    numbers.ofSource = cornerNumbers(source_.mesh, named, numbers.components,
                                     mixesSpaces && from.colorSpace == ColorSpace::linear);
    numbers.ofMesh = cornerNumbers(other_.mesh, there, numbers.components,
                                   mixesSpaces && to.colorSpace == ColorSpace::linear);
    numbers.partOfSource = parts_.ofSource;
    numbers.partOfMesh = parts_.ofOther;
    numbers.chartOfSource = charts_.ofSource;
    numbers.chartOfMesh = charts_.ofOther;
    return isInPixels ? toPixels(numbers, named) : Status();
  }

  /// Pixels of the source's pictures, in the other mesh too: by the names of its materials.
  Status toPixels(ComparedNumbers& numbers, const NamedAttribute& named) {
    ARETE_TRY(const auto sizes, pictureSizesOf(source_.mesh, source_.folder, setOf(named.inFile)));
    const auto sizeOf = [&](std::size_t t) -> std::array<double, 2> {
      const auto& of = source_.mesh.materialOf;
      return of.empty() || of[t] == MeshAttributes::kNone ? std::array<double, 2>{} : sizes[of[t]];
    };
    std::map<std::string, std::array<double, 2>> byName;
    for (std::size_t m = 0; m < sizes.size(); ++m) byName.emplace(source_.mesh.materials[m].name, sizes[m]);
    const auto scale = [&](std::vector<double>& all, std::size_t t, const std::array<double, 2>& size) {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < std::min<std::size_t>(2, numbers.components); ++c)
          all[(3 * t + i) * numbers.components + c] *= size[c];
    };
    std::size_t without = 0;
    std::array<double, 2> any{};
    for (std::size_t t = 0; t < source_.mesh.triangles.size(); ++t) {
      const std::array<double, 2> size = sizeOf(t);
      if (size[0] > 0) {
        any = size;
        scale(numbers.ofSource, t, size);
        continue;
      }
      ++without;
      numbers.partOfSource[t] = ComparedNumbers::kNotCompared;
    }
    if (without == source_.mesh.triangles.size())
      return failure(ErrorCode::usage, "cannot be counted in px: no face of the second mesh has a picture",
                     "expectAttribute " + named.name);
    if (without > 0)
      report_.warnings.push_back(
          {WarningCode::omitted, fmt::format("{} no picture: {} is not compared in pixels there",
                                             counted(without, "face has", "faces have"), named.name)});
    const auto& of = other_.mesh.materialOf;
    for (std::size_t t = 0; t < other_.mesh.triangles.size(); ++t) {
      std::array<double, 2> size = any;
      if (!of.empty() && of[t] != MeshAttributes::kNone)
        if (const auto at = byName.find(other_.mesh.materials[of[t]].name); at != byName.end())
          size = at->second;
      scale(numbers.ofMesh, t, size);
    }
    return {};
  }

  AttributeReport finish() {
    for (AttributeDeviation& a : report_.attributes) {
      if (!a.expected) continue;
      if (!a.notComparable.empty()) {
        a.isKept = false;
        continue;
      }
      double slack = a.unit == "degrees" ? 1e-4 : 0;
      for (std::size_t k = 0; k < compared_.size() && slack == 0; ++k)
        if (&report_.attributes[ofCompared_[k]] == &a)
          for (const auto* numbers : {&compared_[k].ofSource, &compared_[k].ofMesh})
            for (const double x : *numbers)
              if (std::isfinite(x)) slack = std::max(slack, 0x1p-22 * std::abs(x));
      a.isKept = a.found.largest <= *a.expected + slack;  // NaN is not kept
    }
    return std::move(report_);
  }

  const AttributeSubject& other_;
  const AttributeSubject& source_;
  const AttributeOptions& options_;
  std::vector<NamedAttribute> ofOther_;
  AttributeParts parts_;
  ChartMatch charts_;
  std::vector<ComparedNumbers> compared_;
  std::vector<std::size_t> ofCompared_;  // its place in the report
  AttributeReport report_;
};

}  // namespace

Result<AttributeReport> measureAttributes(const AttributeSubject& other, const AttributeSubject& source,
                                          const AttributeOptions& options, const RunContext& context) try {
  ARETE_CHECK(other.mesh.validate());
  ARETE_CHECK(source.mesh.validate());
  return Comparison(other, source, options).measure(context);
} catch (...) {
  return caughtFailure();
}

Status checkAttributes(const AttributeReport& report) try {
  for (const AttributeDeviation& a : report.attributes) {
    if (a.isKept) continue;
    if (!a.notComparable.empty())
      return failure(ErrorCode::brokenPromise, fmt::format("{}: {}", a.name, a.notComparable));
    const Vec3& x = a.found.worst;
    if (std::isinf(a.found.largest))
      return failure(ErrorCode::brokenPromise,
                     fmt::format("{} differs: nothing within {} of {} {} {} of the second mesh has the same",
                                 a.name, report.within, x.x, x.y, x.z));
    return failure(
        ErrorCode::brokenPromise,
        fmt::format("the largest change of {} is {} {}, more than {}: at {} {} {} of the second mesh", a.name,
                    a.found.largest, a.unit, *a.expected, x.x, x.y, x.z));
  }
  return {};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
