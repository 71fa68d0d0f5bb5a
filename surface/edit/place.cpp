// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/place.h"

#include <fmt/format.h>

#include <array>

namespace arete {
namespace {

void turnEach(Attribute& attribute, const std::function<Vec3(const Vec3&)>& turn) {
  const bool isDirection =
      attribute.meaning == AttributeMeaning::normal || attribute.meaning == AttributeMeaning::tangent;
  if (!isDirection || attribute.components < 3) return;
  Attribute turned = emptyLike(attribute);
  turned.values.reserve(attribute.values.size());
  for (std::size_t i = 0; i < attribute.elementCount(); ++i) {
    std::vector<double> numbers = attribute.numbers(i);
    const Vec3 to = turn({numbers[0], numbers[1], numbers[2]});
    numbers[0] = to.x;
    numbers[1] = to.y;
    numbers[2] = to.z;
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
  turnDirections(mesh, [&](const Vec3& d) { return placing.direction(d); });
  return {};
}

void turnDirections(SurfaceMesh& mesh, const std::function<Vec3(const Vec3&)>& turn) {
  for (auto* attributes : {&mesh.vertexAttributes, &mesh.wedgeAttributes, &mesh.triangleAttributes})
    for (Attribute& attribute : *attributes) turnEach(attribute, turn);
}

Similarity withYUp(const Similarity& zUp) {
  const Similarity toZ(std::array{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}}, 1, {});
  return toZ.inverse() * zUp * toZ;
}

}  // namespace arete
