// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/mesh/diagnosis_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "cli/arguments/arguments.h"
#include "io/query/mesh/findings.h"

namespace arete {
namespace {

constexpr std::size_t kMostLines = 10;

std::string elementsText(FindingElements kind, const std::vector<std::uint32_t>& elements,
                         const MeshNumbers& numbers) {
  std::vector<std::uint64_t> named;
  for (const std::uint32_t e : elements)
    named.push_back(kind == FindingElements::faces ? numbers.face(e) : numbers.vertex(e));
  switch (kind) {
    case FindingElements::edge:
      return fmt::format("edge {}", fmt::join(named, " to "));
    case FindingElements::vertexAndEdge:
      return fmt::format("vertex {} in the edge {} to {}", named[0], named[1], named[2]);
    case FindingElements::faces:
      return fmt::format("{} {}", named.size() == 1 ? "face" : "faces", fmt::join(named, " and "));
    default:
      return fmt::format("{} {}", named.size() == 1 ? "vertex" : "vertices", fmt::join(named, " and "));
  }
}

void addFindings(std::string& text, const MeshDiagnosis& diagnosis, const MeshNumbers& numbers) {
  for (const FindingKind& kind : findingKinds()) {
    const MeshFindings* const found = kind.of(diagnosis);
    if (found == nullptr || found->count == 0) continue;
    text += fmt::format("  {}{}\n", countText(kind, found->count), kind.isFault ? "" : " (no fault)");
    const std::size_t shown = std::min(found->places.size(), kMostLines);
    for (std::size_t i = 0; i < shown; ++i) {
      const auto& [elements, p] = found->places[i];
      text += fmt::format("    {} at {:.9g}, {:.9g}, {:.9g}\n",
                          elementsText(kind.elements, elements, numbers), p.x, p.y, p.z);
    }
    if (found->count > shown) text += fmt::format("    and {} more\n", grouped(found->count - shown));
  }
}

/// The numbers of the largest things, the largest first.
template <class T, class Size>
std::vector<std::size_t> largest(const std::vector<T>& things, const Size& size) {
  std::vector<std::size_t> order(things.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t shown = std::min(order.size(), kMostLines);
  std::ranges::partial_sort(order, order.begin() + std::ptrdiff_t(shown), [&](std::size_t a, std::size_t b) {
    return size(things[a]) != size(things[b]) ? size(things[a]) > size(things[b]) : a < b;
  });
  order.resize(shown);
  return order;
}

void addMore(std::string& text, std::size_t count) {
  if (count > kMostLines) text += fmt::format("    and {} more\n", grouped(count - kMostLines));
}

}  // namespace

std::string diagnosisText(const MeshDiagnosis& diagnosis, const MeshNumbers& numbers) {
  std::string text;
  addFindings(text, diagnosis, numbers);
  const auto& components = diagnosis.components;
  if (!components.empty()) text += fmt::format("  components  {}\n", grouped(components.size()));
  for (const std::size_t i : largest(components, [](const ComponentDiagnosis& c) { return c.triangles; })) {
    const ComponentDiagnosis& c = components[i];
    text += fmt::format("    {}: {}, {}, {}, Euler number {}, ", i,
                        grouped(c.triangles, "triangle", "triangles"), grouped(c.edges, "edge", "edges"),
                        grouped(c.vertices, "vertex", "vertices"), c.eulerNumber);
    text += c.genus ? fmt::format("genus {}, ", *c.genus) : "";
    text += c.isManifold() ? "manifold" : "not manifold";
    text += c.isClosed() ? ", closed"
                         : fmt::format(", {} {}", grouped(c.borders), c.borders == 1 ? "border" : "borders");
    text += !c.isOrientable ? ", not orientable" : c.turnedEdges > 0 ? ", not coherent" : "";
    text += fmt::format(", from face {}\n", numbers.face(c.firstTriangle));
  }
  addMore(text, components.size());
  const auto& borders = diagnosis.borders;
  if (!borders.empty()) text += fmt::format("  borders     {}\n", grouped(borders.size()));
  for (const std::size_t i : largest(borders, [](const MeshBorder& b) { return b.edgeCount; })) {
    const MeshBorder& b = borders[i];
    text += fmt::format("    {} {}, length {:.6g}, from vertex {}, of component {}{}\n", grouped(b.edgeCount),
                        b.edgeCount == 1 ? "edge" : "edges", b.length, numbers.vertex(b.firstVertex),
                        b.component, b.isClosed ? "" : ", no loop");
  }
  addMore(text, borders.size());
  return text;
}

}  // namespace arete
