// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every edge, fan and border belongs to one component, and is counted there. A vertex counts once in each of
// its components: its fans are sorted by vertex and component.

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/parallel/parallel_loops.h"
#include "surface/diagnosis/parts.h"
#include "surface/topology/border_loops.h"
#include "surface/topology/components.h"
#include "surface/topology/edges.h"
#include "surface/topology/fans.h"

namespace arete::diagnosis {
namespace {

class TopologyPass {
 public:
  TopologyPass(const TriangleMesh& mesh, const KeptTriangles& kept, const DiagnosisOptions& options,
               MeshDiagnosis& result)
      : mesh_(mesh),
        kept_(kept),
        options_(options),
        result_(result),
        edges_(kept.triangles(), mesh.positions.size()) {
    // Fans, components and orientation each need only the edges, so they are found side by side.
    parallelInvoke([&] { fans_.emplace(edges_); },
                   [&] {
                     components_.emplace(edges_);
                     orientation_.emplace(edges_);
                   });
  }

  void run() {
    result_.components.resize(components_->count);
    countTriangles();
    countEdges();
    countVertices();
    findOrientation();
    listBorders();
    for (ComponentDiagnosis& c : result_.components) conclude(c);
    listGaps();
  }

 private:
  std::uint32_t componentOf(CornerId corner) const {
    return components_->componentOf[triangleOf(corner).index()];
  }
  ComponentDiagnosis& at(CornerId corner) { return result_.components[componentOf(corner)]; }
  Vec3 middle(const MeshEdges::Edge& edge) const {
    return mesh_.positions[edge.low.index()] / 2 + mesh_.positions[edge.high.index()] / 2;
  }
  void addEdge(MeshFindings& findings, const MeshEdges::Edge& edge) const {
    add(findings, options_.mostPlaces, {edge.low.index(), edge.high.index()}, middle(edge));
  }

  void countTriangles() {
    // A triangle that is left out keeps a number beyond all components.
    result_.componentOf.assign(mesh_.triangles.size(), components_->count);
    for (std::uint32_t t = 0; t < kept_.triangles().size(); ++t) {
      const std::uint32_t c = components_->componentOf[t];
      if (result_.components[c].triangles++ == 0) result_.components[c].firstTriangle = kept_.numberOf(t);
      result_.componentOf[kept_.numberOf(t)] = c;
    }
  }

  void countEdges() {
    hasWideEdge_.assign(mesh_.positions.size(), 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const MeshEdges::Edge edge = edges_[e];
      ComponentDiagnosis& component = at(edge.sides[0]);
      ++component.edges;
      if (!edge.isManifold()) {
        ++component.nonManifoldEdges;
        addEdge(result_.nonManifoldEdges, edge);
        hasWideEdge_[edge.low.index()] = hasWideEdge_[edge.high.index()] = 1;
      } else if (edge.sides.size() == 2 && !edges_.areOpposed(edge.sides[0], edge.sides[1])) {
        ++component.turnedEdges;
        addEdge(result_.turnedEdges, edge);
      }
    }
  }

  void countVertices() {
    // The component of a fan is that of its first corner.
    std::vector<std::uint8_t> isSeen(fans_->vertexOf.size(), 0);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> places;  // vertex, component; of several fans
    for (std::uint32_t c = 0; c < fans_->fanOf.size(); ++c) {
      const FanId fan = fans_->fanOf[c];
      if (std::exchange(isSeen[fan.index()], 1) != 0) continue;
      const std::uint32_t vertex = fans_->vertexOf[fan.index()].index(), component = componentOf(CornerId(c));
      if (fans_->fanCount[vertex] == 1)
        ++result_.components[component].vertices;
      else
        places.push_back({vertex, component});
    }
    std::ranges::sort(places);
    for (std::size_t i = 0; i < places.size();) {
      std::size_t end = i;
      while (end < places.size() && places[end] == places[i]) ++end;
      ComponentDiagnosis& component = result_.components[places[i].second];
      ++component.vertices;
      if (end - i > 1) ++component.nonManifoldVertices;
      i = end;
    }
    for (std::uint32_t v = 0; v < fans_->fanCount.size(); ++v)
      if (fans_->fanCount[v] > 1 && hasWideEdge_[v] == 0)
        add(result_.nonManifoldVertices, options_.mostPlaces, {v}, mesh_.positions[v]);
  }

