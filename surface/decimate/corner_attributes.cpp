// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/corner_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "surface/model/labels.h"
#include "surface/model/parts.h"

namespace arete {
namespace {

/// The corner 3 t + c of a triangle that is at one of its vertices.
std::uint32_t cornerAt(const ContractionMesh& mesh, std::uint32_t t, std::uint32_t v) {
  const auto& corners = mesh.corners(t);
  return 3 * t + static_cast<std::uint32_t>(std::ranges::find(corners, v) - corners.begin());
}

bool isDirection(const Attribute& attribute) {
  return attribute.meaning == AttributeMeaning::normal || attribute.meaning == AttributeMeaning::tangent;
}

}  // namespace

CornerAttributes::Records::Records(const std::vector<Attribute>& all, std::size_t elements,
                                   const DecimateOptions& options, double diagonal)
    : attributes(continuousOnes(all)),
      values(attributes.size()),
      isAveraged(elements, 0),
      channels(attributes, options.attributeWeights, diagonal) {}

double CornerAttributes::Records::number(std::size_t channel, std::uint32_t element) const {
  const std::size_t a = channels.attributeOf(channel);
  return values[a][element * attributes[a]->components + channels.componentOf(channel)];
}

void CornerAttributes::Records::addTriangle(const std::array<Vec3, 3>& places, double weight,
                                            const std::array<std::uint32_t, 3>& elements) {
  const AttributeQuadric quadric = channels.ofTriangle(
      places, weight,
      [&](std::size_t channel, std::size_t corner) { return number(channel, elements[corner]); });
  for (const std::uint32_t e : elements) quadrics[e] += quadric;
}

AttributeQuadric CornerAttributes::Records::sum(std::span<const std::uint32_t> elements) const {
  AttributeQuadric all;
  for (const std::uint32_t e : elements) all += quadrics[e];
  return all;
}

double CornerAttributes::Records::gap(std::span<const std::uint32_t> elements, const Vec3& place) const {
  const AttributeQuadric all = sum(elements);
  double gap = 0;
  for (std::size_t k = 0; k < all.channels.size(); ++k)
    gap += channels.gap(all, k, place, number(k, elements[0]));
  return gap;
}

void CornerAttributes::Records::join(std::span<const std::uint32_t> elements) {
  if (quadrics.empty()) return;
  for (const std::uint32_t e : elements.subspan(1)) quadrics[elements[0]] += quadrics[e];
}

void CornerAttributes::Records::solve(std::uint32_t element, const Vec3& place) {
  if (quadrics.empty()) return;
  const AttributeQuadric& quadric = quadrics[element];
  isAveraged[element] = 1;
  for (std::size_t k = 0; k < quadric.channels.size(); ++k) {
    if (!(quadric.channels[k].weight > 0)) continue;
    const std::size_t a = channels.attributeOf(k);
    const std::size_t at = element * attributes[a]->components + channels.componentOf(k);
    const double best = AttributeChannels::best(quadric.channels[k], place, !isDirection(*attributes[a]));
    if (std::isfinite(best)) values[a][at] = best;
  }
  for (std::size_t a = 0; a < attributes.size(); ++a) makeUnit(a, element);
}

void CornerAttributes::Records::makeUnit(std::size_t a, std::uint32_t element) {
  if (!isDirection(*attributes[a])) return;
  const std::size_t n = attributes[a]->components, first = element * n, count = std::min<std::size_t>(n, 3);
  double size = 0;
  for (std::size_t k = 0; k < count; ++k) size += values[a][first + k] * values[a][first + k];
  // Integers stand for fractions of their largest value.
  const Attribute& attribute = *attributes[a];
  const double whole = isFloat(attribute.type) ? 1 : std::exp2(8 * double(sizeOf(attribute.type)) - 1) - 1;
  if (attribute.meaning == AttributeMeaning::tangent && n > 3)
    values[a][first + 3] = values[a][first + 3] < 0 ? -whole : whole;
  if (!(size > 0)) return;
  for (std::size_t k = 0; k < count; ++k) values[a][first + k] *= whole / std::sqrt(size);
}

void CornerAttributes::Records::average(std::span<const std::uint32_t> elements,
                                        std::span<const double> weights) {
  isAveraged[elements[0]] = 1;
  for (std::size_t a = 0; a < attributes.size(); ++a) {
    const std::size_t n = attributes[a]->components;
    for (std::size_t k = 0; k < n; ++k) {
      double sum = 0;
      for (std::size_t i = 0; i < elements.size(); ++i) sum += weights[i] * values[a][elements[i] * n + k];
      values[a][elements[0] * n + k] = sum;
    }
    // The average of directions is shorter than they are, so it becomes a unit vector again unless they
    // cancel out.
    makeUnit(a, elements[0]);
  }
}

Attribute CornerAttributes::Records::taken(const Attribute& attribute,
                                           std::span<const std::uint32_t> elements) const {
  Attribute result = emptyLike(attribute);
  const auto found = std::ranges::find(attributes, &attribute);
  const std::size_t n = attribute.components;
  // What no contraction has averaged is copied as it is, without a detour through doubles.
  for (const std::uint32_t e : elements) {
    if (found != attributes.end() && isAveraged[e] != 0) {
      const auto& numbers = values[static_cast<std::size_t>(found - attributes.begin())];
      result.append(std::span(numbers).subspan(e * n, n));
    } else {
      result.append(attribute.element(e));
    }
  }
  return result;
}

CornerAttributes::CornerAttributes(const SurfaceMesh& mesh, const TriangleMesh& shape,
                                   const DecimateOptions& options)
    : partOf_(partsOf(mesh, mesh.triangles.size())),
      hasClasses_(mesh.hasWedges() || !partOf_.empty()),
      ofVertices_(mesh.vertexAttributes, mesh.positions.size(), options, diagonalOf(mesh)),
      ofClasses_(mesh.wedgeAttributes, 0, options, diagonalOf(mesh)) {
  const auto numbersOf = [](const Attribute& attribute, std::uint32_t element, std::vector<double>& to) {
    const std::vector<double> numbers = attribute.numbers(element);
    to.insert(to.end(), numbers.begin(), numbers.end());
  };
  for (std::size_t a = 0; a < ofVertices_.attributes.size(); ++a)
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
      numbersOf(*ofVertices_.attributes[a], v, ofVertices_.values[a]);
  const auto addAll = [&](Records& records, std::size_t elements, const auto& elementsOf) {
    if (records.attributes.empty()) return;
    records.quadrics.resize(elements);
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
      const auto& [i, j, k] = shape.triangles[t];
      const std::array<Vec3, 3> places = {shape.positions[i], shape.positions[j], shape.positions[k]};
      const double size = norm(cross(places[1] - places[0], places[2] - places[0]));
      records.addTriangle(places, options.weighsByArea ? size / 2 : 1, elementsOf(t));
    }
  };
  addAll(ofVertices_, mesh.positions.size(), [&](std::uint32_t t) { return mesh.triangles[t]; });
  if (!hasClasses_) return;
  // Corners of one vertex with the same wedge and part form a class, which is averaged as a whole.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> known;
  classOf_.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t wedge = mesh.hasWedges() ? mesh.wedges[t][c] : MeshAttributes::kNone;
      const auto [at, isNew] =
          known.try_emplace({mesh.triangles[t][c], wedge, partOf_.empty() ? 0 : partOf_[t]},
                            static_cast<std::uint32_t>(wedgeOf_.size()));
      if (isNew) wedgeOf_.push_back(wedge);
      classOf_.push_back(at->second);
    }
  ofClasses_.isAveraged.assign(wedgeOf_.size(), 0);
  for (std::size_t a = 0; a < ofClasses_.attributes.size(); ++a)
    for (const std::uint32_t wedge : wedgeOf_)
      numbersOf(*ofClasses_.attributes[a], wedge, ofClasses_.values[a]);
  addAll(ofClasses_, wedgeOf_.size(), [&](std::uint32_t t) {
    return std::array<std::uint32_t, 3>{classOf_[3 * t], classOf_[3 * t + 1], classOf_[3 * t + 2]};
  });
}

