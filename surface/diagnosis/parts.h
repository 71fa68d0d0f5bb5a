// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/topology/edges.h"

// The passes of diagnose(). Each fills its own members of the diagnosis.
namespace arete::diagnosis {

using Triangle = std::array<std::uint32_t, 3>;

/// Counts a finding, and keeps its place while there are fewer than `most`.
void add(MeshFindings& findings, std::size_t most, std::vector<std::uint32_t> elements, const Vec3& place);

Vec3 centroid(const TriangleMesh& mesh, std::uint32_t triangle);

/// Whether a triangle has a vertex twice.
inline bool hasRepeat(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The triangles of a mesh with three different vertices.
class KeptTriangles {
 public:
  /// Keeps a reference to the mesh. O(triangles).
  explicit KeptTriangles(const TriangleMesh& mesh);
  KeptTriangles(const KeptTriangles&) = delete;
  KeptTriangles& operator=(const KeptTriangles&) = delete;

  std::span<const Triangle> triangles() const { return triangles_; }
  /// The number in the mesh of the i-th.
  std::uint32_t numberOf(std::uint32_t i) const { return numbers_.empty() ? i : numbers_[i]; }

 private:
  std::span<const Triangle> triangles_;
  // Both empty where all triangles are kept.
  std::vector<Triangle> copies_;
  std::vector<std::uint32_t> numbers_;
};

/// The lowest and the highest coordinates of the vertices that triangles use; zeros if there is none.
std::array<Vec3, 2> boxOf(const TriangleMesh& mesh);
/// The length of its diagonal, also where the squares of its sides overflow.
double diagonalOf(const std::array<Vec3, 2>& box);

/// How far apart two things may be that rounding alone may have moved apart, each by so much: at least a
/// tolerance.
inline double withinRounding(double tolerance, double rounding) {
  return std::max(tolerance, 2 * rounding * (1 + 1e-9));
}

/// Vertices: unused, double.
void examineVertices(const TriangleMesh& mesh, const DiagnosisOptions& options, MeshDiagnosis& result);
/// Triangles: degenerate, duplicate, double-sided.
void examineFaces(const TriangleMesh& mesh, const DiagnosisOptions& options, MeshDiagnosis& result);
/// Edges, fans, borders and components.
void examineTopology(const TriangleMesh& mesh, const KeptTriangles& kept, const DiagnosisOptions& options,
                     MeshDiagnosis& result);

/// Whether three points are on one line. Exact.
bool areCollinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// A vertex inside an edge.
struct TJunction {
  std::uint32_t vertex, low, high;
  auto operator<=>(const TJunction&) const = default;
};
/// The vertices that lie within a distance of an edge and farther than it from its ends.
/// @return in increasing order. O(n log n) but where many vertices are near many edges.
std::vector<TJunction> findTJunctions(std::span<const Vec3> positions,
                                      std::span<const std::array<std::uint32_t, 2>> edges,
                                      std::span<const std::uint32_t> vertices, double distance);

/// A border edge that is another one but for rounding, by its vertices.
struct NearBorder {
  std::array<std::uint32_t, 2> edge;
  double apart;  ///< of the ends, at most
};
/// The edges whose ends are within a distance of those of another one, and within a tenth of the length of
/// either, but not all at equal positions.
/// @return in the order of the edges. O(n) as a rule, and where many edges are near each other.
std::vector<NearBorder> findNearBorders(std::span<const Vec3> positions,
                                        std::span<const std::array<std::uint32_t, 2>> edges, double distance);

/// The pairs of triangles that meet elsewhere than in the vertices and the edge they share; degenerate
/// triangles are left out.
struct SelfIntersections {
  std::uint64_t count = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< the first, first < second, in order
};
/// @param most how many pairs are listed. O(n log n) and the pairs whose boxes meet, but for triangles in one
/// place or at one vertex: of those, the pairs that are in the same direction from it.
/// @return missing: interrupted.
std::optional<SelfIntersections> countSelfIntersections(const TriangleMesh& mesh, std::size_t most,
                                                        const RunContext& context);
/// All of them. Missing: interrupted.
std::optional<std::vector<std::pair<std::uint32_t, std::uint32_t>>> findSelfIntersections(
    const TriangleMesh& mesh, const RunContext& context);

}  // namespace arete::diagnosis
