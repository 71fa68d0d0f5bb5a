// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/warning.h"

namespace arete::test {

inline std::vector<std::string> sentencesOf(const Warnings& warnings) {
  return {warnings.begin(), warnings.end()};
}

}  // namespace arete::test
