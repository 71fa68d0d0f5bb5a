// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "engine/base/ids.h"
#include "engine/base/vec.h"
#include "engine/mt/columns.h"
#include "engine/mt/outward_scale.h"
#include "engine/mt/vertex_arrays.h"

namespace arete {

/// A ball in metric space (see MetricFrame).
struct Sphere {
  float x = 0, y = 0, z = 0, radius = 0;
};

/// The map from plan coordinates and heights to a space in which distances have a unit: (p - origin) * scale,
/// by axis. For a raster in a geographic CRS the scale is the ground size of a column and of a row in metres.
struct MetricFrame {
  Vec3 origin;
  Vec3 scale = {1, 1, 1};

  Vec3 toMetric(const Vec3& p) const {
    return {(p.x - origin.x) * scale.x, (p.y - origin.y) * scale.y, (p.z - origin.z) * scale.z};
  }
};

/// The flat arrays of a multitriangulation. N nodes, V = rootVertices + N vertices, R root triangles.
///
/// Every node inserts one vertex: node n inserts vertex rootVertices + n, and its ceiling is that vertex's
/// star. The star is stored as its link, the cycle (or, on a border, the chain) of vertices around it,
/// counter-clockwise:
///
///      link[1]-----link[0]         slot i of the star is the triangle (apex, link[i], link[i + 1])
///        /  \  1  /  \             closed star: k slots, k triangles, link[k] = link[0]
///       / 2  \   / 0  \            open star:   k + 1 slots, k triangles; the last slot is no triangle
///  link[2]---apex-----link[5]
///       \ 3  /   \ 5  /            floor: slots - 2 triangles, whether the star is closed or open
///        \  /  4  \  /             (a polygon with k, or k + 1, corners)
///      link[3]-----link[4]
///
/// Triangle ids number the root's triangles first, then the slots of node 0, 1, ... A slot that is no
/// triangle has its own creator as its remover, so the test for membership in a front excludes it:
///
///     t is in the front of a cut  <=>  creator(t) in cut (or root)  and  remover(t) not in cut
///
/// Nodes are sorted by falling band of saturated error, parents first. A uniform cut is therefore a prefix of
/// the nodes and a part of one band, and every prefix of the nodes is a cut whose vertices are a prefix of
/// the vertices. Within a band the nodes follow the ground (docs/decisions/0008), so that the nodes of a
/// region are adjacent in memory. A link contains older vertices only: link[i] < apex.
struct MtArrays {
  std::uint32_t rootVertices = 0;
  std::span<const std::array<std::uint32_t, 3>> rootTriangles;  ///< R

  std::span<const std::uint32_t> slotBegin;  ///< N + 1: node n owns slots [slotBegin[n], slotBegin[n + 1])
  std::span<const std::uint32_t> link;       ///< S: a vertex per slot
  std::span<const std::uint32_t> remover;    ///< R + S: the node that removes a triangle, or kNone
  std::span<const std::uint16_t> error;  ///< R + S: max |z - plane| over the samples covered, coded outwards
  std::span<const std::uint32_t> floor;  ///< S - 2N triangle ids; node n's begin at slotBegin[n] - 2n
  std::span<const std::uint16_t> saturatedError;  ///< N, in falling bands
  std::span<const Sphere> sphere;  ///< N, saturated: encloses the node's region and its children's spheres
  /// Of every cluster of kNodesPerBlock nodes, and after all of these of every cluster group of
  /// kNodesPerPage: the largest saturated error and a ball that contains their spheres
  /// (engine/mt/node_blocks.h).
  std::span<const std::uint16_t> blockError;
  std::span<const Sphere> blockSphere;
  std::span<const std::uint32_t> creatorHint;  ///< ceil(S / 64): the node that owns slot 64 i
  /// Of a part of an MT: a bit for each triangle id, 64 in a word, of the triangles that a node of the whole
  /// removes and no node of the part. Empty: nothing is missing.
  std::span<const std::uint64_t> missing;

  OutwardScale scale;  ///< of error and saturatedError, and of columns of such codes
  MetricFrame metric;  ///< of the spheres
  VertexArrays vertices;
  Columns columns;
};

/// An immutable multitriangulation [DeFlorianiMagilloPuppo1998] of vertex insertions: flat arrays in memory
/// or in a mapped file, kept alive by an owner. Cheap to copy. Thread-safe: it is only read.
class MultiTriangulation {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  static constexpr std::uint32_t kSlotsPerHint = 64;

  static constexpr std::uint32_t kNodesPerBlock = 64, kNodesPerPage = 1024;

  /// Nodes are sorted by falling band: an octave of saturated errors.
  static constexpr int kBandShift = 11;
  static constexpr std::uint32_t bandOf(OutwardScale::Code saturatedError) {
    return saturatedError >> kBandShift;
  }
  static constexpr std::uint32_t kBands = (OutwardScale::kMaxCode >> kBandShift) + 1;

  MultiTriangulation() = default;
  /// Precondition: the arrays have the sizes stated in MtArrays (checkSizes) and live as long as the owner.
  MultiTriangulation(const MtArrays& arrays, std::shared_ptr<const void> owner)
      : a_(arrays), owner_(std::move(owner)) {}

  const MtArrays& arrays() const { return a_; }
  const VertexArrays& vertices() const { return a_.vertices; }
  /// Of one kind of model or of both: empty if it has none.
  template <class T>
  std::span<const T> column(ColumnKey<T> key) const {
    return a_.columns.of(key);
  }
  /// Of all codes of errors.
  const OutwardScale& scale() const { return a_.scale; }
  /// The frame of the spheres.
  const MetricFrame& metric() const { return a_.metric; }

