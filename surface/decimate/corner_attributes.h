// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "surface/decimate/contraction_mesh.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// What vertices and corners carry while vertices are contracted. Corners of a vertex that share wedge and
/// part (surface/model/parts.h) are one class. A vertex of several classes is on a line, as of a seam; it
/// moves along it alone: each class of a vertex that goes must continue as one class of the vertex that
/// stays, which a triangle between them tells.
class CornerAttributes {
 public:
  explicit CornerAttributes(const SurfaceMesh& mesh);

  /// By triangle of the source: partsOf().
  const std::vector<std::uint32_t>& partOf() const { return partOf_; }
  bool isOnLine(const ContractionMesh& mesh, std::uint32_t v) const;
  /// Whether every class of the other vertices continues at the first one. Before the contraction.
  bool mayJoin(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices) const;
  /// Joins the classes. Continuous attributes are averaged with weights by vertex, unless the first has all
  /// the weight; labels are those of the first vertex. Before the contraction. Precondition: mayJoin().
  void join(const ContractionMesh& mesh, std::span<const std::uint32_t> vertices,
            std::span<const double> weights);

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

    Records(const std::vector<Attribute>& all, std::size_t elements);
    void average(std::span<const std::uint32_t> elements, std::span<const double> weights);
    /// An attribute of these elements in this order.
    Attribute taken(const Attribute& attribute, std::span<const std::uint32_t> elements) const;
  };

  /// By class of a vertex at an edge: the class of the other end that continues it; kNone: several.
  using Continuations = boost::container::small_vector<std::pair<std::uint32_t, std::uint32_t>, 4>;
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
