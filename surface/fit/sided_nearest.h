// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/triangle_bvh.h"
#include "surface/fit/source_samples.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// A sample's nearest point of a cut; kNone: its chart has no triangle there.
struct NearestOfCut {
  std::uint32_t triangle = TriangleBvh::kNone;
  std::array<double, 3> shares{};
};

/// How far what a sample shows is from what a triangle shows at some shares.
using ShownDistance =
    std::function<double(std::size_t sample, std::uint32_t triangle, const std::array<double, 3>& shares)>;

/// Finds the points of a cut that are nearest to samples of a source, chart by chart. A chart may border on
/// itself, as a cylinder that was cut open does: near a seam, the triangles at it are asked too, and where
/// what one shows is much nearer, it is taken.
/// @param chartOfSource  by triangle of the source; empty: all are one. chartOfCut likewise
/// @param shown          empty: nothing is asked beside the places
/// The result does not depend on the threads. O(samples log triangles).
std::vector<NearestOfCut> sidedNearest(const SurfaceMesh& cut, const SourceSamples& samples,
                                       std::span<const std::uint32_t> chartOfSource,
                                       std::span<const std::uint32_t> chartOfCut, const ShownDistance& shown);

}  // namespace arete
