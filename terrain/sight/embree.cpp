// SPDX-License-Identifier: GPL-3.0-or-later
//
// A coarse front of the multitriangulation, raised at each vertex by the largest bound of the triangles
// around it, is a continuous surface nowhere below the terrain; lowered in the same way, one nowhere above.
// Embree [WaldWoop2014] intersects lines with both. A line that misses the raised surface is visible, one
// that hits the lowered surface is blocked, and every other line is answered by the descent.
//
// Embree computes in single precision. Plan coordinates of a raster's samples are exact in it. Heights are
// rounded outwards, and moved outwards by a margin: as much as the rounding of a line's coordinates changes
// its height above the steepest triangle of the front. Lines far above or below the terrain exceed the margin
// and are answered by the descent.
//
// A curved line is cut into chords. The line is convex, so it is below each chord, by at most its sag: if a
// chord hits the lowered surface, so does the line, and if a chord lowered by the sag misses the raised
// surface, so does the line. On a concave Earth it is the other way round; those lines are answered by the
// descent.
#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/base/float_bounds.h"
#include "engine/cut/cut.h"
#include "terrain/sight/engine.h"

namespace arete {
namespace {

/// The front is that of the first 1 / kNodesPerFrontNode of the nodes.
constexpr std::uint32_t kNodesPerFrontNode = 16;
constexpr double kUlp = 0x1p-23;
/// Largest distance of a curved line from its chords, in the DEM's vertical unit.
constexpr double kSag = 0.1;
/// Steps from the border within which lines are answered by the descent: far more than single precision.
constexpr double kBorder = 0.01;

struct Release {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release>;
using Scene = std::unique_ptr<RTCSceneTy, Release>;

/// Bounds of the terrain around each vertex of the front: how much higher and lower it may be.
struct Envelope {
  std::vector<double> higher, lower;
  double steepest = 0;  ///< height per sample's step
};

Envelope envelopeOf(const MultiTriangulation& mt, const Cut& cut) {
  Envelope envelope;
  envelope.higher.assign(cut.vertices.size(), 0);
  envelope.lower.assign(cut.vertices.size(), 0);
  for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
    const TriangleId t(cut.ids[i]);
    const double higher = mt.decoded(kBelow, t), lower = mt.decoded(kAbove, t);
    std::array<Vec3, 3> p;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = cut.triangles[i][c];
      envelope.higher[v] = std::max(envelope.higher[v], higher);
      envelope.lower[v] = std::max(envelope.lower[v], lower);
      p[c] = mt.position(VertexId(cut.vertices[v]));
    }
    // Gradient of the triangle's plane. (Raising its corners adds at most their raise per step, since its
    // shortest side is a step at least.)
    const double x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y, x2 = p[2].x - p[0].x, y2 = p[2].y - p[0].y;
    const double z1 = std::fabs(p[1].z - p[0].z), z2 = std::fabs(p[2].z - p[0].z),
                 area = std::fabs(x1 * y2 - x2 * y1);
    envelope.steepest = std::max(
        envelope.steepest, (z1 * std::hypot(x2, y2) + z2 * std::hypot(x1, y1)) / std::max(area, 1e-300));
  }
  return envelope;
}

class SightEmbree final : public SightEngine {
 public:
  explicit SightEmbree(const TerrainModel& model)
      : model_(model),
        descent_(makeSightDescent(model)),
        mayFill_(model.options.rimTolerance > 0),
        isFull_(model.mt.vertexCount() == std::size_t{model.columns} * model.rows),
        device_(rtcNewDevice("threads=1")) {
    const MultiTriangulation& mt = model.mt;
    const Cut cut = frontOfPrefix(mt, mt.nodeCount() / kNodesPerFrontNode);
    const Envelope envelope = envelopeOf(mt, cut);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const std::uint32_t v : cut.vertices) {
      const double z = mt.vertices().height(VertexId(v));
      low = std::min(low, z);
      high = std::max(high, z);
    }
    middle_ = low / 2 + high / 2;
    const double extent = std::max(model.columns, model.rows);
    reach_ = 8 * (high - low) + 1000;
    margin_ = 8 * kUlp * (extent * envelope.steepest + reach_);
    raised_ = scene(mt, cut, envelope.higher, 1);
    lowered_ = scene(mt, cut, envelope.lower, -1);
  }

