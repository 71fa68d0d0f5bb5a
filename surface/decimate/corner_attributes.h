// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/decimate/attribute_quadrics.h"
#include "surface/decimate/contraction_mesh.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// What vertices and corners carry while vertices are contracted. Corners of a vertex that share wedge and
/// part (surface/model/parts.h) are one class. A vertex of several classes is on a line, as of a seam; it
/// moves along it alone: each class of a vertex that goes must continue as one class of the vertex that
/// stays, which a triangle between them tells.
class CornerAttributes {
 public:
  /// @param shape    of the mesh, in the frame of the quadrics
  /// @param options  whose weights of attributes and of triangles count
  CornerAttributes(const SurfaceMesh& mesh, const TriangleMesh& shape, const DecimateOptions& options);

  /// By triangle of the source: partsOf().
  const std::vector<std::uint32_t>& partOf() const { return partOf_; }
  bool isOnLine(const ContractionMesh& mesh, std::uint32_t v) const;
  /// Whether every class of the other vertices continues at the first one. Before the contraction.
  bool mayJoin(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices) const;
  bool areWeighed() const { return ofVertices_.channels.areWeighed() || ofClasses_.channels.areWeighed(); }
  /// What the attributes add to the cost of a place, when the first vertex stands for all of them with the
  /// best attributes at the place, class by class. Precondition: mayJoin().
  Quadric quadricOf(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices) const;
  /// What they cost more than that when the first vertex keeps its own.
  double gapOf(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices) const;
  /// Joins the classes. Attributes become the best ones at the place; where the triangles say nothing of
  /// them, as next to numbers that are not finite, they are averaged. With isSolved false, continuous
  /// attributes are averaged with weights by vertex, unless the first has all the weight; labels are those of
  /// the first vertex. Before the contraction. Precondition: mayJoin().
  void join(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices,
            std::span<const double> weights, const Vec3& place, bool isSolved);

  /// The mesh that is left.
  /// @param vertexOf receives a vertex of the source by vertex; faceOf, that by triangle
  SurfaceMesh take(const SurfaceMesh& source, const ContractionMesh& mesh,
                   std::vector<std::uint32_t>& vertexOf, std::vector<std::uint32_t>& faceOf) const;

 private:
  /// The continuous attributes of vertices, or of wedges, as numbers, and whose were averaged.
  struct Records {
    std::vector<const Attribute*> attributes;
    std::vector<std::vector<double>> values;  ///< by attribute: element by element
    std::vector<std::uint8_t> isAveraged;     ///< by element
    AttributeChannels channels;
    std::vector<AttributeQuadric> quadrics;  ///< by element; empty without attributes

    Records(const std::vector<Attribute>& all, std::size_t elements, const DecimateOptions& options,
            double diagonal);
    double number(std::size_t channel, std::uint32_t element) const;
    void addTriangle(const std::array<Vec3, 3>& places, double weight,
                     const std::array<std::uint32_t, 3>& elements);
    /// What the first of them costs more with its own numbers than with the best.
    double gap(std::span<const std::uint32_t> elements, const Vec3& place) const;
    AttributeQuadric sum(std::span<const std::uint32_t> elements) const;
    /// The quadrics of all become the first one's.
    void join(std::span<const std::uint32_t> elements);
    /// Its numbers become the best at a place.
    void solve(std::uint32_t element, const Vec3& place);
    /// Directions become unit vectors, unless they have no length; the sign of a tangent is 1 or -1.
    void makeUnit(std::size_t attribute, std::uint32_t element);
    void average(std::span<const std::uint32_t> elements, std::span<const double> weights);
    /// An attribute of these elements in this order.
    Attribute taken(const Attribute& attribute, std::span<const std::uint32_t> elements) const;
  };

  /// By class of a vertex at an edge: the class of the other end that continues it; kNone: several.
  using Continuations = boost::container::small_vector<std::pair<std::uint32_t, std::uint32_t>, 4>;
  /// The classes that become one, led by the class of the first vertex, without classes that nothing joins.
  /// Calls visit(classes).
  template <class Visit>
  void forJoined(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices,
                 const Visit& visit) const;
  Continuations continuations(const ContractionMesh& mesh, std::uint32_t v, std::uint32_t kept) const;
  /// kNone: none, or several.
  static std::uint32_t continued(const Continuations& all, std::uint32_t classOfV);

  std::vector<std::uint32_t> partOf_;
  bool hasClasses_ = false;
  std::vector<std::uint32_t>
      classOf_;  ///< by corner 3 t + c; a class is a wedge, or more than a wedge at parts' edges
  std::vector<std::uint32_t> wedgeOf_;  ///< by class
  Records ofVertices_, ofClasses_;
};

}  // namespace arete
