// SPDX-License-Identifier: GPL-3.0-or-later
//
// Half-edges between places are sorted by their ends; each that finds an opposite one is mated with it. Mates
// that no crease parts join the corners at both ends (union by the root with the lower number), and the
// corners of a root share a normal.
#include "surface/normals/smooth_corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace arete {
namespace {

constexpr std::uint32_t kNoMate = 0xFFFFFFFF;
/// Stated normals that differ by less are one, rounded.
constexpr double kStatedDegrees = 1;
/// An edge of more faces than these is hard without a search for pairs.
constexpr std::ptrdiff_t kMostFacesPaired = 32;
/// Of the sum of the angles: a shorter sum of normals has no direction.
constexpr double kCancelled = 1e-6;
constexpr int kMostPasses = 64;

/// By vertex: the first one at its place.
std::vector<std::uint32_t> placesOf(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.positions.size()), place(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(
      order, [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
  return place;
}

/// How far rounding may have moved a coordinate.
double roundingOf(const TriangleMesh& mesh) {
  double largest = 0;
  bool areFloats = true;
  for (const Vec3& p : mesh.positions)
    for (const double x : {p.x, p.y, p.z}) {
      largest = std::max(largest, std::abs(x));
      areFloats = areFloats && x == double{static_cast<float>(x)};
    }
  return std::ldexp(largest, areFloats ? -24 : -53);
}

struct FaceShape {
  Vec3 normal;                    ///< of length 1; zero: it has none of its own
  std::array<double, 3> angle{};  ///< at its corners; zeros without a normal
  std::uint8_t longest = 0;       ///< the edge from this corner to the next
};

FaceShape shapeOf(const std::array<Vec3, 3>& p, double rounding) {
  FaceShape face;
  std::array<Vec3, 3> edge;
  std::array<double, 3> length;
  for (std::size_t k = 0; k < 3; ++k) {
    edge[k] = p[(k + 1) % 3] - p[k];
    length[k] = std::hypot(edge[k].x, edge[k].y, edge[k].z);
    if (length[k] > length[face.longest]) face.longest = static_cast<std::uint8_t>(k);
  }
  const double longest = length[face.longest];
  if (!(longest > 0) || !std::isfinite(longest)) return face;
  for (Vec3& e : edge) e = e / longest;
  const Vec3 n = cross(edge[0], edge[1]);
  const double height = norm(n);  // in longest edges
  if (!(height * longest > 2 * rounding)) return face;
  face.normal = n / height;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 to = edge[k], from = -edge[(k + 2) % 3];
    face.angle[k] = std::atan2(norm(cross(to, from)), dot(to, from));
  }
  return face;
}

struct HalfEdge {
  std::uint32_t low = 0, high = 0;
  std::uint32_t corner = 0;  ///< it starts at
  bool rises = false;        ///< from the lower place to the higher one
};

class SmoothCorners {
 public:
  SmoothCorners(const TriangleMesh& mesh, double creaseDegrees, std::span<const Vec3> stated)
      : mesh_(mesh), creaseDegrees_(creaseDegrees), stated_(stated), place_(placesOf(mesh)) {
    const double rounding = roundingOf(mesh);
    for (const auto& t : mesh.triangles)
      faces_.push_back(shapeOf({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, rounding));
    const std::size_t corners = 3 * mesh.triangles.size();
    mate_.assign(corners, kNoMate);
    root_.resize(corners);
    std::iota(root_.begin(), root_.end(), 0u);
  }

  std::vector<Vec3> ofFaces() {
    findMates();
    return handedOn();
  }

  CornerNormals run() {
    const std::vector<Vec3> handed = ofFaces();
    for (std::uint32_t c = 0; c < mate_.size(); ++c)
      if (mate_[c] != kNoMate && c < mate_[c] &&
          !isCrease(handed[c / 3], handed[mate_[c] / 3], creaseDegrees_)) {
        join(c, next(mate_[c]));
        join(next(c), mate_[c]);
      }
    return sums(handed);
  }

 private:
  static std::uint32_t next(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  std::uint32_t placeAt(std::uint32_t corner) const {
    return place_[mesh_.triangles[corner / 3][corner % 3]];
  }

  void findMates() {
    std::vector<HalfEdge> edges;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::array<std::uint32_t, 3> p{placeAt(3 * t), placeAt(3 * t + 1), placeAt(3 * t + 2)};
      // A triangle with two corners at one place is an edge; its neighbours meet there.
      if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(p[k], p[(k + 1) % 3]);
        edges.push_back({low, high, 3 * t + k, p[k] == low});
      }
    }
    std::ranges::sort(edges, {}, [](const HalfEdge& e) { return std::tuple(e.low, e.high, e.corner); });
    for (auto begin = edges.begin(); begin != edges.end();) {
      const auto end = std::find_if(begin, edges.end(), [&](const HalfEdge& e) {
        return e.low != begin->low || e.high != begin->high;
      });
      mateWithin(std::span(begin, end));
      begin = end;
    }
  }

  void mateWithin(std::span<const HalfEdge> edge) {
    if (std::ssize(edge) > kMostFacesPaired) return;
    std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;
    for (const HalfEdge& a : edge)
      for (const HalfEdge& b : edge) {
        if (!a.rises || b.rises) continue;
        const Vec3 &m = faces_[a.corner / 3].normal, &n = faces_[b.corner / 3].normal;
        pairs.emplace_back(edge.size() == 2 ? 0 : std::atan2(norm(cross(m, n)), dot(m, n)), a.corner,
                           b.corner);
      }
    std::ranges::sort(pairs);
    for (const auto& [angle, a, b] : pairs)
      if (mate_[a] == kNoMate && mate_[b] == kNoMate) {
        mate_[a] = b;
        mate_[b] = a;
      }
  }

  /// The normals of faces; a face that has none has its neighbour's at the longest edge.
  std::vector<Vec3> handedOn() const {
    std::vector<Vec3> normals;
    std::vector<std::uint32_t> without;
    for (std::uint32_t t = 0; t < faces_.size(); ++t) {
      normals.push_back(faces_[t].normal);
      if (norm(normals.back()) == 0) without.push_back(t);
    }
    for (int pass = 0; pass < kMostPasses && !without.empty(); ++pass) {
      const std::size_t before = without.size();
      std::erase_if(without, [&](std::uint32_t t) {
        const std::uint32_t mate = mate_[3 * t + faces_[t].longest];
        if (mate == kNoMate || norm(normals[mate / 3]) == 0) return false;
        normals[t] = normals[mate / 3];
        return true;
      });
      if (without.size() == before) break;
    }
    return normals;
  }

  std::uint32_t rootOf(std::uint32_t corner) {
    while (root_[corner] != corner) corner = root_[corner] = root_[root_[corner]];
    return corner;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    if (!stated_.empty() && norm(stated_[a]) > 0 && norm(stated_[b]) > 0 &&
        isCrease(stated_[a], stated_[b], kStatedDegrees))
      return;
    const std::uint32_t first = rootOf(a), second = rootOf(b);
    root_[std::max(first, second)] = std::min(first, second);
  }

  CornerNormals sums(const std::vector<Vec3>& handed) {
    std::vector<Vec3> sum(root_.size());
    std::vector<double> angles(root_.size(), 0);
    for (std::uint32_t c = 0; c < root_.size(); ++c) {
      const std::uint32_t r = rootOf(c);
      const double angle = faces_[c / 3].angle[c % 3];
      sum[r] = sum[r] + angle * faces_[c / 3].normal;
      angles[r] += angle;
    }
    // Corners without a face of their own take what another corner at their place has.
    std::vector<std::uint32_t> rootAt(mesh_.positions.size(), kNoMate);
    for (std::uint32_t c = 0; c < root_.size(); ++c)
      if (angles[rootOf(c)] > 0 && rootAt[placeAt(c)] == kNoMate) rootAt[placeAt(c)] = rootOf(c);
    CornerNormals result;
    result.normalOf.resize(mesh_.triangles.size());
    std::vector<std::uint32_t> numberOf(root_.size(), kNoMate);
    for (std::uint32_t c = 0; c < root_.size(); ++c) {
      std::uint32_t r = rootOf(c);
      if (angles[r] == 0 && norm(handed[c / 3]) == 0 && rootAt[placeAt(c)] != kNoMate) r = rootAt[placeAt(c)];
      const double length = norm(sum[r]);
      const bool isCancelled = !(length > kCancelled * angles[r]) || angles[r] == 0;
      std::uint32_t& number = result.normalOf[c / 3][c % 3];
      if (isCancelled) {
        number = static_cast<std::uint32_t>(result.normals.size());
        result.normals.push_back(handed[c / 3]);
        continue;
      }
      if (numberOf[r] == kNoMate) {
        numberOf[r] = static_cast<std::uint32_t>(result.normals.size());
        result.normals.push_back(sum[r] / length);
      }
      number = numberOf[r];
    }
    return result;
  }

  const TriangleMesh& mesh_;
  double creaseDegrees_;
  std::span<const Vec3> stated_;
  std::vector<std::uint32_t> place_;
  std::vector<FaceShape> faces_;
  std::vector<std::uint32_t> mate_, root_;  // by corner: of the half-edge that starts there; of its union
};

}  // namespace

CornerNormals flatCorners(const TriangleMesh& mesh) {
  CornerNormals flat;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    flat.normals.push_back(
        shapeOf({mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]}, 0).normal);
    flat.normalOf.push_back({t, t, t});
  }
  return flat;
}

std::vector<Vec3> faceNormals(const TriangleMesh& mesh) {
  return SmoothCorners(mesh, 180, {}).ofFaces();
}

CornerNormals smoothCorners(const TriangleMesh& mesh, double creaseDegrees, std::span<const Vec3> stated) {
  return SmoothCorners(mesh, creaseDegrees, stated).run();
}

}  // namespace arete
