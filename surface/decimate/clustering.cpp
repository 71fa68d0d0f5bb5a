// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex clustering with an octree [RossignacBorrel1993] [SchaeferWarren2003]: cells are halved until each
// has one vertex. Then cells whose children are all leaves wait in a heap, by the least of the quadric of
// their vertices; the first one becomes a leaf, until few enough triangles have their corners in three
// leaves.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <queue>
#include <tuple>

#include "engine/base/box3.h"
#include "surface/decimate/attribute_quadrics.h"
#include "surface/decimate/carried.h"
#include "surface/decimate/contractions.h"
#include "surface/decimate/nearest_corners.h"
#include "surface/decimate/quadric.h"
#include "surface/edit/small_components.h"
#include "surface/model/charts.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

constexpr std::uint32_t kNoCell = 0xFFFFFFFF;
/// Halvings of the box at most; vertices nearer than that share a leaf from the beginning.
constexpr int kMostDepth = 24;

struct Cluster {
  std::uint32_t parent = kNoCell, childrenLeft = 0;
  std::vector<std::uint32_t> children;
  std::vector<std::uint32_t> triangles;  ///< of a leaf: those with a corner in it and the others elsewhere
  Quadric quadric;
  /// Of vertices first, then of the wedges by chart, rising; empty without weights.
  std::vector<std::pair<std::uint32_t, AttributeQuadric>> attributes;
  Vec3 place{0, 0, 0};
  std::uint32_t vertex = kNoCell;  ///< of the source
  bool isLeaf = false;
};

class Clustering {
 public:
  Clustering(const FramedMesh& mesh, const DecimateOptions& options, const RunContext& context)
      : source_(mesh.source),
        shape_(mesh.shape),
        options_(options),
        context_(context),
        leafOf_(mesh.shape.positions.size(), kNoCell),
        ofVertices_(continuousOnes(mesh.source.vertexAttributes), options.attributeWeights,
                    diagonalOf(mesh.source)),
        ofWedges_(continuousOnes(mesh.source.wedgeAttributes), options.attributeWeights,
                  diagonalOf(mesh.source)) {}

  Result<FramedResult> run() {
    divide();
    addAttributes();
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
      if (!cells_[c].isLeaf && cells_[c].childrenLeft == 0) offer(c);
    std::uint64_t turns = 0;
    while (triangleCount_ > options_.maxTriangles && !heap_.empty()) {
      if ((turns++ & 1023) == 0) {
        if (context_.cancelled()) return failure(ErrorCode::interrupted, "decimation was interrupted");
        context_.report("decimate", 1 - double(triangleCount_) / double(source_.triangles.size()));
      }
      const std::uint32_t cell = std::get<1>(heap_.top());
      heap_.pop();
      join(cell);
      if (const std::uint32_t parent = cells_[cell].parent;
          parent != kNoCell && --cells_[parent].childrenLeft == 0)
        offer(parent);
    }
    context_.report("decimate", 1);
    if (triangleCount_ == 0 && !source_.triangles.empty())
      return failure(ErrorCode::invalidData,
                     fmt::format("no cells leave between one triangle and {}: the mesh is too small for it",
                                 options_.maxTriangles));
    return taken();
  }

