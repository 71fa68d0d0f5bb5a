// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/surface/why_not_fewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "cli/arguments/arguments.h"
#include "cli/arguments/drop_attributes.h"
#include "engine/base/counted.h"
#include "engine/cut/cut.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/front/front.h"
#include "surface/model/labels.h"

namespace arete {

std::string seamsOfModel(const SurfaceModel& model) {
  std::string seams = seamsOf(finestSurfaceOf(model).mesh);
  if (const std::size_t option = seams.find("--drop-attributes"); option != std::string::npos)
    seams.insert(option, "arete build with ");
  return seams;
}

std::string whyNotFewer(const SurfaceModel& model, const DroppedComponents* dropped,
                        const RunContext& context) {
  Cut root = frontOfPrefix(model.mt, 0);
  if (dropped) root = withoutDropped(model.mt, root, *dropped).cut;
  TriangleMesh mesh;
  for (const std::uint32_t v : root.vertices) mesh.positions.push_back(model.mt.position(VertexId(v)));
  mesh.triangles = root.triangles;
  const Result<MeshDiagnosis> d = diagnose(mesh, {.selfIntersections = false}, context);
  if (!d) return {};
  std::uint64_t handles = 0, borders = 0;
  for (const ComponentDiagnosis& c : d->components) {
    handles += static_cast<std::uint64_t>(std::max<std::int64_t>(0, c.genus.value_or(0)));
    borders += c.borders;
  }
  std::string why = grouped(d->components.size(), "component", "components");
  if (handles > 0) why += ", " + grouped(handles, "handle", "handles");
  if (borders > 0) {
    why += ", " + grouped(borders, "border", "borders");
    if (model.options.keepsBorders) why += agreeing(borders, ", which is kept", ", which are kept");
  }
  if (model.creaseEdges > 0) why += ", " + grouped(model.creaseEdges, "crease", "creases");
  if (!model.attributes.wedgeAttributes.empty()) why += ", seams";
  if (!model.attributes.materialOf.empty() || !model.attributes.objectOf.empty())
    why += ", edges between materials or objects";
  for (const Attribute& attribute : model.attributes.triangleAttributes)
    if (isLabel(attribute)) why += fmt::format(", edges between values of {}", attribute.name);
  return why + seamsOfModel(model);
}

}  // namespace arete