  void findOrientation() {
    std::vector<std::uint8_t> isSeen(orientation_->contradiction.size(), 0);
    for (std::uint32_t t = 0; t < kept_.triangles().size(); ++t) {
      const std::uint32_t patch = orientation_->patchOf[t];
      if (std::exchange(isSeen[patch], 1) != 0 || orientation_->isOrientable(patch, edges_)) continue;
      result_.components[components_->componentOf[t]].isOrientable = false;
      addEdge(result_.nonOrientable, edges_[orientation_->contradiction[patch]]);
    }
  }

  void listBorders() {
    for (const BorderLoop& loop : findBorderLoops(edges_, *fans_)) {
      MeshBorder border;
      border.component = componentOf(loop.sides[0]);
      border.edgeCount = static_cast<std::uint32_t>(loop.sides.size());
      border.firstVertex = edges_.origin(loop.sides[0]).index();
      border.isClosed = loop.isClosed;
      for (const CornerId side : loop.sides)
        border.length +=
            norm(mesh_.positions[edges_.target(side).index()] - mesh_.positions[edges_.origin(side).index()]);
      result_.borders.push_back(border);
      ++result_.components[border.component].borders;
    }
  }

  static void conclude(ComponentDiagnosis& c) {
    c.eulerNumber = std::int64_t(c.vertices) - std::int64_t(c.edges) + std::int64_t(c.triangles);
    // Euler number = 2 - 2 genus - borders.
    if (c.isManifold() && c.isOrientable) c.genus = (2 - std::int64_t(c.borders) - c.eulerNumber) / 2;
  }

  void listGaps() {
    std::vector<std::array<std::uint32_t, 2>> borderEdges;
    std::vector<std::uint32_t> borderVertices;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (const MeshEdges::Edge edge = edges_[e]; edge.isBorder()) {
        borderEdges.push_back({edge.low.index(), edge.high.index()});
        borderVertices.push_back(edge.low.index());
        borderVertices.push_back(edge.high.index());
        const double length = norm(mesh_.positions[edge.high.index()] - mesh_.positions[edge.low.index()]);
        double& shortest = result_.shortestBorderEdge;
        if (length > 0 && (shortest == 0 || length < shortest)) shortest = length;
      }
    std::ranges::sort(borderVertices);
    borderVertices.erase(std::unique(borderVertices.begin(), borderVertices.end()), borderVertices.end());
    for (const TJunction& t :
         findTJunctions(mesh_.positions, borderEdges, borderVertices,
                        withinRounding(options_.tJunctionTolerance * result_.diagonal, options_.rounding)))
      add(result_.tJunctions, options_.mostPlaces, {t.vertex, t.low, t.high}, mesh_.positions[t.vertex]);
    if (options_.rounding > 0)
      for (const auto& [edge, apart] :
           findNearBorders(mesh_.positions, borderEdges, withinRounding(0, options_.rounding))) {
        add(result_.nearBorders, options_.mostPlaces, {edge[0], edge[1]},
            mesh_.positions[edge[0]] / 2 + mesh_.positions[edge[1]] / 2);
        result_.farthestNear = std::max(result_.farthestNear, apart);
      }
  }

  const TriangleMesh& mesh_;
  const KeptTriangles& kept_;
  const DiagnosisOptions& options_;
  MeshDiagnosis& result_;
  const MeshEdges edges_;
  std::optional<MeshFans> fans_;
  std::optional<MeshComponents> components_;
  std::optional<MeshOrientation> orientation_;
  std::vector<std::uint8_t> hasWideEdge_;  // by vertex: an edge of more than two triangles
};

}  // namespace

void examineTopology(const TriangleMesh& mesh, const KeptTriangles& kept, const DiagnosisOptions& options,
                     MeshDiagnosis& result) {
  TopologyPass(mesh, kept, options, result).run();
}

}  // namespace arete::diagnosis
