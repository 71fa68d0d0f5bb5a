// SPDX-License-Identifier: GPL-3.0-or-later
// Colour maps of other programs: whatever is read gives a colour to every value.
#include <cmath>
#include <limits>

#include "fuzz/harness.h"
#include "viewer/color/ramp_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const arete::fuzz::MemoryFile file;
  file.set({data, size});
  const auto ramp = arete::readRampFile(file.path());
  if (!ramp) {
    arete::fuzz::requireClear(ramp.error());
    return 0;
  }
  arete::fuzz::require(!ramp->lines.empty(), "a colour map has a colour");
  for (const auto between : {arete::ColorsBetween::linear, arete::ColorsBetween::discrete,
                             arete::ColorsBetween::nearest, arete::ColorsBetween::exact}) {
    arete::Warnings warnings;
    const auto map = ramp->map(-100, 100, between, warnings);
    if (!map) continue;
    arete::fuzz::requireClear(warnings);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double value : {-infinity, -50.0, 0.0, 50.0, infinity, std::nan("")}) map->at(value);
    map->over(0, 1).at(0.5);
  }
  return 0;
}
