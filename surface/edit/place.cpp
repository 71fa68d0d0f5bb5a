// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/place.h"

#include <fmt/format.h>

#include <array>

namespace arete {
namespace {

void turn(Attribute& attribute, const Similarity& placing) {
  const bool isDirection =
      attribute.meaning == AttributeMeaning::normal || attribute.meaning == AttributeMeaning::tangent;
  if (!isDirection || attribute.components < 3) return;
  Attribute turned = emptyLike(attribute);
  turned.values.reserve(attribute.values.size());
  for (std::size_t i = 0; i < attribute.elementCount(); ++i) {
    std::vector<double> numbers = attribute.numbers(i);
    const Vec3 d = placing.direction({numbers[0], numbers[1], numbers[2]});
    numbers[0] = d.x;
    numbers[1] = d.y;
    numbers[2] = d.z;
    turned.append(numbers);
  }
  attribute = std::move(turned);
}

}  // namespace

Status place(SurfaceMesh& mesh, const Similarity& placing) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = placing(mesh.positions[v]);
    if (!isFinite(mesh.positions[v]))
      return failure(ErrorCode::invalidData, "is placed beyond all numbers", fmt::format("vertex {}", v));
  }
  if (placing.axes() == Similarity().axes()) return {};
  for (auto* attributes : {&mesh.vertexAttributes, &mesh.wedgeAttributes, &mesh.triangleAttributes})
    for (Attribute& attribute : *attributes) turn(attribute, placing);
  return {};
}

Similarity withYUp(const Similarity& zUp) {
  const Similarity toZ(std::array{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}}, 1, {});
  return toZ.inverse() * zUp * toZ;
}

}  // namespace arete
