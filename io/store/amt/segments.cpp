// SPDX-License-Identifier: GPL-3.0-or-later
//
// Segments of all chunks are numbered one after the other, in the order of the directory. Each has a state:
// used, checked or both; only those that are used and not checked are hashed. The smallest altered segment is
// reported, so the message does not depend on the threads.
#include "io/store/amt/segments.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cassert>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/shared_progress.h"
#include "engine/parallel/with_threads.h"
#include "io/store/format/checksum.h"

namespace arete {
namespace {

// States of a segment. A checked one that is marked again is kMarked | kChecked; kAsked: load() has it, or
// will.
constexpr std::uint8_t kMarked = 1, kChecked = 2, kAsked = 4;

}  // namespace

AmtSegments::AmtSegments(const AmtFile& file) : file_(file) {
  std::size_t segments = 0;
  for (const AmtChunk& chunk : file.chunks()) {
    positions_.push_back({segments, chunk.elementBytes});
    segments += amtSegmentCount(chunk.tag, chunk.bytes);
  }
  positions_.push_back({segments, 1});
  states_.resize(segments);
}

AmtSegments::Chunk AmtSegments::of(const AmtTag& tag) const {
  const auto chunks = file_.chunks();
  const auto found = std::ranges::find(chunks, tag, &AmtChunk::tag);
  assert(found != chunks.end());
  return {static_cast<std::size_t>(found - chunks.begin())};
}

void AmtSegments::touch(Chunk chunk, std::uint64_t begin, std::uint64_t end) {
  if (begin >= end) return;
  const Position& position = positions_[chunk.index];
  const std::uint64_t first = begin * position.elementBytes / kAmtSegmentBytes,
                      last = (end * position.elementBytes - 1) / kAmtSegmentBytes;
  const auto bytes = file_.bytes(file_.chunks()[chunk.index]);
  for (std::uint64_t i = first; i <= last; ++i) {
    std::uint8_t& state = states_[position.first + i];
    state |= kMarked;
    if ((state & kAsked) != 0) continue;
    state |= kAsked;
    const std::uint64_t from = i * kAmtSegmentBytes,
                        to = std::min<std::uint64_t>(bytes.size(), from + kAmtSegmentBytes);
    unloaded_.push_back(bytes.subspan(from, to - from));
  }
}

Status AmtSegments::load(const RunContext& context, std::span<const std::byte> beside) {
  unloaded_.push_back(beside);
  const Status loaded = file_.container().loadParts(unloaded_, context);
  unloaded_.clear();
  return loaded;
}

void AmtSegments::touchAll(Chunk chunk) {
  const AmtChunk& c = file_.chunks()[chunk.index];
  touch(chunk, 0, c.bytes / c.elementBytes);
}

void AmtSegments::touchAll() {
  for (std::size_t i = 0; i < file_.chunks().size(); ++i)
    if (positions_[i].first < positions_[i + 1].first) touchAll(Chunk{i});
}

std::size_t AmtSegments::chunkOf(std::size_t segment) const {
  const auto behind = std::ranges::upper_bound(positions_, segment, {}, &Position::first);
  return static_cast<std::size_t>(behind - positions_.begin()) - 1;
}

Status AmtSegments::check(const RunContext& context) {
  ARETE_CHECK(load(context));
  ARETE_CHECK(file_.container().loaded());
  std::vector<std::size_t> segments;
  for (std::size_t i = 0; i < states_.size(); ++i)
    if ((states_[i] & (kMarked | kChecked)) == kMarked) segments.push_back(i);
  std::atomic<std::size_t> altered = states_.size();
  SharedProgress progress(context, "check checksums", segments.size() + 1);
  withThreads(context, [&] {
    parallelFor(std::size_t{0}, segments.size(), [&](std::size_t i) {
      if (context.cancelled()) return;
      const std::size_t segment = segments[i], c = chunkOf(segment);
      const auto bytes = file_.bytes(file_.chunks()[c]);
      const std::uint64_t at = (segment - positions_[c].first) * kAmtSegmentBytes;
      const auto these = bytes.subspan(at, std::min<std::uint64_t>(kAmtSegmentBytes, bytes.size() - at));
      progress.add();
      if (amtChecksum(these) == file_.segmentChecksums()[segment]) {
        states_[segment] = kChecked | kAsked;
        return;
      }
      std::size_t known = altered;
      while (segment < known && !altered.compare_exchange_weak(known, segment)) {
      }
    });
  });
  progress.add();
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the check was interrupted", file_.path());
  if (altered == states_.size()) return {};
  return failure(ErrorCode::corrupt,
                 fmt::format("has been altered: the checksum of chunk {} does not match",
                             file_.chunks()[chunkOf(altered)].name()),
                 file_.path());
}

}  // namespace arete
