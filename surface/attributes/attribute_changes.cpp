// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/attribute_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/triangle_bvh.h"
#include "surface/attributes/attribute_distance.h"
#include "surface/attributes/attribute_names.h"

namespace arete {
namespace {

using Elements = NamedAttribute::Of;

const std::vector<Attribute>& listOf(const MeshAttributes& mesh, Elements of) {
  return of == Elements::vertices ? mesh.vertexAttributes
         : of == Elements::wedges ? mesh.wedgeAttributes
                                  : mesh.triangleAttributes;
}

bool isOfPart(Elements of) {
  return of == Elements::materials || of == Elements::objects || of == Elements::groups;
}

/// The material, object or group of a face by its name; null: it has none.
const std::string* partNameOf(const MeshAttributes& mesh, Elements of, std::uint32_t face) {
  const auto& numbers = of == Elements::materials ? mesh.materialOf
                        : of == Elements::objects ? mesh.objectOf
                                                  : mesh.groupOf;
  if (numbers.empty() || numbers[face] == MeshAttributes::kNone) return nullptr;
  return of == Elements::materials ? &mesh.materials[numbers[face]].name
         : of == Elements::objects ? &mesh.objects[numbers[face]]
                                   : &mesh.groups[numbers[face]];
}

std::size_t elementAt(const SurfaceMesh& mesh, Elements of, std::size_t triangle, std::size_t corner) {
  return of == Elements::vertices ? mesh.triangles[triangle][corner]
         : of == Elements::wedges ? mesh.wedges[triangle][corner]
                                  : triangle;
}

/// One attribute of the source and that of the result.
class Change {
 public:
  Change(const SurfaceMesh& source, const SurfaceMesh& result, const NamedAttribute& named,
         const Attribute* from, const Attribute* to)
      : source_(source), result_(result), named_(named), from_(from), to_(to) {
    if (!from) return;
    distance_ = {AttributeDistance(*from), AttributeDistance(*to)};
    if (named.of != Elements::triangles) least_.assign(from->elementCount(), kNotSeen);
  }

  void takeFace(std::uint32_t face, std::uint32_t triangle) {
    if (!least_.empty()) return;
    if (!from_) {
      const std::string *a = partNameOf(source_, named_.of, face),
                        *b = partNameOf(result_, named_.of, triangle);
      take((a && b ? *a == *b : a == b) ? 0 : kInfinite);
    } else {
      take(distance_[0](distance_[0].values(*from_, face), distance_[1].values(*to_, triangle)));
    }
  }

  void takeCorner(std::uint32_t face, std::size_t corner, std::uint32_t triangle, const TrianglePoint& at) {
    if (least_.empty()) return;
    const std::size_t element = elementAt(source_, named_.of, face, corner);
    if (least_[element] == 0) return;
    std::vector<double> there(distance_[0].components(), 0);
    if (distance_[0].isLinear()) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (at.shares[i] == 0) continue;
        const auto values = distance_[1].values(*to_, elementAt(result_, named_.of, triangle, i));
        for (std::size_t c = 0; c < there.size(); ++c) there[c] += at.shares[i] * values[c];
      }
    } else {
      const auto heaviest = std::size_t(std::ranges::max_element(at.shares) - at.shares.begin());
      there = distance_[1].values(*to_, elementAt(result_, named_.of, triangle, heaviest));
    }
    const double apart = distance_[0](distance_[0].values(*from_, element), there);
    if (least_[element] == kNotSeen || apart < least_[element]) least_[element] = apart;
  }

  AttributeChange found() {
    for (const double apart : least_)
      if (apart != kNotSeen) take(apart);
    change_.name = named_.name;
    change_.isEquality = !from_ || !distance_[0].isLinear();
    if (from_) change_.unit = distance_[0].unit();
    return change_;
  }

 private:
  static constexpr double kNotSeen = -1, kInfinite = std::numeric_limits<double>::infinity();

  void take(double apart) {
    ++change_.compared;
    change_.unequal += std::isinf(apart);
    change_.largest = std::max(change_.largest, apart);
  }

  const SurfaceMesh& source_;
  const SurfaceMesh& result_;
  NamedAttribute named_;
  const Attribute *from_, *to_;
  std::array<AttributeDistance, 2> distance_{AttributeDistance(Attribute{}), AttributeDistance(Attribute{})};
  std::vector<double> least_;  // by element
  AttributeChange change_;
};

}  // namespace

std::vector<AttributeChange> attributeChanges(const SurfaceMesh& source, const SurfaceMesh& result,
                                              std::span<const std::uint32_t> triangleFor,
                                              std::uint64_t mostVertices) {
  std::vector<Change> changes;
  const std::vector<NamedAttribute> ofResult = namedAttributes(result);
  for (const NamedAttribute& named : namedAttributes(source)) {
    const auto there = std::ranges::find_if(
        ofResult, [&](const NamedAttribute& a) { return a.inFile == named.inFile && a.of == named.of; });
    if (there == ofResult.end()) continue;
    const Attribute *from = nullptr, *to = nullptr;
    if (!isOfPart(named.of)) {
      from = &listOf(source, named.of)[named.index];
      to = &listOf(result, named.of)[there->index];
      if (from->components != to->components || from->meaning != to->meaning) continue;
    }
    changes.emplace_back(source, result, named, from, to);
  }
  if (changes.empty()) return {};
  const std::uint64_t step = std::max<std::uint64_t>(
      1, (source.positions.size() + mostVertices - 1) / std::max<std::uint64_t>(mostVertices, 1));
  for (std::uint32_t face = 0; face < source.triangles.size(); ++face) {
    const std::uint32_t triangle = triangleFor[face];
    if (triangle == MeshAttributes::kNone) continue;
    const auto& t = result.triangles[triangle];
    const auto& corners = source.triangles[face];
    if (corners[0] % step == 0)
      for (Change& change : changes) change.takeFace(face, triangle);
    for (std::size_t i = 0; i < 3; ++i) {
      if (corners[i] % step != 0) continue;
      const TrianglePoint at =
          nearestWithShares(source.positions[corners[i]],
                            {result.positions[t[0]], result.positions[t[1]], result.positions[t[2]]});
      for (Change& change : changes) change.takeCorner(face, i, triangle, at);
    }
  }
  std::vector<AttributeChange> found;
  for (Change& change : changes) found.push_back(change.found());
  return found;
}

}  // namespace arete
