// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feature by feature: collections and surfaces are split into polygons, and these into triangles, as seen
// from above: so are polygons valid or not in GIS. Corners are welded, since the format repeats them.
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_geometry.h>
#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "engine/base/counted.h"
#include "io/formats/common/polygon.h"
#include "io/formats/common/vertex_welder.h"
#include "io/formats/gpkg/gpkg.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"
#include "io/geo/gdal/vector_layer.h"
#include "io/geo/network/network_path.h"

namespace arete {

namespace {

constexpr std::size_t kFeaturesPerCancelCheck = 1 << 12;
constexpr std::uint64_t kMostTriangles = std::numeric_limits<std::uint32_t>::max() / 3;
constexpr std::array<const char*, 2> kDrivers = {"GPKG", nullptr};
constexpr const char* kUnitKey = "VERTICAL_UNIT";

/// The layer that writeGpkg() makes; null where there is none.
OGRLayer* ownLayer(GDALDataset& dataset) {
  OGRLayer* layer = dataset.GetLayerByName("triangles");
  return layer && layer->GetGeomType() == wkbPolygon25D &&
                 layer->GetLayerDefn()->GetFieldIndex("triangle") >= 0
             ? layer
             : nullptr;
}

/// The layer of triangles among those of a project.
Result<OGRLayer*> surfacesOf(GDALDataset& dataset) {
  if (OGRLayer* own = ownLayer(dataset)) return own;
  return chooseLayer(dataset, {}, LayerKind::surfaces);
}

class GpkgReader {
 public:
  GpkgReader(OGRLayer& layer, const RunContext& context) : layer_(layer), context_(context) {}

  Result<MeshFile> read() {
    GdalErrors errors;
    const int errorField = numericField("error");
    bool hasErrors = errorField >= 0;
    const double count = static_cast<double>(layer_.GetFeatureCount(FALSE));
    layer_.ResetReading();
    for (std::size_t n = 0;; ++n) {
      if (n % kFeaturesPerCancelCheck == 0) {
        if (count > 0) context_.report("reading the mesh", std::min(1.0, static_cast<double>(n) / count));
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted");
      }
      const OGRFeatureUniquePtr feature(layer_.GetNextFeature());
      if (!feature) break;
      id_ = feature->GetFID();
      if (const OGRGeometry* geometry = feature->GetGeometryRef()) ARETE_CHECK(addGeometry(*geometry));
      if (hasErrors) hasErrors = feature->IsFieldSetAndNotNull(errorField) != 0;
      if (hasErrors)
        result_.triangleErrors.resize(result_.mesh.triangles.size(),
                                      static_cast<float>(feature->GetFieldAsDouble(errorField)));
    }
    if (errors.anyFailure())
      return failure(ErrorCode::corrupt, fmt::format("the layer '{}' cannot be read: {}", layer_.GetName(),
                                                     errors.firstFailure()));
    if (!hasErrors) result_.triangleErrors.clear();
    result_.mesh.positions = welder_.take();
    if (crossing_ > 0)
      result_.warnings.push_back(
          {WarningCode::geometry, fmt::format("{} are a guess (the first is feature {})",
                                              counted(crossing_, "polygon crosses itself, so its triangles",
                                                      "polygons cross themselves, so their triangles"),
                                              firstCrossing_)});
    return std::move(result_);
  }

 private:
  int numericField(const char* name) const {
    const int index = layer_.GetLayerDefn()->GetFieldIndex(name);
    if (index < 0) return -1;
    const OGRFieldType type = layer_.GetLayerDefn()->GetFieldDefn(index)->GetType();
    return type == OFTReal || type == OFTInteger || type == OFTInteger64 ? index : -1;
  }

  tl::unexpected<Error> refuse(ErrorCode code, std::string_view what) const {
    return failure(code, fmt::format("feature {} of layer '{}' {}", id_, layer_.GetName(), what));
  }

