// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogrsf_frmts.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"

namespace arete {

/// The triangles of a cut in the coordinates of the source, counter-clockwise, by rising id.
struct PlacedTriangles {
  TriangleMesh mesh;
  std::vector<std::uint32_t> ids;  ///< by triangle: that of the multitriangulation
  std::vector<float> errors;       ///< by triangle

  /// @param ids,errors by triangle of the mesh
  static PlacedTriangles sorted(TriangleMesh mesh, std::span<const std::uint32_t> ids,
                                std::span<const float> errors);
};

/// A layer of Polygon Z with the error of each triangle. A feature's number is its triangle's in the
/// multitriangulation: the same at every tolerance that has this triangle. The cut is taken when a feature, a
/// count or the extent is asked for.
class TriangleLayer final : public OGRLayer {
 public:
  using Take = std::function<Result<PlacedTriangles>()>;
  TriangleLayer(const std::string& name, const OGRSpatialReference& crs, Take take);
  ~TriangleLayer() override;
  TriangleLayer(const TriangleLayer&) = delete;
  TriangleLayer& operator=(const TriangleLayer&) = delete;

  OGRFeatureDefn* GetLayerDefn() override { return definition_; }
  void ResetReading() override { next_ = 0; }
  OGRFeature* GetNextFeature() override;
  OGRFeature* GetFeature(GIntBig id) override;
  GIntBig GetFeatureCount(int force) override;
  OGRErr GetExtent(OGREnvelope* extent, int force) override;
  OGRErr GetExtent(int field, OGREnvelope* extent, int force) override {
    return OGRLayer::GetExtent(field, extent, force);
  }
  int TestCapability(const char* what) override;

 private:
  /// Null, once an error was said.
  const PlacedTriangles* triangles();
  OGRFeature* feature(const PlacedTriangles& from, std::size_t number) const;
  bool mayBeWanted(const PlacedTriangles& from, std::size_t number) const;

  Take take_;
  OGRFeatureDefn* definition_;
  std::optional<PlacedTriangles> triangles_;
  bool hasFailed_ = false;
  std::size_t next_ = 0;
};

}  // namespace arete
