// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "bench/figure.h"
#include "engine/base/result.h"
#include "terrain/model/heightfield.h"

namespace arete::bench {

/// A DEM as hmm reads it: a 16-bit PNG.
struct HmmInput {
  std::string png;
  double unit = 1;  ///< of one grey level, in the DEM's vertical unit
};

/// Writes the heights above their lowest as grey levels. Whole numbers within 65535 of each other are kept as
/// they are; others are spread over all levels. Errors: unsupported (a void: hmm would mesh over it; more
/// heights than PNG can hold); those of writing, naming the path.
Result<HmmInput> writeHmmInput(const RasterHeightfield& field, const std::string& png);

/// One run of hmm, from its input to the triangles; what it writes is thrown away.
struct HmmRun {
  double seconds = 0;             ///< the whole program
  double processorSeconds = 0;    ///< of it, computing
  double triangulateSeconds = 0;  ///< what it says triangulating alone took
  double triangles = 0;
  double peakBytes = 0;
};

/// Runs the program at `hmm` (github.com/fogleman/hmm, MIT; built by the user) with a tolerance in
/// the DEM's vertical unit. The caller must not have started threads. Errors: notFound; unreadable (it fails,
/// or says nothing that can be understood).
Result<HmmRun> runHmm(const std::string& hmm, const HmmInput& input, double tolerance);

/// From here on this process, and what it starts, stays on one core: the last it may use.
/// Errors: unreadable (the system refuses).
Status stayOnOneCore();

}  // namespace arete::bench
