// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wedges are looked up by vertex and source wedge: corners of one vertex whose
// sources had one wedge share one again. A corner that is no corner of its
// source gets a wedge of its own for each source triangle: its averages hold
// there alone.
#include "surface/model/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "surface/model/average.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

using Weights = std::array<double, 3>;

/// The weights of the corners of a triangle at a point of its plane:
/// barycentric coordinates, held within [0, 1].
Weights weightsAt(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a);
  const double area = dot(normal, normal);
  Weights w{};
  if (area > 0) {
    w = {dot(normal, cross(b - p, c - p)) / area, dot(normal, cross(c - p, a - p)) / area, 0};
    w[2] = 1 - w[0] - w[1];
  } else {  // a triangle without area: the nearest corner
    const std::array<double, 3> apart = {norm(p - a), norm(p - b), norm(p - c)};
    w[std::size_t(std::ranges::min_element(apart) - apart.begin())] = 1;
  }
  double sum = 0;
  for (double& x : w) sum += x = std::clamp(x, 0.0, 1.0);
  for (double& x : w) x /= sum;
  return w;
}

class Transfer {
 public:
  Transfer(const SurfaceMesh& source, TriangleMesh shape, std::span<const std::uint32_t> vertexOf,
           std::span<const std::uint32_t> triangleOf)
      : source_(source), vertexOf_(vertexOf), triangleOf_(triangleOf) {
    result_.shape() = std::move(shape);
    result_.objects = source.objects;
    result_.groups = source.groups;
    result_.materials = source.materials;
    result_.pictures = source.pictures;
  }

  // Vertices and triangles have one source each, so their attributes are copied. A triangle without a source
  // gets zeros.
  SurfaceMesh run() {
    for (const Attribute& attribute : source_.vertexAttributes) {
      Attribute& to = result_.vertexAttributes.emplace_back(emptyLike(attribute));
      for (const std::uint32_t v : vertexOf_) to.append(attribute.element(v));
    }
    for (const Attribute& attribute : source_.triangleAttributes) {
      Attribute& to = result_.triangleAttributes.emplace_back(emptyLike(attribute));
      const std::vector<std::byte> zeros(attribute.elementBytes(), std::byte{0});
      for (const std::uint32_t t : triangleOf_)
        to.append(t == SurfaceMesh::kNone ? std::span<const std::byte>(zeros) : attribute.element(t));
    }
    carry(source_.objectOf, result_.objectOf);
    carry(source_.groupOf, result_.groupOf);
    carry(source_.materialOf, result_.materialOf);
    if (source_.faceOf.empty())
      result_.faceOf.assign(triangleOf_.begin(), triangleOf_.end());
    else
      carry(source_.faceOf, result_.faceOf);
    if (source_.hasWedges()) carryWedges();
    return std::move(result_);
  }

 private:
  void carry(const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to) const {
    if (from.empty()) return;
    for (const std::uint32_t t : triangleOf_)
      to.push_back(t == SurfaceMesh::kNone ? SurfaceMesh::kNone : from[t]);
  }

  // Triangles with a source come first: a filling triangle takes, at each vertex, a wedge that is there
  // already, and gets zeros only where its vertex has none.
  void carryWedges() {
    for (const Attribute& attribute : source_.wedgeAttributes) {
      result_.wedgeAttributes.push_back(emptyLike(attribute));
      areLabels_.push_back(isLabel(attribute));
    }
    result_.wedges.resize(result_.triangles.size());
    std::vector<std::uint32_t> anyWedge(result_.positions.size(), SurfaceMesh::kNone);
    for (const bool isFilling : {false, true})
      for (std::size_t t = 0; t < result_.wedges.size(); ++t) {
        if ((triangleOf_[t] == SurfaceMesh::kNone) != isFilling) continue;
        for (std::size_t i = 0; i < 3; ++i) {
          std::uint32_t& any = anyWedge[result_.triangles[t][i]];
          if (isFilling && any == SurfaceMesh::kNone) any = addZeros();
          result_.wedges[t][i] = isFilling ? any : wedgeAt(t, i);
          if (any == SurfaceMesh::kNone) any = result_.wedges[t][i];
        }
      }
  }

  /// A vertex that only filling triangles use gets a wedge of zeros.
  std::uint32_t addZeros() {
    for (Attribute& to : result_.wedgeAttributes) {
      const std::vector<std::byte> zeros(to.elementBytes(), std::byte{0});
      to.append(std::span<const std::byte>(zeros));
    }
    return result_.wedgeCount++;
  }

  std::uint32_t wedgeAt(std::size_t triangle, std::size_t corner) {
    const std::uint32_t vertex = result_.triangles[triangle][corner], from = triangleOf_[triangle];
    const Vec3& p = result_.positions[vertex];
    const auto& corners = source_.triangles[from];
    // The vertex itself, else a corner at its position.
    std::optional<std::size_t> same;
    for (std::size_t i = 0; i < 3; ++i)
      if (corners[i] == vertexOf_[vertex]) same = i;
    for (std::size_t i = 0; i < 3 && !same; ++i)
      if (source_.positions[corners[i]] == p) same = i;
    const std::uint32_t key = same ? source_.wedges[from][*same] : source_.wedgeCount + from;
    const auto [found, isNew] = wedgeOf_.try_emplace({vertex, key}, result_.wedgeCount);
    if (!isNew) return found->second;
    for (std::size_t a = 0; a < result_.wedgeAttributes.size(); ++a) {
      const Attribute& attribute = source_.wedgeAttributes[a];
      if (same) {
        result_.wedgeAttributes[a].append(attribute.element(key));
      } else {
        const auto& at = source_.positions;
        appendAverage(result_.wedgeAttributes[a], attribute, source_.wedges[from],
                      weightsAt(p, at[corners[0]], at[corners[1]], at[corners[2]]), areLabels_[a]);
      }
    }
    return result_.wedgeCount++;
  }

  const SurfaceMesh& source_;
  std::span<const std::uint32_t> vertexOf_, triangleOf_;
  SurfaceMesh result_;
  std::vector<bool> areLabels_;  // by attribute of wedges
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> wedgeOf_;
};

}  // namespace

Result<SurfaceMesh> transferAttributes(const SurfaceMesh& source, TriangleMesh shape,
                                       std::span<const std::uint32_t> vertexOf,
                                       std::span<const std::uint32_t> triangleOf) try {
  ARETE_CHECK(source.validate());
  ARETE_CHECK(shape.validate());
  const auto isWithin = [](std::span<const std::uint32_t> numbers, std::size_t count, bool mayBeNone) {
    return std::ranges::all_of(
        numbers, [&](std::uint32_t n) { return n < count || (mayBeNone && n == SurfaceMesh::kNone); });
  };
  if (vertexOf.size() != shape.positions.size() || triangleOf.size() != shape.triangles.size() ||
      !isWithin(vertexOf, source.positions.size(), false) ||
      !isWithin(triangleOf, source.triangles.size(), true))
    return failure(ErrorCode::invalidData, "the sources of vertices and triangles do not fit the meshes");
  return Transfer(source, std::move(shape), vertexOf, triangleOf).run();
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
