// SPDX-License-Identifier: GPL-3.0-or-later
//
// A format that rounds is read back, so that the report states the rounding of the file as written.
#include "io/exchange/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/crs/names.h"
#include "io/crs/reader.h"
#include "io/exchange/written_mesh.h"
#include "io/gdal/support.h"

namespace arete {

namespace {

/// Replaces the CRS of the mesh by the stated one.
Status stateCrs(MeshFile& mesh, const std::string& text, std::vector<std::string>& warnings) {
  if (text.empty()) return {};
  registerGdal();
  const auto crs = crsFromUser(text);
  if (!crs) return tl::unexpected(crs.error());
  Georeference described;
  if (Status ok = describeCrs(*crs, described); !ok) {
    ok.error().culprit = text;
    return ok;
  }
  if (compareCrs(mesh.crsWkt, described.crsWkt) == CrsAgreement::different)
    warnings.push_back(fmt::format("the CRS of the file, {}, is replaced by the one stated, {}",
                                   crsName(mesh.crsWkt), crsName(described.crsWkt)));
  mesh.crsWkt = described.crsWkt;
  if (mesh.verticalUnit.empty()) mesh.verticalUnit = described.verticalUnit;
  return {};
}

}  // namespace

Result<ConvertedMesh> convertMesh(MeshFile mesh, const std::filesystem::path& path,
                                  const ConvertOptions& options, const RunContext& context) {
  const Result<MeshFormat> format = meshFormatOf(path, options.format);
  if (!format) return tl::unexpected(format.error());
  ConvertedMesh converted;
  converted.warnings = std::move(mesh.warnings);
  if (const Status ok = stateCrs(mesh, options.crs, converted.warnings); !ok)
    return tl::unexpected(ok.error());
  const MeshWriteOptions writing{.crsWkt = mesh.crsWkt,
                                 .verticalUnit = mesh.verticalUnit,
                                 .triangleErrors = mesh.triangleErrors,
                                 .origin = mesh.frame.origin,
                                 .format = options.format,
                                 .notes = {},
                                 .existing = options.existing,
                                 .up = mesh.up,
                                 .pictureFolder = mesh.folder};
  const Result<WrittenMesh> written = writeAndReadBack(mesh.mesh, path, writing, true, context);
  // A CRS that this format needs and GDAL does not understand is a fault of the mesh, not of the output.
  if (!written && written.error().code == ErrorCode::invalidData && !mesh.crsWkt.empty())
    if (auto crs = crsFromText(mesh.crsWkt); !crs) return tl::unexpected(crs.error());
  if (!written) return tl::unexpected(written.error());
  converted.frame = written->frame;
  converted.lost = written->report.lost;
  const auto lose = [&](bool isHeld, bool isThere, std::string what) {
    if (!isHeld && isThere) converted.lost.push_back(std::move(what));
  };
  lose(format->holds.holdsCrs, !mesh.crsWkt.empty(), "the CRS");
  lose(format->holds.holdsVerticalUnit, !mesh.verticalUnit.empty(), "the unit of the heights");
  lose(format->holds.holdsErrors, !mesh.triangleErrors.empty(), "the error of each triangle");
  const Vec3& r = converted.frame.rounding;
  const bool wasExact = mesh.frame.rounding == Vec3{};
  lose(format->holds.isExact, wasExact,
       fmt::format("coordinates finer than {:.2g}, {:.2g}, {:.2g} (x, y, height)", r.x, r.y, r.z));
  if (const Vec3& off = mesh.frame.rounding; format->holds.isExact && !wasExact)
    converted.warnings.push_back(fmt::format(
        "its coordinates are rounded, by up to {:.2g}, {:.2g}, {:.2g} (x, y, height), which {} cannot "
        "record: arete measure takes them as exact and may find samples in no triangle",
        off.x, off.y, off.z, format->name));
  converted.crsWkt = std::move(mesh.crsWkt);
  converted.verticalUnit = std::move(mesh.verticalUnit);
  return converted;
}

}  // namespace arete
