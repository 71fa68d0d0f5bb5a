// SPDX-License-Identifier: GPL-3.0-or-later
//
// Only the finest triangles at vertices of the TIN are kept. Around each vertex they are divided into sectors
// between creases and borders; the corners of the TIN find their sectors by their directions in plan.
#include "io/query/extract/tin_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/base/crease.h"
#include "engine/cut/cut.h"
#include "surface/model/wedges.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = MeshAttributes::kNone;

/// A finest triangle at a vertex: its other corners, counter-clockwise.
struct Spoke {
  std::uint32_t from = 0, to = 0;  ///< vertices of the MT
  Vec2 right = {}, left = {};      ///< the directions to them in plan
  Vec3 normal = {};                ///< of length 1, or zero
  double angle = 0;                ///< at the vertex
  std::uint32_t sector = kNone;
};

double crossOf(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// In units of its length; a zero stays one.
Vec2 unitOf(const Vec2& v) {
  const double length = std::hypot(v.x, v.y);
  return length > 0 ? Vec2{v.x / length, v.y / length} : v;
}

Vec2 directionTo(const Vec3& from, const Vec3& to) {
  return unitOf({to.x - from.x, to.y - from.y});
}

/// The normal and the angle of a triangle at its first corner.
void giveShape(Spoke& spoke, const Vec3& at, const Vec3& p, const Vec3& q) {
  const Vec3 u = p - at, v = q - at, n = cross(u, v);
  const double length = norm(n);
  if (!(length > 0) || !std::isfinite(length)) return;
  spoke.normal = n / length;
  spoke.angle = std::atan2(length, dot(u, v));
}

/// Which of the spokes of a vertex a direction points into; between none, the one that is nearest.
const Spoke& spokeAlong(std::span<const Spoke> spokes, const Vec2& direction) {
  const auto holds = [&](const Spoke& s) {
    return crossOf(s.right, direction) >= 0 && crossOf(direction, s.left) >= 0 &&
           crossOf(s.right, s.left) > 0;
  };
  if (const auto found = std::ranges::find_if(spokes, holds); found != spokes.end()) return *found;
  return *std::ranges::max_element(spokes, {}, [&](const Spoke& s) {
    const Vec2 middle = unitOf({s.right.x + s.left.x, s.right.y + s.left.y});
    return middle.x * direction.x + middle.y * direction.y;
  });
}

/// One number for the vertices at a place: a raster that goes round the Earth has its first column twice.
class PlacesOfVertices {
 public:
  explicit PlacesOfVertices(const TerrainModel& model) : mt_(model.mt) {
    if (!model.isRaster || !model.georeference.repeatsFirstColumn) return;
    lastColumn_ = model.columns - 1.0;
    firstOfRow_.assign(model.rows, kNone);
    for (std::uint32_t v = 0; v < mt_.vertexCount(); ++v)
      if (const Vec3 p = mt_.position(VertexId(v)); p.x == 0) firstOfRow_[static_cast<std::size_t>(p.y)] = v;
  }

  std::uint32_t operator()(std::uint32_t vertex) const {
    if (firstOfRow_.empty()) return vertex;
    const Vec3 p = mt_.position(VertexId(vertex));
    const std::uint32_t first = p.x == lastColumn_ ? firstOfRow_[static_cast<std::size_t>(p.y)] : kNone;
    return first == kNone ? vertex : first;
  }

 private:
  const MultiTriangulation& mt_;
  double lastColumn_ = 0;
  std::vector<std::uint32_t> firstOfRow_;
};

/// The finest triangles around the vertices of a TIN.
class FinestNormals {
 public:
  FinestNormals(const TerrainModel& model, std::span<const std::uint32_t> vertexOf,
                const std::function<Vec3(const Vec3&)>& toLengths) {
    const MultiTriangulation& mt = model.mt;
    const PlacesOfVertices placeOf(model);
    std::vector<std::uint32_t> numberOf(mt.vertexCount(), kNone);
    for (const std::uint32_t v : vertexOf) {
      std::uint32_t& number = numberOf[placeOf(v)];
      if (number == kNone) {
        number = static_cast<std::uint32_t>(spokes_.size());
        spokes_.emplace_back();
      }
      placeOf_.push_back(number);
    }
    const auto inSource = [&](std::uint32_t vertex) {
      const Vec3 p = mt.position(VertexId(vertex));
      const Vec2 xy = model.toSource({p.x, p.y});
      return Vec3{xy.x, xy.y, p.z};
    };
    const Cut finest = frontOfPrefix(mt, mt.nodeCount());
    for (auto corners : finest.triangles) {
      for (std::uint32_t& c : corners) c = finest.vertices[c];
      if (model.isFlipped()) std::swap(corners[1], corners[2]);
      std::array<std::uint32_t, 3> places;
      std::ranges::transform(corners, places.begin(), placeOf);
      if (std::ranges::all_of(places, [&](std::uint32_t p) { return numberOf[p] == kNone; })) continue;
      std::array<Vec3, 3> sources, lengths;
      for (std::size_t k = 0; k < 3; ++k) {
        sources[k] = inSource(corners[k]);
        lengths[k] = toLengths(sources[k]);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        if (numberOf[places[k]] == kNone) continue;
        const std::size_t right = (k + 1) % 3, left = (k + 2) % 3;
        Spoke spoke{places[right], places[left], directionTo(sources[k], sources[right]),
                    directionTo(sources[k], sources[left])};
        giveShape(spoke, lengths[k], lengths[right], lengths[left]);
        spokes_[numberOf[places[k]]].push_back(spoke);
      }
    }
  }

  /// Divides the triangles at each vertex, and gives the corners of the TIN wedges with normals.
  void giveTo(SurfaceMesh& mesh, double creaseDegrees) {
    std::vector<Vec3> normals;
    for (auto& around : spokes_) divide(around, creaseDegrees, normals);
    const auto up = static_cast<std::uint32_t>(normals.size());
    normals.push_back({0, 0, 1});
    for (const auto& corners : mesh.triangles) {
      auto& wedges = mesh.wedges.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::vector<Spoke>& around = spokes_[placeOf_[corners[k]]];
        const Vec3 &at = mesh.positions[corners[k]], &right = mesh.positions[corners[(k + 1) % 3]],
                   &left = mesh.positions[corners[(k + 2) % 3]];
        wedges[k] = around.empty() ? up : spokeAlong(around, middleOf(at, right, left)).sector;
      }
    }
    Attribute attribute{.name = std::string(kNormalName),
                        .meaning = AttributeMeaning::normal,
                        .type = ScalarType::float32,
                        .components = 3};
    // A zero has no sign, so that equal normals are equal to the bit.
    for (const Vec3& n : normals) attribute.append(std::array{n.x + 0.0, n.y + 0.0, n.z + 0.0});
    mesh.wedgeAttributes.push_back(std::move(attribute));
    mesh.wedgeCount = static_cast<std::uint32_t>(normals.size());
    moveToVertices(mesh);
  }

 private:
  /// The direction of the middle of a corner in plan.
  static Vec2 middleOf(const Vec3& at, const Vec3& p, const Vec3& q) {
    const Vec2 right = directionTo(at, p), left = directionTo(at, q);
    const Vec2 sum{right.x + left.x, right.y + left.y};
    return std::hypot(sum.x, sum.y) > 1e-9 ? unitOf(sum) : Vec2{-right.y, right.x};
  }

  /// Numbers the sectors of a vertex, and appends their normals.
  static void divide(std::vector<Spoke>& around, double creaseDegrees, std::vector<Vec3>& normals) {
    const auto after = [&](const Spoke& s) { return std::ranges::find(around, s.to, &Spoke::from); };
    const auto goesOn = [&](const Spoke& s) {
      const auto next = after(s);
      return next != around.end() && !isCrease(s.normal, next->normal, creaseDegrees);
    };
    std::vector<bool> isStart(around.size(), true);
    for (const Spoke& s : around)
      if (goesOn(s)) isStart[static_cast<std::size_t>(after(s) - around.begin())] = false;
    const auto walk = [&](std::size_t first) {
      const auto sector = static_cast<std::uint32_t>(normals.size());
      Vec3 sum;
      double angles = 0;
      for (auto s = around.begin() + std::ptrdiff_t(first); s->sector == kNone; s = after(*s)) {
        s->sector = sector;
        sum = sum + s->angle * s->normal;
        angles += s->angle;
        if (!goesOn(*s)) break;
      }
      const double length = norm(sum);
      normals.push_back(length > 1e-6 * angles ? sum / length : Vec3{0, 0, 1});
    };
    for (std::size_t i = 0; i < around.size(); ++i)
      if (isStart[i]) walk(i);
    // What is left goes around without a crease.
    for (std::size_t i = 0; i < around.size(); ++i)
      if (around[i].sector == kNone) walk(i);
  }

  std::vector<std::vector<Spoke>> spokes_;  // by place of a vertex of the TIN
  std::vector<std::uint32_t> placeOf_;      // by vertex of the TIN
};

}  // namespace

Result<SurfaceMesh> withNormals(const TriangleMesh& tin, std::span<const std::uint32_t> vertexOf,
                                const TerrainModel& model, const std::function<Vec3(const Vec3&)>& toLengths,
                                const NormalsOptions& options) try {
  SurfaceMesh mesh(tin);
  if (options.kind == NormalsKind::keep) return mesh;
  if (!(options.creaseAngleDegrees >= 0 && options.creaseAngleDegrees <= 180))
    return makeNormals(mesh, options).map([&](const MadeNormals&) { return mesh; });
  if (options.kind == NormalsKind::smooth) {
    FinestNormals(model, vertexOf, toLengths).giveTo(mesh, options.creaseAngleDegrees);
    return mesh;
  }
  for (Vec3& p : mesh.positions) p = toLengths(p);
  ARETE_CHECK(makeNormals(mesh, options));
  mesh.positions = tin.positions;
  return mesh;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