  Status addGeometry(const OGRGeometry& geometry) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPolygon || type == wkbTriangle) return addPolygon(*geometry.toPolygon());
    if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface)) {
      for (const OGRPolygon* polygon : *geometry.toPolyhedralSurface()) ARETE_CHECK(addPolygon(*polygon));
      return {};
    }
    if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
      for (const OGRGeometry* part : *geometry.toGeometryCollection()) ARETE_CHECK(addGeometry(*part));
      return {};
    }
    return refuse(ErrorCode::unsupported, fmt::format("is a {}, not a triangle", geometry.getGeometryName()));
  }

  Status addPolygon(const OGRPolygon& polygon) {
    if (polygon.IsEmpty()) return {};
    if (!polygon.Is3D()) return refuse(ErrorCode::unsupported, "has no heights");
    corners_.clear();
    ringEnds_.clear();
    for (const OGRLinearRing* ring : polygon) ARETE_CHECK(addRing(*ring));
    PolygonTriangles triangles = triangulatePolygon(corners_, PolygonView::above, ringEnds_);
    if (!triangles.isSimple) {
      if (ringEnds_.size() > 1) return refuse(ErrorCode::unsupported, "is a polygon whose rings cross");
      if (crossing_++ == 0) firstCrossing_ = id_;
    }
    if (result_.mesh.triangles.size() + triangles.triangles.size() > kMostTriangles)
      return refuse(ErrorCode::unsupported, "is one triangle more than an index can name");
    std::vector<std::uint32_t> vertices;
    vertices.reserve(corners_.size());
    for (const Vec3& p : corners_) vertices.push_back(welder_.add(p));
    for (const auto& [a, b, c] : triangles.triangles)
      result_.mesh.triangles.push_back({vertices[a], vertices[b], vertices[c]});
    return {};
  }

  Status addRing(const OGRLinearRing& ring) {
    const int points = ring.getNumPoints();
    const auto at = [&](int i) { return Vec3{ring.getX(i), ring.getY(i), ring.getZ(i)}; };
    if (points < 4 || !(at(0) == at(points - 1)))
      return refuse(ErrorCode::unsupported,
                    fmt::format("has a ring of {} points that bounds no area", points));
    for (int i = 0; i + 1 < points; ++i) {
      const Vec3 p = at(i);
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        return refuse(ErrorCode::corrupt, "has a coordinate that is not finite");
      corners_.push_back(p);
    }
    ringEnds_.push_back(static_cast<std::uint32_t>(corners_.size()));
    return {};
  }

  OGRLayer& layer_;
  const RunContext& context_;
  GIntBig id_ = 0, firstCrossing_ = 0;
  std::size_t crossing_ = 0;
  VertexWelder welder_;
  std::vector<Vec3> corners_;  // of a polygon
  std::vector<std::uint32_t> ringEnds_;
  MeshFile result_;
};

Result<MeshFile> readFrom(const std::string& path, const RunContext& context) {
  registerGdal();
  GdalErrors errors;
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  const GdalDatasetPtr dataset(GDALDataset::Open(
      servedPath(path).c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kDrivers.data()));
  if (!dataset) {
    Error error = explainOpenFailure(path, "GeoPackage", errors);
    if (error.code == ErrorCode::unsupported)
      error = {ErrorCode::corrupt, "is damaged or not a GeoPackage", path};
    return tl::unexpected(std::move(error));
  }
  ARETE_TRY(OGRLayer* const layer, surfacesOf(*dataset));
  Result<MeshFile> file = GpkgReader(*layer, context).read();
  if (!file) return file;
  if (const OGRSpatialReference* crs = layer->GetSpatialRef(); isKnownCrs(crs)) {
    OGRSpatialReference copy(*crs);
    copy.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    Georeference described;
    ARETE_CHECK(describeCrs(copy, described));
    file->crsWkt = described.crsWkt;
    file->verticalUnit = described.verticalUnit;
  }
  if (const char* unit = layer->GetMetadataItem(kUnitKey)) file->verticalUnit = unit;
  return file;
}

}  // namespace

Result<MeshFile> readGpkg(const std::filesystem::path& path, const RunContext& context) {
  Result<MeshFile> file = readFrom(path.string(), context);
  if (!file && file.error().culprit.empty()) file.error().culprit = path.string();
  return file;
}

bool holdsSurfaces(const std::filesystem::path& path) {
  registerGdal();
  if (findPipeProblem(path.string())) return false;
  GdalErrors quiet;
  const GdalDatasetPtr dataset(GDALDataset::Open(servedPath(path.string()).c_str(),
                                                 GDAL_OF_VECTOR | GDAL_OF_READONLY, kDrivers.data()));
  if (!dataset) return false;
  return ownLayer(*dataset) ||
         (chooseLayer(*dataset, {}, LayerKind::surfaces) && !chooseLayer(*dataset, {}, LayerKind::points));
}

}  // namespace arete
