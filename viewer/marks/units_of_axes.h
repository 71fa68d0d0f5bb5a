// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "viewer/scene/subject.h"

namespace arete {

/// The units of x, y and z in a model's file, each after a space: " m"; empty where the file does not say.
std::array<std::string, 3> unitsOfAxes(const Subject& subject);

/// A coordinate of a range of so much, as exact as a ten thousandth of it: "409050", "-0.0947".
std::string numberOf(double coordinate, double range);

}  // namespace arete
