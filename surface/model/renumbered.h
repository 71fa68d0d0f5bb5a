// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "surface/model/surface_model.h"

namespace arete {

/// The same model in the order of another MT of the same nodes. Wedges are numbered as the triangles name
/// them first. O(size).
/// @param mt          the MT in the new order
/// @param vertexOf    by vertex of `mt`: that of model.mt
/// @param triangleOf  by triangle of `mt`: that of model.mt, whose corners are the same in the same order
SurfaceModel renumbered(const SurfaceModel& model, const MultiTriangulation& mt,
                        std::span<const std::uint32_t> vertexOf, std::span<const std::uint32_t> triangleOf);

}  // namespace arete
