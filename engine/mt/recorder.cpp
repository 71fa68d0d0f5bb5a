// SPDX-License-Identifier: GPL-3.0-or-later
//
// While recording, nodes are removals and triangles have recorder ids; both are numbered bottom-up. A
// removal's saturated error and sphere are complete as soon as it is recorded, because its children (the
// removals that created its star's triangles) belong to earlier batches: the saturated error is the maximum
// over its floor's errors and its children's saturated errors, and the sphere grows to enclose the
// children's.
//
// recorder_finish.cpp turns the records into the finished arrays.
#include "engine/mt/recorder.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <utility>

#include "engine/mt/enclosing_ball.h"

namespace arete {

MtRecorder::MtRecorder(std::uint32_t finestTriangles, std::uint32_t mostRemovals, OutwardScale scale,
                       MetricFrame metric)
    : finestTriangles_(finestTriangles), scale_(scale), metric_(metric) {
  // A link size is one byte. Only addresses are reserved here: memory is taken as removals come.
  constexpr std::size_t kMostSlots = std::numeric_limits<std::uint8_t>::max();
  const std::size_t removals = mostRemovals;
  slotBegin_.reserve(removals + 1);
  vertex_.reserve(removals);
  saturated_.reserve(removals);
  sphere_.reserve(removals);
  link_.reserve(removals * kMostSlots);
  ceiling_.reserve(removals * kMostSlots);
  floor_.reserve(removals * kMostSlots);
  slotBegin_.resize(1);
  slotBegin_[0] = 0;
}

RemovalId MtRecorder::beginBatch(BatchOrder order, std::span<const std::uint8_t> linkSizes) {
  // All room of a batch is made here, so that its removals can be recorded in parallel.
  const std::lock_guard lock(growing_);
  const std::uint32_t first = removals_;
  const std::size_t count = linkSizes.size();
  slotBegin_.resize(removals_ + count + 1);
  for (std::size_t i = 0; i < count; ++i) slotBegin_[first + i + 1] = slotBegin_[first + i] + linkSizes[i];
  batches_.push_back({order, first, static_cast<std::uint32_t>(count)});
  removals_ += static_cast<std::uint32_t>(count);
  vertex_.resize(removals_);
  saturated_.resize(removals_);
  sphere_.resize(removals_);
  // A floor has two triangles fewer than its link has vertices.
  const std::size_t slots = slotBegin_[removals_], floorTriangles = slots - 2 * std::size_t(removals_);
  link_.resize(slots);
  ceiling_.resize(slots);
  floor_.resize(floorTriangles);
  return RemovalId(first);
}

void MtRecorder::record(RemovalId id, const VertexRemoval& what) {
  const std::uint32_t removal = id.index();
  const std::uint32_t begin = slotBegin_[removal];
  const std::size_t slots = what.link.size();
  assert(slots == slotBegin_[removal + 1] - begin && slots >= 3);
  assert(what.ceiling.size() == slots - (what.isOpen ? 1 : 0) && what.floor.size() == slots - 2);

  vertex_[removal] = what.vertex.index();
  for (std::size_t i = 0; i < slots; ++i) {
    link_[begin + i] = what.link[i].index();
    ceiling_[begin + i] = i < what.ceiling.size() ? what.ceiling[i].index() : kNone;
  }

  const std::size_t firstFloor = begin - 2 * std::size_t(removal);
  for (std::size_t i = 0; i < slots - 2; ++i) floor_[firstFloor + i] = what.floor[i];
}

void MtRecorder::saturate(RemovalId removal, const VertexRemoval& what) {
  std::uint16_t saturated = 0;
  for (const FloorCodes& codes : what.floor) saturated = std::max(saturated, codes.error);
  EnclosingBall ball = EnclosingBall::around(what.metricPositions);
  for (const RemovalId child : what.ceilingCreator) {
    if (!child.isValid()) continue;
    saturated = std::max(saturated, saturated_[child.index()]);
    ball.encloseChild(sphere_[child.index()]);
  }
  saturated_[removal.index()] = saturated;
  sphere_[removal.index()] = ball.rounded();
}

MultiTriangulation withVertices(const MultiTriangulation& mt, const VertexArrays& vertices,
                                std::shared_ptr<const void> owner) {
  MtArrays a = mt.arrays();
  a.vertices = vertices;
  // The result shares the arrays of the MT and keeps them and the vertices alive.
  struct Both {
    MultiTriangulation mt;
    std::shared_ptr<const void> vertices;
  };
  return MultiTriangulation(a, std::make_shared<const Both>(Both{mt, std::move(owner)}));
}

}  // namespace arete
