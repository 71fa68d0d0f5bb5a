// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bench/figure.h"

namespace arete::bench {

/// What the machine would need at least for each part of a build, and for loading and cutting, on one thread:
/// by its bandwidth, by its random access, by its arithmetic, each alone; beside it the time taken, and how
/// many times the largest of the three that is. Of the largest DEM among the figures, where caches help
/// least. Empty where the stages "machine" and "build" are not among them.
Figures limitsOf(const Figures& figures);

}  // namespace arete::bench
