// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/id_array.h"
#include "engine/mt/recorder.h"
#include "engine/simplify/independent_set.h"
#include "engine/simplify/live_mesh.h"
#include "engine/simplify/threshold_list.h"
#include "surface/error/attribute_bound.h"
#include "surface/error/attribute_field.h"
#include "surface/error/original.h"
#include "surface/error/pieces.h"
#include "surface/error/samples.h"
#include "surface/simplify/attribute_error_array.h"
#include "surface/simplify/labels.h"

namespace arete {

/// The data that all steps of a simplification share. Different threads may work on different stars at once.
struct SurfaceState {
  LiveMesh& mesh;
  const OriginalSurface& original;
  const SurfaceSamples& samples;
  MtRecorder& recorder;
  MetricFrame metric;
  std::uint32_t maxDegree = 24;  ///< of a vertex that is removed
  double thresholdRatio = 1.1;   ///< growth of the threshold from level to level
  std::size_t fewEnough = 0;     ///< triangles at which levels end
  /// A power of two by which lengths are multiplied, so that costs do not depend on the unit.
  double unit = 1;

  SurfaceParts parts = {};
  /// What counts in costs beside distances. Empty: nothing does.
  const AttributeField& field;
  bool boundsAttributes = !field.isEmpty();  ///< what is in the field
  /// Attributes are bounded within a triangle's error, and within each of these where they are more.
  std::span<const double> attributeDistances = {};

  IdArray<SlotId, std::vector<PieceList>> pieces = {};
  LabelArray labels{parts.hasWedges};  ///< by slot of the mesh
  /// Of the triangles of removed stars: by slot of the recorder (MtRecorder::firstSlot()).
  LabelArray starLabels{parts.hasWedges};
  /// By slot of the mesh, and of the recorder as starLabels; as AttributeBound has them.
  AttributeErrorArray attributeErrors{boundsPerTriangle()}, starAttributeErrors{boundsPerTriangle()};
  /// By slot of the mesh: its sides that have pieces across them. Empty without wedges or without bounds.
  IdArray<SlotId, std::vector<std::array<AcrossSide, 3>>> acrossSides = {};
  /// The first of those of a removed vertex.
  IdArray<VertexId, std::vector<std::uint32_t>> firstStarLabel = {};
  /// Of a vertex on a border of the original: the next one along it, the surface on the left. Empty without
  /// borders.
  IdArray<VertexId, std::vector<VertexId>> borderNext = {};
  /// Of a vertex in the middle of one line of the original: the next ones along it. Empty without lines.
  IdArray<VertexId, std::vector<std::array<VertexId, 2>>> lineNext = {};
  ThresholdList thresholds = {};
  IndependentSet::Records records = {};
  std::atomic<std::size_t> liveTriangles = 0;

  std::size_t boundsPerTriangle() const {
    return boundsAttributes ? field.entries().size() * (1 + attributeDistances.size()) : 0;
  }
  TriangleLabels labelsOf(SlotId slot) const { return labels[slot.index()]; }
  const Vec3& position(VertexId v) const { return original.positions[v.index()]; }
};

}  // namespace arete