bool CornerAttributes::isOnLine(const ContractionMesh& mesh, std::uint32_t v) const {
  if (!hasClasses_) return false;
  std::uint32_t first = MeshAttributes::kNone;
  for (const std::uint32_t t : mesh.trianglesOf(v)) {
    const std::uint32_t here = classOf_[cornerAt(mesh, t, v)];
    if (first == MeshAttributes::kNone) first = here;
    if (here != first) return true;
  }
  return false;
}

CornerAttributes::Continuations CornerAttributes::continuations(const ContractionMesh& mesh, std::uint32_t v,
                                                                std::uint32_t kept) const {
  Continuations all;
  // Triangles with both vertices show as which class of `kept` a class of v continues.
  for (const std::uint32_t t : mesh.trianglesOf(v)) {
    if (std::ranges::find(mesh.corners(t), kept) == mesh.corners(t).end()) continue;
    const std::uint32_t mine = classOf_[cornerAt(mesh, t, v)], there = classOf_[cornerAt(mesh, t, kept)];
    const auto known = std::ranges::find(all, mine, &Continuations::value_type::first);
    if (known == all.end())
      all.emplace_back(mine, there);
    else if (known->second != there)
      known->second = MeshAttributes::kNone;
  }
  return all;
}

std::uint32_t CornerAttributes::continued(const Continuations& all, std::uint32_t classOfV) {
  const auto found = std::ranges::find(all, classOfV, &Continuations::value_type::first);
  return found == all.end() ? MeshAttributes::kNone : found->second;
}

