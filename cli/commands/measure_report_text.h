// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "terrain/measure/measure.h"

namespace arete {

/// A measurement for people, a line per fact. `unit` may be empty.
std::string measureReportText(const MeasureReport& report, const std::string& unit, bool isRaster);

}  // namespace arete
