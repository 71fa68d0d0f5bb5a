// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/model/surface_model.h"

namespace arete {

/// The same model in the order of another MT of the same nodes. Wedges are numbered as the triangles name
/// them first. O(size).
/// @param mt          the MT in the new order
/// @param vertexOf    by vertex of `mt`: that of model.mt
/// @param triangleOf  by triangle of `mt`: that of model.mt, whose corners are the same in the same order
SurfaceModel renumbered(const SurfaceModel& model, const MultiTriangulation& mt,
                        std::span<const std::uint32_t> vertexOf, std::span<const std::uint32_t> triangleOf);

/// Numbers wedges as corners name them first.
class WedgeNumbering {
 public:
  explicit WedgeNumbering(std::uint32_t wedges) : newOf_(wedges, MeshAttributes::kNone) {}

  /// Gives the wedges of a triangle's corners their new numbers. Once for each triangle.
  void number(std::array<std::uint32_t, 3>& corners);
  /// How many have a corner so far.
  std::uint32_t named() const { return static_cast<std::uint32_t>(oldOf_.size()); }
  /// Puts the values of attributes of wedges into the new order, in which wedges of no corner come last.
  void reorder(std::vector<Attribute>& wedgeAttributes) &&;

 private:
  std::vector<std::uint32_t> newOf_, oldOf_;
};

}  // namespace arete
