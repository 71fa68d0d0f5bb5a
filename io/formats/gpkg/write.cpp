// SPDX-License-Identifier: GPL-3.0-or-later
//
// One feature object is filled anew for every triangle; all triangles are one transaction, since SQLite
// commits each insertion on its own otherwise.
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <string>

#include "io/formats/common/losses.h"
#include "io/formats/gpkg/gpkg.h"
#include "io/geo/geopackage/geopackage.h"

namespace arete {

namespace {

constexpr std::size_t kTrianglesPerCancelCheck = 1 << 12;
constexpr const char* kLayer = "triangles";
constexpr const char* kVerticalUnitKey = "VERTICAL_UNIT";

// The notes become the description of the layer. The unit of heights has no field in the format and is
// metadata.
Result<OGRLayer*> createLayer(GDALDataset& dataset, const MeshWriteOptions& options,
                              const GdalErrors& errors) {
  std::string description;
  for (const std::string& note : options.notes) description += (description.empty() ? "" : "\n") + note;
  CPLStringList list;
  list.SetNameValue("SPATIAL_INDEX", "YES");
  if (!description.empty()) list.SetNameValue("DESCRIPTION", description.c_str());
  const Result<OGRLayer*> layer =
      addLayer(dataset, kLayer, options.crsWkt, wkbPolygon25D, errors, list.List());
  if (!layer) return layer;
  OGRFieldDefn number("triangle", OFTInteger64), error("error", OFTReal);
  if ((*layer)->CreateField(&number) != OGRERR_NONE) return cannotBeWritten(errors);
  if (!options.triangleErrors.empty() && (*layer)->CreateField(&error) != OGRERR_NONE)
    return cannotBeWritten(errors);
  if (!options.verticalUnit.empty())
    (*layer)->SetMetadataItem(kVerticalUnitKey, options.verticalUnit.c_str());
  return layer;
}

// A ring closes with its first point, so it has four. Features are numbered from 1 and triangles from 0.
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
    if (layer.CreateFeature(&feature) != OGRERR_NONE) return cannotBeWritten(errors);
  }
  return {};
}

// An insertion reports its failure by its result, so messages of creating the layer are dropped before.
Status fill(GDALDataset& dataset, GdalErrors& errors, const TriangleMesh& mesh,
            const MeshWriteOptions& options, const RunContext& context) {
  ARETE_TRY(OGRLayer* const layer, createLayer(dataset, options, errors));
  errors.clear();
  if (dataset.StartTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
  ARETE_CHECK(writeTriangles(*layer, mesh, options.triangleErrors, errors, context));
  if (dataset.CommitTransaction() != OGRERR_NONE) return cannotBeWritten(errors);
  return {};
}

}  // namespace

Result<MeshWriteReport> writeGpkg(MeshRef written, const std::filesystem::path& path,
                                  const MeshWriteOptions& options, const RunContext& context) {
  const TriangleMesh& mesh = written.shape;
  if (const Status ok = written.validate(); !ok)
    return failure(ErrorCode::invalidData, ok.error().message, path.string());
  if (!options.triangleErrors.empty() && options.triangleErrors.size() != mesh.triangles.size())
    return failure(
        ErrorCode::invalidData,
        fmt::format("{} errors for {} triangles", options.triangleErrors.size(), mesh.triangles.size()),
        path.string());
  const auto insert = [&](GDALDataset& dataset, GdalErrors& errors) {
    return fill(dataset, errors, mesh, options, context);
  };
  Status status = writeGeoPackage(path, options.existing, {kLayer, {"triangle"}}, insert, context);
  if (!status && status.error().culprit.empty()) status.error().culprit = path.string();
  if (!status) return tl::unexpected(status.error());
  return MeshWriteReport{.lost = lossesOf(written.attributes, {})};
}

}  // namespace arete
