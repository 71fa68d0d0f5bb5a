// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/register.h"

/// What GDAL calls when it has loaded the plugin.
extern "C" __attribute__((visibility("default"))) void GDALRegister_AMT() {
  arete::registerAmtDriver();
}
