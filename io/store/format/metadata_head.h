// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "engine/mt/multitriangulation.h"
#include "io/store/format/columns.h"

namespace arete {

/// What the metadata of every file says, whatever its kind.
struct AmtHead {
  std::string writer;  ///< the program that wrote the file
  AmtCounts counts;
  OutwardScale scale;
  MetricFrame metric;
};

/// Of an MT. The counts beside it are 0.
inline AmtHead amtHeadOf(const MultiTriangulation& mt, std::string writer) {
  return {std::move(writer),
          {.rootVertices = mt.rootVertexCount(),
           .rootTriangles = mt.rootTriangleCount(),
           .nodes = mt.nodeCount(),
           .slots = mt.slotTotal()},
          mt.scale(),
          mt.metric()};
}

/// The first problem of counts that determine arrays; of a scale of codes.
std::optional<std::string> findCountProblem(const AmtCounts& counts);
std::optional<std::string> findScaleProblem(const OutwardScale& scale);

/// The fields of a head, in three places of the metadata (io/store/format/json_fields.h).
template <class Visitor, class Metadata>
void visitSourceFields(Visitor& top, Metadata& m) {
  top.field("writer", m.writer);
  top.field("source", m.model.source);
  top.field("sourceChecksum", m.model.sourceChecksum);
}
template <class Visitor, class Counts>
void visitMtCounts(Visitor& fields, Counts& counts) {
  fields.field("rootVertices", counts.rootVertices);
  fields.field("rootTriangles", counts.rootTriangles);
  fields.field("nodes", counts.nodes);
  fields.field("slots", counts.slots);
}
/// @param scaleBase the base of the scale, which has no member for it
template <class Visitor, class Metadata, class Base>
void visitFrameFields(Visitor& top, Metadata& m, Base& scaleBase) {
  top.field("errorScaleBase", scaleBase);
  top.object("metricFrame", [&](auto& metric) {
    metric.field("origin", m.metric.origin);
    metric.field("scale", m.metric.scale);
  });
}

}  // namespace arete
