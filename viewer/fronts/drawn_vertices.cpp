// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/drawn_vertices.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/formats/common/colors.h"
#include "viewer/fronts/shading_normals.h"

namespace arete {
namespace {

/// By drawn vertex: the vertex of the MT.
std::vector<std::uint32_t> verticesOfDrawn(const SurfaceModel& model) {
  const MultiTriangulation& mt = model.mt;
  std::vector<std::uint32_t> vertexOf(model.hasWedges() ? model.attributes.wedgeCount : mt.vertexCount());
  if (!model.hasWedges()) {
    for (std::uint32_t v = 0; v < vertexOf.size(); ++v) vertexOf[v] = v;
    return vertexOf;
  }
  for (std::uint32_t t = 0; t < model.wedgesOf.size(); ++t) {
    const NodeId creator = mt.creator(TriangleId(t));
    if (creator.isValid() && mt.remover(TriangleId(t)) == creator) continue;  // a slot that is no triangle
    const auto corners = mt.corners(TriangleId(t), creator);
    for (std::size_t i = 0; i < 3; ++i) vertexOf[model.wedgesOf[t][i]] = corners[i];
  }
  return vertexOf;
}

/// An attribute of drawn vertices: the wedges' own, or that of their vertices.
class DrawnAttribute {
 public:
  DrawnAttribute(const SurfaceModel& model, const std::vector<std::uint32_t>& vertexOf, std::string_view name,
                 AttributeMeaning meaning)
      : vertexOf_(vertexOf) {
    const auto find = [&](const std::vector<Attribute>& list) -> const Attribute* {
      for (const Attribute& a : list)
        if (a.meaning == meaning && a.name == name) return &a;
      return nullptr;
    };
    if (model.hasWedges()) attribute_ = find(model.attributes.wedgeAttributes);
    isOfWedges_ = attribute_ != nullptr;
    if (!attribute_) attribute_ = find(model.attributes.vertexAttributes);
  }
  explicit operator bool() const { return attribute_ != nullptr; }
  const Attribute& attribute() const { return *attribute_; }
  std::size_t elementOf(std::size_t drawn) const { return isOfWedges_ ? drawn : vertexOf_[drawn]; }

 private:
  const std::vector<std::uint32_t>& vertexOf_;
  const Attribute* attribute_ = nullptr;
  bool isOfWedges_ = false;
};

/// Integers of normals and texture coordinates stand for fractions.
double scaleOf(const Attribute& a) {
  if (!a.isNormalized) return 1;
  const bool isSigned = a.type == ScalarType::int8 || a.type == ScalarType::int16;
  return 1 / (std::exp2(8 * double(sizeOf(a.type)) - (isSigned ? 1 : 0)) - 1);
}

struct DrawnNormals {
  std::vector<float> stated, smooth;  // smooth: empty where no other ones are stated
};

DrawnNormals normalsOf(const SurfaceModel& model, const ZUpFrame& upright,
                       const std::vector<std::uint32_t>& vertexOf) {
  const std::vector<Vec3> own = shadingNormals(model);
  const DrawnAttribute stated(model, vertexOf, kNormalName, AttributeMeaning::normal);
  const bool isStated = stated && stated.attribute().components >= 3;
  DrawnNormals normals;
  const auto add = [&](std::vector<float>& to, const Vec3& normal) {
    const Vec3 n = upright.turned(normal);
    to.insert(to.end(), {float(n.x), float(n.y), float(n.z)});
  };
  for (std::size_t i = 0; i < vertexOf.size(); ++i) {
    Vec3 n = own[vertexOf[i]];
    if (isStated) {
      add(normals.smooth, n);
      const std::vector<double> numbers = stated.attribute().numbers(stated.elementOf(i));
      const Vec3 said{numbers[0], numbers[1], numbers[2]};
      const double length = norm(said);
      if (std::isfinite(length) && length > 0) n = said / length;
    }
    add(normals.stated, n);
  }
  return normals;
}

std::vector<float> textureCoordsOf(const SurfaceModel& model, const std::vector<std::uint32_t>& vertexOf) {
  std::vector<float> coords;
  for (const std::size_t set : {0u, 1u}) {
    const std::string name = std::string(kTexcoordName) + (set == 0 ? "" : std::to_string(set));
    const DrawnAttribute stated(model, vertexOf, name, AttributeMeaning::textureCoords);
    if (!stated || stated.attribute().components < 2) continue;
    coords.resize(4 * vertexOf.size(), 0);
    const double scale = scaleOf(stated.attribute());
    for (std::size_t i = 0; i < vertexOf.size(); ++i) {
      const std::vector<double> numbers = stated.attribute().numbers(stated.elementOf(i));
      const double v = numbers[1] * scale;
      coords[4 * i + 2 * set] = float(numbers[0] * scale);
      coords[4 * i + 2 * set + 1] = float(stated.attribute().isFromTop ? v : 1 - v);
    }
  }
  return coords;
}

std::vector<std::uint8_t> colorsOf(const SurfaceModel& model, const std::vector<std::uint32_t>& vertexOf) {
  const DrawnAttribute stated(model, vertexOf, kColorName, AttributeMeaning::color);
  if (!stated) return {};
  bool isRounded = false;
  const Attribute bytes = toSrgb8(stated.attribute(), isRounded);
  std::vector<std::uint8_t> colors;
  colors.reserve(4 * vertexOf.size());
  for (std::size_t i = 0; i < vertexOf.size(); ++i) {
    const auto element = bytes.element(stated.elementOf(i));
    for (std::size_t c = 0; c < 4; ++c) {
      // Grey has one number, and perhaps alpha.
      const bool isGrey = element.size() < 3;
      const std::size_t from = !isGrey ? c : c < 3 ? 0 : 1;
      colors.push_back(from < element.size() ? static_cast<std::uint8_t>(element[from]) : 255);
    }
  }
  return colors;
}

}  // namespace

std::vector<Vec3> drawnPlaces(const SurfaceModel& model) {
  std::vector<Vec3> places;
  for (const std::uint32_t v : verticesOfDrawn(model)) places.push_back(model.mt.position(VertexId(v)));
  return places;
}

DrawnVertices drawnVertices(const SurfaceModel& model, const ZUpFrame& upright,
                            std::vector<std::uint8_t> colors) {
  const std::vector<std::uint32_t> vertexOf = verticesOfDrawn(model);
  DrawnVertices drawn;
  drawn.positions.reserve(3 * vertexOf.size());
  for (const std::uint32_t v : vertexOf) {
    const Vec3 p = upright.fromFile(model.mt.position(VertexId(v)));
    drawn.positions.insert(drawn.positions.end(), {float(p.x), float(p.y), float(p.z)});
  }
  DrawnNormals normals = normalsOf(model, upright, vertexOf);
  drawn.normals = std::move(normals.stated);
  drawn.smoothNormals = std::move(normals.smooth);
  drawn.textureCoords = textureCoordsOf(model, vertexOf);
  drawn.colors = colors.empty() ? colorsOf(model, vertexOf) : std::move(colors);
  return drawn;
}

}  // namespace arete
