// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// Makes GDAL know the driver "AMT". Where GDAL has another version than the driver was built for, it says so
/// in one line and does nothing else.
void registerAmtDriver();

}  // namespace arete
