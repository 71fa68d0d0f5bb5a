// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/pages/page_header.h"

#include "engine/mt/hole_limit.h"
#include "io/store/entropy/number_bytes.h"

namespace arete::packed {
namespace {

constexpr std::uint32_t kMostOfARun = MultiTriangulation::kNone - 1;

bool readHeader(std::span<const std::byte> bytes, bool isOfSurface, Packet& page, Segment& segment) {
  NumberReader in(bytes);
  segment.runs = in.number(MultiTriangulation::kBands);
  std::uint64_t nodes = 0;
  for (std::uint32_t i = 0; i < segment.runs && !in.isBad(); ++i) {
    Run run;
    run.band = segment.firstBand;
    if (i > 0) {
      const std::uint32_t above = page.runs.back().band, below = in.number(MultiTriangulation::kBands);
      if (below >= above) return false;
      run.band = above - 1 - below;
    } else if (!page.runs.empty() && run.band >= page.runs.back().band) {
      return false;
    }
    run.nodes = in.number(kMostOfARun);
    const std::uint64_t more = in.number();
    run.listed = in.number(run.nodes);
    run.spread = in.plain<std::uint8_t>();
    if (in.isBad() || run.nodes == 0 || more > std::uint64_t{kMaxHoleCorners - 3} * run.nodes) return false;
    const std::uint64_t slots = 3 * std::uint64_t{run.nodes} + more;
    if (slots > kMostOfARun) return false;
    run.slots = static_cast<std::uint32_t>(slots);
    nodes += run.nodes;
    page.runs.push_back(run);
  }
  std::uint64_t streams = 0;
  for (std::uint32_t& n : segment.streamBytes) streams += n = in.number(kMostOfARun);
  segment.carriedBytes = isOfSurface ? in.number(kMostOfARun) : 0;
  streams += segment.carriedBytes;
  if (in.isBad() || nodes != segment.nodes || streams != in.left() || bytes.size() < leastBytes(nodes))
    return false;
  segment.headerBytes = static_cast<std::uint32_t>(bytes.size() - in.left());
  return true;
}

}  // namespace

std::vector<std::byte> segmentHeader(const Segment& segment, std::span<const Run> runs, bool isOfSurface) {
  NumberWriter out;
  out.number(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    // The directory has the first one.
    if (i > 0) out.number(runs[i - 1].band - 1 - run.band);
    out.number(run.nodes);
    out.number(run.slots - 3 * run.nodes);
    out.number(run.listed);
    out.plain(run.spread);
  }
  for (const std::uint32_t n : segment.streamBytes) out.number(n);
  if (isOfSurface) out.number(segment.carriedBytes);
  return out.take();
}

bool readHeaders(std::span<const std::byte> nodes, bool isOfSurface, Packet& page) {
  page.runs.clear();
  for (Segment& segment : page.segments) {
    const std::uint64_t begin = segment.begin();
    if (!readHeader(nodes.subspan(begin, segment.bytes()), isOfSurface, page, segment)) return false;
    segment.offset = begin + segment.headerBytes;
  }
  return true;
}

}  // namespace arete::packed
