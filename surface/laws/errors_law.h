// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "engine/parallel/run_context.h"
#include "surface/model/surface_model.h"

namespace arete {

/// Points of the source: its vertices; with `isFull` also the middles of its faces and of their sides.
std::vector<Vec3> samplesOfSource(const SurfaceModel& model, bool isFull);

/// Law 10 on one front: every sample of the source lies within the stored error of a triangle of the front,
/// but for a billionth of its longest side and 64 ulp of the largest coordinate. So errors that are too small
/// are found, each by itself, where no other triangle is near.
///
/// O((samples + triangles) log n), and one test for each sample in the box of a triangle, widened by its
/// error. Errors: brokenPromise, with the sample; interrupted.
Status checkErrors(const MultiTriangulation& mt, const Cut& front, std::span<const Vec3> samples,
                   const RunContext& context = {});

/// Law 10 on one front as it is drawn: displaced as far as its stored errors allow, and as far as the largest
/// of them allows everywhere. As checkErrors(). Precondition: the model has a displacement.
Status checkDisplacedErrors(const SurfaceModel& model, const Cut& front, std::span<const Vec3> samples,
                            const RunContext& context = {});

}  // namespace arete
