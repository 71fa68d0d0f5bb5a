// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"

namespace arete {

/// Points of the source.
struct SourceSamples {
  std::vector<Vec3> places;
  /// By sample, and by triangle of the MT: its chart (surface/model/charts.h). Empty where errors are
  /// distances to anything.
  std::vector<std::uint32_t> charts, chartOf;
};
/// Its vertices; with `isFull` also the middles of its faces and of their sides. A point of several charts is
/// a sample of each.
SourceSamples samplesOfSource(const SurfaceModel& model, bool isFull);

/// Law 10 on one front: every sample of the source lies within the stored error of a triangle of its chart,
/// or within that of a triangle beyond a line of an edge between them, but for a billionth of its longest
/// side and 64 ulp of the largest coordinate. This detects an understated error where no other
/// triangle covers the sample.
///
/// O((samples + triangles) log n), and one test for each sample in the box of a triangle, widened by its
/// error. Errors: brokenPromise, with the sample; interrupted.
Status checkErrors(const MultiTriangulation& mt, const Cut& front, const SourceSamples& samples,
                   const RunContext& context = {});

/// Law 10 on one front as it is drawn: displaced as far as its stored errors allow, and as far as the largest
/// of them allows everywhere. As checkErrors(). Precondition: the model has a displacement.
Status checkDisplacedErrors(const SurfaceModel& model, const Cut& front, const SourceSamples& samples,
                            const RunContext& context = {});

}  // namespace arete
