// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts of generated models for the parts of a fit.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "terrain/builder/build.h"
#include "terrain/fit/mesh.h"
#include "terrain/fit/samples.h"

namespace arete::fit_test {

struct CutOfModel {
  std::string name;
  TerrainModel model;
  Cut cut;
  double maxError;
};

/// A model of each family of rasters and of points, and a cut of about a tenth of its error.
inline std::vector<CutOfModel> cutsOfAllFamilies(std::uint64_t seed) {
  std::vector<CutOfModel> cuts;
  const auto add = [&](std::string_view name, Result<TerrainModel> model) {
    ASSERT_TRUE(model) << name << ": " << model.error().describe();
    const double maxError = 0.1 * model->mt.largestError();
    Result<Cut> cut = takeCut(model->mt, UniformError(maxError), {}, {});
    ASSERT_TRUE(cut) << name;
    const std::string title = std::string(name) + ", seed " + std::to_string(seed);
    cuts.push_back({title, std::move(*model), std::move(*cut), maxError});
  };
  for (const RasterFamily& family : rasterFamilies()) add(family.name, build(family.make(23, 19, seed)));
  for (const PointFamily& family : pointFamilies()) add(family.name, build(family.make(160, seed)));
  return cuts;
}

inline FitMesh meshOf(const CutOfModel& c, double bound) {
  const MultiTriangulation& mt = c.model.mt;
  auto samples = shareSamples(mt, c.cut, nodesOf(mt, c.cut), {});
  EXPECT_TRUE(samples) << c.name;
  return {mt, c.cut, std::move(*samples), {.everywhere = bound, .rounding = 1e-9}};
}

/// The nodes of the mesh that can be removed.
inline std::vector<NodeId> leavesOf(const FitMesh& mesh) {
  std::vector<NodeId> leaves;
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const std::uint32_t roots = mesh.mt().rootVertexCount();
    if (mesh.mtVertex(v) < roots || !mesh.isIn(v)) continue;
    const NodeId node(mesh.mtVertex(v) - roots);
    if (mesh.isLeaf(node)) leaves.push_back(node);
  }
  return leaves;
}

inline double worstSeverity(const FitMesh& mesh) {
  double worst = 0;
  for (std::uint32_t t = 0; t < mesh.slotCount(); ++t)
    if (mesh.isLive(t)) worst = std::max(worst, mesh.severity(t));
  return worst;
}

}  // namespace arete::fit_test
