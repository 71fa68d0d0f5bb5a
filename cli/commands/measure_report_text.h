// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "terrain/measure/measure.h"

namespace arete {

/// Formats a measurement, a line per figure. `unit` may be empty.
std::string measureReportText(const MeasureReport& report, const std::string& unit, bool isRaster);

}  // namespace arete
