// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/simplify/level.h"

#include <algorithm>
#include <array>

#include "engine/parallel/loop_threads.h"
#include "engine/parallel/per_thread.h"
#include "surface/simplify/cost.h"
#include "surface/simplify/fans.h"
#include "surface/simplify/removal.h"

namespace arete {
namespace {

using RecordState = RemovalRecord::State;

/// The grain of a parallel loop: late levels have few vertices with wide holes, which all threads share.
std::size_t shareOf(std::size_t size, std::size_t most) {
  return std::clamp<std::size_t>(size / 32, 1, most);
}

}  // namespace

std::size_t SurfaceLevels::level(double threshold, std::uint32_t number, MtRecorder::BatchOrder order) {
  s_.thresholds.collect(threshold, due_, filter_);
  if (due_.empty()) return 0;
  evaluate(threshold, number);
  set_.choose(due_, number, chosen_);
  claim();
  if (chosen_.empty()) return 0;
  remove(order);
  return chosen_.size();
}

void SurfaceLevels::evaluate(double threshold, std::uint32_t number) {
  PerThread<SurfaceCost> costs([&] { return SurfaceCost(s_); });
  filter_(due_.size(), shareOf(due_.size(), 128), due_,
          [&](std::size_t begin, std::size_t end, VertexId* to) {
            SurfaceCost& cost = costs.local();
            for (std::size_t i = begin; i != end; ++i) {
              const VertexId v = due_[i];
              RemovalRecord& record = s_.records[v];
              record.settle();
              if (record.state == RecordState::exact && !cost.isStillValid(v, record))
                record.state = RecordState::stale;
              if (record.state != RecordState::exact) {
                cost.evaluate(v, threshold, record);
                s_.thresholds.set(v, record.nextThreshold());
              }
              if (record.state != RecordState::exact || record.cost > threshold) continue;
              set_.enter(v, number);
              *to++ = v;
            }
            return to;
          });
}

void SurfaceLevels::claim() {
  claimed_.clear();
  std::size_t kept = 0;
  SurfaceHole hole;
  std::vector<std::uint64_t> wanted;
  for (const VertexId v : chosen_) {
    hole.gather(s_, v);
    const Star& star = hole.star();
    const VertexId around(s_.records[v].witness);
    const auto edge = [](VertexId a, VertexId b) {
      return std::uint64_t{std::min(a, b).index()} << 32 | std::max(a, b).index();
    };
    wanted.clear();
    // The new edges of the fan.
    int corner = 0;
    while (star.link[corner] != around) ++corner;
    for (int k = 2; k + 1 < star.linkSize; ++k)
      wanted.push_back(edge(around, star.link[(corner + k) % star.linkSize]));
    if (star.isOpen) wanted.push_back(edge(star.link[0], star.link[star.linkSize - 1]));
    // A single triangle has no new edge, and the hole on its other side may want the same one: an old edge
    // stands for it, the same for both.
    if (!star.isOpen && star.linkSize == 3) {
      std::array<VertexId, 3> corners{star.link[0], star.link[1], star.link[2]};
      std::ranges::sort(corners);
      wanted.push_back(edge(corners[0], corners[1]));
    }
    // Both sides of the edge that a line is going to have may be the last triangle of a part.
    if (const int ear = hole.ear(); ear >= 0)
      wanted.push_back(edge(star.link[ear], star.link[ear + 1 < star.linkSize ? ear + 1 : 0]));
    if (std::ranges::any_of(wanted, [&](std::uint64_t e) { return claimed_.contains(e); })) {
      s_.records[v].state = RecordState::stale;
      s_.thresholds.set(v, ThresholdList::kNow);
      continue;
    }
    claimed_.insert(wanted.begin(), wanted.end());
    chosen_[kept++] = v;
  }
  chosen_.resize(kept);
}

void SurfaceLevels::remove(MtRecorder::BatchOrder order) {
  linkSizes_.resize(chosen_.size());
  for (std::size_t i = 0; i < chosen_.size(); ++i) linkSizes_[i] = s_.records[chosen_[i]].linkSize;
  batch_.begin(order, linkSizes_);
  s_.starLabels.resize(s_.recorder.firstSlot(batch_.removal(chosen_.size())));
  s_.starAttributeErrors.resize(s_.recorder.firstSlot(batch_.removal(chosen_.size())));
  PerThread<SurfaceRemover> removers([&] { return SurfaceRemover(s_); });
  forRanges(LoopThreads::all, chosen_.size(), shareOf(chosen_.size(), 64),
            [&](std::size_t begin, std::size_t end) {
              SurfaceRemover& remover = removers.local();
              for (std::size_t i = begin; i != end; ++i)
                batch_.setOpen(i, remover.remove(chosen_[i], batch_.removal(i), batch_.seams(i)));
            });
  batch_.end(chosen_);
}

}  // namespace arete
