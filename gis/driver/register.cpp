// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/register.h"

#include <gdal_priv.h>

#include <memory>

#include "gis/driver/amt_dataset.h"
#include "gis/driver/open_options.h"
#include "io/geo/network/served_files.h"

namespace arete {

void registerAmtDriver() {
  if (!GDAL_CHECK_VERSION("AMT") || GDALGetDriverByName("AMT") != nullptr) return;
  auto driver = std::make_unique<GDALDriver>();
  driver->SetDescription("AMT");
  driver->SetMetadataItem(GDAL_DMD_LONGNAME, "Arete multitriangulation");
  driver->SetMetadataItem(GDAL_DMD_EXTENSION, "amt");
  driver->SetMetadataItem(GDAL_DMD_EXTENSIONS, "amt");
  driver->SetMetadataItem(GDAL_DCAP_RASTER, "YES");
  driver->SetMetadataItem(GDAL_DCAP_VECTOR, "YES");
  driver->SetMetadataItem(GDAL_DCAP_Z_GEOMETRIES, "YES");
  driver->SetMetadataItem(GDAL_DMD_OPENOPTIONLIST, kAmtOpenOptions);
  driver->pfnIdentify = AmtDataset::identify;
  driver->pfnOpen = AmtDataset::open;
  servedName();  // while no other thread uses GDAL
  GetGDALDriverManager()->RegisterDriver(driver.release());
}

}  // namespace arete
