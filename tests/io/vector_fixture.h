// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace arete::test {

/// A layer of points, or of whatever its features are.
struct LayerSpec {
  const char* name;
  OGRwkbGeometryType type;
  std::vector<std::pair<const char*, double>> features;  ///< WKT (or null), and the field "h"
};

inline std::string writeVector(const std::string& path, const char* driverName,
                               const std::vector<LayerSpec>& layers, const char* crsName = "EPSG:32611") {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driverName);
  GDALDataset* dataset = driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  OGRSpatialReference crs;
  if (crsName) crs.SetFromUserInput(crsName);
  for (const LayerSpec& spec : layers) {
    OGRLayer* layer = dataset->CreateLayer(spec.name, crsName ? &crs : nullptr, spec.type, nullptr);
    OGRFieldDefn height("h", OFTReal), label("label", OFTString);
    EXPECT_EQ(layer->CreateField(&height), OGRERR_NONE);
    EXPECT_EQ(layer->CreateField(&label), OGRERR_NONE);
    for (const auto& [wkt, h] : spec.features) {
      OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
      if (wkt) {
        OGRGeometry* geometry = nullptr;
        OGRGeometryFactory::createFromWkt(wkt, nullptr, &geometry);
        feature->SetGeometryDirectly(geometry);
      }
      if (!std::isnan(h)) feature->SetField("h", h);
      EXPECT_EQ(layer->CreateFeature(feature.get()), OGRERR_NONE);
    }
  }
  GDALClose(GDALDataset::ToHandle(dataset));
  return path;
}

}  // namespace arete::test
