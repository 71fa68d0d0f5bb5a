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

/// One attribute, of the source and of the result.
class Change {
 public:
  Change(const MeshAttributes& source, const SurfaceMesh& result, const NamedAttribute& named,
         const Attribute* from, const Attribute* to)
      : source_(source), result_(result), named_(named), from_(from), to_(to) {
    if (from) distance_ = {AttributeDistance(*from), AttributeDistance(*to)};
  }

  /// @param at of the triangle: nearest to the middle of the face
  void take(const ComparedFace& face, const TrianglePoint& at) {
    if (!from_) {
      const std::string* const a = partNameOf(source_, named_.of, face.face);
      const std::string* const b = partNameOf(result_, named_.of, face.triangle);
      take((a && b ? *a == *b : a == b) ? 0 : kInfinite);
    } else if (named_.of == Elements::triangles) {
      take(distance_[0](from(face.face), to(face.triangle)));
    } else {
      take(atCorners(
          named_.of == Elements::vertices ? face.vertices : face.wedges,
          named_.of == Elements::vertices ? result_.triangles[face.triangle] : result_.wedges[face.triangle],
          at));
    }
  }

  AttributeChange found() {
    change_.name = named_.name;
    change_.isEquality = !from_ || !distance_[0].isLinear();
    if (from_) change_.unit = distance_[0].unit();
    return change_;
  }

 private:
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  std::vector<double> from(std::size_t element) const { return distance_[0].drawnValues(*from_, element); }
  std::vector<double> to(std::size_t element) const { return distance_[1].drawnValues(*to_, element); }

  double atCorners(const std::array<std::uint32_t, 3>& here, const std::array<std::uint32_t, 3>& there,
                   const TrianglePoint& at) const {
    if (!distance_[0].isLinear()) {
      // Any corner's label counts.
      const auto heaviest = std::size_t(std::ranges::max_element(at.shares) - at.shares.begin());
      double least = kInfinite;
      for (const std::uint32_t corner : here)
        least = std::min(least, distance_[0](from(corner), to(there[heaviest])));
      return least;
    }
    // A mean of equal numbers is that number, to the bit.
    std::vector<double> mean = from(here[0]), found = to(there[0]);
    const std::vector<double> first = mean, second = found;
    for (const std::size_t i : {1u, 2u}) {
      const std::vector<double> a = from(here[i]), b = to(there[i]);
      for (std::size_t c = 0; c < mean.size(); ++c) {
        mean[c] += (a[c] - first[c]) / 3;
        if (at.shares[i] != 0) found[c] += at.shares[i] * (b[c] - second[c]);
      }
    }
    return distance_[0](mean, found);
  }

  void take(double apart) {
    ++change_.compared;
    change_.unequal += std::isinf(apart);
    change_.largest = std::max(change_.largest, apart);
  }

  const MeshAttributes& source_;
  const SurfaceMesh& result_;
  NamedAttribute named_;
  const Attribute *from_, *to_;
  std::array<AttributeDistance, 2> distance_{AttributeDistance(Attribute{}), AttributeDistance(Attribute{})};
  AttributeChange change_;
};

}  // namespace

std::vector<AttributeChange> attributeChanges(const MeshAttributes& source, const SurfaceMesh& result,
                                              std::span<const ComparedFace> faces) {
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
  std::vector<AttributeChange> found;
  if (changes.empty()) return found;
  for (const ComparedFace& face : faces) {
    const auto& t = result.triangles[face.triangle];
    const TrianglePoint at = nearestWithShares(
        face.middle, {result.positions[t[0]], result.positions[t[1]], result.positions[t[2]]});
    for (Change& change : changes) change.take(face, at);
  }
  for (Change& change : changes) found.push_back(change.found());
  return found;
}

std::vector<AttributeChange> attributeChanges(const SurfaceMesh& source, const SurfaceMesh& result,
                                              std::span<const std::uint32_t> triangleFor,
                                              std::uint64_t mostFaces) {
  if (namedAttributes(source).empty()) return {};
  std::vector<ComparedFace> faces;
  const std::uint64_t step = source.triangles.size() / std::max<std::uint64_t>(mostFaces, 1) + 1;
  for (std::uint64_t f = 0; f < source.triangles.size(); f += step) {
    if (triangleFor[f] == MeshAttributes::kNone) continue;
    const auto& v = source.triangles[f];
    faces.push_back({.vertices = v,
                     .wedges = source.hasWedges() ? source.wedges[f] : v,
                     .face = static_cast<std::uint32_t>(f),
                     .middle = (source.positions[v[0]] + source.positions[v[1]] + source.positions[v[2]]) / 3,
                     .triangle = triangleFor[f]});
  }
  return attributeChanges(source, result, faces);
}

}  // namespace arete