bool CornerAttributes::mayJoin(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices) const {
  if (!hasClasses_) return true;
  // Each class around a vertex that goes must continue as exactly one class of the vertex that stays.
  for (const std::uint32_t v : vertices.subspan(1)) {
    const Continuations all = continuations(mesh, v, vertices[0]);
    for (const std::uint32_t t : mesh.trianglesOf(v))
      if (continued(all, classOf_[cornerAt(mesh, t, v)]) == MeshAttributes::kNone) return false;
  }
  return true;
}

template <class Visit>
void CornerAttributes::forJoined(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices,
                                 const Visit& visit) const {
  // By class that stays, those that continue as it.
  boost::container::small_vector<std::pair<std::uint32_t, std::uint32_t>, 32> pairs;
  for (const std::uint32_t t : mesh.trianglesOf(vertices[0])) {
    const std::uint32_t here = classOf_[cornerAt(mesh, t, vertices[0])];
    pairs.emplace_back(here, here);
  }
  for (const std::uint32_t v : vertices.subspan(1)) {
    const Continuations all = continuations(mesh, v, vertices[0]);
    for (const auto& [from, to] : all)
      if (to != MeshAttributes::kNone) pairs.emplace_back(to, from);
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  boost::container::small_vector<std::uint32_t, 8> classes;
  for (std::size_t i = 0; i < pairs.size();) {
    const std::uint32_t to = pairs[i].first;
    classes.assign(1, to);
    for (; i < pairs.size() && pairs[i].first == to; ++i)
      if (pairs[i].second != to) classes.push_back(pairs[i].second);
    visit(std::span<const std::uint32_t>(classes.data(), classes.size()));
  }
}

Quadric CornerAttributes::quadricOf(const ContractionMesh& mesh,
                                    std::span<const std::uint32_t> vertices) const {
  Quadric quadric;
  if (ofVertices_.channels.areWeighed()) quadric += ofVertices_.channels.withBest(ofVertices_.sum(vertices));
  if (hasClasses_ && ofClasses_.channels.areWeighed())
    forJoined(mesh, vertices, [&](std::span<const std::uint32_t> classes) {
      quadric += ofClasses_.channels.withBest(ofClasses_.sum(classes));
    });
  return quadric;
}

double CornerAttributes::gapOf(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices) const {
  const Vec3& place = mesh.position(vertices[0]);
  double gap = 0;
  if (ofVertices_.channels.areWeighed()) gap += ofVertices_.gap(vertices, place);
  if (hasClasses_ && ofClasses_.channels.areWeighed())
    forJoined(mesh, vertices,
              [&](std::span<const std::uint32_t> classes) { gap += ofClasses_.gap(classes, place); });
  return gap;
}

void CornerAttributes::join(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices,
                            std::span<const double> weights, const Vec3& place, bool isSolved) {
  const bool moves = weights[0] < 1;
  if (moves) ofVertices_.average(vertices, weights);
  ofVertices_.join(vertices);
  if (isSolved) ofVertices_.solve(vertices[0], place);
  if (!hasClasses_) return;
  // By class of the vertex that stays: the classes that continue as it, with their weights.
  std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, double>>> joined;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> changes;  // corner, class
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const Continuations all = continuations(mesh, vertices[i], vertices[0]);
    for (const std::uint32_t t : mesh.trianglesOf(vertices[i])) {
      const std::uint32_t corner = cornerAt(mesh, t, vertices[i]), to = continued(all, classOf_[corner]);
      auto& from = joined[to];
      if (std::ranges::find(from, std::pair{classOf_[corner], weights[i]}) == from.end())
        from.emplace_back(classOf_[corner], weights[i]);
      changes.emplace_back(corner, to);
    }
  }
  for (const auto& [corner, to] : changes) classOf_[corner] = to;
  // A class of the vertex that stays has only some of the others' classes, so its shares are scaled to 1.
  for (const auto& [to, from] : joined) {
    std::vector<std::uint32_t> elements = {to};
    std::vector<double> shares = {weights[0]};
    for (const auto& [one, weight] : from) {
      elements.push_back(one);
      shares.push_back(weight);
    }
    double sum = 0;
    for (const double s : shares) sum += s;
    if (moves && sum > 0) {
      for (double& s : shares) s /= sum;
      ofClasses_.average(elements, shares);
    }
    std::ranges::sort(elements.begin() + 1, elements.end());
    elements.erase(std::unique(elements.begin() + 1, elements.end()), elements.end());
    ofClasses_.join(elements);
    if (isSolved) ofClasses_.solve(to, place);
  }
}

