// SPDX-License-Identifier: GPL-3.0-or-later
//
// The way to degrees and back is exact but for nanometres: rounded to a float, each coordinate is the file's.
#include "io/query/surface/local_metres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/float_bounds.h"
#include "io/geo/bent/place_map.h"
#include "io/geo/crs/local_frame.h"
#include "io/geo/crs/local_origin.h"

namespace arete {

Result<std::optional<Warning>> returnToLocalMetres(MeshFile& file) {
  if (!file.frame.isLocalMetres || !file.frame.origin) return std::optional<Warning>();
  const Vec3 origin = *file.frame.origin;
  ARETE_TRY(const Georeference georeference, georeferenceOf(file.crsWkt, file.verticalUnit));
  ARETE_TRY(const LocalFrame frame, LocalFrame::create(localFrameSpec(georeference, origin)));
  Vec3 largest;
  for (Vec3& p : file.mesh.positions) {
    const Vec3 metres = frame.toLocal(p);
    p = {double(float(metres.x)), double(float(metres.y)), double(float(metres.z))};
    largest = {std::max(largest.x, std::abs(p.x)), std::max(largest.y, std::abs(p.y)),
               std::max(largest.z, std::abs(p.z))};
  }
  for (float& error : file.triangleErrors)
    error = floatAtLeast(double{error} * frame.spec().verticalUnitMetres);
  Warning place{WarningCode::position,
                fmt::format("x, y and z are metres to the east, to the north and up from {} {} {}, as in the "
                            "file, and the surface keeps no CRS",
                            origin.x, origin.y, origin.z)};
  file.crsWkt.clear();
  file.verticalUnit = "metre";
  file.metresAbout = origin;
  file.frame = {.coordinates = file.frame.coordinates,
                .rounding = {float32Rounding(largest.x, 0), float32Rounding(largest.y, 0),
                             float32Rounding(largest.z, 0)}};
  return std::optional(std::move(place));
}

}  // namespace arete
