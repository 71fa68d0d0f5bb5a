// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_model.h"

namespace arete::packed {

/// The chunk PNUM of a packed surface: by vertex, triangle and corner of the MT, the vertex and face of the
/// source and the wedge (docs/topics/amt-format.md, "Packed surfaces").

/// The bytes for a model. Faces of coarse triangles are among them where they do not follow from the fine
/// ones (SurfaceModel::hasFaceAttributes()). Precondition: model.validate(); wedges are numbered as
/// renumbered() does. O(triangles log triangles).
std::vector<std::byte> packSourceNumbers(const SurfaceModel& model);

/// Fills vertexOf, faceOf and wedgesOf of a model that has everything else. Errors, without a culprit:
/// corrupt. The numbers themselves are unchecked: see SurfaceModel::validate().
Status unpackSourceNumbers(std::span<const std::byte> bytes, SurfaceModel& model);

}  // namespace arete::packed
