// SPDX-License-Identifier: GPL-3.0-or-later
//
// An attribute is taken by its meaning, name and components; what fits no semantic of the standard becomes
// one of the application, whose name begins with '_'. Sets are numbered anew, since the standard allows no
// gaps. What the standard forbids, validators refuse and viewers draw black, is replaced and said: numbers
// that are none, normals and tangents of other than unit length, colors beyond 0 and 1.
#include "io/formats/glb/writer/vertex_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/common/colors.h"
#include "io/formats/glb/writer/numbers.h"

namespace arete {
namespace {

// Below what validators allow, which is the rounding of 8 bits.
constexpr double kUnitTolerance = 0.005;

/// The number of a set: "texcoord" 0, "texcoord1" 1. Nothing if the name is another.
std::optional<std::uint32_t> setNumberOf(std::string_view name, std::string_view stem) {
  if (!name.starts_with(stem)) return std::nullopt;
  const std::string_view digits = name.substr(stem.size());
  if (digits.empty()) return 0;
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || digits[0] == '0') return std::nullopt;
  return number;
}

// glTF has integers of 8 and 16 bits as attributes of vertices, and no longer ones.
bool isSmallInteger(ScalarType type) {
  return type == ScalarType::int8 || type == ScalarType::uint8 || type == ScalarType::int16 ||
         type == ScalarType::uint16;
}
bool isSigned(ScalarType type) {
  return type == ScalarType::int8 || type == ScalarType::int16;
}

class Converter {
 public:
  Converter(const TriangleMesh& mesh, const std::vector<Float3>& positions, GltfDirections directions)
      : mesh_(mesh), positions_(positions), directions_(directions) {}

  // Each attribute finds its semantic first; what has the right meaning and the wrong number of components
  // becomes one of the application.
  GltfVertexValues convert(std::vector<Attribute> attributes) {
    std::map<std::uint32_t, Attribute*> textureSets, colorSets;
    Attribute *normal = nullptr, *tangent = nullptr;
    std::vector<Attribute*> others;
    for (Attribute& a : attributes) {
      const auto texture = setNumberOf(a.name, kTexcoordName), color = setNumberOf(a.name, kColorName);
      if (a.meaning == AttributeMeaning::normal && a.name == kNormalName && a.components == 3)
        normal = &a;
      else if (a.meaning == AttributeMeaning::tangent && a.name == kTangentName && a.components == 4)
        tangent = &a;
      else if (a.meaning == AttributeMeaning::textureCoords && texture && a.components <= 3)
        textureSets[*texture] = &a;
      else if (a.meaning == AttributeMeaning::color && color && (a.components == 3 || a.components == 4))
        colorSets[*color] = &a;
      else
        others.push_back(&a);
    }
    // Tangents come after the normals, since a tangent without a normal is not allowed.
    const bool hasNormal = normal != nullptr || directions_ == GltfDirections::recomputed;
    if (hasNormal) addNormal(normal);
    if (tangent != nullptr) addTangent(*tangent, hasNormal);
    for (const auto& [set, attribute] : textureSets) {
      const auto number = static_cast<std::uint32_t>(out_.textureSets.size());
      out_.textureSets[set] = number;
      if (set != number) lose("the numbers of sets of texture coordinates");
      addTextureCoords(*attribute, number);
    }
    std::uint32_t number = 0;
    for (const auto& [set, attribute] : colorSets) {
      if (set != number) lose("the numbers of sets of colours");
      addColors(*attribute, number++);
    }
    for (Attribute* attribute : others) addOther(*attribute);
    return std::move(out_);
  }

 private:
  /// A loss is named once, however many vertices it concerns.
  void lose(std::string what) {
    if (std::ranges::find(out_.lost, what) == out_.lost.end()) out_.lost.push_back(std::move(what));
  }

  void add(std::string semantic, Attribute& values, bool isQuantized = false, std::string name = {}) {
    const bool isHeld = isFloat(values.type);
    if (const std::size_t bad = isHeld ? makeFinite(values) : 0; bad > 0)
      lose(fmt::format("the numbers of {} that are not finite ({} become 0)", text::quotedToken(values.name),
                       bad));
    out_.values.push_back({std::move(semantic), std::move(name), std::move(values), isQuantized});
  }

  /// As 32-bit floats.
  void makeFloats(Attribute& a, const char* what) {
    if (!makeFloat32(a)) lose(fmt::format("{} finer than 32-bit floats", what));
  }