SurfaceMesh CornerAttributes::take(const SurfaceMesh& source, const ContractionMesh& mesh,
                                   std::vector<std::uint32_t>& vertexOf,
                                   std::vector<std::uint32_t>& faceOf) const {
  vertexOf.clear();
  faceOf.clear();
  SurfaceMesh result;
  std::vector<std::uint32_t> numberOf(mesh.vertexCount(), MeshAttributes::kNone),
      wedgeNumberOf(wedgeOf_.size(), MeshAttributes::kNone), classes;
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t)
    if (mesh.isThere(t)) faceOf.push_back(t);
  for (const std::uint32_t t : faceOf)
    for (const std::uint32_t v : mesh.corners(t)) numberOf[v] = 0;
  for (std::uint32_t v = 0; v < numberOf.size(); ++v) {
    if (numberOf[v] == MeshAttributes::kNone) continue;
    numberOf[v] = static_cast<std::uint32_t>(vertexOf.size());
    vertexOf.push_back(v);
    result.positions.push_back(mesh.position(v));
  }
  // Wedges are numbered as faces first use them, so classes that no face uses any more get no number.
  for (const std::uint32_t t : faceOf) {
    std::array<std::uint32_t, 3> corners = mesh.corners(t), wedges{};
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = numberOf[corners[c]];
      if (!source.hasWedges()) continue;
      const std::uint32_t one = classOf_[3 * t + c];
      if (wedgeNumberOf[one] == MeshAttributes::kNone) {
        wedgeNumberOf[one] = static_cast<std::uint32_t>(classes.size());
        classes.push_back(one);
      }
      wedges[c] = wedgeNumberOf[one];
    }
    result.triangles.push_back(corners);
    if (source.hasWedges()) result.wedges.push_back(wedges);
  }
  for (const Attribute& attribute : source.vertexAttributes)
    result.vertexAttributes.push_back(ofVertices_.taken(attribute, vertexOf));
  result.wedgeCount = static_cast<std::uint32_t>(classes.size());
  for (const Attribute& attribute : source.wedgeAttributes) {
    const bool isContinuous =
        std::ranges::find(ofClasses_.attributes, &attribute) != ofClasses_.attributes.end();
    // Averaged ones are by class, the others by wedge.
    Attribute taken = emptyLike(attribute);
    for (const std::uint32_t one : classes) {
      const bool isAveraged = isContinuous && ofClasses_.isAveraged[one] != 0;
      const std::array<std::uint32_t, 1> element = {one};
      taken.append(isAveraged ? std::span<const std::byte>(ofClasses_.taken(attribute, element).values)
                              : attribute.element(wedgeOf_[one]));
    }
    result.wedgeAttributes.push_back(std::move(taken));
  }
  for (const Attribute& attribute : source.triangleAttributes) {
    Attribute taken = emptyLike(attribute);
    for (const std::uint32_t t : faceOf) taken.append(attribute.element(t));
    result.triangleAttributes.push_back(std::move(taken));
  }
  const auto ofFaces = [&](const std::vector<std::uint32_t>& numbers) {
    std::vector<std::uint32_t> taken;
    if (!numbers.empty())
      for (const std::uint32_t t : faceOf) taken.push_back(numbers[t]);
    return taken;
  };
  result.objectOf = ofFaces(source.objectOf);
  result.groupOf = ofFaces(source.groupOf);
  result.materialOf = ofFaces(source.materialOf);
  result.objects = source.objects;
  result.groups = source.groups;
  result.materials = source.materials;
  result.pictures = source.pictures;
  return result;
}

}  // namespace arete