  SightAnswer answer(const SightLine& line, const SightOptions& options) const override {
    if (options.wantsClearance || !isSupported(line)) return descent_->answer(line, options);
    SightAnswer answer;
    // A line that begins above a surface without holes and does not meet it is above it everywhere.
    if (isFull_ && isInside(line) && isAboveRaised(line) && !meets(raised_.get(), line, true, answer.visited))
      return answer;
    if (!options.wantsObstruction && meets(lowered_.get(), line, false, answer.visited)) {
      answer.verdict = SightVerdict::blocked;
      return answer;
    }
    SightAnswer finished = descent_->answer(line, options);
    finished.visited += answer.visited;
    return finished;
  }

 private:
  Scene scene(const MultiTriangulation& mt, const Cut& cut, const std::vector<double>& away, int side) const {
    Scene scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), cut.vertices.size()));
    for (std::size_t i = 0; i < cut.vertices.size(); ++i) {
      const Vec3 p = mt.position(VertexId(cut.vertices[i]));
      *position++ = static_cast<float>(p.x);
      *position++ = static_cast<float>(p.y);
      const double z = p.z - middle_ + side * (away[i] + margin_);
      *position++ = side > 0 ? floatAtLeast(z) : floatAtMost(z);
    }
    auto* corner = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), cut.triangles.size()));
    for (const auto& triangle : cut.triangles) corner = std::copy(triangle.begin(), triangle.end(), corner);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
  }

  /// Whether single precision and the margin suffice for the line.
  bool isSupported(const SightLine& line) const {
    const double away =
        std::max(std::fabs(line.fromHeight() - middle_), std::fabs(line.toHeight() - middle_));
    return !mayFill_ && line.track().curvature >= 0 && line.length() > 0 && away < reach_ &&
           line.tolerance() < margin_ / 4;
  }

  /// Whether the line keeps away from the border, where a ray along the edge of the surface may miss it.
  bool isInside(const SightLine& line) const {
    return std::ranges::all_of(line.points(), [&](const SightPoint& p) {
      return p.plan.x >= kBorder && p.plan.y >= kBorder && p.plan.x <= model_.columns - 1 - kBorder &&
             p.plan.y <= model_.rows - 1 - kBorder;
    });
  }

  bool isAboveRaised(const SightLine& line) const {
    const Vec2 from = line.points().front().plan;
    constexpr double kUp = 1e9;
    return !meets(raised_.get(), from, line.height(0) - lowest(line), from, kUp);
  }

  /// Bound of how far the line is below its chords.
  double lowest(const SightLine& line) const {
    const double chord = line.length() / chordCount(line);
    return line.sag() * chord * chord / 8;
  }
  static double chordCount(const SightLine& line) {
    return std::clamp(std::ceil(line.length() * std::sqrt(line.sag() / (8 * kSag))), 1.0, 4096.0);
  }

  /// Whether some chord of the line meets the surface. All chords are lowered by the same, so that they join.
  bool meets(RTCSceneTy* scene, const SightLine& line, bool isBelowTheLine, std::uint64_t& visited) const {
    const double sag = isBelowTheLine ? lowest(line) : 0, perMetre = chordCount(line) / line.length();
    const auto points = line.points();
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double from = points[i - 1].distance, whole = points[i].distance - from;
      const int count = std::max(1, static_cast<int>(std::ceil(whole * perMetre)));
      double s0 = from;
      for (int k = 1; k <= count; ++k) {
        const double s1 = k == count ? points[i].distance : from + whole * k / count;
        ++visited;
        if (meets(scene, line.planAt(s0), line.height(s0) - sag, line.planAt(s1), line.height(s1) - sag))
          return true;
        s0 = s1;
      }
    }
    return false;
  }

  bool meets(RTCSceneTy* scene, Vec2 a, double za, Vec2 b, double zb) const {
    RTCRay ray{};
    ray.org_x = static_cast<float>(a.x);
    ray.org_y = static_cast<float>(a.y);
    ray.org_z = static_cast<float>(za - middle_);
    ray.dir_x = static_cast<float>(b.x) - ray.org_x;
    ray.dir_y = static_cast<float>(b.y) - ray.org_y;
    ray.dir_z = static_cast<float>(zb - middle_) - ray.org_z;
    ray.tnear = 0;
    ray.tfar = 1;
    ray.mask = ~0u;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0;
  }

  const TerrainModel& model_;
  std::unique_ptr<SightEngine> descent_;
  bool mayFill_;  ///< the front may extend over NODATA, where it proves nothing
  bool isFull_;
  double middle_ = 0, margin_ = 0;
  double reach_ = 0;  ///< largest height from the middle that the margin suffices for
  Device device_;
  Scene raised_, lowered_;
};

}  // namespace

std::unique_ptr<SightEngine> makeSightEmbree(const TerrainModel& model) {
  return std::make_unique<SightEmbree>(model);
}

}  // namespace arete
