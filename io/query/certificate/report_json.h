// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "measure/mesh_distance.h"
#include "terrain/measure/measure.h"

namespace arete {

/// A measurement as JSON, for certificates and `arete measure --json`; docs/topics/certificate.md states the
/// fields. A missing worst sample is null.
nlohmann::ordered_json toJson(const MeasureReport& report, bool isRaster);

/// Distances between two meshes as JSON, for `arete measure --json`.
nlohmann::ordered_json toJson(const MeshDistanceReport& report);

}  // namespace arete