 private:
  /// Halves the box until each leaf has one vertex; then gives the leaves their triangles and quadrics.
  void divide() {
    const auto& at = shape_.positions;
    std::vector<std::uint8_t> isUsed(at.size(), 0);
    for (const auto& t : source_.triangles)
      for (const std::uint32_t v : t) isUsed[v] = 1;
    std::vector<std::uint32_t> all;
    Box3 box = Box3::empty();
    // Vertices without a triangle get no cell, since they have no quadric and no part in the result.
    for (std::uint32_t v = 0; v < at.size(); ++v) {
      if (isUsed[v] == 0) continue;
      all.push_back(v);
      box.include(at[v]);
    }
    struct Part {
      std::vector<std::uint32_t> vertices;
      Vec3 low;
      double side;
      std::uint32_t cell;
      int depth;
    };
    std::vector<Part> parts;
    cells_.emplace_back();
    parts.push_back({std::move(all), box.low, box.longestSide(), 0, 0});
    // A stack takes the place of recursion. At the greatest depth, vertices in nearly one place stay in one
    // leaf.
    while (!parts.empty()) {
      Part part = std::move(parts.back());
      parts.pop_back();
      if (part.vertices.size() <= 1 || part.depth == kMostDepth) {
        Cluster& leaf = cells_[part.cell];
        leaf.isLeaf = true;
        if (part.vertices.empty()) continue;
        leaf.vertex = part.vertices[0];
        leaf.place = at[leaf.vertex];
        for (const std::uint32_t v : part.vertices) leafOf_[v] = part.cell;
        continue;
      }
      const double half = part.side / 2;
      const Vec3 middle = part.low + Vec3{half, half, half};
      std::array<std::vector<std::uint32_t>, 8> eighths;
      for (const std::uint32_t v : part.vertices)
        eighths[(at[v].x >= middle.x ? 1u : 0u) + (at[v].y >= middle.y ? 2u : 0u) +
                (at[v].z >= middle.z ? 4u : 0u)]
            .push_back(v);
      for (std::size_t e = 0; e < 8; ++e) {
        if (eighths[e].empty()) continue;
        const auto child = static_cast<std::uint32_t>(cells_.size());
        cells_.emplace_back();
        cells_[child].parent = part.cell;
        cells_[part.cell].children.push_back(child);
        const Vec3 corner{(e & 1) != 0 ? middle.x : part.low.x, (e & 2) != 0 ? middle.y : part.low.y,
                          (e & 4) != 0 ? middle.z : part.low.z};
        parts.push_back({std::move(eighths[e]), corner, half, child, part.depth + 1});
      }
    }
    // A cell is ready for the heap when all its children are leaves; this counts how many are not yet.
    for (Cluster& cell : cells_)
      for (const std::uint32_t child : cell.children) cell.childrenLeft += cells_[child].isLeaf ? 0 : 1;
    // Triangles with two corners in one leaf are degenerate from the start and do not count, but their planes
    // belong to the quadrics.
    isThere_.assign(source_.triangles.size(), 1);
    for (std::uint32_t t = 0; t < source_.triangles.size(); ++t) {
      const auto& [i, j, k] = source_.triangles[t];
      const Vec3 n = cross(at[j] - at[i], at[k] - at[i]);
      const double size = norm(n);
      if (size > 0)
        for (const std::uint32_t v : source_.triangles[t])
          cells_[leafOf_[v]].quadric +=
              Quadric::ofPlane(at[i], n / size, options_.weighsByArea ? size / 2 : 1);
      if (isBetween(t)) {
        ++triangleCount_;
        for (const std::uint32_t v : source_.triangles[t]) cells_[leafOf_[v]].triangles.push_back(t);
      } else {
        isThere_[t] = 0;
      }
    }
  }
  /// What triangles say of the attributes in their leaves.
  void addAttributes() {
    if (!ofVertices_.areWeighed() && !ofWedges_.areWeighed()) return;
    const std::vector<std::uint32_t> chartOf = chartsOf(source_);
    const auto addOf = [&](std::uint32_t t, const AttributeChannels& channels,
                           const std::vector<const Attribute*>& attributes,
                           const std::array<std::uint32_t, 3>& elements, std::uint32_t key) {
      const auto& [i, j, k] = shape_.triangles[t];
      const std::array<Vec3, 3> p = {shape_.positions[i], shape_.positions[j], shape_.positions[k]};
      const double size = norm(cross(p[1] - p[0], p[2] - p[0]));
      const AttributeQuadric quadric = channels.ofTriangle(
          p, options_.weighsByArea ? size / 2 : 1, [&](std::size_t channel, std::size_t corner) {
            return attributes[channels.attributeOf(channel)]->numbers(
                elements[corner])[channels.componentOf(channel)];
          });
      for (const std::uint32_t v : shape_.triangles[t]) addTo(cells_[leafOf_[v]].attributes, key, quadric);
    };
    const auto ofVertices = continuousOnes(source_.vertexAttributes),
               ofWedges = continuousOnes(source_.wedgeAttributes);
    for (std::uint32_t t = 0; t < source_.triangles.size(); ++t) {
      if (ofVertices_.areWeighed()) addOf(t, ofVertices_, ofVertices, source_.triangles[t], 0);
      if (ofWedges_.areWeighed() && source_.hasWedges())
        addOf(t, ofWedges_, ofWedges, source_.wedges[t], 1 + (chartOf.empty() ? 0 : chartOf[t]));
    }
  }
  static void addTo(std::vector<std::pair<std::uint32_t, AttributeQuadric>>& all, std::uint32_t key,
                    const AttributeQuadric& quadric) {
    const auto at =
        std::ranges::lower_bound(all, key, {}, &std::pair<std::uint32_t, AttributeQuadric>::first);
    if (at != all.end() && at->first == key)
      at->second += quadric;
    else
      all.emplace(at, key, quadric);
  }

  bool isBetween(std::uint32_t t) const {
    const auto& [i, j, k] = source_.triangles[t];
    return leafOf_[i] != leafOf_[j] && leafOf_[j] != leafOf_[k] && leafOf_[k] != leafOf_[i];
  }

