// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL writes the file under its temporary name, all triangles in one transaction. The journal and the
// waiting for the disk that make a database safe are off: a file that is not finished is never renamed. GDAL
// tells of failures on closing only through its error handler, so the file is renamed once it is closed and
// the handler has heard nothing.
#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <new>
#include <string>

#include "io/crs_reader.h"
#include "io/gdal_support.h"
#include "io/mesh_gpkg.h"
#include "io/output_file.h"

namespace arete {

namespace {

constexpr std::size_t kTrianglesPerCancelCheck = 1 << 12;
constexpr const char* kLayer = "triangles";
constexpr const char* kUnitKey = "VERTICAL_UNIT";

Result<OGRLayer*> createLayer(GDALDataset& dataset, const MeshWriteOptions& options,
                              const GdalErrors& errors) {
  OGRSpatialReference crs;
  if (!options.crsWkt.empty()) {
    auto parsed = crsFromText(options.crsWkt);
    if (!parsed) return tl::unexpected(parsed.error());
    crs = std::move(*parsed);
  }
  std::string description;
  for (const std::string& note : options.notes) description += (description.empty() ? "" : "\n") + note;
  CPLStringList list;
  list.SetNameValue("SPATIAL_INDEX", "YES");
  if (!description.empty()) list.SetNameValue("DESCRIPTION", description.c_str());
  OGRLayer* layer = dataset.CreateLayer(kLayer, crs.IsEmpty() ? nullptr : &crs, wkbPolygon25D, list.List());
  const auto refused = [&] {
    return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  };
  if (!layer) return refused();
  OGRFieldDefn number("triangle", OFTInteger64), error("error", OFTReal);
  if (layer->CreateField(&number) != OGRERR_NONE) return refused();
  if (!options.triangleErrors.empty() && layer->CreateField(&error) != OGRERR_NONE) return refused();
  if (!options.verticalUnit.empty()) layer->SetMetadataItem(kUnitKey, options.verticalUnit.c_str());
  return layer;
}

Status writeTriangles(OGRLayer& layer, const TriangleMesh& mesh, std::span<const float> triangleErrors,
                      const GdalErrors& errors, const RunContext& context) {
  OGRFeature feature(layer.GetLayerDefn());
  const int numberField = feature.GetFieldIndex("triangle"), errorField = feature.GetFieldIndex("error");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % kTrianglesPerCancelCheck == 0) {
      context.report("writing the mesh", static_cast<double>(t) / static_cast<double>(mesh.triangles.size()));
      if (context.cancelled()) return failure(ErrorCode::interrupted, "writing was interrupted");
    }
    auto ring = std::make_unique<OGRLinearRing>();
    ring->setNumPoints(4, FALSE);
    for (int k = 0; k < 4; ++k) {
      const Vec3& p = mesh.positions[mesh.triangles[t][static_cast<std::size_t>(k % 3)]];
      ring->setPoint(k, p.x, p.y, p.z);
    }
    auto polygon = std::make_unique<OGRPolygon>();
    polygon->addRingDirectly(ring.release());
    feature.SetFID(static_cast<GIntBig>(t) + 1);
    feature.SetField(numberField, static_cast<GIntBig>(t));
    if (errorField >= 0) feature.SetField(errorField, double{triangleErrors[t]});
    feature.SetGeometryDirectly(polygon.release());
    if (layer.CreateFeature(&feature) != OGRERR_NONE)
      return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  }
  return {};
}

Status writeTo(const std::string& path, const TriangleMesh& mesh, const MeshWriteOptions& options,
               const RunContext& context) {
  GdalErrors errors;
  const CPLConfigOptionSetter noWait("OGR_SQLITE_SYNCHRONOUS", "OFF", false);
  const CPLConfigOptionSetter noJournal("OGR_SQLITE_JOURNAL", "OFF", false);
  const CPLConfigOptionSetter noClock("OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z", false);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  if (!driver) return failure(ErrorCode::unsupported, "this GDAL cannot write GeoPackages");
  GdalDatasetPtr dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset)
    return failure(ErrorCode::unreadable, fmt::format("cannot be created: {}", errors.firstFailure()));
  const Result<OGRLayer*> layer = createLayer(*dataset, options, errors);
  if (!layer) return tl::unexpected(layer.error());
  errors.clear();
  if (dataset->StartTransaction() != OGRERR_NONE)
    return failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  Status status = writeTriangles(**layer, mesh, options.triangleErrors, errors, context);
  if (status && dataset->CommitTransaction() != OGRERR_NONE)
    status = failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  dataset.reset();
  if (status && errors.anyFailure())
    status = failure(ErrorCode::unreadable, fmt::format("cannot be written: {}", errors.firstFailure()));
  return status;
}

}  // namespace

Status writeGpkg(const TriangleMesh& mesh, const std::filesystem::path& path, const MeshWriteOptions& options,
                 const RunContext& context) {
  if (const Status ok = mesh.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  if (!options.triangleErrors.empty() && options.triangleErrors.size() != mesh.triangles.size())
    return failure(
        ErrorCode::invalidData,
        fmt::format("{} errors for {} triangles", options.triangleErrors.size(), mesh.triangles.size()),
        path.string());
  try {
    registerGdal();
    Result<OutputFile> file = OutputFile::create(path);
    if (!file) return tl::unexpected(file.error());
    Status status = writeTo(file->temporaryPath().string(), mesh, options, context);
    if (status) status = file->commit();
    if (!status && status.error().culprit.empty()) status.error().culprit = path.string();
    return status;
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::unsupported, "there is not enough memory to write it", path.string());
  }
}

}  // namespace arete
