// SPDX-License-Identifier: GPL-3.0-or-later
//
// A segment is clipped to the box of all boxes in double precision before Embree gets it, so its coordinates
// are of the size of the boxes, and rounding is a known part of that size.
#include "io/query/sight/mesh_boxes.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/base/float_bounds.h"

namespace arete {
namespace {

/// Of the size of all boxes: some 16 steps of single precision.
constexpr double kFloatSlack = 2e-6;

struct BoxesRelease {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};

/// What Embree hands to the callback of a box that a segment meets.
struct BoxesContext {
  RTCIntersectContext context;
  const std::function<void(std::uint32_t)>* met = nullptr;
};

double axisOf(const Vec3& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

}  // namespace

void SightBox::add(const Vec3& p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

void SightBox::grow(double by) {
  low = low - Vec3{by, by, by};
  high = high + Vec3{by, by, by};
}

bool SightBox::clip(Vec3& a, Vec3& b) const {
  double first = 0, last = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = axisOf(a, axis), d = axisOf(b, axis) - p;
    const double l = axisOf(low, axis), h = axisOf(high, axis);
    if (d == 0) {
      if (p < l || p > h) return false;
      continue;
    }
    double t0 = (l - p) / d, t1 = (h - p) / d;
    if (t0 > t1) std::swap(t0, t1);
    first = std::max(first, t0);
    last = std::min(last, t1);
  }
  if (!(first <= last)) return false;
  const Vec3 from = a, step = b - a;
  a = from + first * step;
  if (last < 1) b = from + last * step;
  return true;
}

struct MeshBoxes::Tree {
  std::vector<RTCBounds> bounds;
  std::unique_ptr<RTCDeviceTy, BoxesRelease> device;
  std::unique_ptr<RTCSceneTy, BoxesRelease> scene;
};

MeshBoxes::MeshBoxes(const std::vector<SightBox>& boxes, double slack) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  all_ = {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const SightBox& box : boxes) {
    all_.add(box.low);
    all_.add(box.high);
  }
  if (boxes.empty()) return;
  middle_ = all_.low * 0.5 + all_.high * 0.5;
  const double grown = slack + kFloatSlack * (norm(all_.high - all_.low) + slack);
  all_.grow(2 * grown);
  auto tree = std::make_shared<Tree>();
  tree->bounds.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    SightBox box = boxes[i];
    box.grow(grown);
    const Vec3 low = box.low - middle_, high = box.high - middle_;
    RTCBounds& b = tree->bounds[i];
    b.lower_x = floatAtMost(low.x);
    b.lower_y = floatAtMost(low.y);
    b.lower_z = floatAtMost(low.z);
    b.upper_x = floatAtLeast(high.x);
    b.upper_y = floatAtLeast(high.y);
    b.upper_z = floatAtLeast(high.z);
  }
  tree->device.reset(rtcNewDevice("threads=1"));
  tree->scene.reset(rtcNewScene(tree->device.get()));
  rtcSetSceneFlags(tree->scene.get(), RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(tree->device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, tree.get());
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* a) {
        *a->bounds_o = static_cast<const Tree*>(a->geometryUserPtr)->bounds[a->primID];
      },
      nullptr);
  // A box is reported and never hit, so that the traversal goes on to all.
  rtcSetGeometryIntersectFunction(geometry, [](const RTCIntersectFunctionNArguments* a) {
    if (a->valid[0] != 0) (*reinterpret_cast<const BoxesContext*>(a->context)->met)(a->primID);
  });
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree->scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree->scene.get());
  tree_ = std::move(tree);
}

void MeshBoxes::along(const Vec3& from, const Vec3& to, const std::function<void(std::uint32_t)>& met) const {
  Vec3 a = from, b = to;
  if (!tree_ || !all_.clip(a, b)) return;
  a = a - middle_;
  b = b - middle_;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(a.x);
  ray.ray.org_y = static_cast<float>(a.y);
  ray.ray.org_z = static_cast<float>(a.z);
  ray.ray.dir_x = static_cast<float>(b.x - a.x);
  ray.ray.dir_y = static_cast<float>(b.y - a.y);
  ray.ray.dir_z = static_cast<float>(b.z - a.z);
  ray.ray.tnear = 0;
  ray.ray.tfar = 1;
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  BoxesContext context;
  rtcInitIntersectContext(&context.context);
  context.met = &met;
  rtcIntersect1(tree_->scene.get(), &context.context, &ray);
}

}  // namespace arete
