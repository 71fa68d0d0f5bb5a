// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/scene/layer.h"

namespace arete {

/// Lines of a mark, and what they mean.
struct MarkLines {
  SpaceVertices lines;
  Legend legend = {};
};

}  // namespace arete