  /// Puts a cell whose children are leaves on the heap.
  void offer(std::uint32_t c) {
    Cluster& cell = cells_[c];
    ++evaluations_;
    std::vector<Vec3> places;
    for (const std::uint32_t child : cell.children) {
      cell.quadric += cells_[child].quadric;
      places.push_back(cells_[child].place);
      for (const auto& [key, its] : cells_[child].attributes) addTo(cell.attributes, key, its);
      cells_[child].attributes = {};
    }
    Quadric quadric = cell.quadric;
    for (const auto& [key, its] : cell.attributes)
      quadric += (key == 0 ? ofVertices_ : ofWedges_).withBest(its);
    std::size_t best = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
      if (quadric.at(places[i]) < quadric.at(places[best])) best = i;
    cell.vertex = cells_[cell.children[best]].vertex;
    cell.place = options_.keepsClusterVertices ? places[best] : placeFor(quadric, places);
    heap_.emplace(std::max(0.0, quadric.at(cell.place)), c);
  }

  void join(std::uint32_t c) {
    ++steps_;
    Cluster& cell = cells_[c];
    cell.isLeaf = true;
    std::vector<std::uint32_t> triangles;
    for (const std::uint32_t child : cell.children) {
      triangles.insert(triangles.end(), cells_[child].triangles.begin(), cells_[child].triangles.end());
      cells_[child].triangles = {};
    }
    std::ranges::sort(triangles);
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    const auto isMine = [&](std::uint32_t leaf) { return leaf != kNoCell && cells_[leaf].parent == c; };
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t v : source_.triangles[t])
        if (isMine(leafOf_[v])) leafOf_[v] = c;
    for (const std::uint32_t t : triangles) {
      if (isThere_[t] == 0) continue;
      if (isBetween(t)) {
        cell.triangles.push_back(t);
      } else {
        isThere_[t] = 0;
        --triangleCount_;
      }
    }
  }

  FramedResult taken() const {
    // Corners of triangles that are left know their leaf.
    TriangleMesh shape;
    std::vector<std::uint32_t> vertexOf, faceOf, numberOf(cells_.size(), kNoCell);
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> sorted;
    for (std::uint32_t t = 0; t < source_.triangles.size(); ++t) {
      if (isThere_[t] == 0) continue;
      std::array<std::uint32_t, 3> leaves{};
      for (std::size_t k = 0; k < 3; ++k) leaves[k] = leafOf_[source_.triangles[t][k]];
      std::ranges::sort(leaves);
      sorted.emplace_back(leaves, t);
    }
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < sorted.size(); ++i)
      if (i == 0 || sorted[i].first != sorted[i - 1].first) faceOf.push_back(sorted[i].second);
    std::ranges::sort(faceOf);
    for (const std::uint32_t t : faceOf) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t leaf = leafOf_[source_.triangles[t][k]];
        if (numberOf[leaf] == kNoCell) {
          numberOf[leaf] = static_cast<std::uint32_t>(vertexOf.size());
          vertexOf.push_back(cells_[leaf].vertex);
          shape.positions.push_back(cells_[leaf].place);
        }
        corners[k] = numberOf[leaf];
      }
      shape.triangles.push_back(corners);
    }
    DecimatedMesh result = carried(source_, std::move(shape), std::move(vertexOf), std::move(faceOf));
    takeNearestAttributes({source_, shape_}, result);
    result.evaluations = evaluations_;
    result.steps = steps_;
    return {std::move(result), joinedTo()};
  }
  std::vector<std::uint32_t> joinedTo() const {
    std::vector<std::uint32_t> all(leafOf_.size());
    for (std::uint32_t v = 0; v < all.size(); ++v) {
      all[v] = v;
      if (leafOf_[v] == kNoCell) continue;
      std::uint32_t leaf = leafOf_[v];
      while (cells_[leaf].parent != kNoCell && cells_[cells_[leaf].parent].isLeaf) leaf = cells_[leaf].parent;
      all[v] = cells_[leaf].vertex;
    }
    return all;
  }

  const SurfaceMesh& source_;
  const TriangleMesh& shape_;
  const DecimateOptions& options_;
  const RunContext& context_;
  std::vector<Cluster> cells_;
  std::vector<std::uint32_t> leafOf_;  // by vertex; right for those of triangles that are there
  std::vector<std::uint8_t> isThere_;  // by triangle
  AttributeChannels ofVertices_, ofWedges_;
  std::uint64_t triangleCount_ = 0, evaluations_ = 0, steps_ = 0;
  using Entry = std::tuple<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
};

}  // namespace

Result<FramedResult> decimateByClusters(const FramedMesh& mesh, const DecimateOptions& options,
                                        const RunContext& context) {
  return Clustering(mesh, options, context).run();
}

}  // namespace arete
