// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is cut at one face of the box after the other [SutherlandHodgman1974]. What is new: each edge of
// the outline knows the line it lies on, an edge of the triangle or the section of the triangle with a face,
// and every cut is computed from the ends of that whole line, in an order of their positions, never from what
// earlier cuts have left. So neighbours, and the boxes beside this one, compute the same numbers.
//
// Faces are numbered low x, high x, low y, high y, low z, high z. By rounding, a cut at a face of y can lie
// outside the faces of x where the line was cut already, by its last digits: it is put on them.
#include "surface/edit/box_clip.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace arete {
namespace {

unsigned axisOf(unsigned face) {
  return face / 2;
}

double at(const Vec3& p, unsigned axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

double& at(Vec3& p, unsigned axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

double boundOf(const Box3& box, unsigned face) {
  return at(face % 2 == 0 ? box.low : box.high, axisOf(face));
}

bool isBefore(const Vec3& a, const Vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Where on the way from a to b the bound is, from 0 to 1. Halves, so that no difference overflows.
double shareAt(double a, double b, double bound) {
  const double way = b / 2 - a / 2;
  if (way == 0) return 0;
  return std::clamp((bound / 2 - a / 2) / way, 0.0, 1.0);
}

Vec3 between(const Vec3& a, const Vec3& b, double share) {
  return {std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share), std::lerp(a.z, b.z, share)};
}

}  // namespace

bool BoxClip::isInside(std::uint32_t vertex, unsigned face) const {
  const double x = at(positionOf(vertex), axisOf(face));
  return face % 2 == 0 ? x >= boundOf(box_, face) : x <= boundOf(box_, face);
}

const std::vector<std::uint32_t>& BoxClip::clip(const Triangle& triangle, bool& touches) {
  outline_.clear();
  vertices_.clear();
  for (unsigned i = 0; i < 3; ++i) outline_.push_back({triangle[i], i});
  for (unsigned face = 0; face < 6 && !outline_.empty(); ++face) clipAt(face, triangle);
  touches = !outline_.empty();
  for (const Corner& corner : outline_)
    if (std::ranges::find(vertices_, corner.vertex) == vertices_.end()) vertices_.push_back(corner.vertex);
  if (vertices_.size() < 3) vertices_.clear();
  return vertices_;
}

void BoxClip::clipAt(unsigned face, const Triangle& triangle) {
  const double bound = boundOf(box_, face);
  if (std::isinf(bound)) return;
  const auto isOn = [&](const Corner& c) { return at(positionOf(c.vertex), axisOf(face)) == bound; };
  next_.clear();
  const auto addCut = [&](unsigned edge, unsigned edgeAfter) {
    std::uint32_t vertex = cutAt(edge, face, triangle);
    // Where two cuts fall into one point, the outline has it once.
    for (const Corner& other : next_)
      if (positionOf(other.vertex) == positionOf(vertex)) vertex = other.vertex;
    next_.push_back({vertex, edgeAfter});
  };
  // A corner on the face itself serves as its own cut. The outline leaves the box along the face, so the next
  // edge lies on it: its number is 3 plus the face.
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const Corner here = outline_[i], there = outline_[(i + 1) % outline_.size()];
    const bool isHereIn = isInside(here.vertex, face), isThereIn = isInside(there.vertex, face);
    if (isHereIn && (isThereIn || !isOn(here))) next_.push_back(here);
    if (isHereIn && !isThereIn) {
      if (isOn(here))
        next_.push_back({here.vertex, 3 + face});
      else
        addCut(here.edge, 3 + face);
    }
    if (!isHereIn && isThereIn && !isOn(there)) addCut(here.edge, here.edge);
  }
  std::swap(outline_, next_);
}

/// Edges 0 to 2 are edges of the triangle, which neighbours share; the others are sections with a face.
std::uint32_t BoxClip::cutAt(unsigned edge, unsigned face, const Triangle& triangle) {
  return edge < 3 ? cutEdge(triangle[edge], triangle[(edge + 1) % 3], face)
                  : cutWithin(triangle, edge - 3, face);
}

Vec3 BoxClip::heldInBox(Vec3 position, unsigned axes) const {
  for (unsigned axis = 0; axis < axes; ++axis)
    at(position, axis) = std::clamp(at(position, axis), at(box_.low, axis), at(box_.high, axis));
  return position;
}

std::uint32_t BoxClip::add(Cut cut) {
  cuts_.push_back(cut);
  return static_cast<std::uint32_t>(positions_.size() + cuts_.size() - 1);
}

// A cut of an edge is kept for both its triangles. Cuts that fall into one point, at a corner of the box,
// become one vertex.
std::uint32_t BoxClip::cutEdge(std::uint32_t a, std::uint32_t b, unsigned face) {
  const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  auto [found, isNew] = cutsOfEdge_.try_emplace(key);
  std::array<std::uint32_t, 6>& known = found->second;
  if (isNew) known.fill(SurfaceMesh::kNone);
  if (known[face] != SurfaceMesh::kNone) return known[face];
  if (isBefore(positions_[b], positions_[a])) std::swap(a, b);
  const unsigned axis = axisOf(face);
  const double bound = boundOf(box_, face),
               share = shareAt(at(positions_[a], axis), at(positions_[b], axis), bound);
  Vec3 position = between(positions_[a], positions_[b], share);
  at(position, axis) = bound;
  position = heldInBox(position, axis);
  for (const std::uint32_t other : known)
    if (other != SurfaceMesh::kNone && positionOf(other) == position) return known[face] = other;
  return known[face] = add({position, {a, b, b}, {1 - share, share, 0}, true});
}

// The ends are put in order of their positions, so that both triangles at an edge compute the same numbers.
BoxClip::Place BoxClip::placeOnEdge(const Triangle& triangle, unsigned edge, unsigned face) const {
  unsigned a = edge, b = (edge + 1) % 3;
  if (isBefore(positions_[triangle[b]], positions_[triangle[a]])) std::swap(a, b);
  const Vec3 &from = positions_[triangle[a]], &to = positions_[triangle[b]];
  const double share = shareAt(at(from, axisOf(face)), at(to, axisOf(face)), boundOf(box_, face));
  Place place{between(from, to, share), {0, 0, 0}};
  place.weights[a] = 1 - share;
  place.weights[b] = share;
  return place;
}

// The section of the triangle with the first face is a segment; its ends lie on edges or corners of the
// triangle. It is computed anew from the triangle and cut at the second face.
std::uint32_t BoxClip::cutWithin(const Triangle& triangle, unsigned first, unsigned second) {
  const double bound = boundOf(box_, first);
  std::array<Place, 2> ends{};
  std::size_t count = 0;
  for (unsigned i = 0; i < 3 && count < 2; ++i) {
    const double x = at(positions_[triangle[i]], axisOf(first)),
                 next = at(positions_[triangle[(i + 1) % 3]], axisOf(first));
    if (x == bound) {
      ends[count] = {positions_[triangle[i]], {0, 0, 0}};
      ends[count++].weights[i] = 1;
    } else if ((x < bound) != (next < bound) && next != bound) {
      ends[count++] = placeOnEdge(triangle, i, first);
    }
  }
  if (count == 1) ends[1] = ends[0];
  if (isBefore(ends[1].position, ends[0].position)) std::swap(ends[0], ends[1]);
  const double share = shareAt(at(ends[0].position, axisOf(second)), at(ends[1].position, axisOf(second)),
                               boundOf(box_, second));
  // A cut lies on both faces to the bit, and rounding is not left to say on which side.
  Cut cut{between(ends[0].position, ends[1].position, share), triangle, {}, false};
  at(cut.position, axisOf(first)) = bound;
  at(cut.position, axisOf(second)) = boundOf(box_, second);
  cut.position = heldInBox(cut.position, axisOf(second));
  for (std::size_t i = 0; i < 3; ++i)
    cut.weights[i] = std::lerp(ends[0].weights[i], ends[1].weights[i], share);
  return add(cut);
}

}  // namespace arete
