// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/standing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/base/nearest_on_triangle.h"

namespace arete {
namespace {

constexpr std::size_t kMostLooked = 64;  // triangles of a vertex
constexpr int kMostSteps = 64;

/// The triangles at the vertices of a mesh, one vertex after the other.
class TrianglesAt {
 public:
  explicit TrianglesAt(const TriangleMesh& mesh) : begin_(mesh.positions.size() + 1, 0) {
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t) ++begin_[v + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    all_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) all_[next[v]++] = t;
  }
  std::span<const std::uint32_t> operator[](std::uint32_t v) const {
    return std::span(all_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> all_;
};

class Search {
 public:
  Search(const FramedMesh& source, const DecimatedMesh& result)
      : source_(source), result_(result), at_(result.mesh.shape()) {}

  /// @param corners vertices of the result, or MeshAttributes::kNone
  std::uint32_t triangleFor(std::uint32_t face, std::array<std::uint32_t, 3> corners) const {
    const auto& [i, j, k] = source_.shape.triangles[face];
    const auto& p = source_.shape.positions;
    const Vec3 middle = (p[i] + p[j] + p[k]) / 3.0;
    // The vertex with the fewest triangles first: it is looked at however many it has.
    std::ranges::sort(corners, {}, [&](std::uint32_t v) {
      return v == MeshAttributes::kNone || at_[v].empty() ? std::numeric_limits<std::size_t>::max()
                                                          : at_[v].size();
    });
    if (corners[0] == MeshAttributes::kNone || at_[corners[0]].empty()) return MeshAttributes::kNone;
    std::uint32_t best = MeshAttributes::kNone;
    std::pair<bool, double> least{true, std::numeric_limits<double>::infinity()};
    const auto look = [&](std::uint32_t v) {
      bool isNearer = false;
      for (const std::uint32_t t : at_[v]) {
        const std::pair is{!isAlike(face, t), squaredDistanceOf(t, middle)};
        if (!(is < least)) continue;
        least = is;
        best = t;
        isNearer = true;
      }
      return isNearer;
    };
    look(corners[0]);
    for (std::size_t c = 1; c < 3; ++c)
      if (corners[c] != MeshAttributes::kNone && at_[corners[c]].size() <= kMostLooked) look(corners[c]);
    for (int step = 0; step < kMostSteps && best != MeshAttributes::kNone; ++step) {
      bool isNearer = false;
      const std::array<std::uint32_t, 3> around = result_.mesh.triangles[best];
      for (const std::uint32_t v : around)
        if (at_[v].size() <= kMostLooked) isNearer = look(v) || isNearer;
      if (!isNearer) break;
    }
    return best;
  }

 private:
  bool isAlike(std::uint32_t face, std::uint32_t t) const {
    const auto agrees = [&](const std::vector<std::uint32_t>& of, const std::vector<std::uint32_t>& to) {
      return of.empty() || of[face] == to[t];
    };
    return agrees(source_.source.objectOf, result_.mesh.objectOf) &&
           agrees(source_.source.materialOf, result_.mesh.materialOf);
  }
  double squaredDistanceOf(std::uint32_t t, const Vec3& p) const {
    const auto& [i, j, k] = result_.mesh.triangles[t];
    const auto& at = result_.mesh.positions;
    return squaredDistance(p, nearestOnTriangle(p, {at[i], at[j], at[k]}));
  }

  const FramedMesh& source_;
  const DecimatedMesh& result_;
  TrianglesAt at_;
};

}  // namespace

void follow(std::vector<std::uint32_t>& joinedTo) {
  for (std::uint32_t v = 0; v < joinedTo.size(); ++v) {
    std::uint32_t last = v;
    while (joinedTo[last] != last) last = joinedTo[last];
    for (std::uint32_t at = v; joinedTo[at] != last;) at = std::exchange(joinedTo[at], last);
  }
}

std::vector<std::uint32_t> trianglesFor(const FramedMesh& source, const DecimatedMesh& result,
                                        std::span<const std::uint32_t> joinedTo) {
  const auto& faces = source.shape.triangles;
  std::vector<std::uint32_t> numberOf(source.shape.positions.size(), MeshAttributes::kNone),
      standing(faces.size(), MeshAttributes::kNone);
  for (std::uint32_t v = 0; v < result.vertexOf.size(); ++v) numberOf[result.vertexOf[v]] = v;
  for (std::uint32_t t = 0; t < result.faceOf.size(); ++t) standing[result.faceOf[t]] = t;
  const Search search(source, result);
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (standing[f] != MeshAttributes::kNone) continue;
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) corners[c] = numberOf[joinedTo[faces[f][c]]];
    standing[f] = search.triangleFor(f, corners);
  }
  return standing;
}

}  // namespace arete