  const std::vector<Float3>& computedNormals() {
    if (computed_.empty()) computed_ = normalsOf(mesh_, positions_);
    return computed_;
  }

  void addNormal(Attribute* given) {
    if (directions_ == GltfDirections::recomputed) {
      if (given != nullptr) lose("normals of its own (they are computed)");
      Attribute computed{
          .name = std::string(kNormalName), .meaning = AttributeMeaning::normal, .components = 3};
      for (const Float3& n : computedNormals()) {
        const auto* const bytes = reinterpret_cast<const std::byte*>(n.data());
        computed.append(std::span(bytes, sizeof n));
      }
      return add("NORMAL", computed);
    }
    const bool isQuantized = isSigned(given->type) && given->isNormalized;
    turn(*given);
    if (!isQuantized) {
      if (!isFloat(given->type)) given->isNormalized = false;
      makeFloats(*given, "normals");
      makeUnits(*given, "normals");
    }
    add("NORMAL", *given, isQuantized);
  }

  void addTangent(Attribute& tangent, bool hasNormal) {
    if (!hasNormal || directions_ == GltfDirections::recomputed) {
      out_.leftOut.insert(tangent.name);
      return;
    }
    const bool isQuantized = isSigned(tangent.type) && tangent.isNormalized;
    turn(tangent);
    if (!isQuantized) {
      if (!isFloat(tangent.type)) tangent.isNormalized = false;
      makeFloats(tangent, "tangents");
      makeUnits(tangent, "tangents");
      for (std::size_t n = 3; n < numberCount(tangent); n += 4)
        if (const double sign = numberAt(tangent, n); std::abs(sign) != 1) {
          setNumber(tangent, n, sign < 0 ? -1 : 1);
          lose("signs of tangents other than 1 and -1");
        }
    }
    add("TANGENT", tangent, isQuantized);
  }

  /// z up to y up: (x, y, z) becomes (x, z, -y).
  void turn(Attribute& a) const {
    if (directions_ != GltfDirections::turned) return;
    for (std::size_t n = 0; n < numberCount(a); n += a.components) {
      const double y = numberAt(a, n + 1), z = numberAt(a, n + 2);
      setNumber(a, n + 1, z);
      setNumber(a, n + 2, -y);
    }
  }

