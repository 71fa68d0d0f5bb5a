// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/renumbered.h"

#include <utility>
#include <vector>

namespace arete {
namespace {

void reorder(std::vector<Attribute>& attributes, std::span<const std::uint32_t> oldOf) {
  for (Attribute& attribute : attributes) {
    Attribute next = emptyLike(attribute);
    next.values.reserve(attribute.values.size());
    for (const std::uint32_t i : oldOf) next.append(attribute.element(i));
    attribute = std::move(next);
  }
}

template <class T>
std::vector<T> reordered(const std::vector<T>& values, std::span<const std::uint32_t> oldOf) {
  std::vector<T> next;
  next.reserve(oldOf.size());
  for (const std::uint32_t i : oldOf) next.push_back(values[i]);
  return next;
}

}  // namespace

SurfaceModel renumbered(const SurfaceModel& model, const MultiTriangulation& mt,
                        std::span<const std::uint32_t> vertexOf, std::span<const std::uint32_t> triangleOf) {
  SurfaceModel result = model;
  result.mt = mt;
  result.vertexOf = reordered(model.vertexOf, vertexOf);
  result.faceOf = reordered(model.faceOf, triangleOf);
  if (!model.displacement.isEmpty())
    result.displacement = {reordered(model.displacement.directions, vertexOf),
                           reordered(model.displacement.reaches, triangleOf)};
  const std::size_t ids = model.mt.triangleIdCount();
  for (AttributeErrors& errors : result.attributeErrors) {
    std::vector<std::uint16_t> all;
    for (std::size_t at = 0; at < errors.codes.size(); at += ids) {
      const auto level = std::span(errors.codes).subspan(at, ids);
      const auto codes = reordered(std::vector<std::uint16_t>(level.begin(), level.end()), triangleOf);
      all.insert(all.end(), codes.begin(), codes.end());
    }
    errors.codes = std::move(all);
  }
  reorder(result.attributes.vertexAttributes, vertexOf);
  if (!model.hasWedges()) return result;
  result.wedgesOf = reordered(model.wedgesOf, triangleOf);
  WedgeNumbering numbering(model.attributes.wedgeCount);
  for (std::uint32_t t = 0; t < result.wedgesOf.size(); ++t) {
    const NodeId creator = mt.creator(TriangleId(t));
    if (creator.isValid() && mt.remover(TriangleId(t)) == creator)
      result.wedgesOf[t] = {0, 0, 0};  // a slot that is no triangle
    else
      numbering.number(result.wedgesOf[t]);
  }
  std::move(numbering).reorder(result.attributes.wedgeAttributes);
  return result;
}

void WedgeNumbering::number(std::array<std::uint32_t, 3>& corners) {
  for (std::uint32_t& w : corners) {
    if (newOf_[w] == MeshAttributes::kNone) {
      newOf_[w] = named();
      oldOf_.push_back(w);
    }
    w = newOf_[w];
  }
}

void WedgeNumbering::reorder(std::vector<Attribute>& wedgeAttributes) && {
  for (std::uint32_t w = 0; w < newOf_.size(); ++w)
    if (newOf_[w] == MeshAttributes::kNone) oldOf_.push_back(w);
  arete::reorder(wedgeAttributes, oldOf_);
}

}  // namespace arete
