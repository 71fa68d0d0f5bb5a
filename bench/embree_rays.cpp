// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/embree_rays.h"

#include <embree3/rtcore.h>

#include <cmath>

#include "bench/timing.h"

namespace arete::bench {
namespace {

constexpr float kHole = -1e5f;
/// A ray ends a little before its target, or it would hit what the target stands on.
constexpr float kEnd = 1 - 1e-5f;
constexpr std::uint32_t kPacket = 16;

class Rays final : public EmbreeRays {
 public:
  Rays(const SightGrid& grid, const SightEarth::PlaneSteps& steps, double unit, Geometry geometry)
      : grid_(grid), steps_(steps), unit_(unit) {
    const Stopwatch watch;
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    const bool isGrid = geometry == Geometry::grid;
    RTCGeometry shape = rtcNewGeometry(device_, isGrid ? RTC_GEOMETRY_TYPE_GRID : RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::uint32_t columns = grid.columns(), rows = grid.rows();
    // A grid of Embree's has no holes, so samples without data lie far below the rest.
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        shape, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), std::size_t{columns} * rows));
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c, vertices += 3) place(c, r, grid.height(c, r), vertices);
    if (isGrid) {
      auto* whole = static_cast<RTCGrid*>(
          rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
      *whole = {0, columns, static_cast<unsigned short>(columns), static_cast<unsigned short>(rows)};
    } else {
      const std::size_t cells = std::size_t{columns - 1} * (rows - 1);
      auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
          shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), 2 * cells));
      for (std::uint32_t r = 0; r + 1 < rows; ++r)
        for (std::uint32_t c = 0; c + 1 < columns; ++c) {
          const std::uint32_t ul = r * columns + c, ur = ul + 1, ll = ul + columns, lr = ll + 1;
          for (const std::uint32_t v : {ul, ll, lr, ul, lr, ur}) *index++ = v;
        }
    }
    rtcCommitGeometry(shape);
    rtcAttachGeometry(scene_, shape);
    rtcReleaseGeometry(shape);
    rtcCommitScene(scene_);
    buildSeconds_ = watch.seconds();
  }
  Rays(const Rays&) = delete;
  Rays& operator=(const Rays&) = delete;
  ~Rays() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  double buildSeconds() const override { return buildSeconds_; }

  std::vector<std::uint8_t> viewshed(const ViewshedObserver& observer) const override {
    const std::uint32_t columns = grid_.columns(), rows = grid_.rows();
    std::vector<std::uint8_t> seen(std::size_t{columns} * rows);
    float from[3];
    place(observer.plan.x, observer.plan.y, observer.height, from);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRay16 rays;
    alignas(64) int valid[kPacket];
    for (std::uint32_t r = 0; r < rows; ++r)
      // The rays of a packet go to neighbours in a row; the last packet of a row may be partly invalid.
      for (std::uint32_t first = 0; first < columns; first += kPacket) {
        for (std::uint32_t i = 0; i < kPacket; ++i) {
          const std::uint32_t c = first + i;
          valid[i] = c < columns ? -1 : 0;
          if (c >= columns) continue;
          float to[3];
          place(c, r, grid_.height(c, r), to);
          rays.org_x[i] = from[0];
          rays.org_y[i] = from[1];
          rays.org_z[i] = from[2];
          rays.dir_x[i] = to[0] - from[0];
          rays.dir_y[i] = to[1] - from[1];
          rays.dir_z[i] = to[2] - from[2];
          rays.tnear[i] = 0;
          rays.tfar[i] = kEnd;
          rays.time[i] = 0;
          rays.mask[i] = ~0u;
          rays.id[i] = i;
          rays.flags[i] = 0;
        }
        // Embree sets tfar of an occluded ray to minus infinity.
        rtcOccluded16(valid, scene_, &context, &rays);
        for (std::uint32_t i = 0; i < kPacket && first + i < columns; ++i)
          seen[std::size_t{r} * columns + first + i] = rays.tfar[i] >= 0;
      }
    return seen;
  }

 private:
  void place(double column, double row, double height, float* at) const {
    // The middle of the grid is the origin, so that floats are most exact.
    const double x = column - (grid_.columns() - 1) / 2.0, y = row - (grid_.rows() - 1) / 2.0;
    at[0] = static_cast<float>(x * steps_.x.x + y * steps_.y.x);
    at[1] = static_cast<float>(x * steps_.x.y + y * steps_.y.y);
    at[2] = std::isnan(height) ? kHole : static_cast<float>(height * unit_);
  }

  const SightGrid& grid_;
  SightEarth::PlaneSteps steps_;
  double unit_, buildSeconds_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<EmbreeRays> EmbreeRays::make(const SightGrid& grid, const SightEarth::PlaneSteps& steps,
                                             double heightUnitMetres, Geometry geometry) {
  return std::make_unique<Rays>(grid, steps, heightUnitMetres, geometry);
}

}  // namespace arete::bench