  /// Vectors within the tolerance stay to the bit.
  void makeUnits(Attribute& a, const char* what) {
    std::size_t scaled = 0, replaced = 0;
    for (std::size_t i = 0; i < a.elementCount(); ++i) {
      const std::size_t n = i * a.components;
      const Vec3 v{numberAt(a, n), numberAt(a, n + 1), numberAt(a, n + 2)};
      const double length = std::hypot(v.x, v.y, v.z);
      if (std::abs(length - 1) <= kUnitTolerance) continue;
      Vec3 unit{v.x / length, v.y / length, v.z / length};
      if (length > 0 && std::isfinite(length)) {
        ++scaled;
      } else {
        ++replaced;
        const Float3& normal = computedNormals()[i];
        unit = {double{normal[0]}, double{normal[1]}, double{normal[2]}};
        if (a.components == 4) unit = std::abs(unit.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
      }
      setNumber(a, n, unit.x);
      setNumber(a, n + 1, unit.y);
      setNumber(a, n + 2, unit.z);
    }
    if (scaled > 0) lose(fmt::format("{} of other than unit length ({} are scaled)", what, scaled));
    if (replaced > 0) lose(fmt::format("{} without a direction ({} are replaced)", what, replaced));
  }

  void addTextureCoords(Attribute& a, std::uint32_t set) {
    const bool isFromTop = a.isFromTop;
    if (a.components != 2) a = twoComponents(a);
    const bool isPlain = (a.type == ScalarType::uint8 || a.type == ScalarType::uint16) && a.isNormalized;
    const bool isQuantized = isSmallInteger(a.type) && !isPlain && isFromTop;
    // Floats from the lower side are rounded once, when they are flipped.
    if (!isPlain && !isQuantized && (isFromTop || !isFloat(a.type))) makeFloats(a, "texture coordinates");
    if (!isFromTop) flip(a);
    a.isFromTop = true;
    add(fmt::format("TEXCOORD_{}", set), a, isQuantized);
  }

  Attribute twoComponents(const Attribute& a) {
    Attribute two = emptyLike(a);
    two.components = 2;
    bool isLost = false;
    for (std::size_t i = 0; i < a.elementCount(); ++i) {
      std::vector<double> numbers = a.numbers(i);
      isLost = isLost || (numbers.size() > 2 && numbers[2] != 0);
      numbers.resize(2);
      two.append(numbers);
    }
    if (a.components == 1) lose("texture coordinates of one number (the second becomes 0)");
    if (isLost) lose("third texture coordinates");
    return two;
  }

  /// v becomes 1 - v; exact for integers, else computed in doubles and rounded once.
  void flip(Attribute& a) {
    if (!isFloat(a.type)) {
      const double most = a.type == ScalarType::uint8 ? 255 : 65535;
      for (std::size_t n = 1; n < numberCount(a); n += 2) setNumber(a, n, most - numberAt(a, n));
      return;
    }
    Attribute to = emptyLike(a);
    to.type = ScalarType::float32;
    to.values.resize(numberCount(a) * sizeof(float));
    bool isExact = true;
    for (std::size_t n = 0; n < numberCount(a); ++n) {
      const double number = numberAt(a, n);
      setNumber(to, n, n % 2 == 0 ? number : 1 - number);
      double back = n % 2 == 0 ? numberAt(to, n) : 1 - numberAt(to, n);
      if (a.type == ScalarType::float32) back = double{static_cast<float>(back)};
      isExact = isExact && (back == number || !std::isfinite(number));
    }
    if (!isExact) lose("texture coordinates finer than 32-bit floats");
    a = std::move(to);
  }

  void addColors(Attribute& a, std::uint32_t set) {
    const bool isLinear = a.colorSpace == ColorSpace::linear;
    const bool isByte = a.type == ScalarType::uint8, isShort = a.type == ScalarType::uint16;
    for (std::size_t i = 0; i < a.elementCount() && !(isByte || isShort); ++i)
      for (const double fraction : colorFractions(a, i))
        if (!(fraction >= 0 && fraction <= 1)) lose("colours below 0 or above 1");
    if (isByte && !isLinear) {
      a = toLinear16(a);
    } else if (!(isLinear && (isByte || isShort))) {
      Attribute linear = toLinear32(a);
      if (!areKept(a, linear)) lose("colours finer than linear 32-bit floats");
      a = std::move(linear);
    } else {
      a.isNormalized = true;
    }
    add(fmt::format("COLOR_{}", set), a);
  }

  /// Whether the colors come back from linear ones in their own type.
  static bool areKept(const Attribute& a, const Attribute& linear) {
    const bool isLinear = a.colorSpace == ColorSpace::linear;
    Attribute back = emptyLike(a);
    const double scale = a.type == ScalarType::uint16 ? 65535 : 1;
    for (std::size_t i = 0; i < a.elementCount(); ++i) {
      std::vector<double> numbers = linear.numbers(i);
      for (std::size_t k = 0; k < numbers.size(); ++k)
        numbers[k] = scale * (isLinear || k == 3 ? numbers[k] : srgbOfLinear(numbers[k]));
      back.append(numbers);
    }
    return isFloat(a.type) || a.type == ScalarType::uint16 ? back.values == a.values : false;
  }

  void addOther(Attribute& a) {
    const bool isMatrix = a.components == 9 || a.components == 16;
    const std::string name = a.name;
    const auto leaveOut = [&] { out_.leftOut.insert(name); };
    if (a.components > 4 && !isMatrix) return leaveOut();
    const bool isWide = a.type == ScalarType::int32 || a.type == ScalarType::uint32;
    if (isWide && (a.isNormalized || !makeSmaller(a))) return leaveOut();
    if (a.type == ScalarType::float64) makeFloats(a, text::quotedToken(name).c_str());
    if (isMatrix && sizeOf(a.type) != 4) return leaveOut();
    std::string semantic = name.starts_with('_') ? name : "_" + name;
    while (std::ranges::find(out_.values, semantic, &GltfValues::semantic) != out_.values.end())
      semantic.insert(0, "_");
    add(semantic, a, false, semantic == name ? std::string() : name);
  }

  const TriangleMesh& mesh_;
  const std::vector<Float3>& positions_;
  GltfDirections directions_;
  std::vector<Float3> computed_;
  GltfVertexValues out_;
};

}  // namespace

GltfVertexValues gltfVertexValues(std::vector<Attribute> attributes, const TriangleMesh& mesh,
                                  const std::vector<Float3>& positions, GltfDirections directions) {
  return Converter(mesh, positions, directions).convert(std::move(attributes));
}

}  // namespace arete