  std::uint32_t nodeCount() const { return static_cast<std::uint32_t>(a_.saturatedError.size()); }
  std::uint32_t vertexCount() const { return a_.rootVertices + nodeCount(); }
  std::uint32_t rootVertexCount() const { return a_.rootVertices; }
  std::uint32_t rootTriangleCount() const { return static_cast<std::uint32_t>(a_.rootTriangles.size()); }
  /// The corners of the root's triangles, which have the first ids.
  std::span<const std::array<std::uint32_t, 3>> rootTriangles() const { return a_.rootTriangles; }
  /// The number of triangle ids, including slots that are no triangle.
  std::uint32_t triangleIdCount() const { return static_cast<std::uint32_t>(a_.remover.size()); }
  /// The number of slots of all nodes.
  std::uint32_t slotTotal() const { return static_cast<std::uint32_t>(a_.link.size()); }
  /// The number of triangles of the whole MT. O(N).
  std::uint64_t triangleCount() const;
  /// The number of triangles of the finest front. O(N).
  std::uint32_t finestTriangleCount() const { return prefixTriangleCount(nodeCount()); }
  /// The number of triangles in the front of the first n nodes. O(n).
  std::uint32_t prefixTriangleCount(std::uint32_t n) const;
  /// The nodes of a band: from bandBegin() to before bandEnd(). O(log N).
  std::uint32_t bandBegin(std::uint32_t band) const;
  std::uint32_t bandEnd(std::uint32_t band) const { return band == 0 ? nodeCount() : bandBegin(band - 1); }
  /// The largest saturated error: at least the error of every triangle that a node removes. 0 without nodes.
  /// O(its band).
  double largestError() const;

  VertexId apex(NodeId n) const { return VertexId(a_.rootVertices + n.index()); }
  std::uint32_t slotCount(NodeId n) const { return a_.slotBegin[n.index() + 1] - a_.slotBegin[n.index()]; }
  /// The first slot of a node, counted over all nodes.
  std::uint32_t firstSlot(NodeId n) const { return a_.slotBegin[n.index()]; }
  TriangleId slotTriangle(NodeId n, std::uint32_t slot) const {
    return TriangleId(rootTriangleCount() + a_.slotBegin[n.index()] + slot);
  }
  std::span<const std::uint32_t> link(NodeId n) const {
    return a_.link.subspan(a_.slotBegin[n.index()], slotCount(n));
  }
  /// Whether the star is an open fan: the vertex was inserted on a border.
  bool isOpen(NodeId n) const {
    return a_.remover[rootTriangleCount() + a_.slotBegin[n.index() + 1] - 1] == n.index();
  }
  std::uint32_t ceilingSize(NodeId n) const { return slotCount(n) - (isOpen(n) ? 1 : 0); }
  std::span<const std::uint32_t> floor(NodeId n) const {
    return a_.floor.subspan(a_.slotBegin[n.index()] - 2 * n.index(), slotCount(n) - 2);
  }

  /// The node that removes t, or invalid. Precondition: t is a triangle.
  NodeId remover(TriangleId t) const { return NodeId(a_.remover[t.index()]); }
  /// Whether this is a part of an MT, and the node that removes t is not in it.
  bool isRemoverMissing(TriangleId t) const {
    return !a_.missing.empty() && (a_.missing[t.index() / 64] >> t.index() % 64 & 1) != 0;
  }
  /// The node that creates t, or invalid for a root triangle. O(1): a hint and a short scan.
  NodeId creator(TriangleId t) const {
    if (t.index() < rootTriangleCount()) return {};
    const std::uint32_t slot = t.index() - rootTriangleCount();
    std::uint32_t n = a_.creatorHint[slot / kSlotsPerHint];
    while (a_.slotBegin[n + 1] <= slot) ++n;
    return NodeId(n);
  }
  /// The corners of t, counter-clockwise. Precondition: t is a triangle.
  std::array<std::uint32_t, 3> corners(TriangleId t) const { return corners(t, creator(t)); }
  std::array<std::uint32_t, 3> corners(TriangleId t, NodeId creatorOfT) const {
    if (!creatorOfT.isValid()) return a_.rootTriangles[t.index()];
    const std::uint32_t begin = a_.slotBegin[creatorOfT.index()], end = a_.slotBegin[creatorOfT.index() + 1];
    const std::uint32_t slot = t.index() - rootTriangleCount();
    return {apex(creatorOfT).index(), a_.link[slot], a_.link[slot + 1 < end ? slot + 1 : begin]};
  }

  double error(TriangleId t) const { return a_.scale.decode(a_.error[t.index()]); }
  OutwardScale::Code errorCode(TriangleId t) const { return a_.error[t.index()]; }
  /// A magnitude of a column of codes. Precondition: it has the column.
  double decoded(ColumnKey<OutwardScale::Code> key, TriangleId t) const {
    return a_.scale.decode(a_.columns.of(key)[t.index()]);
  }
  double saturatedError(NodeId n) const { return a_.scale.decode(a_.saturatedError[n.index()]); }
  OutwardScale::Code saturatedCode(NodeId n) const { return a_.saturatedError[n.index()]; }
  const Sphere& sphere(NodeId n) const { return a_.sphere[n.index()]; }
  Vec3 position(VertexId v) const { return a_.vertices.position(v); }

 private:
  MtArrays a_;
  std::shared_ptr<const void> owner_;
};

}  // namespace arete
